/*
 * cloud.h: how dense the bubbles of cloudy ice are that are too small to be seen one by one.
 *
 * Ice freezes from its surface inwards, and pushes air ahead: the rim is clear, and what freezes
 * last is white. The density depends on the depth below the surface, relative to the greatest in
 * the object, which a texture of CLOUD_SIZE texels a side has (src/scene/depth_field.h).
 */
#ifndef SHADERS_CLOUD_H
#define SHADERS_CLOUD_H
#include "abi_math.h"

#define CLOUD_SIZE 64

#define CLOUD_RIM  0.18f /* relative depth to which ice is clear */
#define CLOUD_CORE 0.42f /* relative depth from which it is as dense as at the middle */

/* Returns the density at a relative depth, 0 to 1, as a share of the greatest. */
ABI_FUNCTION float cloud_share(float depth)
{
    return glm_smoothstep(CLOUD_RIM, CLOUD_CORE, depth);
}

#endif
