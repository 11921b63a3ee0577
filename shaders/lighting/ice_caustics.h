/* ice_caustics.h: bindings, constants and push constants of the ice's caustics and shadow map. */
#ifndef SHADERS_LIGHTING_ICE_CAUSTICS_H
#define SHADERS_LIGHTING_ICE_CAUSTICS_H
#include "refract/refract_march.h"

#define ICE_CAUSTICS_NONE 0 /* values of ice_caustics_params.light */
#define ICE_CAUSTICS_SUN  1

#define ICE_CAUSTICS_PHOTONS  512     /* photon grid side in light space */
#define ICE_CAUSTICS_SIZE     512     /* side of the caustic map, texels */
#define ICE_CAUSTICS_DISTANCE 1000.0f /* light-space camera's distance, bounding radii */
#define ICE_CAUSTICS_MARGIN   1.02f   /* light-space half width, bounding radii */
#define ICE_CAUSTICS_WEIGHT   4096.0f /* fixed-point weight of a lossless photon */
#define ICE_CAUSTICS_GROUP    8       /* workgroup size along x and y */

/* Bindings of the ground depth and photon passes, in addition to those of refract.h. */
#define ICE_CAUSTICS_LIGHT  6 /* struct ice_caustics_light */
#define ICE_CAUSTICS_GROUND 7 /* light-space depth of the ground */
#define ICE_CAUSTICS_FRONT  8 /* light-space depth of the ice */

/* Shadow map: light-space depth of all surroundings. */
#define ICE_CAUSTICS_SHADOW_MAP       24   /* binding; cleared to 0 (far plane) */
#define ICE_CAUSTICS_SHADOW_MAP_SIZE  2048 /* side, texels */
#define ICE_CAUSTICS_SHADOW_MAP_REACH 6.0f /* width relative to the light-space view */

/* Bindings of the passes that accumulate photons. */
#define ICE_CAUSTICS_LANDED    1 /* landing points; green: 2, blue: 3 */
#define ICE_CAUSTICS_COUNTS    4 /* counts of red, green, blue photons */
#define ICE_CAUSTICS_NORMAL    5 /* w: 1 where ice is lit */
#define ICE_CAUSTICS_REFLECTED 6 /* landing points of light that the outside reflects */
#define ICE_CAUSTICS_LATER     7 /* landing points of light that leaves at the second exit */

/* Binding in shaders that look up the caustic map (lib/sun_light_space.glsl). */
#define ICE_CAUSTICS_MAP 9 /* rgb: caustics; a: ice shadow coverage */

/* Light-space view of the caustic map, `reach` times as wide as the sun's view of the ice. */
struct ice_caustics_light {
    mat4s clip_from_world;
    float reach;
    float front;       /* minimum distance of ground from the light-space camera, metres */
    float shadow_bias; /* offset of shadow map look-ups along the surface normal, metres */
};

struct ice_caustics_push {
    ABI_STRUCT(refract_march) march;
    float sun_x, sun_y; /* random offset of the sample's points on the sun's disc, 0 to 1 */
    float sun;          /* angular diameter of the sun, degrees */
};

#endif
