/* local_box.h: the box on whose sides rays end if refract.lookup is `box`. */
#ifndef TECH_LOCAL_BOX_H
#define TECH_LOCAL_BOX_H
#include "src/scene/mesh.h"
#include "src/tech/technique.h"

/* Sides of the box, metres, world; all 0: the box of the surroundings. */
struct local_params {
    float left, right; /* along x */
    float bottom, top; /* y */
    float back, front; /* z: the front is nearer to +Z */
};

extern const struct setting_group local_settings;

/* Returns the box of the settings or, if that is empty or inside out, the scene's `around`. */
struct box local_box_of(const struct scene *scene, const struct settings *settings);

#endif
