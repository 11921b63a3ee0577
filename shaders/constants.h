/*
 * constants.h: the ids of specialization constants.
 *
 * Drivers remove code that these constants make unreachable. lavapipe, which runs shaders on a
 * CPU's vector units, executes both sides of other branches, including texture fetches, and
 * recompiles a large shader that branches on a uniform in each frame (Mesa 22.3).
 */
#ifndef SHADERS_CONSTANTS_H
#define SHADERS_CONSTANTS_H

/* Bits of CONSTANT_TEXTURED, beside 1 << MATERIAL_USE_... of kinds that some material has */
#define CONSTANT_TEXTURED_ANY   0x80000000u /* some surroundings have textures */
#define CONSTANT_TEXTURED_HOLES 0x40000000u /* some material is cut out or blended */

#define CONSTANT_BACKGROUND      0  /* GLOBALS_SKY ... */
#define CONSTANT_TEXTURED        1  /* bits as above; 0: none has any */
#define CONSTANT_LIT             2  /* 1: some surroundings are lit */
#define CONSTANT_LIGHTS          3  /* number of valid elements of globals.lights */
#define CONSTANT_BUMP_UV         4  /* 1: bumps are mapped by the mesh's uv; 0: triplanar */
#define CONSTANT_REFRACT_COLORS  5  /* 3: each colour has its own path (dispersion); else 1 */
#define CONSTANT_REFRACT_FRESNEL 6  /* REFRACT_FRESNEL_PAPER ... */
#define CONSTANT_REFRACT_LOOKUP  7  /* REFRACT_LOOKUP_INFINITE ... */
#define CONSTANT_REFRACT_STEPS   8  /* iterations of REFRACT_LOOKUP_DISTANCE */
#define CONSTANT_TONEMAP_CURVE   9  /* TONEMAP_NEUTRAL ... */
#define CONSTANT_TILED           10 /* 1: globals.lod_bias is applied */
#define CONSTANT_ICE_SHADOW      11 /* 1: the ice casts a shadow (ice_caustics.c) */
#define CONSTANT_OVER            12 /* OVER_HAS_AIR ... */
#define CONSTANT_OBJECTS         13 /* 1: other objects may have been drawn before */
#define CONSTANT_ENVIRONMENT     14 /* a float: environment.turn */
#define CONSTANT_HIDDEN          15 /* 1: the background is seen in cubes and by rays alone */
#define CONSTANT_SCENE_LIGHTS    16 /* number of lights of the scene's files */
#define CONSTANT_REFRACT_EXITS   17 /* refract_bounce.exits */
#define CONSTANT_ORTHOGRAPHIC    18 /* 1: all rays of the picture have one direction */
#define CONSTANT_TRACE           19 /* bits of refract_trace.h */
#define CONSTANT_CONTACT         20 /* 1: objects hide light from surroundings (contact.c) */
#define CONSTANT_CRACKS_MET      21 /* 1: the rung follows what cracks mirror (cracks.met) */
#define CONSTANT_COUNT           22

#endif
