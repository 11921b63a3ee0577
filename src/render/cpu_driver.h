/*
 * cpu_driver.h: optimisations for drivers that draw on the CPU, such as Mesa's lavapipe.
 *
 * All code for such drivers is here and in warm_up.h, which compiles their shaders in parallel.
 * It saves time and memory and changes no byte of a picture.
 */
#ifndef FIRN_RENDER_CPU_DRIVER_H
#define FIRN_RENDER_CPU_DRIVER_H

#include "graph/rg_exec.h"
#include "src/gpu/gpu.h"

/* Returns whether the device is the CPU. */
bool cpu_driver_is(const struct gpu *gpu);

/*
 * Asks llvmpipe to compile shaders without optimization, for pictures whose drawing takes less than
 * that saves: sets GALLIVM_PERF in the environment unless it has a value. Call it before
 * gpu_create() and while no other thread reads the environment.
 */
void cpu_driver_prefer_start(void);

/*
 * Chooses the size of pages for an executor's memory, where the device is the CPU: large ones,
 * because a frame touches its memory page by page for the first time in its first picture; small
 * ones for a region of the view, which touches pieces of rows, so that the rest costs nothing.
 */
void cpu_driver_advise_memory(const struct gpu *gpu, const struct rg_plan *plan,
                              struct rg_exec *exec);

#endif
