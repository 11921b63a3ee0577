/* bubbles.h: bindings of bubbles*.{vert,frag}, which also use ice_depth.h and refract.h. */
#ifndef SHADERS_INCLUSIONS_BUBBLES_H
#define SHADERS_INCLUSIONS_BUBBLES_H
#include "abi.h"

#define BUBBLES_ENV_CUBE 1  /* environment cube map, as REFRACT_ENV_CUBE */
#define BUBBLES_CRACKS   6  /* image cracks.hits, read by bubbles_light.glsl */
#define BUBBLES_DRAWN    20 /* storage buffer of bubbles_drawn, sorted back to front */

#define BUBBLES_COUNT_MAX 4096

/* Bubble in world space; src/scene/bubble_intersect.h has the object-space counterpart, struct
 * bubble. */
struct bubbles_drawn {
    vec3s center;  /* metres */
    float radius;  /* perpendicular to the axis */
    vec3s axis;    /* unit; unused for spheres */
    float stretch; /* half the bubble's length along the axis, minus `radius`; 0 for a sphere */
    uint32_t is_capsule;
};

#endif
