/* caustics.h: caustics of the sun on the floor of a pool. */
#ifndef FIRN_TECH_WATER_CAUSTICS_H
#define FIRN_TECH_WATER_CAUSTICS_H
#include "shaders/water/caustics.h"
#include "src/tech/technique.h"

/* Light map on the floor's plane (lib/caustics_map.glsl), relative to light through level water. */
extern const struct rg_image caustics_light;

/* AOV layer: sunlight on the ground visible in a pixel; 0 without ground. Relative to sunlight
 * below level water (caustics_light) or to sunlight without the ice (ice_caustics.h). */
extern const struct rg_image caustics_layer;

extern const struct technique caustics;              /* passes depend on the method */
extern const struct setting_group caustics_settings; /* struct caustics_params */

/* Returns true if pool caustics are on, i.e. the method is not `none`. */
bool caustics_are_lit(const struct settings *settings);

#endif
