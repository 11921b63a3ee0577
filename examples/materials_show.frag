/* materials_show.frag: tone-maps to an 8-bit image. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 shown;
layout(binding = 0) uniform sampler2D even;
layout(binding = 1) uniform sampler2D odd;

layout(push_constant) uniform Push
{
    uint number; /* of the frame */
}

push;

void main()
{
    vec3 lit = push.number % 2 == 0 ? texture(even, uv).rgb : texture(odd, uv).rgb;
    shown = vec4(pow(1.0 - exp(-1.5 * lit), vec3(1.0 / 2.2)), 1.0);
}
