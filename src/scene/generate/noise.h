/*
 * noise.h: smooth random fields for the generators; the same on every machine.
 */
#ifndef FIRN_SCENE_GENERATE_NOISE_H
#define FIRN_SCENE_GENERATE_NOISE_H

#include <cglm/struct.h>
#include <stdint.h>

/* A number to look random beside those of other numbers. */
uint32_t noise_hash(uint32_t x);

/*
 * Value noise in [-1, 1] with two continuous derivatives: random values at the points with whole
 * coordinates, interpolated. Its slope stays below 4. Seeds give unrelated fields. Coordinates
 * must be below 2^30.
 */
float noise_value(vec3s p, uint32_t seed);

/* Three unrelated fields as a vector. */
vec3s noise_vector(vec3s p, uint32_t seed);

/* A sum of `octaves` fields, each of twice the frequency and half the height, in (-2, 2). */
float noise_fractal(vec3s p, int octaves, uint32_t seed);

enum {
    NOISE_PLANE_OCTAVES_MAX = 3,
    NOISE_PLANE_SIDE_MAX = 32,
};

/* The random values of noise_fractal() where z is 0, kept for those who ask often. */
struct noise_plane {
    int octaves;
    float corners[NOISE_PLANE_OCTAVES_MAX][NOISE_PLANE_SIDE_MAX][NOISE_PLANE_SIDE_MAX]; /* x, y */
};

/* For x and y from 0 on; in the last octave they stay below NOISE_PLANE_SIDE_MAX - 1. */
void noise_plane_init(struct noise_plane *plane, int octaves, uint32_t seed);

/* What noise_fractal() gives, to the bit. */
float noise_plane_at(const struct noise_plane *plane, float x, float y);

#endif
