/* view_ray.glsl: rays from the eye through points of the picture. */
#ifndef LIB_VIEW_RAY_GLSL
#define LIB_VIEW_RAY_GLSL
#include "lib/globals.glsl"

/* Returns the ray whose length along the view's axis is 1; it is linear over the picture. */
vec3 view_ray(vec2 ndc)
{
    mat4 m = frame.clip_from_world;
    /* The rows of a projection are the picture's axes, divided by its half sizes. */
    vec3 x = vec3(m[0][0], m[1][0], m[2][0]);
    vec3 y = vec3(m[0][1], m[1][1], m[2][1]);
    vec3 w = vec3(m[0][3], m[1][3], m[2][3]);
    return inverse(transpose(mat3(x, y, w))) * vec3(ndc, 1.0);
}

/* Converts a depth by `clip_from_world` to metres along the view's axis. */
float view_distance(mat4 clip_from_world, float depth)
{
    return clip_from_world[3][2] / depth;
}

#endif
