/*
 * plan.h: a frame's techniques, the copies that bring its results back, and their plan.
 *
 * Needs no device unless one is given.
 */
#ifndef FIRN_FRAME_PLAN_H
#define FIRN_FRAME_PLAN_H

#include "src/base/status.h"
#include "src/frame/layers.h"
#include "src/frame/list.h"

enum {
    FRAME_READBACK_COUNT = FRAME_LAYER_MAX + 2
}; /* images brought back at most */

/* What is brought in and wanted back. */
struct frame_request {
    struct technique_choice choice;
    const struct scene *scene; /* whose pictures are imported; NULL: none, but a texel of each */
    VkExtent2D view;
    VkExtent2D part;      /* of it, that is drawn at once; 0: all */
    uint32_t layers;      /* bit i: techniques_layer(i), if it is drawn */
    bool beauty, display; /* the linear picture; the 8-bit one */
    bool cube_back;       /* bring frame_env_cube_baked back */
    bool keep_cube;       /* leave frame_env_cube ready to be sampled elsewhere */
    bool keep_display;    /* the same of the 8-bit picture */
    enum rg_sharing sharing;
    const struct rg_device *device; /* may be NULL */
};

/* An image and the host buffer it is copied to. */
struct frame_readback {
    const struct rg_image *image;
    struct rg_buffer buffer;
    struct rg_use uses[3];
    char name[64]; /* of the pass and the buffer */
};

/* Points into itself: must not move. */
struct frame_plan {
    struct rg_plan *plan;
    struct frame_list list;
    const struct rg_technique **techniques; /* the list's parts, and `readback` */
    size_t technique_count;
    struct rg_technique readback;
    struct rg_pass readback_passes[FRAME_READBACK_COUNT];
    struct frame_readback readbacks[FRAME_READBACK_COUNT];
    uint32_t readback_count;
    struct rg_output outputs[FRAME_READBACK_COUNT + 2];
    size_t output_count;
    struct rg_import *imports;
    size_t import_count;
};

/* Faults of the tables are logged, all of them, and are STATUS_FAILED; memory STATUS_TRY_AGAIN. */
MUST_USE enum status frame_plan_init(struct frame_plan *plan, const struct frame_request *request);

void frame_plan_finish(struct frame_plan *plan);

/* The buffer that an image comes back in, or NULL. */
const struct rg_buffer *frame_plan_buffer(const struct frame_plan *plan,
                                          const struct rg_image *image);

#endif
