/* low_res_inclusions.h: renders inclusions in the ice at a fraction of the view's resolution. */
#ifndef FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H
#define FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H

#include "src/tech/pass_builder.h"
#include "src/tech/technique.h"

/* List of a frame's images of reduced resolution. */
struct low_res_images {
    struct pass_builder *builder; /* owner of images and passes */
    struct low_res_image *first;
};

/* Changes a pass group: inclusions are drawn at the scale inclusions.scale and upsampled, or read
 * at that scale when composited. Returns additional passes that draw the object's depth maps at
 * that scale, if any. Changes nothing in a pool or if inclusions.scale is 1. Sets builder->failed
 * when out of memory. */
struct rg_technique low_res_inclusions_apply(struct low_res_images *small,
                                             const struct technique_config *config,
                                             enum technique_phase phase,
                                             struct rg_technique *group);

#endif
