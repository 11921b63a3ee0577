/* caustics.h: the sun's light on the floor of a pool. */
#ifndef TECH_CAUSTICS_H
#define TECH_CAUSTICS_H
#include "shaders/caustics.h"
#include "src/tech/technique.h"

/* The light map of the floor's plane (shaders/lib/caustics_map.glsl): 1 is the light that falls on
 * it through water at rest without walls. */
extern const struct rg_image caustics_light;

/* The layer: the light on the ground in a pixel, relative to that below water at rest
 * (caustics_light) or without the ice (ice_caustics.h); 0 in other pixels. */
extern const struct rg_image caustics_seen;

extern const struct technique caustics;              /* has the rows of the chosen method */
extern const struct setting_group caustics_settings; /* struct caustics_params */

/* Returns whether the settings choose a method. */
bool caustics_are_lit(const struct settings *settings);

#endif
