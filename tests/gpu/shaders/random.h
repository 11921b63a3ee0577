/* random.h: what the shaders of random graphs compute, in C and GLSL alike. */
#ifndef RANDOM_H
#define RANDOM_H
#include "shaders/abi.h"

/* Bindings; what is there is folded into a texel's sum in this order. */
#define RANDOM_SAMPLED       0 /* and 1: images, sampled */
#define RANDOM_LOADED        2 /* storage image, read */
#define RANDOM_READ          3 /* storage buffer, read */
#define RANDOM_UNIFORM       4 /* uniform buffer of RANDOM_UNIFORM_WORDS */
#define RANDOM_STORED        5 /* storage image, written */
#define RANDOM_WRITTEN       6 /* storage buffer, written */
#define RANDOM_BINDING_COUNT 7

#define RANDOM_UNIFORM_WORDS 4
#define RANDOM_OWN_WORDS     4 /* of a buffer in a descriptor set of the program's own */
#define RANDOM_TARGETS       3
#define RANDOM_GROUP         4 /* a workgroup's width and height */

struct random_push {
    uint32_t salt;                  /* where the sum begins */
    uint32_t shift;                 /* moves what is read */
    uint32_t masks[RANDOM_TARGETS]; /* bits of a channel */
    uint32_t from[2], to[2];        /* texels that are written */
    float depth;
};

#ifdef GL_core_profile
#define RANDOM_FUNCTION
#else
#define RANDOM_FUNCTION static inline
#endif

RANDOM_FUNCTION uint32_t random_mix(uint32_t sum, uint32_t word)
{
    sum = (sum ^ word) * 0x9e3779b1u;
    return sum ^ (sum >> 15);
}

/* A whole number so small that many of them are added exactly. */
RANDOM_FUNCTION uint32_t random_small(uint32_t sum)
{
    return random_mix(sum, 0) & 255u;
}

/* Which word of a buffer belongs to a texel; to be taken modulo the count of words. */
RANDOM_FUNCTION uint32_t random_word(uint32_t x, uint32_t y, uint32_t layer)
{
    return x + 16u * y + 256u * layer;
}

#endif
