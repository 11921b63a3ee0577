/* linear_filter.h: texel indices and weights of a linear texture lookup along one axis. */
#ifndef FIRN_REFERENCE_LINEAR_FILTER_H
#define FIRN_REFERENCE_LINEAR_FILTER_H

#include <stdbool.h>
#include <stdint.h>

/* The two texels around a texture coordinate, and the weight of the second one. */
struct linear_filter {
    uint32_t first, second;
    float weight;
};

/* Returns the texels of a lookup at `coordinate`, 0 to 1 over `count` texels. Beyond that range the
 * texture repeats or is clamped to its edge. */
struct linear_filter linear_filter_at(float coordinate, uint32_t count, bool repeat);

#endif
