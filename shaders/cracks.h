/* cracks.h: what cracks.c and cracks*.{glsl,vert,frag} agree on. */
#ifndef SHADERS_CRACKS_H
#define SHADERS_CRACKS_H
#include "abi.h"

/* bindings of the rows that draw cracks: with the paper's clipping the first two, with intervals
 * the next ones */
#define CRACKS_FRONT    1
#define CRACKS_BACK     2
#define CRACKS_NEAR     3
#define CRACKS_FAR      4
#define CRACKS_ENV_CUBE 5 /* if they reflect it */

/* what the vertex shader hands on: in the object's space */
#define CRACKS_POSITION     0 /* over the radius of the object's sphere */
#define CRACKS_NORMAL       1
#define CRACKS_EYE_TO_POINT 2
#define CRACKS_LIGHTS       3 /* each: from the eye to it; w: strength of its highlight */
#define CRACKS_LOOK         7 /* struct cracks_look */

#define CRACKS_MAX 64 /* cracks.count, at most */

struct cracks_look {
    float strength;   /* of the highlights */
    float shininess;  /* Blinn and Phong's exponent */
    float bump;       /* slope of the roughness; 0: smooth */
    uint32_t surface; /* 1: flat opaque red in place of what they show */
};

#endif
