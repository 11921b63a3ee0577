/* surroundings.h: bindings and push constants of surroundings*.{vert,frag} and env_cube.c. */
#ifndef SHADERS_SURROUNDINGS_SURROUNDINGS_H
#define SHADERS_SURROUNDINGS_SURROUNDINGS_H
#include "abi_math.h"

#define SURROUNDINGS_ENVIRONMENT       1 /* equirectangular map, -Z in the middle */
#define SURROUNDINGS_TEXTURES          2 /* colour textures, one layer each */
#define SURROUNDINGS_DATA_TEXTURES     3 /* non-colour (linear) textures: normals, roughness, ... */
#define SURROUNDINGS_MATERIALS         4 /* material texture (material_layout.h) */
#define SURROUNDINGS_ENVIRONMENT_LIGHT 5 /* prefiltered environment light (brdf.h) */
#define SURROUNDINGS_LIGHTS            11 /* light texture (brdf.h) */
#define SURROUNDINGS_EXTRAS            12 /* vertex attributes (mesh_layout.h) */
/* split-sum BRDF table; bindings 6 to 9 are in ice_caustics.h */
#define SURROUNDINGS_BRDF_TABLE 10

/* Additional outputs of the surroundings pass, which screen-space reflections read. */
#define SURROUNDINGS_OUT_SURFACE  1 /* octahedral normal, roughness, mean specular reflectance */
#define SURROUNDINGS_OUT_SPECULAR 2 /* specular environment light, replaced where SSR rays hit */

/* Push constants of one view, the camera's or that of a cube map face. */
struct surroundings_push {
    mat4s clip_from_world;
    vec3s eye;             /* camera position, world, metres */
    float environment_lod; /* mip level of the environment map that matches the size of a pixel */
    vec3s right;           /* vector from centre to right edge of an image at distance 1 */
    vec3s up;              /* vector from centre to top edge of an image at distance 1 */
    vec3s forward;         /* unit view direction */
    float background_lod;  /* mip level of the environment map where it is visible directly */
    uint32_t inverse;      /* 1: output alpha is 1 / distance in metres; 0: output alpha is 1 */
};

/* Returns equirectangular texture coordinates of a unit direction. -Z is in the middle, +Y at the
 * top. `turn` rotates the map counterclockwise about +Y, in turns. u is from 0 to 1 + `turn`. */
ABI_FUNCTION vec2s surroundings_equirect_uv(vec3s dir, float turn)
{
    float pi = 3.14159265358979f;
    float u = 0.5f + atan2f(dir.x, -dir.z) / (2.0f * pi) + turn;
    float v = acosf(glm_clamp(dir.y, -1.0f, 1.0f)) / pi;
    return ABI_VEC2(u, v);
}

#endif
