/* linear_texture_filter.h: texel indices and weights of linear texture filtering along one axis. */
#ifndef FIRN_LAB_REFERENCE_LINEAR_TEXTURE_FILTER_H
#define FIRN_LAB_REFERENCE_LINEAR_TEXTURE_FILTER_H

#include <stdbool.h>
#include <stdint.h>

/* The two texels nearest to a texture coordinate, and the interpolation weight of the second. */
struct linear_filter {
    uint32_t first, second;
    float weight;
};

/* Returns the two texels nearest to a texture coordinate. Coordinates 0 to 1 span `count` texels.
 * Outside 0 to 1, the texture repeats if `repeat` is true, else the coordinate is clamped. */
struct linear_filter linear_filter_at(float coordinate, uint32_t count, bool repeat);

#endif
