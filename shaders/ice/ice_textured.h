/* ice_textured.h: varyings and push constants of the pass that draws textured ice. */
#ifndef SHADERS_ICE_ICE_TEXTURED_H
#define SHADERS_ICE_ICE_TEXTURED_H
#include "object_material.h"

/* Varyings written by ice_textured.vert. */
#define ICE_MATERIAL_EYE_TO_POINT 0
#define ICE_MATERIAL_NORMAL       1
#define ICE_MATERIAL_FRESNEL      2 /* Fresnel reflectance by eq. 4 */
#define ICE_MATERIAL_COLOR        3
#define ICE_MATERIAL_UV           4

/* Material parameters of an object before texturing. */
struct ice_material_push {
    ABI_STRUCT(object_material) parameters;
    uint32_t row;   /* row in the material texture */
    uint32_t layer; /* base colour's texture layer + 1 */
};

#endif
