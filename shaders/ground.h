/* ground.h: directions from which light comes to a surface, for trace_ground.glsl and the
 * reference. */
#ifndef SHADERS_GROUND_H
#define SHADERS_GROUND_H
#include "abi_math.h"

#define GROUND_MATT_WAYS 2 /* of the matt base, in each sample; every second one is guided */

/* What seeds are hashed with for random numbers of their own; of the first, that of the matt base,
 * as many as there are ways. */
#define GROUND_MATT_SEED   20u
#define GROUND_GLOSSY_SEED 40u
#define GROUND_SUN_SEED    41u
#define GROUND_WAY_SEED    42u
#define GROUND_CHANCE_SEED 43u /* and the numbers after it, one for each way */

/* Returns a point of the unit sphere for one of the unit square; both are filled evenly. */
ABI_FUNCTION vec3s ground_sphere(vec2s at)
{
    float z = 1.0f - 2.0f * at.x;
    float r = sqrtf(fmaxf(1.0f - z * z, 0.0f));
    float angle = 6.28318531f * at.y;
    return ABI_VEC3(r * cosf(angle), r * sinf(angle), z);
}

/* Returns the direction whose angle to an axis has a cosine, `turn` turns about it. */
ABI_FUNCTION vec3s ground_around(vec3s axis, float cosine, float turn)
{
    float sine = sqrtf(fmaxf(1.0f - cosine * cosine, 0.0f));
    float angle = 6.28318531f * turn;
    vec3s up = fabsf(axis.z) < 0.7f ? ABI_VEC3(0.0f, 0.0f, 1.0f) : ABI_VEC3(1.0f, 0.0f, 0.0f);
    vec3s x = glms_vec3_normalize(glms_vec3_cross(up, axis));
    vec3s y = glms_vec3_cross(axis, x);
    vec3s aside = glms_vec3_add(glms_vec3_scale(x, sine * cosf(angle)),
                                glms_vec3_scale(y, sine * sinf(angle)));
    return glms_vec3_normalize(glms_vec3_add(glms_vec3_scale(axis, cosine), aside));
}

/* Returns a direction from a matt surface of normal `n`: as many as each lights it. */
ABI_FUNCTION vec3s ground_matt_dir(vec3s n, vec2s at)
{
    return glms_vec3_normalize(glms_vec3_add(glms_vec3_scale(n, 1.0001f), ground_sphere(at)));
}

/* Returns the direction of a way from a matt surface: guided ones lead into a cone from which most
 * light comes. `guide`: its axis, unit, and the cosine of its angle; (0, 0, 0, 1): there is none.
 */
ABI_FUNCTION vec3s ground_dir(vec3s n, vec4s guide, uint32_t way, vec2s at)
{
    vec3s axis = ABI_VEC3(guide.x, guide.y, guide.z);
    float z = guide.w + (1.0f - guide.w) * at.x;
    if (guide.w >= 1.0f || way % 2u == 0u)
        return ground_matt_dir(n, at);
    return ground_around(axis, z, at.y);
}

/* Returns by how much light from a direction of ground_dir() counts (Veach's balance heuristic). */
ABI_FUNCTION float ground_weight(vec3s n, vec4s guide, vec3s dir)
{
    float matt = fmaxf(glms_vec3_dot(n, dir), 0.0f) / 3.14159265f;
    float along = dir.x * guide.x + dir.y * guide.y + dir.z * guide.z;
    float guided = along >= guide.w ? 1.0f / (6.28318531f * fmaxf(1.0f - guide.w, 1e-6f)) : 0.0f;
    if (guide.w >= 1.0f)
        return 1.0f;
    return matt / fmaxf(0.5f * matt + 0.5f * guided, 1e-9f);
}

/* Returns a direction to a disc of an angular radius in radians. */
ABI_FUNCTION vec3s ground_disc_dir(vec3s to_disc, float radius, vec2s at)
{
    return ground_around(to_disc, 1.0f - at.x * (1.0f - cosf(radius)), at.y);
}

#endif
