/* caustics.h: caustics of the sun on the floor of a pool. */
#ifndef FIRN_TECH_WATER_CAUSTICS_H
#define FIRN_TECH_WATER_CAUSTICS_H
#include "shaders/water/caustics.h"
#include "src/tech/technique.h"

/* Light map of the pool's floor (lib/caustics_map_coordinates.glsl), relative to light through
 * level water. */
extern const struct rg_image caustics_light;

/* AOV layer of sunlight on the visible ground; 0 where there is no ground. In pools, 1 is the
 * sunlight below level water. In other scenes, 1 is the sunlight without the ice. */
extern const struct rg_image caustics_layer;

extern const struct technique caustics;              /* passes depend on the method */
extern const struct setting_group caustics_settings; /* struct caustics_params */

/* Returns true if pool caustics are on, i.e. the method is not `none`. */
bool caustics_are_lit(const struct settings *settings);

#endif
