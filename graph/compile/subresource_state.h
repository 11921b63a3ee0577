/*
 * subresource_state.h: synchronisation state of a subresource, and its barriers.
 *
 * A cell (compiler.h) has the layout, the last write, its readers so far, and the accesses to which
 * the write was made visible. From these follow (Vulkan 1.3, chapter 7): a read needs a barrier
 * unless an earlier one covers it; a write always needs one; a layout transition is a write between
 * the barrier's two scopes, and later barriers chain to the second. Frames overlap on one queue, so
 * the first use of any memory waits for its last use in the previous frame, and for the resources
 * that it aliases. Private to graph/compile/.
 */
#ifndef RG_COMPILE_SUBRESOURCE_STATE_H
#define RG_COMPILE_SUBRESOURCE_STATE_H

#include "graph/compile/compiler.h"

/* Returns true if an access writes the subresource; a layout transition counts as a write. */
static inline bool rg_changes_cell(const struct cell *s, const struct access *a)
{
    return a->flags & ACCESS_WRITES || s->layout != a->layout;
}

/* Returns false if the access needs no barrier. Fills the barrier `b` except its resource and
 * range. Sets *release to the earliest pass that the barrier may precede. */
static inline bool rg_needs_barrier(const struct cell *s, const struct access *a,
                                    struct rg_barrier *b, uint32_t *release)
{
    bool changes = rg_changes_cell(s, a);
    if (!changes && !(a->visibility & ~s->visible))
        return false;
    VkPipelineStageFlags2 readers = changes ? s->read_stages : VK_PIPELINE_STAGE_2_NONE;
    /* the earlier readers have waited for the write, so waiting for the readers is enough */
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

/* Updates a subresource's state for an access. `made_visible` is true if a barrier precedes it. */
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
    /* A wait for an earlier frame's write is not recorded, because some synchronization validation
     * layers forget such waits at the end of a frame. */
    if (s->flags & CELL_CERTAIN && !conditional)
        s->flags |= CELL_AWAITED;
    if (made_visible)
        s->visible |= a->visibility & RG_VISIBLE_TO_ALL;
}

#endif
