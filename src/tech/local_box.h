/* local_box.h: box of projected environment lookups (refract.lookup=box). */
#ifndef TECH_LOCAL_BOX_H
#define TECH_LOCAL_BOX_H
#include "src/scene/mesh.h"
#include "src/tech/technique.h"

/* Sides of the box in world space, metres; all 0 selects the bounds of the surroundings. */
struct local_params {
    float left, right; /* minimum and maximum x */
    float bottom, top; /* minimum and maximum y */
    float back, front; /* minimum and maximum z: the front is nearer to +Z */
};

extern const struct setting_group local_settings;

/* Returns the box set by local.* or, if all sides are 0, the bounds of the surroundings. */
struct box local_box_of(const struct scene *scene, const struct settings *settings);

#endif
