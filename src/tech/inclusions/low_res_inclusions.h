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

/* Makes a pass group draw inclusions at the resolution set by inclusions.scale. Returns further
 * passes, which draw the object's depth maps at this resolution. For pools or a scale of 1, does
 * nothing. If out of memory, sets builder->failed. */
struct rg_technique low_res_inclusions_apply(struct low_res_images *small,
                                             const struct technique_config *config,
                                             enum technique_phase phase,
                                             struct rg_technique *group);

#endif
