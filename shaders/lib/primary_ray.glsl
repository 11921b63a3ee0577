/* primary_ray.glsl: primary rays and their depth. In perspective views, rays start at the camera.
 * In orthographic views, rays start on the image plane through the camera. */
#ifndef PRIMARY_RAY_GLSL
#define PRIMARY_RAY_GLSL
#include "lib/globals.glsl"
#include "lib/specialization_constants.glsl"

/* Returns the unit direction of the primary ray through the point frame.eye + eye_to_point. */
vec3 primary_ray_dir(vec3 eye_to_point)
{
    if (constant_orthographic != 0u)
        return frame.forward;
    return normalize(eye_to_point);
}

/* Returns a pixel's primary ray for primary_ray_at(). The result is linear in screen space. */
vec3 primary_ray(vec2 ndc)
{
    mat4 m = frame.clip_from_world;
    /* The x and y rows of a projection matrix are the image axes divided by half the image size. */
    vec3 x = vec3(m[0][0], m[1][0], m[2][0]);
    vec3 y = vec3(m[0][1], m[1][1], m[2][1]);
    vec3 w = vec3(m[0][3], m[1][3], m[2][3]);
    if (constant_orthographic != 0u) {
        vec2 at = ndc - (m * vec4(frame.eye, 1.0)).xy;
        return at.x / dot(x, x) * x + at.y / dot(y, y) * y;
    }
    return inverse(transpose(mat3(x, y, w))) * vec3(ndc, 1.0);
}

/* Returns the camera-relative position of a primary ray at a view-space depth in metres. */
vec3 primary_ray_at(vec3 ray, float distance)
{
    if (constant_orthographic != 0u)
        return ray + distance * frame.forward;
    return distance * ray;
}

/* Returns the ratio of distance along a primary ray to view-space depth. */
float primary_ray_slant(vec3 ray)
{
    return constant_orthographic != 0u ? 1.0 : length(ray);
}

/* Converts a depth-buffer value of `clip_from_world` to view-space depth in metres. */
float view_depth(mat4 clip_from_world, float depth)
{
    if (constant_orthographic != 0u) {
        mat4 m = clip_from_world;
        vec3 z = vec3(m[0][2], m[1][2], m[2][2]);
        return (depth - dot(z, frame.eye) - m[3][2]) / dot(z, frame.forward);
    }
    return clip_from_world[3][2] / depth;
}

#endif
