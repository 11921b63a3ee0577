/* material_textures.glsl: reads material parameters and samples the materials' textures. */
#ifndef MATERIAL_TEXTURES_GLSL
#define MATERIAL_TEXTURES_GLSL
#include "lib/specialization_constants.glsl"
#include "material_layout.h"
#include "mesh_layout.h"
#include "surroundings/surroundings.h"

layout(set = 0, binding = SURROUNDINGS_TEXTURES) uniform sampler2DArray textures;
layout(set = 0, binding = SURROUNDINGS_MATERIALS) uniform sampler2D materials;

vec4 material_texel(uint row, int column)
{
    return texelFetch(materials, ivec2(column, int(row)), 0);
}

/* ---- textures ---- */

#if defined(SURROUNDINGS_EXTRA) || defined(LIT_NO_DERIVATIVES)
/* Optional vertex attributes (mesh_extra) at the shaded point, set by main() or the ray tracer. */
vec2 lit_second_uv;
vec4 lit_tangent;
#endif

/* Returns wrapped texture coordinates; `wraps` is 3 * wrap_v + wrap_u (material_layout.h). */
vec2 lit_wrapped(sampler2DArray of, vec2 at, float wraps)
{
    vec2 size = vec2(textureSize(of, 0).xy);
    float wrap_v = floor(wraps / float(MATERIAL_WRAP_COUNT));
    float wrap_u = wraps - wrap_v * float(MATERIAL_WRAP_COUNT);
    return vec2(material_wrap(at.x, uint(wrap_u), size.x),
                material_wrap(at.y, uint(wrap_v), size.y));
}

/* Samples a texture. Derivatives select the mip level by default. The ray tracer uses level 0.
 * Per-vertex shading uses the level of 64 texels' width, because vertices are sparse. */
vec4 lit_fetch(sampler2DArray of, vec3 at, vec2 uv, float blur)
{
#ifdef LIT_NO_DERIVATIVES
    return textureLod(of, at, 0.0);
#elif defined LIT_PER_VERTEX
    return textureLod(of, at, log2(float(textureSize(of, 0).x) / 64.0));
#else
    return textureGrad(of, at, blur * dFdx(uv), blur * dFdy(uv));
#endif
}

/* Samples a material's texture, or returns white if there is none. `blur` scales the footprint. */
vec4 lit_texel(sampler2DArray of, uint row, int use, vec2 uv, float blur)
{
    vec4 u = material_texel(row, MATERIAL_ROW_TEXTURES + 2 * use);
    vec4 v = material_texel(row, MATERIAL_ROW_TEXTURES + 2 * use + 1);
    if ((constant_textured & 1u << use) == 0u || u.w == 0.0)
        return vec4(1.0);
#if defined(SURROUNDINGS_EXTRA) || defined(LIT_NO_DERIVATIVES)
    if (v.w >= float(MATERIAL_OTHER_SET)) {
        v.w -= float(MATERIAL_OTHER_SET);
        uv = lit_second_uv;
    }
#else
    v.w -= v.w >= float(MATERIAL_OTHER_SET) ? float(MATERIAL_OTHER_SET) : 0.0;
#endif
    vec2 at = vec2(dot(u.xyz, vec3(uv, 1.0)), dot(v.xyz, vec3(uv, 1.0)));
    return lit_fetch(of, vec3(lit_wrapped(of, at, v.w), u.w - 1.0), at, blur);
}

/* Samples the material's base colour texture. If there is none, samples layer `layer` - 1. */
vec4 lit_base(uint row, uint layer, vec2 uv, float blur)
{
    bool has_texture = material_texel(row, MATERIAL_ROW_TEXTURES).w > 0.0;
    if (constant_textured == 0u || has_texture || layer == 0u)
        return lit_texel(textures, row, MATERIAL_BASE_COLOR, uv, blur);
    return lit_fetch(textures, vec3(uv, float(layer - 1u)), uv, blur);
}

#ifndef LIT_PER_VERTEX
/* Returns a surface's base colour and alpha for AOVs, without vertex colour. */
vec4 material_base_color(uint material, vec2 uv)
{
    uint layer = material & MESH_TEXTURE_MASK;
    uint row = material >> MESH_SURFACE_SHIFT;
    if (textureSize(materials, 0).x == MATERIAL_ROW_WIDTH) {
        vec4 base = lit_base(row, layer, uv, 1.0);
        return vec4(base.rgb, base.a * material_texel(row, MATERIAL_ROW_FACTORS).w);
    }
    if (constant_textured == 0u || layer == 0u)
        return vec4(1.0);
    return textureGrad(textures, vec3(uv, float(layer - 1u)), dFdx(uv), dFdy(uv));
}
#endif

/* Returns true if AOVs skip a point because it is cut out or blended with alpha below 1/2. */
bool material_is_hole(uint material, float alpha)
{
    if ((constant_textured & CONSTANT_TEXTURED_HOLES) == 0u) /* `alpha` need not be sampled */
        return false;
    uint row = material >> MESH_SURFACE_SHIFT;
    if (textureSize(materials, 0).x != MATERIAL_ROW_WIDTH)
        return (material & MESH_CUTOUT) != 0u && alpha < 0.5;
    float kind = material_texel(row, MATERIAL_ROW_F0).w;
    if (kind == float(MATERIAL_KIND_CUTOUT))
        return alpha < material_texel(row, MATERIAL_ROW_EMISSION).w;
    if (kind == float(MATERIAL_KIND_BLENDED))
        return alpha < 0.5;
    return (material & MESH_CUTOUT) != 0u && alpha < 0.5;
}

#endif
