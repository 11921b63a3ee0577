/* ice_interval.h: the intervals of each pixel's ray that are inside an object of any shape. */
#ifndef TECH_ICE_INTERVAL_H
#define TECH_ICE_INTERVAL_H
#include "shaders/ice_interval.h"
#include "src/tech/technique.h"

struct ice_interval_params {
    uint32_t count; /* intervals that are searched for in a pixel: 1 to ICE_INTERVAL_MAX */
};

/* Images for k intervals at index k - 1; that at ice_interval_index() is drawn. Each interval has
 * two layers of fitted depth; the nearer half of all layers is in one image and the farther half in
 * the other, because one image of a large picture would exceed devices' limits.
 * shaders/ice_interval.glsl reads them. */
extern const struct rg_image ice_interval_near[ICE_INTERVAL_MAX];
extern const struct rg_image ice_interval_far[ICE_INTERVAL_MAX];

extern const struct rg_image ice_interval_count; /* number of intervals in each pixel */

extern const struct setting_group ice_interval_settings;

/* Returns the index of the images that are drawn. */
uint32_t ice_interval_index(const struct settings *settings);

#endif
