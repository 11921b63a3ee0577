/*
 * barriers.c: which barrier goes before which pass.
 *
 * A barrier may lie anywhere between its release (whoever it waits for has been recorded) and its
 * deadline (the pass that waits for it). A batch is one vkCmdPipelineBarrier2 before a pass.
 * Greedy interval stabbing: barriers come in the order of their deadlines; each joins the newest
 * batch if that is not before its release, or else opens one at its deadline. No set of batches
 * for the same order of passes is smaller, and none waits earlier than it has to.
 */
#include "graph/compile/barriers.h"
#include <assert.h>

static void close_batch(struct sync *sync)
{
    struct rg_plan *plan = sync->c->plan;
    uint32_t count = sync->barrier_count - sync->batch_first;
    if (!sync->batch_end)
        return;
    uint32_t position = sync->batch_end - 1;
    plan->batch_count++;
    if (position == plan->pass_count) {
        plan->first_final_barrier = sync->batch_first;
        plan->final_barrier_count = count;
    } else {
        sync->passes[position].first_barrier = sync->batch_first;
        sync->passes[position].barrier_count = count;
    }
}

static bool same_words(const struct rg_barrier *a, const struct rg_barrier *b)
{
    return a->image == b->image && a->buffer == b->buffer && a->src_stages == b->src_stages &&
           a->dst_stages == b->dst_stages && a->src_access == b->src_access &&
           a->dst_access == b->dst_access && a->old_layout == b->old_layout &&
           a->new_layout == b->new_layout;
}

/* Grows `a` by `b` if together they are one range of layers, mips or aspects. */
static bool join_ranges(VkImageSubresourceRange *a, const VkImageSubresourceRange *b)
{
    bool aspects = a->aspectMask == b->aspectMask;
    bool mips = a->baseMipLevel == b->baseMipLevel && a->levelCount == b->levelCount;
    bool layers = a->baseArrayLayer == b->baseArrayLayer && a->layerCount == b->layerCount;
    if (aspects && mips && a->baseArrayLayer + a->layerCount == b->baseArrayLayer)
        a->layerCount += b->layerCount;
    else if (aspects && layers && a->baseMipLevel + a->levelCount == b->baseMipLevel)
        a->levelCount += b->levelCount;
    else if (mips && layers)
        a->aspectMask |= b->aspectMask;
    else
        return false;
    return true;
}

/* Makes one of the newest barrier and that of index `before`, of the same batch, if it can. */
static bool join(struct sync *sync, uint32_t before)
{
    struct rg_barrier *a = &sync->barriers[before];
    const struct rg_barrier *b = &sync->barriers[sync->barrier_count - 1];
    if (before < sync->batch_first || !same_words(a, b) || !join_ranges(&a->range, &b->range))
        return false;
    sync->barrier_count--;
    return true;
}

void rg_sync_open_batch(struct sync *sync, uint32_t position)
{
    close_batch(sync);
    sync->batch_first = sync->barrier_count;
    sync->batch_end = position + 1;
}

bool rg_sync_widen(struct sync *sync, const struct cell *s, const struct access *a,
                   const struct rg_barrier *next)
{
    for (uint32_t i = s->first_barrier; i < s->barrier_end && i < sync->barrier_count; i++) {
        struct rg_barrier *b = &sync->barriers[i];
        const VkImageSubresourceRange *all = &b->range;
        const VkImageSubresourceRange *one = &next->range;
        if (b->image != next->image || b->buffer != next->buffer)
            continue;
        if (b->image != RG_NONE && (!(all->aspectMask & one->aspectMask) ||
                                    one->baseMipLevel - all->baseMipLevel >= all->levelCount ||
                                    one->baseArrayLayer - all->baseArrayLayer >= all->layerCount))
            continue;
        b->dst_stages |= a->effect->stages;
        b->dst_access |= a->effect->mask;
        return true;
    }
    return false;
}

void rg_sync_whole(struct sync *sync, struct resource *r, const struct access *a, uint32_t pass)
{
    struct cell *cell = &r->cell;
    if (!rg_sync_has_room(sync))
        return;
    struct rg_barrier *b = &sync->barriers[sync->barrier_count];
    uint32_t release;
    bool needed = rg_state_decide(cell, a, b, &release);
    bool added = false;
    if (needed) {
        rg_sync_name(b, r);
        b->range = r->all;
        added = !rg_state_may_widen(cell, a) || !rg_sync_widen(sync, cell, a, b);
        if (added)
            rg_sync_put(sync, b, r, cell->flags & CELL_FRESH, release, pass);
    }
    rg_state_apply(cell, a, pass, needed);
    if (added && !(a->flags & ACCESS_WRITES_CONTENT)) {
        cell->first_barrier = sync->barrier_count - 1;
        cell->barrier_end = sync->barrier_count;
    }
}

static VkImageAspectFlags aspect_bit(VkImageAspectFlags aspects, uint32_t index)
{
    while (index--)
        aspects &= aspects - 1;
    return aspects & (~aspects + 1);
}

static VkImageSubresourceRange cell_range(const struct resource *r, const struct cell_walk *w)
{
    if (!r->image)
        return (VkImageSubresourceRange){ 0 };
    return (VkImageSubresourceRange){
        aspect_bit(r->all.aspectMask, w->aspect), w->mip, 1, w->layer, 1,
    };
}

/* Adds the barrier of one cell to those from `start` on, or to the resource's last one. */
static void put_cell(struct sync *sync, struct rg_barrier *b, struct resource *r,
                     const struct cell_walk *w, uint32_t release, uint32_t pass)
{
    uint32_t before = r->last_barrier;
    r->last_barrier = rg_sync_put(sync, b, r, w->cell->flags & CELL_FRESH, release, pass);
    if (before != RG_NONE && r->image && join(sync, before))
        r->last_barrier = before;
}

/* Joins the newest barriers, all from `start` on and of one resource, while they make one. */
static void join_rows(struct sync *sync, struct resource *r, uint32_t start)
{
    while (sync->barrier_count >= start + 2 && join(sync, sync->barrier_count - 2))
        r->last_barrier = sync->barrier_count - 1;
}

/* Whether a frame has left an import in another state than it came in. */
static bool has_to_go_back(const struct cell *s, const struct access *arrival)
{
    if (!(arrival->flags & ACCESS_WRITES_CONTENT))
        return s->flags & CELL_CHANGED;
    const struct effect *e = arrival->effect;
    return s->layout != e->layout || s->write_stages != e->stages || s->write_access != e->writes ||
           s->read_stages;
}

/* Returns whether it has added a barrier. */
static bool sync_cell(struct sync *sync, struct resource *r, const struct cell_walk *w,
                      const struct access *a, uint32_t pass)
{
    if (!rg_sync_has_room(sync))
        return false;
    struct rg_barrier *b = &sync->barriers[sync->barrier_count];
    uint32_t release;
    bool needed = rg_state_decide(w->cell, a, b, &release);
    bool added = false;
    if (needed) {
        rg_sync_name(b, r);
        b->range = cell_range(r, w);
        added = !rg_state_may_widen(w->cell, a) || !rg_sync_widen(sync, w->cell, a, b);
        if (added)
            put_cell(sync, b, r, w, release, pass);
    }
    rg_state_apply(w->cell, a, pass, needed);
    return added;
}

static void sync_cells(struct sync *sync, struct resource *r, const struct access *a, uint32_t pass,
                       bool hand_back)
{
    bool writes = a->flags & ACCESS_WRITES_CONTENT;
    uint32_t start = sync->barrier_count;
    uint32_t mip = RG_NONE;
    const VkImageSubresourceRange *range = rg_range_of(sync->c, a);
    for (struct cell_walk w = rg_walk(r, range); rg_walk_next(&w);) {
        if (hand_back && !has_to_go_back(w.cell, a))
            continue;
        if (w.mip != mip)
            join_rows(sync, r, start); /* the mip before with those before it */
        mip = w.mip;
        if (sync_cell(sync, r, &w, a, pass) && !writes && r->last_barrier < start) {
            w.cell->first_barrier = r->last_barrier;
            w.cell->barrier_end = r->last_barrier + 1;
        }
    }
    join_rows(sync, r, start);
    if (writes || sync->barrier_count == start)
        return;
    for (struct cell_walk w = rg_walk(r, range); rg_walk_next(&w);) {
        if (w.cell->barrier_end)
            continue;
        w.cell->first_barrier = start;
        w.cell->barrier_end = sync->barrier_count;
    }
}

void rg_sync_cells(struct sync *sync, struct resource *r, const struct access *a, uint32_t pass)
{
    sync_cells(sync, r, a, pass, false);
}

void rg_sync_begin(struct sync *sync, struct rg_plan_pass *passes)
{
    struct compiler *c = sync->c;
    sync->passes = passes;
    sync->changes_early = c->params->sharing == RG_SHARE_FEWEST_BATCHES;
    sync->barrier_room = c->alive_access_count;
    sync->barriers = ARENA_ARRAY(c->arena, struct rg_barrier, sync->barrier_room);
    rg_state_begin(c);
}

/* Outputs become ready for their access; other imports go back as they came. */
static void end_resource(struct sync *sync, struct resource *r)
{
    struct compiler *c = sync->c;
    bool hand_back = r->output == RG_NONE && r->import != RG_NONE;
    enum rg_access access = RG_ACCESS_NONE;
    if (hand_back)
        access = c->params->imports[r->import].access;
    else if (r->output != RG_NONE)
        access = c->params->outputs[r->output].access;
    if (access == RG_ACCESS_NONE)
        return;
    struct effect effect;
    const struct access a = rg_end_access(r, access, &effect);
    if (r->cell_count > 1)
        sync_cells(sync, r, &a, c->plan->pass_count, hand_back);
    else if (!hand_back || has_to_go_back(&r->cell, &a))
        rg_sync_whole(sync, r, &a, c->plan->pass_count);
}

/* From the zeros of the very first frame to what every frame finds: what every frame leaves. */
static void begin_history(struct sync *sync, struct resource *r)
{
    uint32_t start = sync->barrier_count;
    uint32_t mip = RG_NONE;
    for (struct cell_walk w = rg_walk(r, &r->all); rg_walk_next(&w);) {
        if (w.mip != mip)
            join_rows(sync, r, start);
        mip = w.mip;
        if (!rg_sync_has_room(sync))
            return;
        struct rg_barrier *b = &sync->barriers[sync->barrier_count];
        *b = (struct rg_barrier){
            .src_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
            .src_access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
            .dst_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dst_access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        };
        rg_sync_name(b, r);
        b->range = cell_range(r, &w);
        if (r->image) {
            b->old_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
            b->new_layout = w.cell->layout == VK_IMAGE_LAYOUT_UNDEFINED ? VK_IMAGE_LAYOUT_GENERAL
                                                                        : w.cell->layout;
        }
        sync->barrier_count++;
        if (sync->barrier_count >= start + 2 && r->image)
            join(sync, sync->barrier_count - 2);
    }
    join_rows(sync, r, start);
}

/* The barrier by which this frame makes what it leaves visible to some makes it so to who reads it
 * in the next frame, as that expects. */
static void serve_early(void *user, struct resource *r, const struct cell_walk *w,
                        const struct access *a)
{
    struct sync *sync = user;
    struct rg_barrier next = { .range = cell_range(r, w) };
    if (!(a->effect->visibility & RG_VISIBLE_TO_ALL & ~w->cell->visible) || !w->cell->visible)
        return;
    rg_sync_name(&next, r);
    bool served = rg_sync_widen(sync, w->cell, a, &next);
    assert(served);
    (void)served;
}

void rg_sync_end(struct sync *sync)
{
    struct compiler *c = sync->c;
    struct rg_plan *plan = c->plan;
    for (uint32_t i = 0; i < c->end_count; i++) {
        if (c->resources[i].first != RG_NONE)
            end_resource(sync, &c->resources[i]);
    }
    if (c->persistent_count && !c->arena->failed)
        rg_state_each_early(c, serve_early, sync);
    close_batch(sync);
    plan->barrier_count = sync->barrier_count;
    plan->first_initial_barrier = sync->batch_first = sync->barrier_count;
    for (uint32_t i = 0; i < c->resource_count && c->persistent_count; i++) {
        if (c->resources[i].first != RG_NONE && c->resources[i].persistent)
            begin_history(sync, &c->resources[i]);
    }
    plan->initial_barrier_count = sync->barrier_count - plan->barrier_count;
    plan->barriers = sync->barriers;
}

void rg_sync_takeovers(struct sync *sync)
{
    const struct compiler *c = sync->c;
    bool placed_before = c->params->sharing == RG_SHARE_LEAST_MEMORY;
    const uint32_t *places = placed_before ? NULL : c->item_places;
    struct rg_barrier *end = sync->barriers + c->plan->barrier_count;
    for (struct rg_barrier *b = sync->barriers; b < end; b++) {
        if (b->src_access != RG_SYNC_TAKEOVER)
            continue;
        const struct former *former = &c->formers[places ? places[b->src_stages] : b->src_stages];
        b->src_stages = former->stages;
        b->src_access = former->writes;
    }
}
