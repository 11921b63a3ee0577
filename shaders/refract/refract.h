/* refract.h: bindings, varyings and render targets of the refraction models (refract_*.c). */
#ifndef SHADERS_REFRACT_REFRACT_H
#define SHADERS_REFRACT_REFRACT_H
#include "abi.h"

#define REFRACT_ENV_CUBE 1 /* cube map of the surroundings */
/* G-buffers of the ice: outward normals, and depth-buffer values, which are 0 without a face. */
#define REFRACT_NORMAL_BACK  2
#define REFRACT_DEPTH_BACK   3
#define REFRACT_NORMAL_FRONT 4
#define REFRACT_DEPTH_FRONT  5
#define REFRACT_SHADING      7 /* shading normal of front faces */
#define REFRACT_DEPTH_SCENE  8 /* depth of the surroundings (refract_deferred_front_face.glsl) */
/* Front faces' depth map for ray marching with REFRACT_FULLSCREEN, maybe wider than the image. */
#define REFRACT_DEPTH_FRONT_MAP 12

/* Images of material parameters, as written by ice_gbuffer.c and sampled with REFRACT_MATERIAL. */
#define REFRACT_MATERIAL_FRONT 9
#define REFRACT_MATERIAL_BACK  10
#define REFRACT_MATERIAL_BASE  11
/* Image of the cracks that refracted rays can hit, as written by cracks_gbuffer.frag. */
#define REFRACT_CRACKS    6
#define REFRACT_BUBBLES   28 /* texel buffer of bubbles_node, the BVH of the bubbles */
#define REFRACT_COMPOSITE 1  /* image that refract_composite.frag composites */

/* Varyings written by the vertex shaders of the front faces. */
#define REFRACT_EYE_TO_POINT           0
#define REFRACT_NORMAL                 1
#define REFRACT_FRESNEL                2
#define REFRACT_BUMP_AT                3 /* texture coordinates (bump_map_sampling.glsl) */
#define REFRACT_BUMP_WORLD_FROM_OBJECT 4 /* matrix, locations 4 to 6 */
#define REFRACT_BUMP_SLOPE             7 /* bump strength */
#define REFRACT_REFLECTED              3 /* reflected direction */
#define REFRACT_REFRACTED              4 /* refracted directions, locations 4 to 6 */

/* Varyings written by refract_fullscreen.vert. */
#define REFRACT_VIEW_RAY         0
#define REFRACT_FULLSCREEN_FRAME 1 /* locations 1 to 8 (refract_uniforms.glsl) */
#define REFRACT_FULLSCREEN_MEAN  9 /* mean radiance, 1 / nearest distance */

/* Varyings for highlight.glsl, written by every vertex shader of the ice. */
#define REFRACT_LIGHTS    11 /* locations 11 to 14 */
#define REFRACT_SHININESS 15

/* Colour targets of the pass that draws a refraction model's image. */
#define REFRACT_OUT_COLOR     0
#define REFRACT_OUT_HIGHLIGHT 1

/* Colour targets of the pass that writes a refraction model's AOVs. */
#define REFRACT_OUT_EXIT       0
#define REFRACT_OUT_REFRACTION 1
#define REFRACT_OUT_REFLECTION 2
#define REFRACT_OUT_FRESNEL    3
#define REFRACT_OUT_PATH       4

/* First of three colour targets with packed AOVs, in the pass of the image with
 * REFRACT_PACKED_LAYERS. The second value is for passes that also write denoiser inputs. */
#define REFRACT_OUT_PACKED         2
#define REFRACT_OUT_PACKED_DENOISE 5
/* Bindings of refract_unpack_layers.frag, in addition to REFRACT_DEPTH_SCENE. */
#define REFRACT_PACKED_PATH  1
#define REFRACT_PACKED_MORE  2 /* the second or third target */
#define REFRACT_FIRST_OBJECT 3 /* layer `object` */

/* values of the specialisation constant CONSTANT_REFRACT_FRESNEL */
#define REFRACT_FRESNEL_PAPER     0 /* paper's approximation, eq. 4, per vertex */
#define REFRACT_FRESNEL_EXACT     1 /* exact Fresnel equations per pixel */
#define REFRACT_FRESNEL_CROSSFADE 2 /* one constant reflectance for all pixels */
#define REFRACT_FRESNEL_AUTO      3 /* refraction model's default; setting only */

/* values of the specialisation constant CONSTANT_REFRACT_LOOKUP */
#define REFRACT_LOOKUP_INFINITE 0 /* environment infinitely far away */
#define REFRACT_LOOKUP_DISTANCE 1 /* rays march through the cube's distances */
#define REFRACT_LOOKUP_BOX      2 /* box projection (env_box_settings) */
#define REFRACT_LOOKUP_AUTO     3 /* refraction model's default; setting only */

#endif
