/*
 * cell_state.h: what a cell needs before an access, and what the access leaves.
 *
 * Every cell (compiler.h) has its layout, its last write, the stages that have read it since, and
 * the stages and accesses that the write was made visible to. From these follow (Vulkan 1.3,
 * chapter 7): a read needs a barrier unless it is covered by an earlier one; a write always needs
 * one; a change of layout is a write between the barrier's two halves, and later barriers chain to
 * the stages it was made visible to.
 *
 * A frame follows the frame before on one queue without a pause, so the first use of any memory
 * waits for its last use in the frame before, and for the resources it is shared with.
 *
 * Private to graph/compile/.
 */
#ifndef RG_COMPILE_CELL_STATE_H
#define RG_COMPILE_CELL_STATE_H

#include "graph/compile/compiler.h"

/* A change of layout is a write. */
static inline bool rg_changes_cell(const struct cell *s, const struct access *a)
{
    return a->flags & ACCESS_WRITES || s->layout != a->layout;
}

/* Fills `b` but for resource and range, and *release: the first pass before which the barrier may
 * be. Returns false if the access needs no barrier. */
static inline bool rg_needs_barrier(const struct cell *s, const struct access *a,
                                    struct rg_barrier *b, uint32_t *release)
{
    bool changes = rg_changes_cell(s, a);
    if (!changes && !(a->visibility & ~s->visible))
        return false;
    VkPipelineStageFlags2 readers = changes ? s->read_stages : VK_PIPELINE_STAGE_2_NONE;
    /* the readers have waited for the write, and a barrier made the write available then */
    bool awaited = readers && s->flags & CELL_AWAITED;
    b->src_stages = awaited ? readers : readers | s->write_stages;
    b->src_access = awaited ? VK_ACCESS_2_NONE : s->write_access;
    b->dst_stages = a->stages;
    b->dst_access = a->mask;
    b->old_layout = a->flags & ACCESS_OVERWRITES ? VK_IMAGE_LAYOUT_UNDEFINED : s->layout;
    b->new_layout = a->layout;
    *release = changes ? s->touched : s->written;
    return s->layout != a->layout || b->src_stages || s->flags & CELL_FRESH;
}

/* Changes the state by an access in a pass; `made_visible`: it has just been given a barrier. */
static inline void rg_apply_access(struct cell *s, const struct access *a, uint32_t pass,
                                   bool made_visible)
{
    bool conditional = a->flags & ACCESS_CONDITIONAL;
    s->touched = pass + 1;
    if (rg_changes_cell(s, a)) {
        s->write_stages = a->stages;
        s->write_access = rg_access_table[a->kind].writes;
        s->read_stages = VK_PIPELINE_STAGE_2_NONE;
        s->visible = 0;
        s->barrier_end = 0;
        s->layout = a->layout;
        s->flags = conditional ? CELL_CHANGED : CELL_CHANGED | CELL_CERTAIN;
        s->written = pass + 1;
    }
    if (a->flags & ACCESS_WRITES)
        return;
    s->flags &= ~(uint32_t)CELL_FRESH;
    s->read_stages |= a->stages;
    /* the synchronization validation of some releases takes a read only for that in the frame of
     * the write, and no barrier for one */
    if (s->flags & CELL_CERTAIN && !conditional)
        s->flags |= CELL_AWAITED;
    if (made_visible)
        s->visible |= a->visibility & RG_VISIBLE_TO_ALL;
}

#endif
