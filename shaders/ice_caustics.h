/* ice_caustics.h: what ice_caustics.c, background.c and their shaders agree on: the sun's light
 * through the ice, and the map of where it falls. */
#ifndef SHADERS_ICE_CAUSTICS_H
#define SHADERS_ICE_CAUSTICS_H
#include "refract_march.h"

#define ICE_CAUSTICS_NONE 0 /* ice_caustics_params.light */
#define ICE_CAUSTICS_SUN  1

#define ICE_CAUSTICS_PHOTONS  512     /* texels a side of the sun's view of the ice */
#define ICE_CAUSTICS_SIZE     512     /* texels a side of the map of the light */
#define ICE_CAUSTICS_DISTANCE 1000.0f /* from which the sun looks, radii of the ice's sphere */
#define ICE_CAUSTICS_MARGIN   1.02f   /* half width of its view, the same */
#define ICE_CAUSTICS_WEIGHT   4096.0f /* that a photon counts which loses nothing */
#define ICE_CAUSTICS_GROUP    8       /* invocations along each side of a workgroup */

/* ice_caustics_ground.*; photons read 2 to 5 as rungs do (refract.h) */
#define ICE_CAUSTICS_LIGHT  6 /* struct ice_caustics_light */
#define ICE_CAUSTICS_GROUND 7 /* depth of the ground in it */
#define ICE_CAUSTICS_FRONT  8 /* depth of the ice's front faces in the sun's view */

/* what becomes of photons */
#define ICE_CAUSTICS_LANDED 1 /* of red; green and blue follow */
#define ICE_CAUSTICS_COUNTS 4 /* three maps side by side */
#define ICE_CAUSTICS_NORMAL 5 /* w: whether the sun sees ice there */

/* of those who look light up: lib/ice_light.glsl */
#define ICE_CAUSTICS_MAP 9 /* rgb: light; a: how much the ice covers */

/* The sun's view of ground and ice: a square picture, `reach` times as wide as that of the ice. */
struct ice_caustics_light {
    mat4s clip_from_world;
    float reach;
    float front; /* metres from the eye to where the ground begins */
};

struct ice_caustics_push {
    ABI_STRUCT(refract_march) march;
    float sun_x, sun_y; /* of this sample: where on the sun photons begin to be drawn, 0 to 1 */
    float sun;          /* the sun's diameter, degrees */
};

#endif
