/* absorb.h: absorption of light in the object. */
#ifndef TECH_ABSORB_H
#define TECH_ABSORB_H
#include "src/tech/technique.h"

/* What the object takes of light that passes it: exp(-absorb * length) is left. */
struct absorb_params {
    float red, green, blue; /* 1 / metre */
};

extern const struct setting_group absorb_settings;

#endif
