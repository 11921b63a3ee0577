/* stage.h: floor and backdrop that are added below a model file without surroundings. */
#ifndef FIRN_SCENE_STAGE_STAGE_H
#define FIRN_SCENE_STAGE_STAGE_H

#include "src/scene/environment/environment.h"
#include "src/scene/import/model.h"

/* Kinds of ground, in the order of stage_ground_names. */
enum stage_ground {
    STAGE_AUTO, /* not chosen */
    STAGE_NONE,
    STAGE_SHADOW, /* shows the environment, with shadows and caustics */
    STAGE_STUDIO,
    STAGE_SLATE,
    STAGE_WOOD,
    STAGE_COLOR, /* matt ground of stage_params.color */
    STAGE_GROUND_COUNT,
};

/* Names on the command line; NULL-terminated. STAGE_COLOR has none. */
extern const char *const stage_ground_names[];

struct stage_params {
    enum stage_ground ground;
    vec3s color; /* albedo, linear; for STAGE_COLOR */
};

/* Returns true if a stage has a floor. */
static inline bool stage_has_floor(const struct stage_params *stage)
{
    return stage->ground > STAGE_NONE;
}

/* Returns the bounding box of what stands on a stage: the objects and, unless they are much larger,
 * the surroundings of the file. */
struct box stage_subject_box(const struct model *model);

/* Returns true if a model has surroundings of its own: a surface below the refractive objects that
 * is wider than these, or surroundings on all sides. A model without refractive objects has them if
 * it is a room seen from inside. */
bool stage_has_own_surroundings(const struct model *model);

/* Appends the floor to the surroundings of a model. `subject` stands on it. With distance, the
 * floor takes on the radiance of the panorama at the horizon, so that no horizon line is visible;
 * `environment` may be empty. Returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status stage_add(struct model *model, const struct stage_params *stage,
                               struct box subject, const struct environment *environment);

#endif
