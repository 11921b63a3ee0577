/* materials_smoke.frag: smoke that fades where it comes near a surface. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
layout(binding = 0) uniform sampler2D depth;

/* Linearises depth: returns the view-space z of a value of the depth buffer. */
float distance_of(float z)
{
    return 0.1 * 40.0 / (40.0 - z * 39.9);
}

void main()
{
    float behind = distance_of(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r);
    float near = behind - distance_of(gl_FragCoord.z);
    float alpha = 0.4 * smoothstep(1.0, 0.0, length(uv)) * smoothstep(0.0, 0.6, near);
    color = vec4(vec3(0.9), 1.0) * alpha;
}
