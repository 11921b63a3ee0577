/* gbuffer.frag: fragment shader of the G-buffer: normal, position and object of the visible
 * surface. */
#version 460
#include "lib/globals.glsl"
#include "lib/material_textures.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) flat in uint material;
layout(location = 4) flat in float number;
layout(location = 0) out vec4 out_normal; /* w: distance along the view axis */
layout(location = 1) out float out_object;

void main()
{
    if (material_is_hole(material, material_base_color(material, uv).a))
        discard;
    out_normal = vec4(normalize(normal), dot(position - frame.eye, frame.forward));
    out_object = number;
}
