/* contact.h: uniform data and bindings of the ambient occlusion, shared by contact.c,
 * contact_map.frag and lib/contact.glsl. */
#ifndef SHADERS_CONTACT_H
#define SHADERS_CONTACT_H
#include "abi.h"

/* Bindings; the others belong to background.h. */
#define CONTACT_BINDING 13 /* struct contact_bodies */
#define CONTACT_MAP     14 /* map of the light change on the plane at the objects' base */
#define CONTACT_HEIGHTS 15 /* height field of the surroundings above that plane, 0 to 1 */
#define CONTACT_BELOW   16 /* height of the surroundings' lowest undersides; 1 if none */

#define CONTACT_BODIES 4    /* maximum number of occluders */
#define CONTACT_SIDE   128  /* side of the occlusion map, texels */
#define CONTACT_FINE   256  /* side of the height fields, texels */
#define CONTACT_HIGH   3.0f /* range of the height fields, in units of contact_bodies.height */
/* height above the plane at which they begin, relative to that range */
#define CONTACT_GAP 0.01f

/* Box occluder: fractions of the transmitted light that come from sky and ground. */
struct contact_body {
    vec3s min, max; /* corners of the box, object space, metres */
    vec3s sky, ground;
    float straight; /* fraction of the transmitted sky light that keeps nearly its direction */
};

struct contact_bodies {
    ABI_STRUCT(contact_body) all[CONTACT_BODIES];
    uint32_t count;
    float strength;  /* 0: no effect; 1: full occlusion */
    vec3s middle;    /* centre of the map, on the plane of the objects' base; world, metres */
    float half_side; /* half the side of the map, metres */
    float height;    /* distance from the plane beyond which the effect ends, metres */
};

#endif
