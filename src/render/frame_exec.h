/*
 * frame_exec.h: a plan, realised: for the renderer, and for what compiles shaders beside it.
 *
 * Errors: logged once; as the renderer's.
 */
#ifndef FIRN_RENDER_FRAME_EXEC_H
#define FIRN_RENDER_FRAME_EXEC_H

#include "graph/rg_exec.h"
#include "shaders/constants.h"
#include "src/frame/plan.h"
#include "src/frame/view.h"
#include "src/render/renderer.h"

struct frame_exec {
    struct frame_plan frame;
    struct rg_exec *exec; /* NULL: not realised */
};

/* The request's tables to a plan; does it fit? */
MUST_USE enum status frame_exec_compile(struct frame_exec *frame_exec,
                                        const struct renderer_params *params,
                                        struct frame_request request);

/* The plan to memory, images, pipelines; imports as FRAME_IMPORT_COUNT has them. */
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
