/* water.h: a pool of water: its surface, and the ground seen through it. */
#ifndef TECH_WATER_H
#define TECH_WATER_H
#include "shaders/water.h"
#include "src/tech/technique.h"

/* Whether ice floats in the pool. */
bool water_has_ice(const struct settings *settings);
extern const struct setting_group water_settings, pool_settings;

/* What shaders of the pool are told: struct water_push. */
struct water_push water_push_of(const struct settings *settings);

/* The row that says in a picture's settings that its scene is a pool. */
#define WATER_IS_ON_ROW (&pool_settings.rows[0])

#endif
