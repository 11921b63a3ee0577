/*
 * warm_up.h: shaders compiled side by side, before and while the first picture is drawn.
 *
 * Mesa's drivers for the CPU compile a pipeline at its first draw, one after another, and keep the
 * result in a cache on disk. So threads draw the same passes from the last one on, nowhere, each
 * on a device of its own; what they have compiled the renderer's device finds in the cache. Where
 * there is no such cache the work is done twice, on cores that have nothing to do. Nothing depends
 * on it: whatever fails, or comes too late, the picture is the same. With FIRN_WARM_UP=off in the
 * environment there are no such threads: where many firn run beside each other, and the cache has
 * the shaders already, they would take a fourth of the processor time of a small picture.
 */
#ifndef FIRN_RENDER_WARM_UP_H
#define FIRN_RENDER_WARM_UP_H

#include "src/render/frame_exec.h"

struct warm_up;

/*
 * Begins with a frame_exec that is compiled, which outlives the result, as gpu and scene do. NULL:
 * nothing to be done, since the device is no CPU, there is one core only, validation watches, or
 * the environment says so.
 */
struct warm_up *warm_up_begin(const struct frame_exec *frame_exec,
                              const struct renderer_params *params);

/* Begins no further pass, waits for the threads, frees. NULL is fine. */
void warm_up_end(struct warm_up *warm_up);

#endif
