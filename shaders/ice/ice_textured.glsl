/* ice_textured.glsl: surface parameters of textured ice for the G-buffer pass; uses uv set 0. */
#ifndef ICE_TEXTURED_GLSL
#define ICE_TEXTURED_GLSL
#include "ice/ice_textured.h"
#include "lib/brdf_shading.glsl"
#include "lib/primary_ray.glsl"
#include "lighting/bump_normal.h"

layout(push_constant, scalar) uniform Push
{
    ice_material_push push;
};

layout(location = ICE_MATERIAL_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = ICE_MATERIAL_NORMAL) in vec3 normal;
layout(location = ICE_MATERIAL_FRESNEL) in float fresnel_paper; /* eq. 4, per vertex */
layout(location = ICE_MATERIAL_COLOR) in vec3 color;
layout(location = ICE_MATERIAL_UV) in vec2 uv;

/* Returns the textured surface parameters; sets `mapped_n` to the normal-mapped outward normal. */
object_material ice_material_at(out vec3 mapped_n)
{
    vec3 base = lit_texel(textures, push.row, MATERIAL_BASE_COLOR, uv, 1.0).rgb;
    float rough = lit_texel(data_textures, push.row, MATERIAL_METALLIC_ROUGHNESS, uv, 1.0).g;
    float through = lit_texel(data_textures, push.row, MATERIAL_TRANSMISSION, uv, 1.0).r;
    vec4 texel = lit_texel(data_textures, push.row, MATERIAL_NORMAL, uv, 1.0);
    vec4 scales = material_texel(push.row, MATERIAL_ROW_SCALES);
    mapped_n = normalize(normal);
    if (texel != vec4(1.0))
        mapped_n = normal_map_by_derivatives(mapped_n, texel.rgb, scales.x, eye_to_point, uv);
    return object_material_of(push.parameters, base, rough, through);
}

#endif
