/* linear_texture_filter.h: texel indices and weights of linear texture filtering along one axis. */
#ifndef FIRN_REFERENCE_LINEAR_TEXTURE_FILTER_H
#define FIRN_REFERENCE_LINEAR_TEXTURE_FILTER_H

#include <stdbool.h>
#include <stdint.h>

/* The two texels nearest to a texture coordinate, and the interpolation weight of the second. */
struct linear_filter {
    uint32_t first, second;
    float weight;
};

/* Returns the two texels for a texture coordinate, 0 to 1 across `count` texels. Beyond this range
 * the texture repeats if `repeat` is true, else the coordinate is clamped to the edge. */
struct linear_filter linear_filter_at(float coordinate, uint32_t count, bool repeat);

#endif
