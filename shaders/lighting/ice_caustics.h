/* ice_caustics.h: bindings, constants and push constants of the ice's caustics and shadow map. */
#ifndef SHADERS_LIGHTING_ICE_CAUSTICS_H
#define SHADERS_LIGHTING_ICE_CAUSTICS_H
#include "refract/refract_march.h"

#define ICE_CAUSTICS_NONE 0 /* values of ice_caustics_params.light */
#define ICE_CAUSTICS_SUN  1

#define ICE_CAUSTICS_PHOTONS  512     /* photons along each side of the sun's view of the ice */
#define ICE_CAUSTICS_SIZE     512     /* side of the caustic map, texels */
#define ICE_CAUSTICS_DISTANCE 1000.0f /* distance of the sun's camera, radii of the ice's sphere */
#define ICE_CAUSTICS_MARGIN   1.02f   /* half width of the sun's view, radii of the ice's sphere */
#define ICE_CAUSTICS_WEIGHT   4096.0f /* fixed-point weight of a photon without losses */
#define ICE_CAUSTICS_GROUP    8       /* workgroup size along x and y */

/* Bindings of ice_caustics_ground.* and of the photon pass, which also uses 2 to 5 of refract.h. */
#define ICE_CAUSTICS_LIGHT  6 /* struct ice_caustics_light */
#define ICE_CAUSTICS_GROUND 7 /* depth of the ground, from the sun */
#define ICE_CAUSTICS_FRONT  8 /* depth of the ice's front faces, from the sun */

/* Shadow map: depth of all surroundings in the sun's view. */
#define ICE_CAUSTICS_SHADOW_MAP      24   /* binding; cleared to 0, the far plane */
#define ICE_CAUSTICS_SHADOW_MAP_SIZE 2048 /* side, texels */
#define ICE_CAUSTICS_SHADOW_MAP_REACH \
    6.0f /* width of the shadow map, relative to the sun's view of the ice */

/* Bindings of the passes that accumulate photons. */
#define ICE_CAUSTICS_LANDED 1 /* landing points of red; green and blue use bindings 2 and 3 */
#define ICE_CAUSTICS_COUNTS 4 /* maps of red, green and blue side by side */
#define ICE_CAUSTICS_NORMAL 5 /* w: 1 where the sun sees the ice */

/* Binding in shaders that look up the caustic map (lib/sun_light_space.glsl). */
#define ICE_CAUSTICS_MAP 9 /* rgb: caustics; a: coverage of the ice's shadow */

/* View of the caustic map: the sun's view of the ice, widened by the factor `reach`. */
struct ice_caustics_light {
    mat4s clip_from_world;
    float reach;
    float front; /* distance from the sun's camera at which the ground begins, metres */
    float lift;  /* offset of shadow map look-ups along the surface normal, metres */
};

struct ice_caustics_push {
    ABI_STRUCT(refract_march) march;
    float sun_x, sun_y; /* random offset of this sample's points on the sun's disc, 0 to 1 */
    float sun;          /* angular diameter of the sun, degrees */
};

#endif
