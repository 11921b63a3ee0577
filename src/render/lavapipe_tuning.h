/*
 * lavapipe_tuning.h: optimisations for software Vulkan drivers, such as Mesa's lavapipe.
 *
 * All code for such drivers is here and in shader_warm_up.h, which compiles their shaders in
 * parallel. The optimisations save time and memory; every image stays bit-identical.
 */
#ifndef FIRN_RENDER_LAVAPIPE_TUNING_H
#define FIRN_RENDER_LAVAPIPE_TUNING_H

#include "graph/rg_exec.h"
#include "src/gpu/gpu.h"

/* Returns true if the device is the CPU. */
bool lavapipe_tuning_is_cpu(const struct gpu *gpu);

/* Asks llvmpipe to compile shaders without optimisation, which is faster overall for images that
 * take little time to draw: sets GALLIVM_PERF in the environment unless it has a value. Must be
 * called before gpu_create() and while no other thread reads the environment. */
void lavapipe_tuning_prefer_start(void);

/* Chooses the page size of an executor's memory on a CPU device. A whole view gets huge pages,
 * because its first frame page-faults on all of its memory. A region of the view gets small pages,
 * because it touches only parts of rows, and the rest is then never committed. */
void lavapipe_tuning_advise_memory(const struct gpu *gpu, const struct rg_plan *plan,
                                   struct rg_exec *exec);

#endif
