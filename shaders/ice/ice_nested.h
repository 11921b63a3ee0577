/* ice_nested.h: bindings and uniforms of the depth layers of nested objects. */
#ifndef SHADERS_ICE_ICE_NESTED_H
#define SHADERS_ICE_ICE_NESTED_H
#include "abi.h"
#include "inclusions/medium_density.h"

#define ICE_NESTED_LEVELS    3  /* number of nesting levels; level 0 is the outermost */
#define ICE_NESTED_MEDIA_MAX 16 /* maximum number of media; medium 0 is the outside */

#define ICE_NESTED_BEFORE 1 /* surrounding level's near, far depths */

/* Bindings in shaders that read the depth layers of nested objects. */
#define ICE_NESTED_DEPTHS  2
#define ICE_NESTED_NORMALS 3
#define ICE_NESTED_MEDIA   4

struct ice_nested_media {
    vec4s ior[ICE_NESTED_MEDIA_MAX];    /* refractive indices for red, green, blue */
    vec4s absorb[ICE_NESTED_MEDIA_MAX]; /* absorption coefficients, 1 / metre */
    ABI_STRUCT(medium_field)
    scattering_media[ICE_NESTED_MEDIA_MAX]; /* extinction 0: clear medium */
};

struct ice_nested_push {
    uint32_t medium;        /* medium inside the drawn object */
    uint32_t cavity_medium; /* medium in the object's cavities */
    uint32_t is_far;        /* 1: keep farthest faces; 0: nearest */
};

#endif
