/* bubbles.h: shared by bubbles.c and bubbles*.{vert,frag}, beside the bindings of ice_depth.h and
 * refract.h. */
#ifndef SHADERS_BUBBLES_H
#define SHADERS_BUBBLES_H
#include "abi.h"

#define BUBBLES_ENV_CUBE 1  /* REFRACT_ENV_CUBE: radiance around the object */
#define BUBBLES_CRACKS   6  /* cracks.met, of bubbles_seen.glsl */
#define BUBBLES_DRAWN    20 /* storage buffer, farthest first */

#define BUBBLES_COUNT_MAX 4096

/* As struct bubble of src/scene/bubble.h, in the world. */
struct bubbles_drawn {
    vec3s center;  /* metres */
    float radius;  /* across the axis */
    vec3s axis;    /* unit, but of spheres */
    float stretch; /* along the axis a bubble reaches radius + stretch; 0: a sphere */
    uint32_t is_capsule;
};

#endif
