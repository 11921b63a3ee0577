/*
 * cloud.h: how dense the bubbles of cloudy ice are that are too small to be seen one by one.
 *
 * Ice freezes from its surface inwards, and pushes air ahead: the rim is clear, and what freezes
 * last is white. The density depends on the depth below the surface, relative to the greatest in
 * the object; textures of CLOUD_SIZE texels a side have it (src/scene/clouds.h).
 */
#ifndef SHADERS_CLOUD_H
#define SHADERS_CLOUD_H
#include "abi.h"
#include "abi_math.h"

#define CLOUD_SIZE 64

/* Binding of the densities, CLOUD_SIZE layers each. A texel has that of its own layer, and that of
 * the next one, so that one lookup finds all that is between two layers. */
#define CLOUD_TEXELS 16
#define CLOUD_AROUND 17 /* binding of LIT_AROUND in refract_cloud.glsl */

#define CLOUD_RIM  0.18f /* relative depth to which ice is clear */
#define CLOUD_VEIL 0.42f /* relative depth at which a veil is complete */
#define CLOUD_CORE 0.55f /* relative depth at which the white core begins */
#define CLOUD_MILK 0.9f  /* relative depth at which it is complete */

#define CLOUD_VEIL_SHARE 0.25f /* density of the veil as a share of the core's */

/* A cloud, in the space of the objects. */
struct cloud_place {
    vec3s low;         /* of the box of its texels */
    float extinction;  /* 1 / metre, where it is densest */
    vec3s texels_each; /* texels a metre */
    float first_layer;
    vec3s from, to; /* box outside of which there is no cloud, in that of the texels */
};

/* Returns the density at a relative depth, 0 to 1, as a share of the greatest. */
ABI_FUNCTION float cloud_share(float depth)
{
    float core = glm_smoothstep(CLOUD_CORE, CLOUD_MILK, depth);
    return glm_smoothstep(CLOUD_RIM, CLOUD_VEIL, depth) *
           (CLOUD_VEIL_SHARE + (1.0f - CLOUD_VEIL_SHARE) * core);
}

#endif
