/* target_scale.h: draws what is in the ice at a fraction of the view. */
#ifndef FIRN_TECH_TARGET_SCALE_H
#define FIRN_TECH_TARGET_SCALE_H

#include "src/tech/row_builder.h"
#include "src/tech/technique.h"

/* The images of a frame that have a fraction of the view's size. */
struct small_images {
    struct row_builder *builder; /* owns them, and the rows that draw them */
    struct small_image *first;
};

/*
 * Changes a part's rows as target.scale wants them. Depths inside the object are drawn once more at
 * that size, by the rows that are returned. Inclusions are drawn at that size, and rows that make
 * images of the view's size from theirs follow, for whatever reads those. Rows that blend
 * inclusions over the picture read the small images.
 *
 * With target.scale=1, and in a pool, nothing is changed. When out of memory, `failed` of the
 * builder is set.
 */
struct rg_technique target_scale_apply(struct small_images *small,
                                       const struct technique_choice *choice,
                                       enum technique_phase phase, struct rg_technique *part);

#endif
