/* deferred_show.frag: adds bloom, and tone-maps to an 8-bit image. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 shown;
layout(binding = 0) uniform sampler2D lit;
layout(binding = 1) uniform sampler2D bloom;

void main()
{
    vec3 light = texture(lit, uv).rgb;
    for (int mip = 1; mip < 5; mip++)
        light += 0.12 * textureLod(bloom, uv, float(mip)).rgb;
    shown = vec4(pow(1.0 - exp(-1.5 * light), vec3(1.0 / 2.2)), 1.0);
}
