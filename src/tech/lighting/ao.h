/* ao.h: ambient occlusion of the refractive objects on their surroundings. */
#ifndef FIRN_TECH_LIGHTING_AO_H
#define FIRN_TECH_LIGHTING_AO_H
#include "src/tech/technique.h"

/* Uses of passes whose shaders include lib/ao.glsl. */
extern const struct rg_use ao_uses[];

extern const struct setting_group ao_settings;

struct ao_params {
    float strength; /* factor on the occlusion */
};

#endif
