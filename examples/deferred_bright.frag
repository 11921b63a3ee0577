/* deferred_bright.frag: extracts the part of the radiance above white, for bloom. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 bright;
layout(binding = 0) uniform sampler2D lit;

void main()
{
    bright = max(texture(lit, uv) - 1.0, 0.0);
}
