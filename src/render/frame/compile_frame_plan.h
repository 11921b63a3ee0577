/* compile_frame_plan.h: compiles a frame's techniques and readback to a render-graph plan. */
#ifndef FIRN_RENDER_FRAME_COMPILE_FRAME_PLAN_H
#define FIRN_RENDER_FRAME_COMPILE_FRAME_PLAN_H

#include "src/base/status.h"
#include "src/render/frame/output_layers.h"
#include "src/render/frame/pass_list.h"

enum {
    FRAME_READBACK_COUNT = FRAME_LAYER_MAX + 2
}; /* maximum number of images read back */

/* Description of a frame: what it imports, draws and reads back. */
struct frame_request {
    struct technique_config config;
    VkExtent2D view;       /* pixels */
    uint32_t face_size;    /* cube face width, texels; 0: automatic */
    VkExtent2D max_view;   /* limit of frame_plan_change_view(); 0: `view` */
    VkExtent2D max_region; /* largest tile, pixels; 0: whole view */
    uint64_t layers;       /* bit i: read back techniques_layer(i) */
    bool beauty, display;  /* read back linear; 8-bit image */
    bool keep_cube;        /* keep frame_env_cube for other frames */
    bool keep_display;     /* keep the 8-bit image */
    enum rg_sharing sharing;
    const struct rg_device *device; /* may be NULL */
};

/* An image, and the host-visible buffer to which it is copied. */
struct frame_readback {
    const struct rg_image *image;
    struct rg_buffer buffer;
    struct rg_use uses[3];
    char name[64]; /* of the pass and the buffer */
};

/* Compiled plan and its tables. It contains pointers to itself, so it must not be moved. */
struct frame_plan {
    struct rg_plan *plan;
    VkExtent2D max_region; /* largest tile, pixels; 0: whole view */
    struct frame_list list;
    const struct rg_technique **techniques; /* pass groups of `list`, and `readback` */
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

/* Compiles the plan of a frame, without a device. Logs errors. Returns STATUS_FAILED if tables are
 * invalid, STATUS_TRY_AGAIN if out of memory. Even after an error, call frame_plan_finish(). */
MUST_USE enum status frame_plan_init(struct frame_plan *plan, const struct frame_request *request);

/* Recompiles the plan for the image size request->view. The size is limited by request->max_view
 * and by the max_view given to frame_plan_init(). On success, the caller owns the replaced plan,
 * *previous. On failure, nothing changes. */
MUST_USE enum status frame_plan_change_view(struct frame_plan *plan,
                                            const struct frame_request *request,
                                            struct rg_plan **previous);

void frame_plan_finish(struct frame_plan *plan);

/* Returns the buffer into which an image is read back, or NULL. */
const struct rg_buffer *frame_plan_buffer(const struct frame_plan *plan,
                                          const struct rg_image *image);

#endif
