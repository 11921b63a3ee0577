/* object_transform.h: moves, rotates, scales and hides single objects of a loaded model. */
#ifndef FIRN_SCENE_GEOMETRY_OBJECT_TRANSFORM_H
#define FIRN_SCENE_GEOMETRY_OBJECT_TRANSFORM_H

#include "src/base/status.h"
#include "src/scene/import/model.h"

/* Transform of all objects with the same name. Rotation and scale are about the centre of each
 * object's bounding box. */
struct object_transform {
    char name[MATERIAL_NAME_SIZE]; /* name of a node with refractive or opaque triangles */
    bool is_hidden;                /* the object is left out */
    vec3s move;                    /* metres */
    vec3s rotate_deg; /* about X, then Y, then Z; each counterclockwise seen from +axis */
    float scale;      /* 0 means 1 */
};

/* Returns true if the transform neither changes nor hides an object. */
bool object_transform_is_identity(const struct object_transform *transform);

/* Applies all transforms to a model's objects and surroundings, in order. `path` is for messages.
 * Names of no object are ignored, with a warning if `warns`. Logs errors. Returns STATUS_DATA if a
 * coordinate exceeds 1 000 000 metres or no triangle is left, or STATUS_TRY_AGAIN. On failure, the
 * model must be freed. */
MUST_USE enum status object_transform_apply(struct model *model, const struct object_transform *all,
                                            uint32_t count, const char *path, bool warns);

#endif
