/* contact.h: shared by contact.c, contact_map.frag and lib/contact.glsl. */
#ifndef SHADERS_CONTACT_H
#define SHADERS_CONTACT_H
#include "abi.h"

/* Bindings beside those of background.h. */
#define CONTACT_BINDING 13 /* struct contact_bodies */
#define CONTACT_MAP     14 /* what bodies do to light on the level of their foot */
#define CONTACT_HEIGHTS 15 /* of surroundings above that level, 0 to 1 */
#define CONTACT_BELOW   16 /* of the lowest of their undersides, 1 where there is none */

#define CONTACT_BODIES 4     /* at most */
#define CONTACT_SIDE   128   /* texels a side of the map */
#define CONTACT_FINE   256   /* and of the heights over it */
#define CONTACT_HIGH   3.0f  /* of their range, contact_bodies.height */
#define CONTACT_GAP    0.01f /* above the foot at which it begins, of that range */

/* A body: of the light that it brings to a point beside it, as much has come from the sky and from
 * the ground as follows; the rest is lost in it. */
struct contact_body {
    vec3s min, max; /* of a box, in the space of the objects, metres */
    vec3s sky, ground;
    float straight; /* share of the sky's light that comes from nearly where the body is seen */
};

struct contact_bodies {
    ABI_STRUCT(contact_body) all[CONTACT_BODIES];
    uint32_t count;
    float strength;  /* 0: no effect; 1: as much as there is */
    vec3s middle;    /* of the map, on the level of the foot; world, metres */
    float half_side; /* of the map, metres */
    float height;    /* above and below that level the effect ends, metres */
};

#endif
