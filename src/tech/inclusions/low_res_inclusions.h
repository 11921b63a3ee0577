/* low_res_inclusions.h: renders inclusions in the ice at a fraction of the view's resolution. */
#ifndef FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H
#define FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H

#include "src/tech/pass_builder.h"
#include "src/tech/technique.h"

/* The images of a frame that have reduced resolution. */
struct low_res_images {
    struct pass_builder *builder; /* owner of images and passes */
    struct low_res_image *first;
};

/* Changes a pass group for inclusions.scale: inclusions are drawn at reduced resolution and
 * upsampled for readers; passes that composite them read the reduced images. Returns passes that
 * draw the object's depth maps again at that resolution. With inclusions.scale=1, and in a pool,
 * changes nothing. Sets `failed` of the builder when out of memory. */
struct rg_technique low_res_inclusions_apply(struct low_res_images *small,
                                             const struct technique_config *config,
                                             enum technique_phase phase,
                                             struct rg_technique *group);

#endif
