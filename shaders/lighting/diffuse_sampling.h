/* diffuse_sampling.h: importance sampling of diffuse light, for shaders and the CPU reference. */
#ifndef SHADERS_LIGHTING_DIFFUSE_SAMPLING_H
#define SHADERS_LIGHTING_DIFFUSE_SAMPLING_H
#include "abi_math.h"

#define DIFFUSE_SAMPLING_RAYS 2 /* diffuse rays per sample; odd rays sample the guide cone */

/* Seeds that give each type of ray its own random sequence. Diffuse rays add their ray index. */
#define DIFFUSE_SAMPLING_SEED          20u
#define DIFFUSE_SAMPLING_GLOSSY_SEED   40u
#define DIFFUSE_SAMPLING_SUN_SEED      41u
#define DIFFUSE_SAMPLING_PATH_SEED     42u
#define DIFFUSE_SAMPLING_ROULETTE_SEED 43u /* DIFFUSE_SAMPLING_ROULETTE_SEED + i for ray i */

/* Maps a point of the unit square to a uniformly distributed point of the unit sphere. */
ABI_FUNCTION vec3s diffuse_sampling_sphere(vec2s at)
{
    float z = 1.0f - 2.0f * at.x;
    float r = sqrtf(fmaxf(1.0f - z * z, 0.0f));
    float angle = 6.28318531f * at.y;
    return ABI_VEC3(r * cosf(angle), r * sinf(angle), z);
}

/* Returns a direction at an angle of the given cosine to an axis; `turn` is the azimuth, 0 to 1. */
ABI_FUNCTION vec3s diffuse_sampling_around(vec3s axis, float cosine, float turn)
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

/* Returns a cosine-distributed direction above a diffuse surface of normal `n`. */
ABI_FUNCTION vec3s diffuse_sampling_cosine_dir(vec3s n, vec2s at)
{
    return glms_vec3_normalize(
        glms_vec3_add(glms_vec3_scale(n, 1.0001f), diffuse_sampling_sphere(at)));
}

/* Returns the direction of a diffuse ray. Odd rays sample the cone from which most light comes.
 * `guide` is the cone's unit axis and its half-angle's cosine, or (0, 0, 0, 1) for no cone. */
ABI_FUNCTION vec3s diffuse_sampling_dir(vec3s n, vec4s guide, uint32_t ray_index, vec2s at)
{
    vec3s axis = ABI_VEC3(guide.x, guide.y, guide.z);
    float z = guide.w + (1.0f - guide.w) * at.x;
    if (guide.w >= 1.0f || ray_index % 2u == 0u)
        return diffuse_sampling_cosine_dir(n, at);
    return diffuse_sampling_around(axis, z, at.y);
}

/* Returns a sample's weight by the balance heuristic (Veach 1995), for diffuse_sampling_dir(). */
ABI_FUNCTION float diffuse_sampling_weight(vec3s n, vec4s guide, vec3s dir)
{
    float diffuse_pdf = fmaxf(glms_vec3_dot(n, dir), 0.0f) / 3.14159265f;
    float along = dir.x * guide.x + dir.y * guide.y + dir.z * guide.z;
    float guide_pdf = along >= guide.w ? 1.0f / (6.28318531f * fmaxf(1.0f - guide.w, 1e-6f)) : 0.0f;
    if (guide.w >= 1.0f)
        return 1.0f;
    return diffuse_pdf / fmaxf(0.5f * diffuse_pdf + 0.5f * guide_pdf, 1e-9f);
}

/* Returns a uniformly distributed direction to a disc of the angular radius `radius`, radians. */
ABI_FUNCTION vec3s diffuse_sampling_disc_dir(vec3s to_disc, float radius, vec2s at)
{
    return diffuse_sampling_around(to_disc, 1.0f - at.x * (1.0f - cosf(radius)), at.y);
}

#endif
