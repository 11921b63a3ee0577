/* absorb.h: absorption of light in the object. */
#ifndef TECH_ABSORB_H
#define TECH_ABSORB_H
#include "src/tech/technique.h"

/* Absorption coefficients: the share exp(-coefficient * length) of the light passes the object. */
struct absorb_params {
    float red, green, blue; /* 1 / metre */
};

extern const struct setting_group absorb_settings;

#endif
