/*
 * warm_up.h: compiles shaders in parallel, before and while the first picture is drawn.
 *
 * Mesa's drivers for the CPU compile a pipeline when it is first drawn with, one after another, and
 * keep the result in a cache on disk. Therefore threads, each with a logical device of its own,
 * record the passes of the frame from the last to the first, without drawing a pixel; the
 * renderer's device then finds the compiled shaders in the cache. Without such a cache the threads
 * repeat work on idle cores. No result depends on them: if they fail or are late, the picture is
 * the same. FIRN_WARM_UP=off in the environment disables them: where many processes run in parallel
 * and the cache is filled already, they take a quarter of the processor time of a small picture.
 */
#ifndef FIRN_RENDER_WARM_UP_H
#define FIRN_RENDER_WARM_UP_H

#include "src/render/frame_exec.h"

struct warm_up;

/*
 * Starts the threads for a compiled frame_exec. It, gpu and scene must outlive the result. Returns
 * NULL, which is no error, if the device is no CPU, there is only one core, validation is on,
 * shaders are replaced, memory is short, or the environment disables it.
 */
struct warm_up *warm_up_begin(const struct frame_exec *frame_exec,
                              const struct renderer_params *params);

/* Tells the threads to begin no further pass, waits for them and frees everything. NULL is fine. */
void warm_up_end(struct warm_up *warm_up);

#endif
