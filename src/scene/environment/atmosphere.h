/*
 * atmosphere.h: radiance of a clear sky: single scattering by ray marching, plus tabulated multiple
 * scattering (Hillaire 2020, "A scalable and production ready sky and atmosphere rendering
 * technique"; constants of air, ozone and the planet by Bruneton 2017).
 *
 * Summing every order of scattering would need nested integrals. Higher orders are assumed to be
 * isotropic, so that they form a geometric series. Directions have +Y up. Radiance is for a sun of
 * irradiance 1 per channel above the atmosphere, and excludes the sun's disc. The caller owns the
 * tables; several threads may read them.
 */
#ifndef FIRN_SCENE_ENVIRONMENT_ATMOSPHERE_H
#define FIRN_SCENE_ENVIRONMENT_ATMOSPHERE_H

#include <cglm/types-struct.h>

enum {
    ATMOSPHERE_TRANSMITTANCE_WIDTH = 256,     /* transmittance table: angles */
    ATMOSPHERE_TRANSMITTANCE_HEIGHT = 64,     /* transmittance table: heights */
    ATMOSPHERE_MULTIPLE_SCATTERING_SIZE = 32, /* sun elevations, and heights */
};

struct atmosphere {
    vec3s haze;   /* Mie scattering coefficient of aerosols at sea level, 1/km */
    float albedo; /* ground albedo, everywhere */
    vec3s transmittance_table[ATMOSPHERE_TRANSMITTANCE_HEIGHT][ATMOSPHERE_TRANSMITTANCE_WIDTH];
    vec3s multiple_scattering[ATMOSPHERE_MULTIPLE_SCATTERING_SIZE]
                             [ATMOSPHERE_MULTIPLE_SCATTERING_SIZE];
};

/* Computes the tables of transmittance and multiple scattering. `turbidity` is the extinction of
 * air with haze, divided by the extinction of air alone: 1 without haze, 2 in mountains, 3 in
 * summer, 5 when hazy. `albedo` is the ground albedo, 0 to 1. */
void atmosphere_make(struct atmosphere *atmosphere, float turbidity, float albedo);

/* Returns a ray's transmittance from `height` kilometres above the ground to the top of the
 * atmosphere. If the ground occludes the ray, returns 0. `cosine` is of the ray's zenith angle. */
vec3s atmosphere_transmittance(const struct atmosphere *atmosphere, float height, float cosine);

/* Returns the radiance that arrives from the unit direction `dir` at `height` kilometres above the
 * ground. Light from the ground is included. `sun` is the unit direction to the sun. */
vec3s atmosphere_radiance(const struct atmosphere *atmosphere, float height, vec3s dir, vec3s sun);

#endif
