/* pool_parameters.h: settings of a pool of water: waves, ground, floating ice. */
#ifndef FIRN_TECH_WATER_POOL_PARAMETERS_H
#define FIRN_TECH_WATER_POOL_PARAMETERS_H
#include "shaders/water/water.h"
#include "src/tech/technique.h"

extern const struct setting_group water_settings, pool_settings;

/* Returns true if ice floats in the pool. */
bool pool_has_ice(const struct settings *settings);

/* Returns the push constants of the pool's shaders. */
struct water_push pool_push_of(const struct settings *settings);

#endif
