/*
 * dress.h: textured surface parameters of transmissive materials, for shaders and CPU.
 *
 * As in glTF 2.0 and KHR_materials_transmission, transmitted light is multiplied by the base
 * colour; light that is neither reflected nor transmitted reaches the diffuse base.
 */
#ifndef SHADERS_DRESS_H
#define SHADERS_DRESS_H
#include "abi_math.h"

struct dress {
    vec3s tint;      /* colour factor on transmitted light */
    float roughness; /* perceptual roughness, 0 to 1 */
    float shine;     /* opacity: fraction of unreflected light that reaches the diffuse base */
};

/* Multiplies a material's parameters by its texels: base colour, roughness and transmission. */
ABI_FUNCTION ABI_STRUCT(dress)
    dress_of(ABI_STRUCT(dress) own, vec3s base, float rough, float through)
{
    own.tint = glms_vec3_mul(own.tint, base);
    own.roughness *= rough;
    own.shine = 1.0f - (1.0f - own.shine) * through;
    return own;
}

#endif
