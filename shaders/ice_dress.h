/* ice_dress.h: varyings and push constants of the pass that draws textured ice (ice_normal.c). */
#ifndef SHADERS_ICE_DRESS_H
#define SHADERS_ICE_DRESS_H
#include "dress.h"

/* Varyings written by ice_dress.vert. */
#define ICE_DRESS_EYE_TO_POINT 0
#define ICE_DRESS_NORMAL       1
#define ICE_DRESS_FRESNEL      2 /* Fresnel reflectance by eq. 4 */
#define ICE_DRESS_COLOR        3
#define ICE_DRESS_UV           4

/* Material parameters of an object before texturing. */
struct ice_dress_push {
    ABI_STRUCT(dress) own;
    uint32_t row;   /* row in the material texture */
    uint32_t layer; /* texture layer of the base colour + 1, as in the vertices */
};

#endif
