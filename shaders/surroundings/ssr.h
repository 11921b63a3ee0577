/* ssr.h: bindings and push constants of the screen-space reflections, ssr*.{glsl,vert,frag}. */
#ifndef SHADERS_SURROUNDINGS_SSR_H
#define SHADERS_SURROUNDINGS_SSR_H
#include "abi.h"

#define SSR_COLOR        1 /* frame_color, or mip level to downsample */
#define SSR_DEPTH        2 /* frame_depth */
#define SSR_OBJECTS      3 /* premultiplied colours of the objects, with mip levels */
#define SSR_OBJECT_DEPTH 4 /* objects' depth; 0 where none */
#define SSR_SURFACE      5 /* ssr_surface */
#define SSR_SPECULAR     6 /* ssr_specular */
#define SSR_REFRACTED    7 /* half resolution: reflected rays' refracted colour */

/* Bindings of ssr_shade_refractive_hit.frag, in addition to those of the refraction model. */
#define SSR_HIT_POINT 20 /* hit point of the reflected ray, relative to the camera */
#define SSR_HIT_DIR   21 /* direction of the reflected ray */

/* Upper limit of reflected radiance. The limit dims sun glints, because reflections show them in
 * wrong places. Glints also alias, because reflections have half resolution. */
#define SSR_RADIANCE_MAX 2.0f

struct ssr_push {
    vec3s box_min;            /* bounding box of the objects, object space, metres */
    uint32_t steps;           /* ray march steps inside the box */
    vec3s box_max;            /* object space, metres */
    float thickness;          /* assumed thickness behind front faces, metres */
    vec2s area_min, area_max; /* scissored area, pixels; infinite where it touches image edges */
    vec2s area_edge;          /* fade width at the scissored area's edges, pixels */
    float pixel;              /* pixel size, metres; in perspective views at a depth of 1 metre */
};

#endif
