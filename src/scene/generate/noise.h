/*
 * noise.h: smooth random fields for the generators, equal on every machine.
 */
#ifndef FIRN_SCENE_GENERATE_NOISE_H
#define FIRN_SCENE_GENERATE_NOISE_H

#include <cglm/types-struct.h>
#include <stdint.h>

/* Returns a hash of x. */
uint32_t noise_hash(uint32_t x);

/*
 * Value noise in [-1, 1] with two continuous derivatives: random values at the points with whole
 * coordinates, interpolated. Its slope stays below 4. Seeds give unrelated fields. Coordinates
 * must be below 2^30.
 */
float noise_value(vec3s p, uint32_t seed);

/* Returns three unrelated fields as a vector. */
vec3s noise_vector(vec3s p, uint32_t seed);

/* A sum of `octaves` fields, each of twice the frequency and half the height, in (-2, 2). */
float noise_fractal(vec3s p, int octaves, uint32_t seed);

enum {
    NOISE_PLANE_OCTAVES_MAX = 3,
    NOISE_PLANE_SIDE_MAX = 32,
};

/* The random values of noise_fractal() in the plane z = 0, cached for many evaluations. */
struct noise_plane {
    int octaves;
    float corners[NOISE_PLANE_OCTAVES_MAX][NOISE_PLANE_SIDE_MAX][NOISE_PLANE_SIDE_MAX]; /* x, y */
};

/* Fills the cache for coordinates from 0 to below NOISE_PLANE_SIDE_MAX - 1 in the last octave. */
void noise_plane_init(struct noise_plane *plane, int octaves, uint32_t seed);

/* Returns the same bits as noise_fractal(). */
float noise_plane_at(const struct noise_plane *plane, float x, float y);

#endif
