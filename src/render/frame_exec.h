/*
 * frame_exec.h: a plan and its executor, for the renderer and for the warm-up of shaders.
 *
 * Errors: logged once; as the renderer's.
 */
#ifndef FIRN_RENDER_FRAME_EXEC_H
#define FIRN_RENDER_FRAME_EXEC_H

#include "graph/rg_exec.h"
#include "shaders/constants.h"
#include "src/frame/plan.h"
#include "src/frame/view.h"
#include "src/render/renderer_params.h"

struct frame_exec {
    struct frame_plan frame;
    struct rg_exec *exec; /* NULL: not realised */
};

/* A device as the graph library takes it. */
struct rg_vulkan frame_exec_vulkan(const struct gpu *gpu);

/* Compiles the request to a plan, and checks that its memory fits. */
MUST_USE enum status frame_exec_compile(struct frame_exec *frame_exec,
                                        const struct renderer_params *params,
                                        struct frame_request request);

/* Makes the plan's memory, images and pipelines; `imports` are in the order of frame.imports. */
MUST_USE enum status frame_exec_realise(struct frame_exec *frame_exec,
                                        const struct renderer_params *params,
                                        const struct rg_exec_import *imports);

/* What an executor is made from, all but imports, with what that points to: it must not move. */
struct frame_exec_params {
    struct frame_constants constants;
    VkSpecializationMapEntry entries[CONSTANT_COUNT];
    VkSpecializationInfo info;
    struct rg_exec_params params;
};

void frame_exec_describe(struct frame_exec_params *described, const struct frame_exec *frame_exec,
                         const struct renderer_params *params);

void frame_exec_destroy(struct frame_exec *frame_exec); /* half-built, {0}: fine */

#endif
