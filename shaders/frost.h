/* frost.h: shared by frost.c and frost*.frag. */
#ifndef SHADERS_FROST_H
#define SHADERS_FROST_H
#include "abi.h"

#define FROST_ENV_CUBE 1 /* of frost_cube.frag: radiance around the object */
#define FROST_CUBE     1 /* of frost.frag: blurred radiance around the object */
#define FROST_EXIT     2 /* of frost.frag: the rung's direction in which light leaves */

#define FROST_CUBE_SIZE 64 /* texels of a face's side */

/* One face of the blurred cube. */
struct frost_cube_push {
    vec3s right;  /* from the middle of the face to its right edge, at distance 1 */
    float spread; /* alpha of the crystals' slopes (GGX) */
    vec3s up;
    vec3s forward;
};

struct frost_push {
    float amount; /* share of the light that the thickest frost scatters */
};

#endif
