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
#define REFRACT_OVER         1 /* of refract_over.frag: what is drawn over a rung's picture */

/* what a vertex shader of the front faces hands on */
#define REFRACT_EYE_TO_POINT 0
#define REFRACT_NORMAL       1
#define REFRACT_FRESNEL      2
#define REFRACT_CHOICES      7 /* flat, see refract_front.glsl */
#define REFRACT_UV           3 /* refract_bump.vert alone */
#define REFRACT_REFLECTED    3 /* refract_per_vertex.vert alone, as is the next */
#define REFRACT_REFRACTED    4 /* three of them */

/* colour targets of the pass that writes a rung's layers */
#define REFRACT_OUT_EXIT       0
#define REFRACT_OUT_REFRACTION 1
#define REFRACT_OUT_REFLECTION 2
#define REFRACT_OUT_FRESNEL    3
#define REFRACT_OUT_WAY        4

/* globals.refract_fresnel */
#define REFRACT_FRESNEL_PAPER     0 /* eq. 4, at the vertices */
#define REFRACT_FRESNEL_EXACT     1 /* Fresnel's equations, in each pixel */
#define REFRACT_FRESNEL_CROSSFADE 2 /* one share for all */

/* globals.refract_steps: a ray ends on the sides of a box */
#define REFRACT_STEPS_BOX 0xffffu

#endif
