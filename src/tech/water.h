/* water.h: a pool of water: its surface, and the ground seen through it. */
#ifndef TECH_WATER_H
#define TECH_WATER_H
#include "shaders/water.h"
#include "src/tech/technique.h"

/* What the settings choose: its ground under even light or caustics_light; ice that floats in it.
 * Comes after ice_normal where there is ice. */
const struct technique *water_find(const struct settings *settings);
bool water_has_ice(const struct settings *settings);
extern const struct setting_group water_settings, pool_settings;

/* What shaders of the pool are told: struct water_push. */
struct water_push water_push_of(const struct settings *settings);

/* Whether the frame is of a pool; and the row that says so. */
bool water_is_on(const struct settings *settings);
#define WATER_IS_ON_ROW (&pool_settings.rows[0])

#endif
