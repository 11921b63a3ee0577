/*
 * camera.h: camera of a view, and its matrices.
 *
 * World space: right-handed, +Y up, metres. Clip space: Vulkan's (y down), with reversed depth and
 * no far plane: 1 at the near plane, 0 at infinity, which preserves the precision of a float depth
 * buffer. Orthographic: w is 1, and depth is linear, 1 at the near plane and 0 at `depth`.
 */
#ifndef FIRN_SCENE_CAMERA_H
#define FIRN_SCENE_CAMERA_H

#include <cglm/types-struct.h>
#include <stdint.h>
#include "src/scene/geometry/mesh.h"

struct camera {
    vec3s eye;
    vec3s target;  /* must differ from eye */
    vec3s up;      /* up vector, not necessarily perpendicular to the view; zero means +Y */
    float fov_deg; /* vertical field of view, degrees, in (0, 180) */
    float height;  /* height of an orthographic view, metres; 0 for perspective */
    float depth;   /* orthographic depth range from the eye, metres */
    /* width / height of a pixel on a plane that faces the camera; 0 for square pixels */
    float pixel_aspect;
    /* offset of the principal point from the image's centre, right and down, as fractions of the
     * image's width and height */
    vec2s off_center;
};

/* Orthonormal axes of a view. */
struct camera_basis {
    vec3s right, up, forward;
};

/* Returns true if all members of two cameras are equal. */
bool camera_is_equal(const struct camera *a, const struct camera *b);

/* Returns the axes of a camera. Replaces an `up` that is parallel to the view direction. */
struct camera_basis camera_basis(const struct camera *camera);

/* Returns the matrix from world to clip space for an image of width x height pixels. `near` is in
 * metres. `jitter` shifts the sample positions in pixels: x to the right, y down. */
mat4s camera_clip_from_world(const struct camera *camera, uint32_t width, uint32_t height,
                             float near, vec2s jitter);

/* Returns the aspect ratio (width / height) of a view's image plane. */
float camera_aspect(const struct camera *camera, uint32_t width, uint32_t height);

/* Returns the offset of sample positions, in pixels right and down, that is equivalent to the
 * offset of the principal point. */
vec2s camera_pixel_shift(const struct camera *camera, uint32_t width, uint32_t height);

/* Returns half the height of an orthographic view, or of a perspective view at distance 1. */
float camera_half_height(const struct camera *camera);

/* Returns the matrix from world to camera space (+X right, +Y up, -Z forward), for column vectors.
 * EXR's attribute worldToCamera is the transpose, because EXR multiplies row vectors. */
mat4s camera_view_from_world(const struct camera *camera);

/* Returns the matrix from world to clip space for one face of a cube map centred at `center`.
 * `near` is in metres. The field of view is 90 degrees. Faces are ordered (+X -X +Y -Y +Z -Z) and
 * oriented as in Vulkan 1.3, section 16.5.4 "Cube Map Face Selection". */
mat4s camera_cube_clip_from_world(uint32_t face, vec3s center, float near);

/* Returns the axes of a cube map face. `right` and `up` are +s and -t of the stored image. Triangle
 * winding is reversed, because faces are seen from inside: `right` x `up` is `forward`. */
struct camera_basis camera_cube_basis(uint32_t face);

/* Returns a camera that looks at `target`, from `distance` metres. Azimuth 0 is +Z, 90 is +X;
 * elevation 90 is +Y. */
struct camera camera_orbit(float azimuth_deg, float elevation_deg, float distance, vec3s target,
                           float fov_deg);

/* Returns the camera distance in metres at which a sphere nearly fills the smaller image dimension.
 * `diagonal` is the sphere's diameter in metres. */
float camera_framing_distance(float diagonal, float fov_deg, uint32_t width, uint32_t height);

#endif
