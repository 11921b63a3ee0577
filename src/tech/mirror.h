/* mirror.h: screen-space reflections of the refractive objects in glossy surroundings. */
#ifndef TECH_MIRROR_H
#define TECH_MIRROR_H
#include "src/tech/technique.h"

/* Inputs written by the passes of the surroundings: BACKGROUND_OUT_SURFACE and _GLOSSY
 * (shaders/background.h). Undefined in pixels without materials. */
extern const struct rg_image mirror_surface, mirror_glossy;

extern const struct setting_group mirror_settings;

struct mirror_params {
    uint32_t steps;   /* ray march steps; 0 switches reflections off */
    uint32_t refract; /* 1: reflected rays are refracted by the object that they hit */
};

/* Returns true if a frame draws screen-space reflections. */
bool mirror_is_drawn(const struct technique_choice *choice);

#endif
