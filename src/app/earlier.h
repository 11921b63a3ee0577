/* earlier.h: an animated model in the frame before, for the layer motion. */
#ifndef FIRN_APP_EARLIER_H
#define FIRN_APP_EARLIER_H

#include "src/app/app.h"

/* The vertices' positions; the caller frees them, or hands them over. */
struct earlier {
    vec4s *positions; /* NULL: it was as it is */
    uint32_t rows, object_count, surroundings_count;
};

/* Returns whether a picture has the layer motion. */
bool earlier_is_wanted(const struct app_picture *picture);

/* Poses an animated model for the frame before `time`, and finds its camera. Without one, or before
 * the first frame, nothing happens and *camera stays. Logs and returns what app_pose_scene() and
 * app_camera() do. */
MUST_USE enum status earlier_pose(struct earlier *earlier, struct camera *camera,
                                  struct scene *scene, const struct app_picture *picture,
                                  float time);

/* Hands the positions over to the scene, if it still has the same vertices. */
void earlier_give(struct earlier *earlier, struct scene *scene);

#endif
