/* surroundings_per_vertex.frag: fragment shader of surroundings lit per vertex;
 * SURROUNDINGS_CAUSTICS adds the ice's caustics and shadow. */
#version 460
#include "lib/alpha_test.glsl"
#include "lib/brdf_shading.glsl"
#include "surroundings/surroundings.h"
#ifdef SURROUNDINGS_CAUSTICS
#include "lib/sun_shadow_caustics.glsl"
#endif

layout(location = 0) flat in uint material;
layout(location = 1) in vec3 diffuse; /* diffuse light, plus sun unless SURROUNDINGS_CAUSTICS */
layout(location = 2) in vec3 specular;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec2 glow_uv;
layout(location = 5) flat in vec4 lookups; /* colour, emission: layer and wrap mode */
#ifdef SURROUNDINGS_CAUSTICS
layout(location = 6) in vec3 sun; /* sunlight on the diffuse base, without shadow and caustics */
layout(location = 7) in vec4 shadow_clip;        /* position in the shadow map: ice_light_clip() */
layout(location = 8) flat in float direct;       /* 1 if lit, 0 if unlit */
layout(location = 9) in vec4 shadow_clip_lifted; /* with the shadow bias */
#endif
layout(location = 0) out vec4 color;

/* Samples a texture array. `lookup` is the array layer and the wrap mode; layer -1 is white. */
vec4 texel_at(sampler2DArray of, vec2 at, vec2 lookup)
{
    vec3 wrapped = vec3(lit_wrapped(of, at, lookup.y), lookup.x);
    vec4 texel = texture(of, wrapped);
    if (constant_tiled != 0u)
        texel = texture(of, wrapped, frame.lod_bias);
    return lookup.x < 0.0 ? vec4(1.0) : texel;
}

/* Returns the emission if there are emission textures. Otherwise the vertex shader has added it. */
vec3 emitted()
{
    if ((constant_textured & 1u << MATERIAL_EMISSION) == 0u)
        return vec3(0.0);
    vec3 emission = material_texel(material >> MESH_SURFACE_SHIFT, MATERIAL_ROW_EMISSION).rgb;
    return emission * texel_at(textures, glow_uv, lookups.zw).rgb;
}

void main()
{
    vec4 base = constant_textured != 0u ? texel_at(textures, uv, lookups.xy) : vec4(1.0);
    vec3 on_base = diffuse;
#ifdef SURROUNDINGS_CAUSTICS
    sun_shadow shadow = sun_shadow_lookup(shadow_clip, shadow_clip_lifted);
    on_base += sun * (direct * shadow.direct * shadow.visibility + shadow.refracted);
#endif
    color = vec4(on_base * base.rgb + specular + emitted(), 1.0);
    /* after all texture lookups, which need derivatives */
    if (is_hole(base.a, material >> MESH_SURFACE_SHIFT))
        discard;
}
