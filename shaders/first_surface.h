/* first_surface.h: shared by first_surface.c and first_surface.{vert,frag}. */
#ifndef SHADERS_FIRST_SURFACE_H
#define SHADERS_FIRST_SURFACE_H
#include "abi.h"

#define FIRST_SURFACE_EARLIER   12 /* the frame before */
#define FIRST_SURFACE_POSITIONS 13 /* of vertices in the frame before, in rows */
#define FIRST_SURFACE_STARTS    14 /* first vertices of the objects of the surroundings, in rows */
#define FIRST_SURFACE_WIDTH     2048

/* The frame before. */
struct first_surface_earlier {
    mat4s clip_from_world;
    mat4s world_from_object;
    mat4s world_from_movers;
    vec2s half_size; /* of the picture, pixels */
};

struct first_surface_push {
    uint32_t id;     /* of the object, or that of surroundings that are none; 0 is nothing's */
    uint32_t first;  /* vertex of the mesh in FIRST_SURFACE_POSITIONS */
    uint32_t object; /* 1: a refractive object; 0: the surroundings */
    uint32_t count;  /* of FIRST_SURFACE_STARTS */
};

#endif
