/* background_vertices_frag.glsl: main() of the pixels of surroundings whose light
 * background_vertices_vert.glsl has computed; with BACKGROUND_SHINE, with the ice's caustics and
 * shadow. */
#include "background.h"
#include "lib/lit.glsl"
#include "lib/see_through.glsl"
#ifdef BACKGROUND_SHINE
#include "lib/ice_shine.glsl"
#endif

layout(location = 0) in vec3 point;
layout(location = 1) flat in uint material;
layout(location = 2) in vec3 matt;
layout(location = 3) in vec3 sun;
layout(location = 4) in vec3 glossy;
layout(location = 5) in vec3 normal;
layout(location = 6) in vec4 uv;
layout(location = 7) flat in vec4 places; /* of the textures of colours and of normals */
layout(location = 8) in vec2 glow_uv;
layout(location = 9) flat in vec3 others; /* place of the texture of emission, scale of bumps */
layout(location = 0) out vec4 color;

/* Returns a texel at a place: layer, -1 for none, and wraps. */
vec4 texel_at(sampler2DArray of, vec2 at, vec2 place)
{
    vec3 wrapped = vec3(lit_wrapped(of, at, place.y), place.x);
    vec4 texel = texture(of, wrapped);
    if (constant_tiled != 0u)
        texel = texture(of, wrapped, frame.lod_bias);
    return place.x < 0.0 ? vec4(1.0) : texel;
}

/* Returns the unit normal with bumps. */
vec3 bent_normal()
{
    vec3 n = normalize(normal);
    if ((constant_textured & 1u << MATERIAL_USE_NORMAL) == 0u)
        return n;
    vec4 texel = texel_at(numbers, uv.zw, places.zw);
    return texel == vec4(1.0) ? n : lit_bend(n, texel.rgb, vec2(others.z), point, uv.zw);
}

/* Returns emission that has a texture in some material; vertices have the rest. */
vec3 glow()
{
    if ((constant_textured & 1u << MATERIAL_USE_EMISSION) == 0u)
        return vec3(0.0);
    vec3 emission = material_texel(material >> MESH_SURFACE_SHIFT, MATERIAL_ROW_EMISSION).rgb;
    return emission * texel_at(textures, glow_uv, others.xy).rgb;
}

bool is_gone(float alpha)
{
    uint row = material >> MESH_SURFACE_SHIFT;
    float opacity = material_texel(row, MATERIAL_ROW_FACTORS).w;
    float kind = material_texel(row, MATERIAL_ROW_F0).w;
    return is_hole(alpha * opacity, kind, material_texel(row, MATERIAL_ROW_EMISSION).w, row);
}

void main()
{
    vec4 base = constant_textured != 0u ? texel_at(textures, uv.xy, places.xy) : vec4(1.0);
    float cosine = max(dot(bent_normal(), frame.sun_dir), 0.0);
    vec3 lit = sun * cosine, unlit = vec3(1.0);
#ifdef BACKGROUND_SHINE
    ice_shine shine = ice_shine_at(point);
    lit *= shine.own + shine.through;
    unlit += sky_sun() * shine.through * cosine;
#endif
    unlit = (material & MESH_UNLIT) != 0u ? unlit : vec3(1.0);
    color = vec4((matt * unlit + lit) * base.rgb + glossy + glow(), 1.0);
    if (is_gone(base.a)) /* after all derivatives */
        discard;
}
