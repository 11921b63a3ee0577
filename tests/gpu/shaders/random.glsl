/* random.glsl: folds everything that is bound into a sum. What is bound, the build defines. */
#include "tests/gpu/shaders/random.h"

layout(push_constant, scalar) uniform Push
{
    random_push push;
};

#ifdef VOLUME
#define SAMPLER usampler3D
#else
#define SAMPLER usampler2DArray
#endif
#ifdef ARRAY
layout(binding = RANDOM_SAMPLED) uniform SAMPLER sampled[SAMPLED];
#define sampled_0 sampled[0]
#define sampled_1 sampled[1]
#else
#if SAMPLED > 0
layout(binding = RANDOM_SAMPLED) uniform SAMPLER sampled_0;
#endif
#if SAMPLED > 1
layout(binding = RANDOM_SAMPLED + 1) uniform SAMPLER sampled_1;
#endif
#endif
#ifdef LOADED
layout(binding = RANDOM_LOADED, LOADED) uniform readonly uimage2DArray loaded;
#endif
#if defined(READ) && defined(TEXELS)
layout(binding = RANDOM_READ) uniform usamplerBuffer read_texels;
#elif defined(READ)
layout(binding = RANDOM_READ, scalar) readonly buffer Read
{
    uint read_words[];
};
#endif
#ifdef UNIFORM
layout(binding = RANDOM_UNIFORM, scalar) uniform Uniform
{
    uint uniform_words[RANDOM_UNIFORM_WORDS];
};
#endif
#ifdef OWN
layout(set = 1, binding = 0, scalar) readonly buffer Own
{
    uint own_words[RANDOM_OWN_WORDS];
};
#endif
#ifdef INSTANCES
layout(location = 0) flat in uint word_of_instance;
#endif

uint fold(uint sum, uvec4 texel)
{
    for (int i = 0; i < 4; i++)
        sum = random_mix(sum, texel[i]);
    return sum;
}

/* Where a texel reads an image of this size: x, y, layer. */
ivec3 place(uvec3 at, ivec3 size)
{
    return ivec3((at + push.shift * uvec3(1, 1, 0) + uvec3(0, 0, at.x + 2 * at.y)) % uvec3(size));
}

#if SAMPLED > 0
/* A texel of each mip. */
uint fetch(uint sum, SAMPLER image, uvec3 at)
{
    for (int mip = 0; mip < textureQueryLevels(image); mip++)
        sum = fold(sum, texelFetch(image, place(at, textureSize(image, mip)), mip));
    return sum;
}
#endif

uint inputs(uvec3 at)
{
    uint sum = fold(push.salt, uvec4(at, 0));
#if SAMPLED > 0
    sum = fetch(sum, sampled_0, at);
#endif
#if SAMPLED > 1
    sum = fetch(sum, sampled_1, at);
#endif
#ifdef LOADED
    sum = fold(sum, imageLoad(loaded, place(at, imageSize(loaded))));
#endif
#ifdef READ
    uint index = random_word(at.x, at.y, at.z) + push.shift;
#ifdef TEXELS
    sum = random_mix(sum, texelFetch(read_texels, int(index % textureSize(read_texels))).r);
#else
    sum = random_mix(sum, read_words[index % read_words.length()]);
#endif
#endif
#ifdef UNIFORM
    sum = random_mix(sum, uniform_words[(at.x + at.y) % RANDOM_UNIFORM_WORDS]);
#endif
#ifdef OWN
    sum = random_mix(sum, own_words[(at.x + 2 * at.y) % RANDOM_OWN_WORDS]);
#endif
#ifdef INSTANCES
    sum = random_mix(sum, word_of_instance);
#endif
    return sum;
}

uvec4 channels(uint sum, uint target)
{
    uvec4 texel;
    for (uint i = 0; i < 4; i++)
        texel[i] = random_mix(sum, 4 * target + i) & push.masks[target];
    return texel;
}
