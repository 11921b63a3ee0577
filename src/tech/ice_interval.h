/* ice_interval.h: where along each pixel's ray there is ice, for objects of any shape. */
#ifndef TECH_ICE_INTERVAL_H
#define TECH_ICE_INTERVAL_H
#include "shaders/ice_interval.h"
#include "src/tech/technique.h"

struct ice_interval_params {
    uint32_t count; /* intervals of a pixel that are found: 1 to ICE_INTERVAL_MAX */
};

/* [k - 1] has k intervals: [ice_interval_index()] is drawn. Two layers an interval, by fitted
 * depth, the nearer half of them and the others: two images, for one of a large picture would be
 * larger than devices allow. shaders/ice_interval.glsl reads them. */
extern const struct rg_image ice_interval_near[ICE_INTERVAL_MAX];
extern const struct rg_image ice_interval_far[ICE_INTERVAL_MAX];

extern const struct rg_image ice_interval_count; /* how many there are */

extern const struct setting_group ice_interval_settings;

uint32_t ice_interval_index(const struct settings *settings);

#endif
