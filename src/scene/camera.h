/*
 * camera.h: the camera of a picture, and its matrices.
 *
 * World: right-handed, +Y up, metres. Clip space: Vulkan's, y down, with reversed depth and no far
 * plane: 1 at the near plane, 0 at infinity, so that a float depth buffer keeps its precision. In
 * an orthographic picture w is 1, and depth is linear: 1 at the near plane, 0 at `depth`.
 */
#ifndef FIRN_SCENE_CAMERA_H
#define FIRN_SCENE_CAMERA_H

#include <cglm/types-struct.h>
#include <stdint.h>
#include "src/scene/mesh.h"

struct camera {
    vec3s eye;
    vec3s target;  /* not equal to eye */
    vec3s up;      /* {0} means +Y; need not be perpendicular to the view */
    float fov_deg; /* full vertical angle of view, degrees, in (0, 180) */
    float height;  /* of what an orthographic picture shows, metres; 0: a perspective one */
    float depth;   /* of what an orthographic picture shows, metres from the eye, above 0 */
};

/* The axes of a picture: unit vectors, perpendicular to each other. */
struct camera_basis {
    vec3s right, up, forward;
};

/* Returns the axes of the camera's picture. If it looks along `up`, another up is chosen. */
struct camera_basis camera_basis(const struct camera *camera);

/*
 * Returns clip_from_world of a picture of width x height pixels. `near` is in metres. `jitter`
 * moves the samples, pixels, x to the right and y down: with (0.5, 0) a sample is half a pixel
 * further right.
 */
mat4s camera_clip_from_world(const struct camera *camera, uint32_t width, uint32_t height,
                             float near, vec2s jitter);

/* Returns half of what the picture shows upward at distance 1; of an orthographic one at any. */
float camera_half_height(const struct camera *camera);

/* Returns the matrix to camera space (+X right, +Y up, looking down -Z), for column vectors. EXR's
 * worldToCamera is its transpose, because EXR multiplies row vectors. */
mat4s camera_view_from_world(const struct camera *camera);

/*
 * Returns clip_from_world of one face of a cube map, 90 degrees, with the eye at `center`; faces
 * have Vulkan's order +X -X +Y -Y +Z -Z and orientation (Vulkan 1.3, 16.5.4 "Cube Map Face
 * Selection"). `near` is in metres.
 */
mat4s camera_cube_clip_from_world(uint32_t face, vec3s center, float near);

/* Returns the axes of a face: `right` and `up` as stored in the image (+s and -t). A cube map is
 * seen from inside, so they are mirrored: right x up is `forward`, and triangles have the opposite
 * winding on the screen. */
struct camera_basis camera_cube_basis(uint32_t face);

/* Returns a camera that looks at `target` from `distance` metres. Azimuth 0 is on +Z, 90 on +X;
 * elevation 90 on +Y. */
struct camera camera_orbit(float azimuth_deg, float elevation_deg, float distance, vec3s target,
                           float fov_deg);

/* Returns the distance from which the sphere around a box of this diagonal, metres, fills most of
 * the picture's smaller side. */
float camera_framing_distance(float diagonal, float fov_deg, uint32_t width, uint32_t height);

#endif
