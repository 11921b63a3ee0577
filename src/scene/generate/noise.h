/* noise.h: smooth procedural noise, bit-identical on every machine. */
#ifndef FIRN_SCENE_GENERATE_NOISE_H
#define FIRN_SCENE_GENERATE_NOISE_H

#include <cglm/types-struct.h>
#include <stdint.h>

uint32_t noise_hash(uint32_t x);

/* Returns value noise in [-1, 1], interpolated between random values at integer coordinates. Two
 * derivatives are continuous, and slopes are below 4. Different seeds give uncorrelated noise.
 * Coordinates must be below 2^30. */
float noise_value(vec3s p, uint32_t seed);

/* Returns a vector of three uncorrelated noise values. */
vec3s noise_vector(vec3s p, uint32_t seed);

/* Returns fractal noise in (-2, 2), the sum of `octaves` noise fields. Each field has twice the
 * frequency and half the amplitude of the previous one. */
float noise_fractal(vec3s p, int octaves, uint32_t seed);

enum {
    NOISE_PLANE_OCTAVES_MAX = 3,
    NOISE_PLANE_SIDE_MAX = 32,
};

/* Cached lattice values of noise_fractal() in the plane z = 0. */
struct noise_plane {
    int octaves;
    /* lattice values by octave, x, y */
    float corners[NOISE_PLANE_OCTAVES_MAX][NOISE_PLANE_SIDE_MAX][NOISE_PLANE_SIDE_MAX];
};

/* Fills a cache for x and y from 0 to (NOISE_PLANE_SIDE_MAX - 1) / 2^(octaves - 1), exclusive. */
void noise_plane_init(struct noise_plane *plane, int octaves, uint32_t seed);

/* Returns noise_fractal() at (x, y, 0), bit-identical but faster, from the cache. */
float noise_plane_at(const struct noise_plane *plane, float x, float y);

#endif
