/* first_surface.h: bindings and uniforms of the first-surface layers (albedo, motion). */
#ifndef SHADERS_OUTPUT_FIRST_SURFACE_H
#define SHADERS_OUTPUT_FIRST_SURFACE_H
#include "abi.h"

#define FIRST_SURFACE_PREVIOUS  12 /* uniforms of the previous frame */
#define FIRST_SURFACE_POSITIONS 13 /* previous frame's vertex positions, texture */
#define FIRST_SURFACE_WIDTH     2048

/* Transformations of the previous frame. */
struct first_surface_previous {
    mat4s clip_from_world;
    mat4s world_from_object;
    mat4s world_from_movers;
    vec2s half_size; /* half the image size, pixels */
};

struct first_surface_push {
    uint32_t first;  /* the mesh's first vertex in FIRST_SURFACE_POSITIONS */
    uint32_t object; /* 1: refractive object; 0: surroundings */
};

#endif
