/*
 * dress.h: what the textures of a transmissive material make of its surface: what the rungs draw,
 * and what the reference finds.
 *
 * As in glTF 2.0 and KHR_materials_transmission: the light that passes the surface is multiplied by
 * the base colour; what is neither reflected nor transmitted is the matt base's.
 */
#ifndef SHADERS_DRESS_H
#define SHADERS_DRESS_H
#include "abi_math.h"

struct dress {
    vec3s tint;      /* of light that passes the surface */
    float roughness; /* 0 to 1 */
    float shine;     /* share of light that the surface neither reflects nor lets pass */
};

/* Returns a surface's own values times its texels: the base colour's rgb, the roughness, the
 * transmission. */
ABI_FUNCTION ABI_STRUCT(dress)
    dress_of(ABI_STRUCT(dress) own, vec3s base, float rough, float through)
{
    own.tint = glms_vec3_mul(own.tint, base);
    own.roughness *= rough;
    own.shine = 1.0f - (1.0f - own.shine) * through;
    return own;
}

#endif
