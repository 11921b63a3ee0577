/* model_transform.h: user-defined rotation and scale of a model, applied while it is loaded. */
#ifndef FIRN_SCENE_MODEL_TRANSFORM_H
#define FIRN_SCENE_MODEL_TRANSFORM_H

#include "src/base/status.h"
#include "src/scene/import/model.h"

/* Transform about the model's origin, in the order of the members. All zeros is the identity. */
struct model_transform {
    bool is_z_up; /* converts Z-up to Y-up: +Z becomes +Y, and +Y becomes -Z */
    /* rotation in degrees about X, then Y, then Z; each counterclockwise seen from +axis */
    vec3s rotate_deg;
    float scale; /* scale factor; 0 means 1 */
};

/* Transforms a model's meshes, cameras, lights (without their intensities) and bounding box. If a
 * new coordinate exceeds 1 000 000 metres, logs an error with `path` and returns STATUS_DATA. */
MUST_USE enum status model_transform_apply(struct model *model,
                                           const struct model_transform *model_transform,
                                           const char *path);

#endif
