/* compiled_frame.h: compiled plan of a frame, with its executor. Errors are logged. */
#ifndef FIRN_RENDER_COMPILED_FRAME_H
#define FIRN_RENDER_COMPILED_FRAME_H

#include "graph/rg_exec.h"
#include "shaders/specialization_constants.h"
#include "src/render/frame/compile_frame_plan.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/render/renderer_params.h"

struct compiled_frame {
    struct frame_plan *frame; /* NULL until compiled_frame_compile() */
    struct rg_exec *exec;     /* NULL until compiled_frame_realise() */
};

/* Returns the Vulkan handles that the render graph library needs. */
struct rg_vulkan compiled_frame_vulkan(const struct gpu *gpu);

/* Compiles the request to a plan, and checks that its memory fits in the device's heaps. */
MUST_USE enum status compiled_frame_compile(struct compiled_frame *compiled_frame,
                                            const struct renderer_params *params,
                                            struct frame_request request);

/* Creates the plan's memory, images and pipelines. `imports` are in the order of frame->imports. */
MUST_USE enum status compiled_frame_realise(struct compiled_frame *compiled_frame,
                                            const struct renderer_params *params,
                                            const struct rg_exec_import *imports);

/* Moves the plan of *next, which has no executor yet, to compiled_frame. Resources that the old
 * plan also needs are kept (rg_exec_update()). After a failure, destroy compiled_frame. */
MUST_USE enum status compiled_frame_replace(struct compiled_frame *compiled_frame,
                                            struct compiled_frame *next,
                                            const struct renderer_params *params,
                                            const struct rg_exec_import *imports);

/* Changes the view to request.view, without a new executor (see frame_plan_change_view()). */
MUST_USE enum status compiled_frame_change_view(struct compiled_frame *compiled_frame,
                                                const struct renderer_params *params,
                                                struct frame_request request,
                                                const struct rg_exec_import *imports);

void compiled_frame_destroy(struct compiled_frame *compiled_frame); /* half-built, {0}: fine */

#endif
