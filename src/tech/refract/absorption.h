/* absorption.h: settings of Beer-Lambert absorption in the object. */
#ifndef FIRN_TECH_REFRACT_ABSORPTION_H
#define FIRN_TECH_REFRACT_ABSORPTION_H
#include "src/tech/technique.h"

/* Absorption coefficients; the transmittance of a path is exp(-coefficient * length). */
struct absorb_params {
    float red, green, blue; /* 1 / metre */
};

extern const struct setting_group absorb_settings;

#endif
