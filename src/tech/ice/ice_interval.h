/* ice_interval.h: depth-peeled intervals of primary rays inside an object of any shape. */
#ifndef FIRN_TECH_ICE_ICE_INTERVAL_H
#define FIRN_TECH_ICE_ICE_INTERVAL_H
#include "shaders/ice/ice_interval.h"
#include "src/tech/technique.h"

struct ice_interval_params {
    uint32_t count; /* maximum intervals per pixel */
};

/* Images for k intervals are at index k - 1. Each interval has two depth layers: entry and exit.
 * The nearer half and the farther half of all layers are separate images, because one image would
 * exceed device limits in large views. */
extern const struct rg_image ice_interval_near[ICE_INTERVAL_MAX];
extern const struct rg_image ice_interval_far[ICE_INTERVAL_MAX];

extern const struct rg_image ice_interval_count; /* number of intervals in each pixel */

extern const struct setting_group ice_interval_settings;

/* Returns the index of the images in use in the arrays ice_interval_near and ice_interval_far. */
uint32_t ice_interval_index(const struct settings *settings);

#endif
