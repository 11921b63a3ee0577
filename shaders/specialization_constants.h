/*
 * specialization_constants.h: identifiers of specialisation constants.
 *
 * Drivers remove code that these constants make unreachable. Branches on uniforms are slow on
 * lavapipe, which runs shaders on a CPU's SIMD units. It executes both sides, including texture
 * fetches, and recompiles a shader whose branch depends on a member of globals in every frame,
 * without freeing the last one (Mesa 22.3).
 */
#ifndef SHADERS_SPECIALIZATION_CONSTANTS_H
#define SHADERS_SPECIALIZATION_CONSTANTS_H

/* Bits of CONSTANT_TEXTURED, in addition to 1 << MATERIAL_... for the textures in use. */
#define CONSTANT_TEXTURED_ANY     0x80000000u /* some surroundings have textures */
#define CONSTANT_TEXTURED_HOLES   0x40000000u /* some material is alpha-tested or blended */
#define CONSTANT_TEXTURED_COAT    0x20000000u /* some opaque material has a clear coat */
#define CONSTANT_TEXTURED_CATCHER 0x10000000u /* some material is a shadow catcher */

#define CONSTANT_BACKGROUND      0  /* background mode: GLOBALS_SKY ... */
#define CONSTANT_TEXTURED        1  /* CONSTANT_TEXTURED_ bits; 0 without textures */
#define CONSTANT_LIT             2  /* 1 if some surroundings are lit */
#define CONSTANT_LIGHTS          3  /* number of valid elements of globals.lights */
#define CONSTANT_BUMP_UV         4  /* bump map: 1: uv; 0: triplanar */
#define CONSTANT_REFRACT_COLORS  5  /* 3 with dispersion, otherwise 1 */
#define CONSTANT_REFRACT_FRESNEL 6  /* Fresnel mode: REFRACT_FRESNEL_PAPER ... */
#define CONSTANT_REFRACT_LOOKUP  7  /* environment lookup mode: REFRACT_LOOKUP_INFINITE ... */
#define CONSTANT_REFRACT_STEPS   8  /* ray marching steps of REFRACT_LOOKUP_DISTANCE */
#define CONSTANT_TONEMAP_CURVE   9  /* tone mapping curve: TONEMAP_NEUTRAL ... */
#define CONSTANT_TILED           10 /* 1 to apply globals.lod_bias */
#define CONSTANT_ICE_SHADOW      11 /* 1 if the ice casts shadows */
#define CONSTANT_COMPOSITE       12 /* compositing features: COMPOSITE_HAS_AIR ... */
#define CONSTANT_OBJECTS         13 /* 1: earlier passes may draw objects */
#define CONSTANT_ENVIRONMENT     14 /* environment.turn, a float */
#define CONSTANT_BACKDROP        15 /* background of primary rays: GLOBALS_BACKDROP_... */
#define CONSTANT_SCENE_LIGHTS    16 /* number of punctual lights */
#define CONSTANT_REFRACT_EXITS   17 /* maximum number of exits: refract_bounce.exits */
#define CONSTANT_ORTHOGRAPHIC    18 /* 1 if the projection is orthographic */
#define CONSTANT_TRACE           19 /* TRACE_ flags of refract_trace.h */
#define CONSTANT_AO              20 /* 1: ambient occlusion by objects (ao.c) */
#define CONSTANT_CRACKS_TRACED   21 /* 1: refracted rays intersect cracks.hits */
#define CONSTANT_BUBBLES_TRACED  22 /* 1: refracted rays intersect the BVH of the bubbles */
#define CONSTANT_COUNT           23

#endif
