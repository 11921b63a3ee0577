/* view_ray.glsl: the picture's rays, which begin at the eye, or in an orthographic picture in the
 * plane through the eye across the view's axis. */
#ifndef LIB_VIEW_RAY_GLSL
#define LIB_VIEW_RAY_GLSL
#include "lib/constants.glsl"
#include "lib/globals.glsl"

/* Returns the unit direction of the ray that sees a point; `eye_to_point` is from frame.eye. */
vec3 view_dir(vec3 eye_to_point)
{
    if (constant_orthographic != 0u)
        return frame.forward;
    return normalize(eye_to_point);
}

/* Returns what view_at() takes; it is linear over the picture. */
vec3 view_ray(vec2 ndc)
{
    mat4 m = frame.clip_from_world;
    /* The rows of a projection are the picture's axes, divided by its half sizes. */
    vec3 x = vec3(m[0][0], m[1][0], m[2][0]);
    vec3 y = vec3(m[0][1], m[1][1], m[2][1]);
    vec3 w = vec3(m[0][3], m[1][3], m[2][3]);
    if (constant_orthographic != 0u) {
        vec2 at = ndc - (m * vec4(frame.eye, 1.0)).xy;
        return at.x / dot(x, x) * x + at.y / dot(y, y) * y;
    }
    return inverse(transpose(mat3(x, y, w))) * vec3(ndc, 1.0);
}

/* Returns the point of a ray at a distance along the view's axis, metres, from the eye. */
vec3 view_at(vec3 ray, float distance)
{
    if (constant_orthographic != 0u)
        return ray + distance * frame.forward;
    return distance * ray;
}

/* Returns the length of a ray per length along the view's axis. */
float view_slant(vec3 ray)
{
    return constant_orthographic != 0u ? 1.0 : length(ray);
}

/* Converts a depth by `clip_from_world` to metres along the view's axis. */
float view_distance(mat4 clip_from_world, float depth)
{
    if (constant_orthographic != 0u) {
        mat4 m = clip_from_world;
        vec3 z = vec3(m[0][2], m[1][2], m[2][2]);
        return (depth - dot(z, frame.eye) - m[3][2]) / dot(z, frame.forward);
    }
    return clip_from_world[3][2] / depth;
}

#endif
