/* ice_nested.h: shared by ice_nested.c, its shaders and those that read its images. */
#ifndef SHADERS_ICE_NESTED_H
#define SHADERS_ICE_NESTED_H
#include "abi.h"
#include "cloud.h"

#define ICE_NESTED_LEVELS    3  /* of bodies in bodies: the outermost one is level 0 */
#define ICE_NESTED_MEDIA_MAX 16 /* media of objects, and that around them, which is medium 0 */

#define ICE_NESTED_BEFORE 1 /* binding of the depths of the level before: near, far */

/* Bindings of readers */
#define ICE_NESTED_DEPTHS  2
#define ICE_NESTED_NORMALS 3
#define ICE_NESTED_MEDIA   4

struct ice_nested_media {
    vec4s ior[ICE_NESTED_MEDIA_MAX];                      /* for red, green, blue */
    vec4s absorb[ICE_NESTED_MEDIA_MAX];                   /* 1 / metre */
    ABI_STRUCT(cloud_place) clouds[ICE_NESTED_MEDIA_MAX]; /* extinction 0: none */
};

struct ice_nested_push {
    uint32_t own;    /* medium of the object that is drawn */
    uint32_t around; /* that in its cavities */
    uint32_t is_far; /* 1: the farthest faces are kept */
};

#endif
