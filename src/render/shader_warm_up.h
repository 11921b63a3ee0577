/*
 * shader_warm_up.h: compiles shaders in parallel, before and while the first image is drawn.
 *
 * Mesa's CPU drivers compile a pipeline at its first draw, one pipeline after another, and keep the
 * result in a cache on disk. So several threads, each with a logical device of its own, record the
 * passes of the frame from the last to the first without drawing a pixel; the renderer's device
 * then finds the compiled shaders in the cache. Without such a cache the threads repeat work on
 * idle cores. No result depends on them: if they fail or are late, the image is the same.
 * FIRN_WARM_UP=off in the environment disables them, which is useful where many processes run in
 * parallel and the cache is filled: they take a quarter of the processor time of a small image.
 */
#ifndef FIRN_RENDER_SHADER_WARM_UP_H
#define FIRN_RENDER_SHADER_WARM_UP_H

#include "src/render/compiled_frame.h"

struct warm_up;

/* Starts warm-up threads for a compiled frame. The result borrows compiled_frame, gpu and scene.
 * Returns NULL, without an error, if the device is no CPU or has one core, validation is on,
 * shaders are replaced, FIRN_WARM_UP is `off`, or memory runs out. */
struct warm_up *shader_warm_up_begin(const struct compiled_frame *compiled_frame,
                                     const struct renderer_params *params);

/* Stops the threads after their current pass, waits for them and frees everything. Accepts NULL. */
void shader_warm_up_end(struct warm_up *warm_up);

#endif
