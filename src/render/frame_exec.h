/* frame_exec.h: a frame's plan and its executor. Errors are logged once; see renderer.h. */
#ifndef FIRN_RENDER_FRAME_EXEC_H
#define FIRN_RENDER_FRAME_EXEC_H

#include "graph/rg_exec.h"
#include "shaders/specialization_constants.h"
#include "src/frame/frame_plan.h"
#include "src/frame/frame_uniforms.h"
#include "src/render/renderer_params.h"

struct frame_exec {
    struct frame_plan *frame; /* NULL until frame_exec_compile() */
    struct rg_exec *exec;     /* NULL until frame_exec_realise() */
};

/* Returns the Vulkan handles that the render graph library needs. */
struct rg_vulkan frame_exec_vulkan(const struct gpu *gpu);

/* Compiles the request to a plan, and checks that its memory fits in the device's heaps. */
MUST_USE enum status frame_exec_compile(struct frame_exec *frame_exec,
                                        const struct renderer_params *params,
                                        struct frame_request request);

/* Creates the plan's memory, images and pipelines. `imports` are in the order of frame->imports. */
MUST_USE enum status frame_exec_realise(struct frame_exec *frame_exec,
                                        const struct renderer_params *params,
                                        const struct rg_exec_import *imports);

/* Replaces frame_exec's plan by that of *next, which has no executor. Keeps resources that both
 * need (rg_exec_update()). *next becomes {0}. After a failure frame_exec may only be destroyed. */
MUST_USE enum status frame_exec_replace(struct frame_exec *frame_exec, struct frame_exec *next,
                                        const struct renderer_params *params,
                                        const struct rg_exec_import *imports);

/* Changes the view to request.view and keeps the executor: see frame_plan_change_view(). */
MUST_USE enum status frame_exec_change_view(struct frame_exec *frame_exec,
                                            const struct renderer_params *params,
                                            struct frame_request request,
                                            const struct rg_exec_import *imports);

/* Parameters of an executor, except for its imports. `info` and `params` point into this struct, so
 * it must not be moved or copied. */
struct frame_exec_params {
    struct frame_constants constants;
    VkSpecializationMapEntry entries[CONSTANT_COUNT];
    VkSpecializationInfo info;
    struct rg_exec_params params;
};

/* Fills *described for a frame_exec that has been compiled. */
void frame_exec_describe(struct frame_exec_params *described, const struct frame_exec *frame_exec,
                         const struct renderer_params *params);

void frame_exec_destroy(struct frame_exec *frame_exec); /* half-built, {0}: fine */

#endif
