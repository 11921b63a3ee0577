/* cracks.h: bindings, varyings and push constants of cracks.c and cracks*.{glsl,vert,frag}. */
#ifndef SHADERS_INCLUSIONS_CRACKS_H
#define SHADERS_INCLUSIONS_CRACKS_H
#include "abi.h"

/* Bindings of crack passes, which clip by depth maps (FRONT, BACK) or peeled layers (NEAR, FAR). */
#define CRACKS_FRONT    1
#define CRACKS_BACK     2
#define CRACKS_NEAR     3
#define CRACKS_FAR      4
#define CRACKS_ENV_CUBE 5 /* used with cracks.refract=gap */

/* Locations of the outputs of cracks.vert, which are in object space. */
#define CRACKS_POSITION     0 /* in radii of the bounding sphere */
#define CRACKS_NORMAL       1
#define CRACKS_EYE_TO_POINT 2
#define CRACKS_OPEN         3  /* CRACKS_SQUARED_GAP of the vertex */
#define CRACKS_LIGHTS       4  /* vectors to lights; w: highlight strength */
#define CRACKS_SHADING      8  /* struct cracks_shading */
#define CRACKS_ETA          13 /* relative index, ice to gap, or 0 without Fresnel's factor */

/* Reflectance threshold of the image cracks.hits. Cracks above the threshold hide cracks below the
 * threshold, even nearer ones. */
#define CRACKS_HIT_REFLECTANCE 0.2f

#define CRACKS_MAX 64 /* maximum of cracks.count */

/* Squared ratio of a vertex's gap width to cracks_shading.gap. Linear interpolation of this square
 * gives the elliptic profile of a crack under tension (Sneddon 1946). */
#define CRACKS_SQUARED_GAP(color) ((color).r)

struct cracks_shading {
    float strength;   /* factor on the highlights */
    float shininess;  /* Blinn-Phong exponent */
    float bump;       /* slope of bump noise; 0: smooth */
    float gap;        /* maximum gap width, micrometres */
    uint32_t surface; /* 1: draw flat opaque red */
};

#endif
