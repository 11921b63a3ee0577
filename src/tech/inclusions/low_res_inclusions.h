/* low_res_inclusions.h: renders inclusions in the ice at a fraction of the view's resolution. */
#ifndef FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H
#define FIRN_TECH_INCLUSIONS_LOW_RES_INCLUSIONS_H

#include "src/tech/pass_builder.h"
#include "src/tech/technique.h"

/* The images of a frame that have reduced resolution. */
struct low_res_images {
    struct pass_builder *builder; /* owns the images and the passes that draw them */
    struct low_res_image *first;
};

/*
 * Changes the passes of a part for inclusions.scale. Depth maps inside the object are drawn once
 * more at that resolution, by the returned passes. Inclusions are drawn at that resolution and
 * upsampled for readers. Passes that composite inclusions read the reduced images.
 *
 * With inclusions.scale=1, and in a pool, nothing is changed. When out of memory, `failed` of the
 * builder is set.
 */
struct rg_technique low_res_inclusions_apply(struct low_res_images *small,
                                             const struct technique_choice *choice,
                                             enum technique_phase phase, struct rg_technique *part);

#endif
