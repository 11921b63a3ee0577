/* frame_executor.h: compiled plan of a frame, with its executor. Errors are logged. */
#ifndef FIRN_RENDER_FRAME_EXECUTOR_H
#define FIRN_RENDER_FRAME_EXECUTOR_H

#include "graph/rg_exec.h"
#include "shaders/specialization_constants.h"
#include "src/frame/frame_plan.h"
#include "src/frame/frame_uniforms.h"
#include "src/render/renderer_params.h"

struct frame_executor {
    struct frame_plan *frame; /* NULL until frame_executor_compile() */
    struct rg_exec *exec;     /* NULL until frame_executor_realise() */
};

/* Returns the Vulkan handles that the render graph library needs. */
struct rg_vulkan frame_executor_vulkan(const struct gpu *gpu);

/* Compiles the request to a plan, and checks that its memory fits in the device's heaps. */
MUST_USE enum status frame_executor_compile(struct frame_executor *frame_executor,
                                            const struct renderer_params *params,
                                            struct frame_request request);

/* Creates the plan's memory, images and pipelines. `imports` are in the order of frame->imports. */
MUST_USE enum status frame_executor_realise(struct frame_executor *frame_executor,
                                            const struct renderer_params *params,
                                            const struct rg_exec_import *imports);

/* Replaces the plan of frame_executor by that of *next, which has no executor yet. Keeps resources
 * that both plans need (rg_exec_update()). After a failure, frame_executor must be destroyed. */
MUST_USE enum status frame_executor_replace(struct frame_executor *frame_executor,
                                            struct frame_executor *next,
                                            const struct renderer_params *params,
                                            const struct rg_exec_import *imports);

/* Changes the view to request.view, without a new executor (see frame_plan_change_view()). */
MUST_USE enum status frame_executor_change_view(struct frame_executor *frame_executor,
                                                const struct renderer_params *params,
                                                struct frame_request request,
                                                const struct rg_exec_import *imports);

/* Parameters for creating an executor, without imports. Must not be moved or copied, because `info`
 * and `params` point into the struct. */
struct frame_executor_params {
    struct frame_constants constants;
    VkSpecializationMapEntry entries[CONSTANT_COUNT];
    VkSpecializationInfo info;
    struct rg_exec_params params;
};

/* Fills *described from a frame_executor whose plan has been compiled. */
void frame_executor_describe(struct frame_executor_params *described,
                             const struct frame_executor *frame_executor,
                             const struct renderer_params *params);

void frame_executor_destroy(struct frame_executor *frame_executor); /* half-built, {0}: fine */

#endif
