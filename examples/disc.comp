/* disc.comp: draws a white disc on black. */
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1, rgba8) uniform writeonly image2D target;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    float inside = float(distance(vec2(at), 0.5 * vec2(imageSize(target))) < 64.0);
    imageStore(target, at, vec4(vec3(inside), 1.0));
}
