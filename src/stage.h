/*
 * stage.h: a plan, realised: for the renderer, and for what compiles shaders beside it.
 *
 * Errors: logged once; as the renderer's.
 */
#ifndef FIRN_STAGE_H
#define FIRN_STAGE_H

#include "graph/rg_exec.h"
#include "shaders/constants.h"
#include "src/frame_plan.h"
#include "src/frame_view.h"
#include "src/renderer.h"

struct stage {
    struct frame_plan frame;
    struct rg_exec *exec; /* NULL: not realised */
};

/* The request's tables to a plan; does it fit? */
MUST_USE enum status stage_compile(struct stage *stage, const struct renderer_params *params,
                                   struct frame_request request);

/* The plan to memory, images, pipelines; imports as FRAME_IMPORT_COUNT has them. */
MUST_USE enum status stage_realise(struct stage *stage, const struct renderer_params *params,
                                   const struct rg_exec_import *imports);

/* What an executor is made from, all but imports, with what that points to: it must not move. */
struct stage_exec {
    struct frame_constants constants;
    VkSpecializationMapEntry entries[CONSTANT_COUNT];
    VkSpecializationInfo info;
    struct rg_exec_params params;
};

void stage_describe(struct stage_exec *described, const struct stage *stage,
                    const struct renderer_params *params);

void stage_destroy(struct stage *stage); /* half-built, {0}: fine */

#endif
