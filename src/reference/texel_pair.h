/* texel_pair.h: which texels of a row a bilinear filter reads. */
#ifndef FIRN_REFERENCE_TEXEL_PAIR_H
#define FIRN_REFERENCE_TEXEL_PAIR_H

#include <stdbool.h>
#include <stdint.h>

/* The two texels around a coordinate, and the weight of the second one. */
struct texel_pair {
    uint32_t first, second;
    float share;
};

/* `coordinate` is from 0 to 1 across `count` texels, which repeat beyond, or end. */
struct texel_pair texel_pair_at(float coordinate, uint32_t count, bool repeat);

#endif
