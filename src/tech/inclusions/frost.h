/* frost.h: frost crystals on the ice's surface. */
#ifndef FIRN_TECH_INCLUSIONS_FROST_H
#define FIRN_TECH_INCLUSIONS_FROST_H
#include "src/tech/technique.h"

extern const struct technique frost;
extern const struct setting_group frost_settings;

struct frost_params {
    float amount;    /* maximum fraction of light that the frost scatters; 0 for no frost */
    float roughness; /* of the slopes; squared: GGX alpha */
};

#endif
