/* materials_show.frag: tone-maps to an 8-bit image. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 shown;
layout(binding = 0) uniform sampler2D blended;

void main()
{
    vec3 lit = texture(blended, uv).rgb;
    shown = vec4(pow(1.0 - exp(-1.5 * lit), vec3(1.0 / 2.2)), 1.0);
}
