/* framing.h: support points of a model file's geometry, and the camera that frames them. */
#ifndef FIRN_SCENE_GEOMETRY_FRAMING_H
#define FIRN_SCENE_GEOMETRY_FRAMING_H

#include "src/scene/camera.h"

enum {
    FRAMING_POINT_COUNT = 200, /* maximum number of support points */
};

/* Geometry that the default camera frames: the refractive objects and the opaque geometry of the
 * same file, or the objects alone if the opaque geometry is a room or a floor around them. The
 * points are the vertices that are extreme in evenly distributed directions. */
struct framing {
    vec3s points[FRAMING_POINT_COUNT];
    uint32_t count;  /* 0 without a model file */
    struct box box;  /* bounding box of what is framed */
    struct box room; /* bounding box of the room, in which the camera must be; empty for none */
};

/* Camera that is wanted. */
struct framing_view {
    float fov_deg; /* 0 for the default field of view */
    float aspect;  /* width over height of the image */
    bool rotates;  /* true to frame the points at any rotation about the box's vertical axis */
    const vec3s *target; /* point at the centre of the image; NULL to centre the projected bounds */
};

/* Finds the support points of a model file's meshes. */
void framing_init(struct framing *framing, const struct mesh *object, const struct mesh *opaque);

/* Returns a camera in three-quarter view from slightly above whose image shows the projected bounds
 * of the points centred and at two thirds of the limiting image dimension. `count` must not be 0.
 */
struct camera framing_camera(const struct framing *framing, const struct framing_view *view);

#endif
