/*
 * cpu_driver.h: optimisations for software Vulkan drivers, such as Mesa's lavapipe.
 *
 * All code for such drivers is here and in shader_warm_up.h, which compiles their shaders in
 * parallel. It saves time and memory and leaves every image bit-identical.
 */
#ifndef FIRN_RENDER_CPU_DRIVER_H
#define FIRN_RENDER_CPU_DRIVER_H

#include "graph/rg_exec.h"
#include "src/gpu/gpu.h"

/* Returns true if the device is the CPU. */
bool cpu_driver_is(const struct gpu *gpu);

/* Asks llvmpipe to compile shaders without optimisation, which is faster overall for images that
 * take little time to draw: sets GALLIVM_PERF in the environment unless it has a value. Must be
 * called before gpu_create() and while no other thread reads the environment. */
void cpu_driver_prefer_start(void);

/* Chooses the page size of an executor's memory if the device is the CPU: huge pages for a whole
 * view, because its first frame page-faults on all of its memory; small pages for a region of the
 * view, which touches only pieces of rows, so that the rest is never committed. */
void cpu_driver_advise_memory(const struct gpu *gpu, const struct rg_plan *plan,
                              struct rg_exec *exec);

#endif
