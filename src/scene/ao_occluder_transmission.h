/*
 * ao_occluder_transmission.h: fractions of sky light and ground light that a body brings to its
 * base.
 *
 * Paths are traced backwards from the ground around the body: through refraction, Fresnel
 * reflection, absorption and scattering in its medium. Paths that leave upwards gather sky light,
 * the others ground light. A clear body loses no energy: a uniform environment stays uniform.
 */
#ifndef FIRN_SCENE_AO_OCCLUDER_TRANSMISSION_H
#define FIRN_SCENE_AO_OCCLUDER_TRANSMISSION_H

#include "src/scene/ao_occluders.h"

/* Homogeneous medium that fills a body. */
struct ao_medium {
    float ior;        /* refractive index, relative to the outside */
    float scattering; /* reduced scattering coefficient (as for isotropic scattering), 1 / metre */
    float diffuse_fraction; /* fraction that the surface reflects diffusely */
    vec3s absorption;       /* absorption coefficient, 1 / metre */
    vec3s tint;             /* tint of diffuse transmission and reflection */
};

/* Fractions of the light from a body that come from sky and ground. Their sum is at most 1. */
struct ao_light {
    vec3s sky, ground;
    float undeviated; /* fraction of sky light, almost undeviated */
};

/* Estimates the light that a body sends to the ground near its base, by tracing random rays. The
 * result is deterministic, because the random sequence is fixed. `up` is a unit vector. */
struct ao_light ao_light_of(const struct ao_shape *shape, const struct ao_medium *medium, vec3s up);

#endif
