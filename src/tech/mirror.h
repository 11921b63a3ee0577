/* mirror.h: the objects' mirror image in the surroundings. */
#ifndef TECH_MIRROR_H
#define TECH_MIRROR_H
#include "src/tech/technique.h"

/* What the background's rows draw of the nearest surroundings with materials, undefined elsewhere:
 * BACKGROUND_OUT_SURFACE and _GLOSSY (shaders/background.h). */
extern const struct rg_image mirror_surface, mirror_glossy;

extern const struct setting_group mirror_settings;

struct mirror_params {
    uint32_t steps;   /* along a mirrored ray; 0: nothing is mirrored */
    uint32_t refract; /* 1: mirrored rays are refracted by what they meet */
};

/* Returns whether a frame draws it. */
bool mirror_is_drawn(const struct technique_choice *choice);

#endif
