/* first_surface.frag: fragment shader of the albedo and motion layers (AOVs). */
#version 460
#include "lib/material_textures.glsl"
#include "output/first_surface.h"

layout(set = 0, binding = FIRST_SURFACE_PREVIOUS, scalar) uniform Previous
{
    first_surface_previous previous;
};

layout(push_constant, scalar) uniform Push
{
    first_surface_push push;
};

layout(location = 0) in vec3 color;
layout(location = 1) in vec2 uv;
layout(location = 2) flat in uint material;
layout(location = 3) in vec4 clip;
layout(location = 4) in vec4 previous_clip;

layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec4 out_motion; /* screen-space motion in pixels */

void main()
{
    vec4 base = material_base_color(material, uv);
    bool object = push.object != 0u;
    if (!object && material_is_hole(material, base.a))
        discard;
    out_albedo = vec4(color * base.rgb, 1.0);
    vec2 moved = (clip.xy / clip.w - previous_clip.xy / previous_clip.w) * previous.half_size;
    out_motion = previous_clip.w > 0.0 ? vec4(moved, 0.0, 0.0) : vec4(0.0);
}
