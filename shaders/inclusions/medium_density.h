/*
 * medium_density.h: density field of the scattering medium that microscopic bubbles form in ice.
 *
 * Ice freezes from its surface inwards and pushes dissolved air ahead: the rim is clear, and what
 * freezes last is white. The density depends on the depth below the surface relative to the maximum
 * depth in the object. src/scene/medium_density.h stores it in 3D grids.
 */
#ifndef SHADERS_INCLUSIONS_MEDIUM_DENSITY_H
#define SHADERS_INCLUSIONS_MEDIUM_DENSITY_H
#include "abi.h"
#include "abi_math.h"

#define MEDIUM_SIZE 64 /* side of a density grid, texels */
#define MEDIUM_MAX  8  /* scattering media per scene */

/* Binding of the density grids. Each grid has MEDIUM_SIZE array layers. A texel holds the densities
 * of two successive layers, so one bilinear lookup suffices for interpolation along z. */
#define MEDIUM_TEXELS 16
#define MEDIUM_AROUND 17 /* binding of LIT_ENVIRONMENT_BINDING in refract_medium.glsl */

#define MEDIUM_RIM        0.18f /* relative depth down to which the ice is clear */
#define MEDIUM_VEIL       0.42f /* relative depth at which the thin veil reaches its full density */
#define MEDIUM_CORE_BEGIN 0.55f /* relative depth at which the white core begins */
#define MEDIUM_CORE_FULL  0.9f  /* relative depth at which the core reaches its full density */

#define MEDIUM_VEIL_DENSITY 0.25f /* density of the thin veil relative to that of the white core */

/* Density field of an object, with its bounding box. Coordinates are in object space. */
struct medium_field {
    vec3s min_corner;       /* minimum corner of the grid's box */
    float extinction;       /* extinction coefficient at the maximum density, 1 / metre */
    vec3s texels_per_metre; /* texels per metre along each axis */
    float first_layer;
    vec3s from, to; /* bounding box of the non-zero densities, inside the grid's box */
};

/* Returns the density, 0 to 1, at a relative depth from 0 (surface) to 1 (deepest point). */
ABI_FUNCTION float medium_relative_density(float depth)
{
    float core = glm_smoothstep(MEDIUM_CORE_BEGIN, MEDIUM_CORE_FULL, depth);
    return glm_smoothstep(MEDIUM_RIM, MEDIUM_VEIL, depth) *
           (MEDIUM_VEIL_DENSITY + (1.0f - MEDIUM_VEIL_DENSITY) * core);
}

/* Evaluates the Henyey-Greenstein phase function, relative to isotropic scattering. */
ABI_FUNCTION float medium_phase(float cosine, float g)
{
    float base = 1.0f + g * g - 2.0f * g * cosine;
    return (1.0f - g * g) / (base * sqrtf(base));
}

#endif
