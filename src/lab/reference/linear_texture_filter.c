/* linear_texture_filter.c: the two texels and the weight of a linear texture lookup. */
#include "src/lab/reference/linear_texture_filter.h"
#include <math.h>

static uint32_t wrapped(double index, uint32_t count)
{
    return (uint32_t)(index - floor(index / count) * count);
}

struct linear_filter linear_filter_at(float coordinate, uint32_t count, bool repeat)
{
    const double x = (double)coordinate * count - 0.5;
    const double first = floor(x);
    const double last = count - 1.0;
    if (repeat)
        return (struct linear_filter){ wrapped(first, count), wrapped(first + 1, count),
                                       (float)(x - first) };
    return (struct linear_filter){
        (uint32_t)fmin(fmax(first, 0), last),
        (uint32_t)fmin(fmax(first + 1, 0), last),
        (float)(x - first),
    };
}
