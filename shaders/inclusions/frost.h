/* frost.h: bindings and push constants of frost*.frag, shared with frost.c. */
#ifndef SHADERS_INCLUSIONS_FROST_H
#define SHADERS_INCLUSIONS_FROST_H
#include "abi.h"

#define FROST_ENV_CUBE 1 /* frost_env_cube_prefilter.frag: environment cube map */
#define FROST_CUBE     1 /* frost.frag: blurred environment cube map */
#define FROST_EXIT     2 /* frost.frag: image of the refracted rays' exit directions */

#define FROST_CUBE_SIZE 64 /* side of a cube face, texels */

/* Push constants of one face of the blurred cube map. */
struct frost_cube_push {
    vec3s right;  /* vector from centre to right edge of a face at distance 1 */
    float spread; /* GGX alpha of the crystals' slopes */
    vec3s up;
    vec3s forward;
};

struct frost_push {
    float amount; /* fraction of the light that the thickest frost scatters */
};

#endif
