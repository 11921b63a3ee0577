/* pool.h: what a pool of water is: its waves, its ground, what floats in it. */
#ifndef TECH_POOL_H
#define TECH_POOL_H
#include "shaders/water.h"
#include "src/tech/technique.h"

/* Whether ice floats in the pool. */
bool pool_has_ice(const struct settings *settings);
extern const struct setting_group water_settings, pool_settings;

/* What shaders of the pool are told: struct water_push. */
struct water_push pool_push_of(const struct settings *settings);

#endif
