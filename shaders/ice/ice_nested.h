/* ice_nested.h: bindings and uniforms of the depth layers of nested objects. */
#ifndef SHADERS_ICE_ICE_NESTED_H
#define SHADERS_ICE_ICE_NESTED_H
#include "abi.h"
#include "inclusions/medium.h"

#define ICE_NESTED_LEVELS    3  /* levels of nesting; the outermost one is level 0 */
#define ICE_NESTED_MEDIA_MAX 16 /* maximum number of media, including the outside, medium 0 */

#define ICE_NESTED_BEFORE 1 /* binding of the surrounding level's depths: near, far */

/* Bindings of shaders that read the layers. */
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
    uint32_t own;    /* medium of the object that is drawn */
    uint32_t around; /* medium in the object's cavities */
    uint32_t is_far; /* 1 to keep the farthest faces, 0 the nearest */
};

#endif
