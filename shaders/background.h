/* background.h: shared by background.c, env_cube.c and background*.{vert,frag}. */
#ifndef SHADERS_BACKGROUND_H
#define SHADERS_BACKGROUND_H
#include "abi_math.h"

#define BACKGROUND_ENVIRONMENT 1  /* equirectangular picture, -Z in the middle */
#define BACKGROUND_TEXTURES    2  /* colours of the surroundings, one layer each */
#define BACKGROUND_NUMBERS     3  /* textures of what is no colour */
#define BACKGROUND_MATERIALS   4  /* a row of texels each (material.h) */
#define BACKGROUND_LIGHT       5  /* of the environment on surfaces (lit.h) */
#define BACKGROUND_LIGHTS      11 /* a row of texels for each light of a file (lit.h) */
#define BACKGROUND_EXTRAS      12 /* of the surroundings' vertices (mesh.h) */
#define BACKGROUND_SPLIT       10 /* what surfaces reflect (lit.h); 6 to 9 are ice_caustics.h's */

/* Outputs of surroundings that mirror objects. */
#define BACKGROUND_OUT_SURFACE 1 /* a normal (lib/octahedron.glsl), roughness, mean of the share: */
#define BACKGROUND_OUT_GLOSSY  2 /* radiance of the share that mirrors the environment */

/* Push constants of one view: that of the picture, or a face of a cube. */
struct background_push {
    mat4s clip_from_world;
    vec3s eye;             /* world, metres */
    float environment_lod; /* mip of the environment picture that fits this picture's pixels */
    vec3s right;           /* from the middle of the picture to its right edge, at distance 1 */
    vec3s up;              /* from the middle of the picture to its upper edge, at distance 1 */
    vec3s forward;         /* from the eye to the middle of the picture, at distance 1 */
    uint32_t inverse;      /* 1: alpha is 1 / distance from the eye, 1 / metre; 0: alpha is 1 */
};

/* Returns the texture coordinates of a unit direction in an equirectangular picture: -Z is in the
 * middle, +Y at the top. The picture is turned by `turn` turns about +Y, counterclockwise as seen
 * from above; u is from 0 to 1 + turn. */
ABI_FUNCTION vec2s background_uv(vec3s dir, float turn)
{
    float pi = 3.14159265358979f;
    float u = 0.5f + atan2f(dir.x, -dir.z) / (2.0f * pi) + turn;
    float v = acosf(glm_clamp(dir.y, -1.0f, 1.0f)) / pi;
    return ABI_VEC2(u, v);
}

#endif
