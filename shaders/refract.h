/* refract.h: shared by the refraction rungs (refract_*.c, refract*.{glsl,vert,frag}). */
#ifndef SHADERS_REFRACT_H
#define SHADERS_REFRACT_H
#include "abi.h"

#define REFRACT_ENV_CUBE 1 /* radiance around the object */
/* Bindings of rungs that read outward normals, and depth by globals.clip_from_world, 0 without a
 * face. */
#define REFRACT_NORMAL_BACK  2
#define REFRACT_DEPTH_BACK   3
#define REFRACT_NORMAL_FRONT 4
#define REFRACT_DEPTH_FRONT  5
#define REFRACT_SHADING      7 /* of refract_seen.glsl */
#define REFRACT_DEPTH_SCENE  8 /* of refract_seen.glsl */
/* Of rungs that march among front faces with REFRACT_SEEN. */
#define REFRACT_DEPTH_FRONT_MAP 12

/* Bindings of rungs with REFRACT_DRESS, of ice_normal.c's images. */
#define REFRACT_DRESS_FRONT 9
#define REFRACT_DRESS_BACK  10
#define REFRACT_DRESS_SHINE 11
/* Of rungs that meet cracks: cracks_met.glsl writes it. */
#define REFRACT_CRACKS 6
#define REFRACT_OVER   1 /* of refract_over.frag: the image that is blended over a picture */

/* Outputs of the front faces' vertex shaders. */
#define REFRACT_EYE_TO_POINT 0
#define REFRACT_NORMAL       1
#define REFRACT_FRESNEL      2
#define REFRACT_BUMP_AT      3 /* of refract_bump.vert, for bump_map.glsl */
#define REFRACT_BUMP_TURN    4 /* of refract_bump.vert: 4 to 6 */
#define REFRACT_BUMP_SLOPE   7 /* of refract_bump.vert */
#define REFRACT_REFLECTED    3 /* of refract_per_vertex.vert */
#define REFRACT_REFRACTED    4 /* of refract_per_vertex.vert: 4 to 6 */

/* Outputs of refract_seen.vert. */
#define REFRACT_VIEW_RAY   0
#define REFRACT_SEEN_FRAME 1 /* refract_frame.glsl: 1 to 8 */
#define REFRACT_SEEN_MEAN  9 /* of refract_seen_mean.vert: radiance, 1 / nearest distance */

/* Outputs of all these vertex shaders, for surface.glsl. */
#define REFRACT_LIGHTS    11 /* 11 to 14 */
#define REFRACT_SHININESS 15

/* Colour targets of the pass that draws a rung's picture. */
#define REFRACT_OUT_COLOR     0
#define REFRACT_OUT_HIGHLIGHT 1

/* Colour targets of the pass that writes a rung's layers. */
#define REFRACT_OUT_EXIT       0
#define REFRACT_OUT_REFRACTION 1
#define REFRACT_OUT_REFLECTION 2
#define REFRACT_OUT_FRESNEL    3
#define REFRACT_OUT_WAY        4

/* CONSTANT_REFRACT_FRESNEL */
#define REFRACT_FRESNEL_PAPER     0 /* eq. 4, at the vertices */
#define REFRACT_FRESNEL_EXACT     1 /* Fresnel's equations, in each pixel */
#define REFRACT_FRESNEL_CROSSFADE 2 /* one share for all pixels */
#define REFRACT_FRESNEL_AUTO      3 /* the rung's own; of the setting alone */

/* CONSTANT_REFRACT_LOOKUP */
#define REFRACT_LOOKUP_INFINITE 0 /* as if the surroundings were infinitely far away */
#define REFRACT_LOOKUP_DISTANCE 1 /* a ray is traced to the distances of the environment cube */
#define REFRACT_LOOKUP_BOX      2 /* a ray ends on the sides of the box of local_settings */
#define REFRACT_LOOKUP_AUTO     3 /* the rung's own; of the setting alone */

#endif
