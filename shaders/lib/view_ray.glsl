/* view_ray.glsl: from the eye through the picture's points. */
#ifndef LIB_VIEW_RAY_GLSL
#define LIB_VIEW_RAY_GLSL
#include "lib/globals.glsl"

/* Metres for each metre along the view's axis; linear over the picture. */
vec3 view_ray(vec2 ndc)
{
    mat4 m = frame.clip_from_world;
    /* the rows of a projection are the picture's axes, divided by its half sizes */
    vec3 x = vec3(m[0][0], m[1][0], m[2][0]);
    vec3 y = vec3(m[0][1], m[1][1], m[2][1]);
    vec3 w = vec3(m[0][3], m[1][3], m[2][3]);
    return inverse(transpose(mat3(x, y, w))) * vec3(ndc, 1.0);
}

/* Of a depth by globals.clip_from_world: metres along the view's axis. */
float view_distance(mat4 clip_from_world, float depth)
{
    return clip_from_world[3][2] / depth;
}

#endif
