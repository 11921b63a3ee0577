/*
 * barriers.c: emits the plan's barriers and merges them into as few batches as possible.
 *
 * A batch is one vkCmdPipelineBarrier2 before a pass. A barrier may be recorded between its release
 * (when the accesses that it waits for are recorded) and its deadline (the pass that waits for it).
 * Greedy interval stabbing, in the order of deadlines: a barrier joins the latest batch unless that
 * precedes its release, else it opens one at its deadline. This gives the fewest batches for this
 * order of passes.
 *
 * Until rg_complete_alias_barriers(), a barrier that takes over aliased memory has no source
 * stages, and the item's index in src_access.
 */
#include <assert.h>
#include "graph/compile/subresource_state.h"

/* Stores the newest batch's barriers in the pass after it, or in the plan at the frame's end. */
static void close_batch(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    uint32_t count = c->barrier_count - c->batch_first;
    if (!c->batch_end)
        return;
    plan->batch_count++;
    if (c->batch_end > plan->pass_count) {
        plan->first_final_barrier = c->batch_first;
        plan->final_barrier_count = count;
    } else {
        c->plan_passes[c->batch_end - 1].first_barrier = c->batch_first;
        c->plan_passes[c->batch_end - 1].barrier_count = count;
    }
}

/* ---- merging subresource ranges ---- */

static bool has_same_dependency(const struct rg_barrier *a, const struct rg_barrier *b)
{
    return a->image == b->image && a->buffer == b->buffer && a->src_stages == b->src_stages &&
           a->dst_stages == b->dst_stages && a->src_access == b->src_access &&
           a->dst_access == b->dst_access && a->old_layout == b->old_layout &&
           a->new_layout == b->new_layout;
}

/* Extends range `a` to include `b`. Returns false if no single range is exactly their union. */
static bool merge_ranges(VkImageSubresourceRange *a, const VkImageSubresourceRange *b)
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

/* Merges the newest barrier into barrier `before`. Returns false if they cannot be merged. */
static bool merge(struct compiler *c, uint32_t before)
{
    struct rg_barrier *a = &c->barriers[before];
    const struct rg_barrier *b = &c->barriers[c->barrier_count - 1];
    if (before < c->batch_first || a->image == RG_NONE || !has_same_dependency(a, b) ||
        !merge_ranges(&a->range, &b->range))
        return false;
    c->barrier_count--;
    return true;
}

/* Merges a resource's newest barriers, back to index `start`, as far as possible. */
static void merge_newest(struct compiler *c, struct resource *r, uint32_t start)
{
    while (c->barrier_count >= start + 2 && merge(c, c->barrier_count - 2))
        r->last_barrier = c->barrier_count - 1;
}

/* Tries to extend an earlier barrier of this frame to cover a read too. If this succeeds, returns
 * true, and the read does not need the barrier `next`. */
static bool widen(struct compiler *c, const struct cell *s, const struct access *a,
                  const struct rg_barrier *next)
{
    for (uint32_t i = s->first_barrier; i < s->barrier_end && i < c->barrier_count; i++) {
        struct rg_barrier *b = &c->barriers[i];
        const VkImageSubresourceRange *all = &b->range;
        const VkImageSubresourceRange *one = &next->range;
        if (b->image != next->image || b->buffer != next->buffer)
            continue;
        if (b->image != RG_NONE && (!(all->aspectMask & one->aspectMask) ||
                                    one->baseMipLevel - all->baseMipLevel >= all->levelCount ||
                                    one->baseArrayLayer - all->baseArrayLayer >= all->layerCount))
            continue;
        b->dst_stages |= a->stages;
        b->dst_access |= a->mask;
        return true;
    }
    return false;
}

/* Adds barrier c->barrier_count to the newest batch, or to a new one if it must come later. */
static void append_barrier(struct compiler *c, const struct cell_walk *w, struct resource *r,
                           uint32_t release, uint32_t deadline)
{
    uint32_t before = r->last_barrier;
    if (release >= c->batch_end) {
        close_batch(c);
        c->batch_first = c->barrier_count;
        c->batch_end = deadline + 1;
    }
    if (w->cell->flags & CELL_FRESH && r->acquired_before >= c->batch_end)
        r->acquired_before = c->batch_end - 1;
    r->last_barrier = c->barrier_count++;
    if (before != RG_NONE && merge(c, before))
        r->last_barrier = before;
}

/* Synchronises one subresource with an access. Returns true if a barrier was added. */
static bool sync_cell(struct compiler *c, const struct cell_walk *w, const struct access *a,
                      uint32_t pass)
{
    struct resource *r = a->resource;
    struct rg_barrier *b = &c->barriers[c->barrier_count];
    uint32_t release;
    bool needed = rg_needs_barrier(w->cell, a, b, &release);
    bool added = false;
    if (needed) {
        bool only_reads = !(a->flags & ACCESS_WRITES) && w->cell->layout == a->layout;
        b->image = r->plan_image;
        b->buffer = r->plan_buffer;
        b->range = rg_cell_range(w);
        if (!b->src_stages)
            b->src_access = r->item;
        added = !only_reads || !widen(c, w->cell, a, b);
        if (added)
            append_barrier(c, w, r, release, pass);
    }
    rg_apply_access(w->cell, a, pass, needed);
    return added;
}

static bool has_room(struct compiler *c)
{
    return ARENA_ROOM(c->arena, c->barriers, c->barrier_count, c->barrier_room, c->row_count * 4);
}

/* Returns true if the frame changes the state in which an import's subresource arrived. */
static bool must_be_restored(const struct cell *s, const struct access *arrival)
{
    if (!(arrival->flags & ACCESS_WRITES))
        return s->flags & CELL_CHANGED;
    return s->layout != arrival->layout || s->write_stages != arrival->stages ||
           s->write_access != rg_access_table[arrival->kind].writes || s->read_stages;
}

void rg_add_barriers(struct compiler *c, const struct access *a, uint32_t pass,
                     bool restores_import)
{
    struct resource *r = a->resource;
    bool writes = a->flags & ACCESS_WRITES;
    uint32_t start = c->barrier_count;
    uint32_t mip = a->range.baseMipLevel;
    for (struct cell_walk w = rg_cells(a); w.cell && has_room(c); rg_next_cell(&w)) {
        if (restores_import && !must_be_restored(w.cell, a))
            continue;
        if (w.mip != mip)
            merge_newest(c, r, start); /* merges the previous mip level */
        mip = w.mip;
        if (sync_cell(c, &w, a, pass) && !writes && r->last_barrier < start) {
            w.cell->first_barrier = r->last_barrier;
            w.cell->barrier_end = r->last_barrier + 1;
        }
    }
    merge_newest(c, r, start);
    if (writes || c->barrier_count == start)
        return;
    for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w)) {
        if (w.cell->barrier_end)
            continue;
        w.cell->first_barrier = start;
        w.cell->barrier_end = c->barrier_count;
    }
}

/* ---- final and initial barriers ---- */

/* Adds the final barriers of an output, or of an import that returns to its initial state. */
static void end_resource(struct compiler *c, struct resource *r)
{
    bool restores_import = r->output == RG_NONE && r->import != RG_NONE;
    enum rg_access access = RG_ACCESS_NONE;
    if (restores_import)
        access = c->params->imports[r->import].access;
    else if (r->output != RG_NONE)
        access = c->params->outputs[r->output].access;
    if (access == RG_ACCESS_NONE)
        return;
    const struct access a = rg_boundary_access(r, access);
    rg_add_barriers(c, &a, c->plan->pass_count, restores_import);
}

/* Adds the barriers that a persistent resource needs between its zero fill and the first frame. */
static void begin_history(struct compiler *c, struct resource *r)
{
    const struct access all = rg_boundary_access(r, RG_ACCESS_NONE);
    uint32_t start = c->barrier_count;
    uint32_t mip = 0;
    for (struct cell_walk w = rg_cells(&all); w.cell && has_room(c); rg_next_cell(&w)) {
        if (w.mip != mip)
            merge_newest(c, r, start);
        mip = w.mip;
        VkImageLayout found = w.cell->layout ? w.cell->layout : VK_IMAGE_LAYOUT_GENERAL;
        c->barriers[c->barrier_count++] = (struct rg_barrier){
            .image = r->plan_image,
            .buffer = r->plan_buffer,
            .src_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
            .src_access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
            .dst_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dst_access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
            .old_layout = r->image ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : 0,
            .new_layout = r->image ? found : VK_IMAGE_LAYOUT_UNDEFINED,
            .range = rg_cell_range(&w),
        };
        if (c->barrier_count >= start + 2)
            merge(c, c->barrier_count - 2);
    }
    merge_newest(c, r, start);
}

/* Extends a barrier of this frame so that it also covers a read in the next frame. */
static void extend_to_history_read(struct compiler *c, const struct cell_walk *w,
                                   const struct access *a)
{
    const struct rg_barrier next = {
        .image = a->resource->plan_image,
        .buffer = a->resource->plan_buffer,
        .range = rg_cell_range(w),
    };
    if (!(a->visibility & RG_VISIBLE_TO_ALL & ~w->cell->visible) || !w->cell->visible)
        return;
    bool extended = widen(c, w->cell, a, &next);
    assert(extended);
    (void)extended;
}

void rg_end_barriers(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    for (uint32_t i = 0; i < c->boundary_count; i++) {
        if (c->resources[i]->first != RG_NONE)
            end_resource(c, c->resources[i]);
    }
    if (c->persistent_count && !c->arena->failed)
        rg_each_history_read(c, extend_to_history_read);
    close_batch(c);
    plan->barrier_count = c->barrier_count;
    plan->first_initial_barrier = c->batch_first = c->barrier_count;
    for (uint32_t i = 0; i < c->resource_count; i++) {
        if (c->resources[i]->first != RG_NONE && c->resources[i]->persistent)
            begin_history(c, c->resources[i]);
    }
    plan->initial_barrier_count = c->barrier_count - plan->barrier_count;
    plan->barriers = c->barriers;
}
