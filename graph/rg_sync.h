/*
 * rg_sync.h: which barrier goes before which pass; see rg_sync.c. What nearly every access needs is
 * here, so that it is inlined where accesses are walked.
 */
#ifndef RG_SYNC_H
#define RG_SYNC_H

#include "graph/rg_state.h"

/* Ends the newest batch and begins one before the pass `position`. */
void rg_sync_open_batch(struct sync *sync, uint32_t position);

/*
 * Another stage reads what an earlier barrier of this frame has made visible to some: that barrier
 * makes it visible to this one too, instead of a barrier more. `next` is what would be added. False
 * if there is no such barrier, or it cannot be used.
 */
bool rg_sync_widen(struct sync *sync, const struct cell *s, const struct access *a,
                   const struct rg_barrier *next);

/* Of an access to a resource of one cell. */
void rg_sync_whole(struct sync *sync, struct resource *r, const struct access *a, uint32_t pass);

/* Of an access to a resource of several cells. */
void rg_sync_cells(struct sync *sync, struct resource *r, const struct access *a, uint32_t pass);

/* Room for the next barrier, which is not there before rg_sync_put() says so. */
static inline struct rg_barrier *rg_sync_next(struct sync *sync)
{
    return ARENA_ROOM(sync->c->arena, sync->barriers, sync->barrier_count, sync->barrier_room, 64)
               ? &sync->barriers[sync->barrier_count]
               : NULL;
}

static inline void rg_sync_name(struct rg_barrier *b, const struct resource *r)
{
    b->image = r->plan_image;
    b->buffer = r->plan_buffer;
}

/* Notes that the next barrier takes over a resource's memory. */
static inline void rg_sync_take_over(struct sync *sync, struct resource *r)
{
    if (sync->changes_early && r->taken > sync->batch_position)
        r->taken = sync->batch_position;
    if (ARENA_ROOM(sync->c->arena, sync->takeovers, sync->takeover_count, sync->takeover_room, 64))
        sync->takeovers[sync->takeover_count++] = (struct takeover){ sync->barrier_count, r->item };
}

static inline void rg_sync_put(struct sync *sync, struct resource *r, bool fresh, uint32_t release,
                               uint32_t deadline)
{
    if (sync->batch_position == RG_NONE || release > sync->batch_position)
        rg_sync_open_batch(sync, deadline);
    if (fresh)
        rg_sync_take_over(sync, r);
    r->last_barrier = sync->barrier_count++;
}

/* The first use of a single cell in shared memory, which is a write, else it would be a fault. */
static inline void rg_sync_fresh(struct sync *sync, struct resource *r, const struct access *a,
                                 uint32_t pass)
{
    struct rg_barrier *b = rg_sync_next(sync);
    if (!b)
        return;
    rg_sync_name(b, r);
    b->src_stages = VK_PIPELINE_STAGE_2_NONE; /* not yet known (rg_sync_takeovers) */
    b->src_access = VK_ACCESS_2_NONE;
    b->dst_stages = a->effect->stages;
    b->dst_access = a->effect->mask;
    b->old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    b->new_layout = a->effect->layout;
    b->range = r->all;
    rg_sync_put(sync, r, true, r->cell.touched, pass);
    rg_state_write(&r->cell, a, pass);
}

static inline void rg_sync_access(struct sync *sync, struct resource *r, const struct access *a,
                                  uint32_t pass)
{
    if (r->cell_count > 1)
        rg_sync_cells(sync, r, a, pass);
    else if (rg_state_is_covered(&r->cell, a))
        rg_state_read(&r->cell, a, pass);
    else
        rg_sync_whole(sync, r, a, pass);
}

#endif
