/* place.h: turns and scales a model as it is loaded. */
#ifndef FIRN_SCENE_PLACE_H
#define FIRN_SCENE_PLACE_H

#include "src/base/status.h"
#include "src/scene/import/model.h"

/* About the origin of the model, in this order; {0} leaves it as it is. */
struct place {
    bool is_z_up;     /* the model's +Z becomes +Y, and its +Y becomes -Z */
    vec3s rotate_deg; /* about X, then Y, then Z; degrees, counterclockwise seen from the axis */
    float scale;      /* 0 means 1 */
};

/* Applies it to both meshes, the cameras, the lights, whose intensities stay, and the
 * box of a model. Logs, naming `path`, and returns
 * STATUS_DATA if coordinates are then beyond 1 000 000. */
MUST_USE enum status place_model(struct model *model, const struct place *place, const char *path);

#endif
