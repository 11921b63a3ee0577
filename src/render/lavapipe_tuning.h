/*
 * lavapipe_tuning.h: optimisations for software Vulkan drivers such as Mesa's lavapipe. They save
 * time and memory, and all images stay bit-identical.
 */
#ifndef FIRN_RENDER_LAVAPIPE_TUNING_H
#define FIRN_RENDER_LAVAPIPE_TUNING_H

#include "graph/rg_exec.h"
#include "src/gpu/gpu.h"
#include "src/render/frame/compile_frame_plan.h"

enum {
    /* number of samples, of all pixels and frames, up to which a process prefers a short start */
    LAVAPIPE_TUNING_START_SAMPLES = 1 << 17,
};

/* Returns true if the device is the CPU. */
bool lavapipe_tuning_is_cpu(const struct gpu *gpu);

/* Makes llvmpipe compile shaders without optimisation: sets GALLIVM_PERF in the environment, unless
 * it is set. This is faster for images that take little time to draw. Must be called before
 * gpu_create(), while no other thread reads the environment. */
void lavapipe_tuning_prefer_start(void);

/* Chooses the page size of an executor's memory on a CPU device. A whole view gets huge pages,
 * because the first frame page-faults on all memory. A region of a view gets small pages, because
 * untouched pages between parts of rows are then never committed. */
void lavapipe_tuning_advise_memory(const struct gpu *gpu, const struct frame_plan *frame,
                                   struct rg_exec *exec);

#endif
