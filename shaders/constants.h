/*
 * constants.h: what shaders know before they are compiled: specialization constants, by id.
 *
 * A driver leaves out what they make unreachable. One that runs shaders on a CPU's vector units
 * (lavapipe) runs both sides of every other branch, texture fetches and all, and compiles a large
 * shader that branches on a uniform anew with each frame (Mesa 22.3).
 */
#ifndef SHADERS_CONSTANTS_H
#define SHADERS_CONSTANTS_H

#define CONSTANT_BACKGROUND      0  /* GLOBALS_SKY ... */
#define CONSTANT_TEXTURED        1  /* 1: some surroundings have textures */
#define CONSTANT_LIT             2  /* 1: some surroundings are lit */
#define CONSTANT_LIGHTS          3  /* how many of globals.lights there are */
#define CONSTANT_BUMP_UV         4  /* 1: bumps lie by the mesh's uv; 0: along three planes */
#define CONSTANT_REFRACT_COLORS  5  /* how many bend by themselves: 1 or 3 */
#define CONSTANT_REFRACT_FRESNEL 6  /* REFRACT_FRESNEL_PAPER ... */
#define CONSTANT_REFRACT_LOOKUP  7  /* REFRACT_LOOKUP_INFINITE ... */
#define CONSTANT_REFRACT_STEPS   8  /* of REFRACT_LOOKUP_DISTANCE, in which a ray is followed */
#define CONSTANT_TONEMAP_CURVE   9  /* TONEMAP_NEUTRAL ... */
#define CONSTANT_TILED           10 /* 1: globals.lod_bias counts */
#define CONSTANT_ICE_SHADOW      11 /* 1: the ice casts one, where light goes through it */
#define CONSTANT_OVER            12 /* OVER_HAS_AIR ... */
#define CONSTANT_COUNT           13

#endif
