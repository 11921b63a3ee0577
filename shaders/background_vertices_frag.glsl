/* background_vertices_frag.glsl: main() of the pixels of surroundings whose light
 * background_vertices_vert.glsl has computed; with BACKGROUND_SHINE, with the ice's caustics and
 * shadow. */
#include "background.h"
#include "lib/lit.glsl"
#include "lib/see_through.glsl"
#ifdef BACKGROUND_SHINE
#include "lib/ice_shine.glsl"
#endif

layout(location = 0) flat in uint material;
layout(location = 1) in vec3 matt; /* with BACKGROUND_SHINE, without the sun's */
layout(location = 2) in vec3 glossy;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec2 glow_uv;
layout(location = 5) flat in vec4 places; /* of the textures of colour and emission */
#ifdef BACKGROUND_SHINE
layout(location = 6) in vec3 sun;         /* light on the matt base, without shadow and caustics */
layout(location = 7) in vec4 seen_by_sun; /* ice_light_clip() */
layout(location = 8) flat in float open;  /* share of the sun's direct light: 0 if unlit, or 1 */
layout(location = 9) in vec4 lifted;      /* the same as seen_by_sun, of ice_light_lifted() */
#endif
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

/* Returns emission that has a texture in some material; vertices have the rest. */
vec3 glow()
{
    if ((constant_textured & 1u << MATERIAL_USE_EMISSION) == 0u)
        return vec3(0.0);
    vec3 emission = material_texel(material >> MESH_SURFACE_SHIFT, MATERIAL_ROW_EMISSION).rgb;
    return emission * texel_at(textures, glow_uv, places.zw).rgb;
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
    vec4 base = constant_textured != 0u ? texel_at(textures, uv, places.xy) : vec4(1.0);
    vec3 on_base = matt;
#ifdef BACKGROUND_SHINE
    ice_shine shine = ice_shine_seen(seen_by_sun, lifted);
    on_base += sun * (open * shine.own * shine.open + shine.through);
#endif
    color = vec4(on_base * base.rgb + glossy + glow(), 1.0);
    if (is_gone(base.a)) /* after all derivatives */
        discard;
}
