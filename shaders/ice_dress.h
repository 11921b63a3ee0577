/* ice_dress.h: shared by ice_normal.c and ice_dress*.{vert,frag}. */
#ifndef SHADERS_ICE_DRESS_H
#define SHADERS_ICE_DRESS_H
#include "dress.h"

/* Outputs of ice_dress.vert. */
#define ICE_DRESS_EYE_TO_POINT 0
#define ICE_DRESS_NORMAL       1
#define ICE_DRESS_FRESNEL      2 /* eq. 4 */
#define ICE_DRESS_COLOR        3
#define ICE_DRESS_UV           4

/* An object's material, without textures. */
struct ice_dress_push {
    ABI_STRUCT(dress) own;
    uint32_t row;   /* in the texture of materials */
    uint32_t layer; /* of its base colour, + 1, as of the vertices */
};

#endif
