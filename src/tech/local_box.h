/* local_box.h: the box on whose sides rays end with refract.lookup=box. */
#ifndef TECH_LOCAL_BOX_H
#define TECH_LOCAL_BOX_H
#include "src/scene/mesh.h"
#include "src/tech/technique.h"

/* Metres, world; all 0: that of the surroundings. */
struct local_params {
    float left, right; /* along x */
    float bottom, top; /* y */
    float back, front; /* z: the front is nearer to +Z */
};

extern const struct setting_group local_settings;

/* The box: that of the settings, else what lies around the object. One without room, or inside out,
 * is none. */
struct box local_box_of(const struct scene *scene, const struct settings *settings);

#endif
