/* rg_firn.h: extensions of the executor for firn and for tests. Neither installed nor exported. */
#ifndef RG_RG_FIRN_H
#define RG_RG_FIRN_H

#include "graph/rg_exec.h"

/* Returns the next row to merge into a raster pass, given the pass's own `row` first and then each
 * result; NULL ends the list. Merging passes over parts of the same targets saves barriers. A
 * merged row comes later in the plan and has the pass's targets, images, shaders and state; its
 * buffers may differ, its load operations are ignored, and the pass's `area` applies. Its own pass
 * must be skipped in this frame (`when`, `area`). The graph does not check whether passes in
 * between write what it reads. */
typedef const struct rg_pass *rg_more_fn(const struct rg_pass *row, const struct rg_frame *frame);

/* Further parameters of an executor; a zeroed struct has no effect. */
struct rg_exec_extensions {
    /* VkRenderPass objects instead of dynamic rendering, for old validation layers */
    bool render_passes;
    rg_more_fn *more; /* called for each raster pass without rg_pass.secondary; may be NULL */
    /* fragments fetch through this sampler only the texel at their own position; may be NULL */
    const struct rg_sampler *same_texel;
};

/* As rg_exec_create(). `extensions` is copied and stays in effect after rg_exec_update(). */
struct rg_exec *rg_exec_create_extended(const struct rg_exec_params *params,
                                        const struct rg_exec_extensions *extensions,
                                        VkResult *result);

/* A region of the view, for tiled rendering of images that are too large to draw at once. */
struct rg_exec_region {
    VkRect2D region; /* nonempty */
    /* area in which images are drawn if passes sample them without `same_texel`; any size */
    VkRect2D reach;
};

/* Restricts later frames to a region of the view, with values bit-identical to those of a whole
 * frame; the rest is undefined. Affects passes that draw into images of the view's size that are
 * neither imported nor persistent, or that only copy from these to buffers, which receive `region`
 * tightly packed. Images that a pass samples without `same_texel` are also drawn in `reach`.
 * Fragment derivatives require even offsets. rg_exec_update() resets the region. */
void rg_exec_set_region(struct rg_exec *exec, const struct rg_exec_region *region);

/*
 * Submits the next part of the frame begun last, and waits for it. A part is a group of passes, or
 * a rectangle of one raster pass, that will take about `seconds` by the times of earlier parts;
 * a compute pass or a copy is never divided. Returns VK_NOT_READY until the last part, and then
 * VK_SUCCESS. Between the parts of a frame, which have equal `frame`, the host may use other
 * executors, but of this one only rg_exec_submit_part(), rg_exec_abandon() and rg_exec_destroy().
 * Values are those of rg_exec_submit(). Raster passes with storage writes are not divided. Record
 * functions may be called several times. The plan uses only the main queue.
 */
VkResult rg_exec_submit_part(struct rg_exec *exec, const struct rg_frame *frame, double seconds);

/* Ends a frame of which only some parts have been submitted, without the other passes' commands.
 * Resources that these passes write have undefined content, persistent ones too. Also called
 * before a frame of another view, because it forgets which rows of a pass take long. */
VkResult rg_exec_abandon(struct rg_exec *exec);

#endif
