/* blur.comp: Gaussian blur along one axis. */
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D source;
layout(binding = 1, rgba8) uniform writeonly image2D target;

layout(push_constant) uniform Push
{
    ivec2 step;
}

push;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = textureSize(source, 0) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = -16; i <= 16; i++) {
        float weight = exp(-0.5 * float(i * i) / 64.0);
        sum += weight * texelFetch(source, clamp(at + i * push.step, ivec2(0), last), 0);
        weights += weight;
    }
    imageStore(target, at, sum / weights);
}
