/* random.comp: an image or a buffer from all inputs; CHANGES: from what was there, too. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/random.glsl"

layout(local_size_x = RANDOM_GROUP, local_size_y = RANDOM_GROUP) in;

#ifdef STORED
layout(binding = RANDOM_STORED, STORED) uniform
#ifndef CHANGES
    writeonly
#endif
#ifdef VOLUME
    uimage3D stored;
#else
    uimage2DArray stored;
#endif
#elif defined(TEXELS)
layout(binding = RANDOM_WRITTEN, r32ui) uniform uimageBuffer written;
#else
layout(binding = RANDOM_WRITTEN, scalar) buffer Written
{
    uint written_words[];
};
#endif

void main()
{
    uvec3 at = gl_GlobalInvocationID;
    uint sum = inputs(at); /* by all, as some drivers read the mip that the first of four names */
#ifdef STORED
    uvec3 size = imageSize(stored);
#elif defined(TEXELS)
    uvec3 size = uvec3(imageSize(written), 1, 1);
#else
    uvec3 size = uvec3(written_words.length(), 1, 1);
#endif
    if (any(lessThan(at.xy, uvec2(push.from[0], push.from[1]))) ||
        any(greaterThanEqual(at.xy, uvec2(push.to[0], push.to[1]))) ||
        any(greaterThanEqual(at, size)))
        return;
#ifdef STORED
#ifdef CHANGES
    sum = fold(sum, imageLoad(stored, ivec3(at)));
#endif
    imageStore(stored, ivec3(at), channels(sum, 0));
#elif defined(TEXELS)
#ifdef CHANGES
    sum = random_mix(sum, imageLoad(written, int(at.x)).r);
#endif
    imageStore(written, int(at.x), channels(sum, 0));
#else
#ifdef CHANGES
    sum = random_mix(sum, written_words[at.x]);
#endif
    written_words[at.x] = channels(sum, 0).x;
#endif
}
