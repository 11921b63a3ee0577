/*
 * barriers.h: which barrier goes before which pass; see barriers.c. What nearly every access needs
 * is here, so that it is inlined where accesses are walked.
 */
#ifndef RG_COMPILE_BARRIERS_H
#define RG_COMPILE_BARRIERS_H

#include "graph/compile/cell_state.h"

/* Ends the newest batch and begins one before the pass `position`. */
void rg_sync_open_batch(struct sync *sync, uint32_t position);

/*
 * Another stage reads what an earlier barrier of this frame has made visible to some: that barrier
 * makes it visible to this one too, instead of a barrier more. `next` is what would be added. False
 * if there is no such barrier, or it cannot be used.
 */
bool rg_sync_widen(struct sync *sync, const struct cell *s, const struct access *a,
                   const struct rg_barrier *next);

/* Of an access to a resource of one cell, that does not change its layout. */
void rg_sync_whole(struct sync *sync, struct resource *r, const struct access *a, uint32_t pass);

/* Of an access to a resource of several cells. */
void rg_sync_cells(struct sync *sync, struct resource *r, const struct access *a, uint32_t pass);

/* For the next barrier, which is not there before rg_sync_put() says so. */
static inline bool rg_sync_has_room(struct sync *sync)
{
    return ARENA_ROOM(sync->c->arena, sync->barriers, sync->barrier_count, sync->barrier_room, 64);
}

static inline void rg_sync_name(struct rg_barrier *b, const struct resource *r)
{
    b->image = r->plan_image;
    b->buffer = r->plan_buffer;
}

/* src_access of a barrier that waits for whoever had an item's memory before, which is not yet
 * known; src_stages is the item, as numbered when the barrier was made. */
#define RG_SYNC_TAKEOVER UINT64_MAX

/* The next barrier, `b`, is there now. Returns its index. */
static inline uint32_t rg_sync_put(struct sync *sync, struct rg_barrier *b, struct resource *r,
                                   bool fresh, uint32_t release, uint32_t deadline)
{
    if (release >= sync->batch_end)
        rg_sync_open_batch(sync, deadline);
    if (fresh) {
        b->src_stages = r->item;
        b->src_access = RG_SYNC_TAKEOVER;
        if (sync->changes_early && r->taken >= sync->batch_end)
            r->taken = sync->batch_end - 1;
    }
    return sync->barrier_count++;
}

/* Of an access to a single cell that is in another layout, or in memory that the frame has not used
 * yet (`fresh`): then it is a write, else it would be a fault. */
__attribute__((always_inline)) static inline void rg_sync_move(struct sync *sync,
                                                               struct resource *r,
                                                               const struct access *a,
                                                               uint32_t pass, bool fresh)
{
    struct cell *cell = &r->cell;
    if (!rg_sync_has_room(sync))
        return;
    struct rg_barrier *b = &sync->barriers[sync->barrier_count];
    rg_sync_name(b, r);
    if (!fresh)
        rg_state_wait(cell, cell->read_stages, b);
    rg_state_become(cell, a, b);
    b->range = r->all;
    uint32_t index = rg_sync_put(sync, b, r, fresh, cell->touched, pass);
    rg_state_write(cell, a, pass);
    if (fresh || a->flags & ACCESS_WRITES_CONTENT)
        return;
    rg_state_read(cell, a, pass);
    cell->visible = a->effect->visibility & RG_VISIBLE_TO_ALL;
    cell->first_barrier = index;
    cell->barrier_end = index + 1;
}

static inline void rg_sync_access(struct sync *sync, struct resource *r, const struct access *a,
                                  uint32_t pass)
{
    if (r->cell_count > 1)
        rg_sync_cells(sync, r, a, pass);
    else if (rg_state_is_covered(&r->cell, a))
        rg_state_read(&r->cell, a, pass);
    else if (r->cell.layout != a->effect->layout && !(r->cell.flags & CELL_FRESH))
        rg_sync_move(sync, r, a, pass, false);
    else
        rg_sync_whole(sync, r, a, pass);
}

#endif
