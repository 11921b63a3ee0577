/* low_res_inclusions.h: renders inclusions in the ice at a fraction of the view's resolution. */
#ifndef FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H
#define FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H

#include "src/tech/pass_arena.h"
#include "src/tech/technique.h"

/* List of the images that a frame draws at reduced resolution. */
struct low_res_images {
    struct pass_arena *builder; /* owner of images and passes */
    struct low_res_image *first;
};

/* Changes a pass group so that inclusions are drawn at the resolution set by inclusions.scale.
 * Returns additional passes that draw the object's depth maps at that resolution. Does nothing for
 * pools or a scale of 1. Sets builder->failed when out of memory. */
struct rg_technique low_res_inclusions_apply(struct low_res_images *small,
                                             const struct technique_config *config,
                                             enum technique_phase phase,
                                             struct rg_technique *group);

#endif
