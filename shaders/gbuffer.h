/* gbuffer.h: what gbuffer.c and gbuffer.vert agree on. */
#ifndef SHADERS_GBUFFER_H
#define SHADERS_GBUFFER_H
#include "abi.h"

struct gbuffer_push {
    uint32_t object; /* 1: the object; 0: its surroundings */
};

#endif
