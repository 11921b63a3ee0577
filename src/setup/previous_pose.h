/* previous_pose.h: pose of an animated model in the previous frame, for motion vectors. */
#ifndef FIRN_SETUP_PREVIOUS_POSE_H
#define FIRN_SETUP_PREVIOUS_POSE_H

#include "src/setup/setup.h"

/* Vertex positions in the previous frame. The caller frees them or moves them to a scene. */
struct previous_pose {
    vec4s *positions; /* NULL if unchanged */
    uint32_t object_count, surroundings_count;
};

/* Returns true if an image has the layer `motion`. */
bool previous_pose_is_needed(const struct setup_image *image);

/* Poses an animated model as in the frame before `time`, in seconds. Copies vertex positions to
 * *previous and the camera to *camera. Copies nothing without an animation, a previous frame or the
 * layer `motion`. Logs errors. Returns a status of setup_pose_scene() or setup_camera(). */
MUST_USE enum status previous_pose_find(struct previous_pose *previous, struct camera *camera,
                                        struct scene *scene, const struct setup_image *image,
                                        float time);

/* Moves the positions to the scene if the vertex counts are equal, else frees them. */
void previous_pose_move_to(struct previous_pose *previous, struct scene *scene);

#endif
