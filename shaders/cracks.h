/* cracks.h: shared by cracks.c and cracks*.{glsl,vert,frag}. */
#ifndef SHADERS_CRACKS_H
#define SHADERS_CRACKS_H
#include "abi.h"

/* Bindings of the rows that draw cracks. FRONT and BACK are for clipping to a convex object, NEAR
 * and FAR for clipping to intervals. */
#define CRACKS_FRONT    1
#define CRACKS_BACK     2
#define CRACKS_NEAR     3
#define CRACKS_FAR      4
#define CRACKS_ENV_CUBE 5 /* with cracks.refract=gap */

/* Outputs of the vertex shader, in the object's space. */
#define CRACKS_POSITION     0 /* divided by the radius of the object's sphere */
#define CRACKS_NORMAL       1
#define CRACKS_EYE_TO_POINT 2
#define CRACKS_OPEN         3 /* as of CRACKS_OPEN_OF */
#define CRACKS_LIGHTS       4 /* array; xyz: from the eye to a light; w: highlight strength */
#define CRACKS_LOOK         8 /* struct cracks_look */

/* Share of light that a gap mirrors, as far as the straight ray tells, beyond which cracks.met
 * shows it before others. */
#define CRACKS_MET_MUCH 0.2f

#define CRACKS_MAX 64 /* cracks.count, at most */

/* Of vertices of cracks, the red of their colour: the square of the gap there, in gaps of
 * cracks_look. So it is even from a sheet's middle to its rim, as that of a crack which something
 * has pulled open (Sneddon 1946). */
#define CRACKS_OPEN_OF(color) ((color).r)

struct cracks_look {
    float strength;   /* of the highlights */
    float shininess;  /* Blinn and Phong's exponent */
    float bump;       /* slope of the roughness; 0: smooth */
    float gap;        /* in the middle of a crack, micrometres */
    uint32_t surface; /* 1: cracks are flat opaque red */
};

#endif
