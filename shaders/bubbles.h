/* bubbles.h: shared by bubbles.c and bubbles.{vert,frag}; bindings 1 and 2 are those of
 * ice_depth.h. */
#ifndef SHADERS_BUBBLES_H
#define SHADERS_BUBBLES_H
#include "abi.h"

#define BUBBLES_ENV_CUBE 3 /* radiance around the object */
#define BUBBLES_SPHERES  4 /* storage buffer, farthest first */

#define BUBBLES_COUNT_MAX 4096

struct bubbles_sphere {
    vec3s center; /* metres */
    float radius;
};

#endif
