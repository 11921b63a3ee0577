/* ice_interval.h: depth-peeled intervals of primary rays inside an object of any shape. */
#ifndef FIRN_TECH_ICE_ICE_INTERVAL_H
#define FIRN_TECH_ICE_ICE_INTERVAL_H
#include "shaders/ice/ice_interval.h"
#include "src/tech/technique.h"

struct ice_interval_params {
    uint32_t count; /* maximum intervals per pixel */
};

/* Entry and exit depths of each pixel's ray inside the ice. Images with index i hold up to i + 1
 * intervals. Nearer and farther depths are in separate images, because one image would exceed
 * device limits in large views. */
extern const struct rg_image ice_interval_near[ICE_INTERVAL_MAX];
extern const struct rg_image ice_interval_far[ICE_INTERVAL_MAX];

extern const struct rg_image ice_interval_count; /* number of intervals in each pixel */

extern const struct setting_group ice_interval_settings;

/* Returns the index into ice_interval_near and ice_interval_far that the settings select. */
uint32_t ice_interval_index(const struct settings *settings);

#endif
