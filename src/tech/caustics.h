/* caustics.h: the sun's light on the floor of a pool. */
#ifndef TECH_CAUSTICS_H
#define TECH_CAUSTICS_H
#include "shaders/caustics.h"
#include "src/tech/technique.h"

/* A map on the plane of the floor (shaders/lib/caustics_map.glsl): 1 is as much light as falls on
 * it below water at rest with nothing around it. */
extern const struct rg_image caustics_light;

/* The layer: the light on the ground that a pixel shows, as in caustics_light, or as much as
 * without the ice (ice_caustics.h); 0 elsewhere. */
extern const struct rg_image caustics_seen;

extern const struct technique caustics;              /* its rows are those of the method */
extern const struct setting_group caustics_settings; /* struct caustics_params */

/* Whether the settings choose a method. */
bool caustics_are_lit(const struct settings *settings);

#endif
