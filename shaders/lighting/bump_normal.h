/* bump_normal.h: bump-mapped normal of the ice's surface, for shaders and C. Surface gradients need
 * no parametrisation (Mikkelsen 2010, Bump Mapping Unparametrized Surfaces on the GPU). Gradients
 * of the three triplanar projections can therefore be added without tangents. */
#ifndef SHADERS_LIGHTING_BUMP_NORMAL_H
#define SHADERS_LIGHTING_BUMP_NORMAL_H
#include "abi_math.h"

/* Texture offsets of the projections along y and z, so that all three differ at the origin. */
#define BUMP_OFFSET_Y ABI_VEC2(0.37f, 0.61f)
#define BUMP_OFFSET_Z ABI_VEC2(0.71f, 0.23f)

/* Returns the triplanar blend weights, whose sum is 1, for an object-space normal. */
ABI_FUNCTION vec3s bump_weights(vec3s n)
{
    float x = n.x * n.x * n.x * n.x;
    float y = n.y * n.y * n.y * n.y;
    float z = n.z * n.z * n.z * n.z;
    float all = x + y + z;
    return ABI_VEC3(x / all, y / all, z / all);
}

/* Returns the normal tilted away from the direction in which the height rises. */
ABI_FUNCTION vec3s bump_perturbed(vec3s normal, vec3s gradient)
{
    vec3s aside = glms_vec3_sub(normal, gradient);
    return glms_vec3_normalize(
        glms_vec3_add(aside, glms_vec3_scale(normal, glms_vec3_dot(normal, gradient))));
}

/* Returns `perturbed`, made to face the camera. If `perturbed` faces away, it is tilted until it
 * is nearly perpendicular to the view direction `e`. */
ABI_FUNCTION vec3s bump_facing(vec3s perturbed, vec3s normal, vec3s e)
{
    float excess = glms_vec3_dot(perturbed, e) - fmaxf(glms_vec3_dot(normal, e), -0.02f);
    if (excess > 0.0f)
        return glms_vec3_normalize(glms_vec3_sub(perturbed, glms_vec3_scale(e, excess)));
    return perturbed;
}
#endif
