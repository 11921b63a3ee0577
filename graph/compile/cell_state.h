/*
 * cell_state.h: what a cell needs before an access, and what the access leaves; see rg_state.c.
 */
#ifndef RG_COMPILE_CELL_STATE_H
#define RG_COMPILE_CELL_STATE_H

#include "graph/compile/compiler.h"

/* Whether an access only reads what is visible to it already. */
static inline bool rg_state_is_covered(const struct cell *s, const struct access *a)
{
    const struct effect *e = a->effect;
    return !(a->flags & ACCESS_WRITES_CONTENT) && s->layout == e->layout &&
           !(e->visibility & ~s->visible);
}

/* Whether an access could use what an earlier barrier has made visible. */
static inline bool rg_state_may_widen(const struct cell *s, const struct access *a)
{
    return !(a->flags & ACCESS_WRITES_CONTENT) && s->layout == a->effect->layout;
}

/* Whom a barrier waits for, if it waits for these readers. */
static inline void rg_state_wait(const struct cell *s, VkPipelineStageFlags2 readers,
                                 struct rg_barrier *b)
{
    /* who read it has waited for the write, and a barrier made the write available then */
    bool awaited = readers && s->flags & CELL_AWAITED;
    b->src_stages = awaited ? readers : readers | s->write_stages;
    b->src_access = awaited ? VK_ACCESS_2_NONE : s->write_access;
}

/* Who waits for it, and for what layout. */
static inline void rg_state_become(const struct cell *s, const struct access *a,
                                   struct rg_barrier *b)
{
    b->dst_stages = a->effect->stages;
    b->dst_access = a->effect->mask;
    b->old_layout = a->flags & ACCESS_OVERWRITES ? VK_IMAGE_LAYOUT_UNDEFINED : s->layout;
    b->new_layout = a->effect->layout;
}

/* Fills `b` but for resource and range, and *release: the first pass before which it may lie.
 * False if nothing is needed. */
static inline bool rg_state_decide(const struct cell *restrict s, const struct access *restrict a,
                                   struct rg_barrier *restrict b, uint32_t *restrict release)
{
    const struct effect *e = a->effect;
    bool moves = s->layout != e->layout;
    bool writes = a->flags & ACCESS_WRITES_CONTENT;
    if (rg_state_is_covered(s, a))
        return false;
    rg_state_wait(s, writes || moves ? s->read_stages : VK_PIPELINE_STAGE_2_NONE, b);
    rg_state_become(s, a, b);
    *release = writes || moves ? s->touched : s->written;
    return moves || b->src_stages || s->flags & CELL_FRESH;
}

/* A write, or a change of layout, which is one. */
static inline void rg_state_write(struct cell *s, const struct access *a, uint32_t pass)
{
    s->write_stages = a->effect->stages;
    s->write_access = a->effect->writes;
    s->read_stages = VK_PIPELINE_STAGE_2_NONE;
    s->visible = 0;
    s->barrier_end = 0;
    s->layout = a->effect->layout;
    s->flags = a->flags & ACCESS_CONDITIONAL ? CELL_CHANGED : CELL_CHANGED | CELL_CERTAIN;
    s->written = s->touched = pass + 1;
}

static inline void rg_state_read(struct cell *s, const struct access *a, uint32_t pass)
{
    s->touched = pass + 1;
    s->flags &= ~(uint32_t)CELL_FRESH;
    s->read_stages |= a->effect->stages;
    /* the synchronization validation of some releases takes a read only for that in the frame of
     * the write, and no barrier for one */
    if (s->flags & CELL_CERTAIN && !(a->flags & ACCESS_CONDITIONAL))
        s->flags |= CELL_AWAITED;
}

static inline void rg_state_apply(struct cell *s, const struct access *a, uint32_t pass,
                                  bool made_visible)
{
    bool writes = a->flags & ACCESS_WRITES_CONTENT;
    if (writes || s->layout != a->effect->layout)
        rg_state_write(s, a, pass);
    if (writes)
        return;
    rg_state_read(s, a, pass);
    if (made_visible)
        s->visible |= a->effect->visibility & RG_VISIBLE_TO_ALL;
}

#endif
