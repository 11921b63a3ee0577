/* match.frag: reads an image, and writes two targets. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal;

layout(binding = 2) uniform sampler2D source;

void main()
{
    albedo = texture(source, uv);
    normal = vec4(uv, 0.0, 1.0);
}
