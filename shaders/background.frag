#version 460
#extension GL_GOOGLE_include_directive : require
#include "background.h"
#include "lib/constants.glsl"
#include "lib/globals.glsl"
#include "lib/sky.glsl"
#include "mesh.h"

layout(push_constant, scalar) uniform Push
{
    background_push push;
};

layout(set = 0, binding = BACKGROUND_TEXTURES) uniform sampler2DArray textures;

layout(location = 0) in vec3 eye_to_point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base_color;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
layout(location = 0) out vec4 color;

/* Matt surfaces of vertex colour times texture; both sides alike. */
void main()
{
    uint layer = material & MESH_TEXTURE_MASK;
    vec3 albedo = base_color;
    if (constant_textured != 0u && layer != 0u) {
        vec4 texel = texture(textures, vec3(uv, float(layer - 1u)));
        if ((material & MESH_CUTOUT) != 0u && texel.a < 0.5)
            discard;
        albedo *= texel.rgb;
    }
    if (constant_lit != 0u && (material & MESH_UNLIT) == 0u) {
        vec3 n = normalize(normal);
        albedo *= sky_light(dot(n, eye_to_point) > 0.0 ? -n : n);
    }
    color = vec4(albedo, push.inverse != 0u ? 1.0 / length(eye_to_point) : 1.0);
}
