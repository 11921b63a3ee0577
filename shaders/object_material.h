/*
 * object_material.h: textured surface parameters of transmissive materials, for shaders and CPU.
 *
 * The model is KHR_materials_transmission of glTF 2.0. The base colour multiplies transmitted
 * light. Light that is neither reflected nor transmitted reaches the diffuse base.
 */
#ifndef SHADERS_OBJECT_MATERIAL_H
#define SHADERS_OBJECT_MATERIAL_H
#include "abi_math.h"

struct object_material {
    vec3s tint;      /* colour factor on transmitted light */
    float roughness; /* perceptual roughness, 0 to 1 */
    float opacity;   /* fraction of unreflected light that reaches the diffuse base */
};

/* Multiplies a material's parameters by its texels: base colour, roughness and transmission. */
ABI_FUNCTION ABI_STRUCT(object_material)
    object_material_of(ABI_STRUCT(object_material) material, vec3s base, float rough, float through)
{
    material.tint = glms_vec3_mul(material.tint, base);
    material.roughness *= rough;
    material.opacity = 1.0f - (1.0f - material.opacity) * through;
    return material;
}

#endif
