/* env_box.h: box of parallax-corrected environment lookups (refract.lookup=box). */
#ifndef FIRN_TECH_REFRACT_ENV_BOX_H
#define FIRN_TECH_REFRACT_ENV_BOX_H
#include "src/scene/geometry/mesh.h"
#include "src/tech/technique.h"

/* Sides of the box in world space, metres; all 0 selects the bounds of the surroundings. */
struct env_box_params {
    float min_x, max_x, min_y, max_y, min_z, max_z;
};

extern const struct setting_group env_box_settings;

/* Returns the box set by env_box.* or, if all sides are 0, the bounds of the surroundings. */
struct box env_box_of(const struct scene *scene, const struct settings *settings);

#endif
