/* match_array.comp: an array of two descriptors, and another set. */
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba8) uniform writeonly image2D target;
layout(binding = 1) uniform sampler2D sources[2];
layout(set = 1, binding = 0) uniform sampler2D own;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    imageStore(target, at,
               texelFetch(sources[0], at, 0) + texelFetch(sources[1], at, 0) +
                   texelFetch(own, at, 0));
}
