/*
 * cloud.h: density field of cloudy ice, a scattering medium of microscopic bubbles.
 *
 * Ice freezes from its surface inwards and pushes dissolved air ahead: the rim is clear, and what
 * freezes last is white. The density depends on the depth below the surface relative to the maximum
 * depth in the object; it is stored in 3D grids of CLOUD_SIZE texels a side (src/scene/clouds.h).
 */
#ifndef SHADERS_CLOUD_H
#define SHADERS_CLOUD_H
#include "abi.h"
#include "abi_math.h"

#define CLOUD_SIZE 64

/* Binding of the density grids, CLOUD_SIZE array layers each. A texel holds the density of its own
 * layer and of the next one, so that one bilinear lookup gives both for interpolation along z. */
#define CLOUD_TEXELS 16
#define CLOUD_AROUND 17 /* binding of LIT_AROUND in refract_cloud.glsl */

#define CLOUD_RIM  0.18f /* relative depth down to which the ice is clear */
#define CLOUD_VEIL 0.42f /* relative depth at which the thin veil reaches its full density */
#define CLOUD_CORE 0.55f /* relative depth at which the white core begins */
#define CLOUD_MILK 0.9f  /* relative depth at which the core reaches its full density */

#define CLOUD_VEIL_SHARE 0.25f /* density of the veil relative to the core's */

/* Density field of one object and its bounds, in object space. */
struct cloud_place {
    vec3s low;         /* minimum corner of the grid's box */
    float extinction;  /* extinction coefficient at the maximum density, 1 / metre */
    vec3s texels_each; /* texels per metre along each axis */
    float first_layer;
    vec3s from, to; /* box of the non-zero densities, inside the grid's box */
};

/* Returns the density relative to its maximum at a relative depth from 0 to 1. */
ABI_FUNCTION float cloud_share(float depth)
{
    float core = glm_smoothstep(CLOUD_CORE, CLOUD_MILK, depth);
    return glm_smoothstep(CLOUD_RIM, CLOUD_VEIL, depth) *
           (CLOUD_VEIL_SHARE + (1.0f - CLOUD_VEIL_SHARE) * core);
}

#endif
