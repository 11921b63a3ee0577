/*
 * atmosphere.h: radiance of a clear sky, by single scattering along the ray and an estimate of all
 * further orders (Hillaire 2020, "A scalable and production ready sky and atmosphere rendering
 * technique"; constants of air, ozone and the planet by Bruneton 2017).
 *
 * Directions have +Y up. Radiance is that for a sun whose irradiance above the air is 1 in each
 * channel; the sun's disc is not part of it. Tables are in memory that the caller owns; a finished
 * atmosphere may be read by several threads.
 */
#ifndef FIRN_SCENE_ATMOSPHERE_H
#define FIRN_SCENE_ATMOSPHERE_H

#include <cglm/types-struct.h>

enum {
    ATMOSPHERE_PATH_WIDTH = 256, /* of the table of transmittances: angles */
    ATMOSPHERE_PATH_HEIGHT = 64, /* heights */
    ATMOSPHERE_GLOW_SIDE = 32,   /* of the table of further orders: sun's elevations, heights */
};

struct atmosphere {
    vec3s haze;   /* scattering coefficient of aerosols at sea level, 1/km */
    float albedo; /* of the ground, all around the planet */
    vec3s path[ATMOSPHERE_PATH_HEIGHT][ATMOSPHERE_PATH_WIDTH];
    vec3s glow[ATMOSPHERE_GLOW_SIDE][ATMOSPHERE_GLOW_SIDE];
};

/* Computes the tables. `turbidity` is extinction by air and haze over that by air alone: 2 in the
 * mountains, 3 in summer, 5 where it is hazy; 1 has no haze. `albedo` is from 0 to 1. */
void atmosphere_make(struct atmosphere *atmosphere, float turbidity, float albedo);

/* Returns the transmittance from `height`, kilometres above the ground, to the end of the air.
 * `cosine` is that of the angle from the zenith; 0 where the ground is in the way. */
vec3s atmosphere_transmittance(const struct atmosphere *atmosphere, float height, float cosine);

/* Returns the radiance that arrives at `height`, kilometres, from the unit direction `dir`: of the
 * air, and of the ground below the horizon. `sun` is the unit direction to the sun. */
vec3s atmosphere_radiance(const struct atmosphere *atmosphere, float height, vec3s dir, vec3s sun);

#endif
