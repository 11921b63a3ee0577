/* bubbles.h: bindings and storage buffer of bubbles*.{vert,frag}, beside ice_depth.h, refract.h. */
#ifndef SHADERS_INCLUSIONS_BUBBLES_H
#define SHADERS_INCLUSIONS_BUBBLES_H
#include "abi.h"

#define BUBBLES_ENV_CUBE 1  /* REFRACT_ENV_CUBE: cube map of the radiance around the object */
#define BUBBLES_CRACKS   6  /* image cracks.hits, read by bubbles_light.glsl */
#define BUBBLES_DRAWN    20 /* storage buffer of bubbles_drawn, sorted back to front */

#define BUBBLES_COUNT_MAX 4096

/* A bubble in world space; the counterpart of struct bubble in src/scene/bubble.h. */
struct bubbles_drawn {
    vec3s center;  /* metres */
    float radius;  /* perpendicular to the axis */
    vec3s axis;    /* unit; unused for spheres */
    float stretch; /* along the axis the bubble extends radius + stretch; 0 for a sphere */
    uint32_t is_capsule;
};

#endif
