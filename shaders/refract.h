/* refract.h: what the refraction rungs (refract_*.c, refract*.{glsl,vert,frag}) agree on. */
#ifndef SHADERS_REFRACT_H
#define SHADERS_REFRACT_H
#include "abi.h"

#define REFRACT_ENV_CUBE 1 /* radiance around the object */
/* of rungs that read them: outward normals, and depth by globals.clip_from_world, 0 none */
#define REFRACT_NORMAL_BACK  2
#define REFRACT_DEPTH_BACK   3
#define REFRACT_NORMAL_FRONT 4
#define REFRACT_DEPTH_FRONT  5
#define REFRACT_SHADING      7 /* of refract_seen.glsl, as is the next */
#define REFRACT_DEPTH_SCENE  8
#define REFRACT_OVER         1 /* of refract_over.frag: what is drawn over a rung's picture */

/* what a vertex shader of the front faces hands on */
#define REFRACT_EYE_TO_POINT 0
#define REFRACT_NORMAL       1
#define REFRACT_FRESNEL      2
#define REFRACT_BUMP_AT      3 /* bump_map.glsl; refract_bump.vert alone, as are the next two */
#define REFRACT_BUMP_TURN    4 /* three of them */
#define REFRACT_BUMP_SLOPE   7
#define REFRACT_REFLECTED    3 /* refract_per_vertex.vert alone, as is the next */
#define REFRACT_REFRACTED    4 /* three of them */

/* what refract_seen.vert hands on */
#define REFRACT_VIEW_RAY   0
#define REFRACT_SEEN_FRAME 1 /* refract_frame.glsl */

/* what both hand on: surface.glsl */
#define REFRACT_LIGHTS    11 /* four of them */
#define REFRACT_SHININESS 15

/* colour targets of the pass that draws a rung's picture */
#define REFRACT_OUT_COLOR     0
#define REFRACT_OUT_HIGHLIGHT 1

/* and of the pass that writes its layers */
#define REFRACT_OUT_EXIT       0
#define REFRACT_OUT_REFRACTION 1
#define REFRACT_OUT_REFLECTION 2
#define REFRACT_OUT_FRESNEL    3
#define REFRACT_OUT_WAY        4

/* CONSTANT_REFRACT_FRESNEL */
#define REFRACT_FRESNEL_PAPER     0 /* eq. 4, at the vertices */
#define REFRACT_FRESNEL_EXACT     1 /* Fresnel's equations, in each pixel */
#define REFRACT_FRESNEL_CROSSFADE 2 /* one share for all */

/* CONSTANT_REFRACT_LOOKUP */
#define REFRACT_LOOKUP_INFINITE 0 /* as if the surroundings were infinitely far away */
#define REFRACT_LOOKUP_DISTANCE 1 /* a ray is followed to where the environment cube shows them */
#define REFRACT_LOOKUP_BOX      2 /* it ends on the sides of the box of local_settings */

#endif
