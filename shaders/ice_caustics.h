/* ice_caustics.h: shared by ice_caustics.c, background.c and their shaders: the sun's light through
 * the ice, and its light map. */
#ifndef SHADERS_ICE_CAUSTICS_H
#define SHADERS_ICE_CAUSTICS_H
#include "refract_march.h"

#define ICE_CAUSTICS_NONE 0 /* ice_caustics_params.light */
#define ICE_CAUSTICS_SUN  1

#define ICE_CAUSTICS_PHOTONS  512     /* texels a side of the sun's view of the ice */
#define ICE_CAUSTICS_SIZE     512     /* texels a side of the light map */
#define ICE_CAUSTICS_DISTANCE 1000.0f /* distance of the sun's camera, radii of the ice's sphere */
#define ICE_CAUSTICS_MARGIN   1.02f   /* half width of its view, radii of the ice's sphere */
#define ICE_CAUSTICS_WEIGHT   4096.0f /* integer weight of a photon without losses */
#define ICE_CAUSTICS_GROUP    8       /* invocations along each side of a workgroup */

/* Bindings of ice_caustics_ground.* and of the photons, which also have 2 to 5 of refract.h. */
#define ICE_CAUSTICS_LIGHT  6 /* struct ice_caustics_light */
#define ICE_CAUSTICS_GROUND 7 /* depth of the ground in the sun's view */
#define ICE_CAUSTICS_FRONT  8 /* depth of the ice's front faces in the sun's view */

/* The sun's view of all surroundings, which may hide it from each other. */
#define ICE_CAUSTICS_SHADE       24   /* binding: its depth; 0 where there is none */
#define ICE_CAUSTICS_SHADE_SIZE  2048 /* texels a side */
#define ICE_CAUSTICS_SHADE_REACH 6.0f /* half its width, in those of the sun's view of the ice */

/* Bindings of the passes that count photons. */
#define ICE_CAUSTICS_LANDED 1 /* landing points of red; green and blue are 2 and 3 */
#define ICE_CAUSTICS_COUNTS 4 /* maps of red, green and blue side by side */
#define ICE_CAUSTICS_NORMAL 5 /* w: 1 where the sun sees ice */

/* Binding of shaders that look up the light map (lib/ice_light.glsl). */
#define ICE_CAUSTICS_MAP 9 /* rgb: light; a: cover of the ice */

/* The sun's view of ground and ice: a square, `reach` times as wide as its view of the ice. */
struct ice_caustics_light {
    mat4s clip_from_world;
    float reach;
    float front; /* distance from the eye at which the ground begins, metres */
    float lift;  /* of points over their own surface in the view of all surroundings, metres */
};

struct ice_caustics_push {
    ABI_STRUCT(refract_march) march;
    float sun_x, sun_y; /* offset of this sample's random points on the sun, 0 to 1 */
    float sun;          /* the sun's diameter, degrees */
};

#endif
