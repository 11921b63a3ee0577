/* mirror.h: shared by mirror.c and mirror*.{vert,frag}. */
#ifndef SHADERS_MIRROR_H
#define SHADERS_MIRROR_H
#include "abi.h"

#define MIRROR_COLOR     1 /* frame_color, or what is made smaller */
#define MIRROR_DEPTH     2 /* frame_depth */
#define MIRROR_SEEN      3 /* the objects' colours, premultiplied, and smaller images of them */
#define MIRROR_FRONT     4 /* the objects' depths, 0 beside them */
#define MIRROR_SURFACE   5 /* mirror_surface */
#define MIRROR_GLOSSY    6 /* mirror_glossy */
#define MIRROR_REFRACTED 7 /* of a quarter of the pixels: what their rays see in an object */

/* Bindings of mirror_refract.frag, besides the rung's. */
#define MIRROR_POINT 20 /* at which a ray meets an object, from the eye */
#define MIRROR_DIR   21 /* of the ray */

/* The sun's glints in objects are not where the eye sees them for what mirrors the objects, and
 * too small for a quarter of the pixels. */
#define MIRROR_BRIGHTEST 2.0f

struct mirror_push {
    vec3s box_min;   /* around the objects, in their space, metres */
    uint32_t steps;  /* along a ray in the box */
    vec3s box_max;   /* likewise */
    float thickness; /* of the objects, metres: how far behind their fronts a ray meets them */
    vec2s area_min, area_max; /* that is drawn, pixels; far away where it ends with the picture */
    vec2s area_edge;          /* in which the image fades, pixels */
    float pixel; /* the side of a pixel at distance 1; of an orthographic picture at any, metres */
};

#endif
