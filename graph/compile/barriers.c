/*
 * barriers.c: emits the plan's passes with their targets and uses, and their barriers, merged into
 * as few batches as possible.
 *
 * A cell (compiler.h) has the layout, the last write, its readers so far, and the accesses to which
 * the write was made visible. From these follow (Vulkan 1.3, chapter 7): a read needs a barrier
 * unless an earlier one covers it; a write always needs one; a layout transition is a write between
 * the barrier's two scopes, and later barriers chain to the second. Frames overlap on one queue, so
 * the first use of any memory waits for its last use in the previous frame, and for the resources
 * that it aliases.
 *
 * A batch is one vkCmdPipelineBarrier2 before a pass. A barrier may be recorded between its release
 * (when the accesses that it waits for are recorded) and its deadline (the pass that waits for it).
 * Greedy interval stabbing, in the order of deadlines (Cormen et al., "Introduction to Algorithms",
 * activity selection): a barrier joins the latest batch unless that precedes its release, else it
 * opens one at its deadline. This gives the fewest batches for this order of passes.
 *
 * Until rg_complete_alias_barriers(), a barrier that takes over aliased memory has no source
 * stages, and the item's index in src_access.
 */
#include <assert.h>
#include "graph/compile/compiler.h"

/* ---- state of a subresource ---- */

/* Returns true if an access writes the subresource; a layout transition counts as a write. */
static bool changes_cell(const struct cell *s, const struct access *a)
{
    return a->flags & ACCESS_WRITES || s->layout != a->layout;
}

/* Returns false if the access needs no barrier. Fills the barrier `b` except its resource and
 * range. Sets *release to the earliest pass that the barrier may precede. */
RG_INLINE bool needs_barrier(const struct cell *s, const struct access *a, struct rg_barrier *b,
                             uint32_t *release)
{
    bool changes = changes_cell(s, a);
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
RG_INLINE void apply_access(struct cell *s, const struct access *a, uint32_t pass,
                            bool made_visible)
{
    bool conditional = a->flags & ACCESS_CONDITIONAL;
    s->touched = pass + 1;
    if (changes_cell(s, a)) {
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

/* ---- several queues ---- */

/* Makes the current pass wait for other queues' accesses to the subresource. The resource must have
 * queue_cells. Returns true if the access then needs no barrier: it reads what another queue wrote,
 * which the semaphore makes visible. The state of the subresource describes its home queue only; a
 * change on another queue moves it there, and then waits for all commands, which include the
 * semaphore's wait. */
static bool cross_queues(struct compiler *c, struct cell *s, const struct access *a, uint32_t pass)
{
    struct cell_queues *q = &a->resource->queue_cells[s - a->resource->cells];
    bool moves = q->home != a->queue;
    bool changes = changes_cell(s, a) || (moves && a->kind == RG_HOST_READ);
    bool waits = moves;
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++) {
        uint32_t wait = changes ? q->touched[i] : i == q->home ? s->written : 0;
        if (i == a->queue || !wait)
            continue;
        c->waits[i] = c->waits[i] < wait ? wait : c->waits[i];
        waits = true;
    }
    if (changes && moves) {
        s->write_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        s->write_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
        s->read_stages = VK_PIPELINE_STAGE_2_NONE;
        s->visible = 0;
        s->flags &= ~(uint32_t)CELL_AWAITED;
        q->home = a->queue;
    }
    if (changes && waits) /* the barrier follows this pass's wait */
        s->written = s->touched = pass;
    for (uint32_t i = 0; i < RG_QUEUE_COUNT && changes; i++)
        q->touched[i] = 0;
    q->touched[a->queue] = pass + 1;
    return moves && !changes;
}

/* Sets the access state of a subresource at the end of the frame, where the main queue has waited
 * on the semaphores of all other queues. */
static void join_queues(struct cell *s, struct cell_queues *q)
{
    if (q->home != RG_QUEUE_MAIN) {
        s->write_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        s->write_access = VK_ACCESS_2_NONE;
        s->read_stages = VK_PIPELINE_STAGE_2_NONE;
        s->visible = RG_VISIBLE_TO_ALL;
    }
    *q = (struct cell_queues){ 0 };
}

/* Adds a pass to the newest submission, or opens one if the queue changes, if the pass waits for
 * another queue, or if `pass_count` is 0. */
static void submit(struct compiler *c, uint32_t pass, uint32_t pass_count)
{
    struct rg_plan *plan = c->plan;
    struct rg_submission *s =
        plan->submission_count ? &c->submissions[plan->submission_count - 1] : NULL;
    bool opens = !s || !s->pass_count || !pass_count || s->queue != c->queue;
    for (uint32_t i = 0; i < RG_QUEUE_COUNT && !pass_count; i++)
        c->waits[i] = 0;
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++)
        opens = opens || c->waits[i] > c->waited[c->queue][i];
    if (opens &&
        ARENA_ROOM(c->arena, c->submissions, plan->submission_count, c->submission_room, 8)) {
        assert(c->submissions);
        s = &c->submissions[plan->submission_count++];
        *s = (struct rg_submission){ .queue = c->queue, .first_pass = pass };
        s->waits[RG_QUEUE_MAIN] = c->queue != RG_QUEUE_MAIN; /* for the frame's first submission */
        for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++) {
            uint32_t of = plan->submission_count - 1;
            if (c->waits[i] <= c->waited[c->queue][i])
                continue;
            while (c->submissions[of].first_pass >= c->waits[i] || c->submissions[of].queue != i)
                of--;
            s->waits[i] = of + 1;
            c->waited[c->queue][i] = c->submissions[of].first_pass + c->submissions[of].pass_count;
        }
    }
    if (s)
        s->pass_count += pass_count;
    c->plan->submissions = c->submissions;
}

/* ---- state at the start of a frame ---- */

/* Returns the state in which an import's subresources begin a frame (struct rg_import). The first
 * write waits for all commands, because earlier readers are unknown. */
static struct cell import_state(const struct compiler *c, struct resource *r)
{
    enum rg_access access = c->params->imports[r->import].access;
    const struct access arrival = rg_boundary_access(r, access);
    struct cell s = {
        .layout = arrival.layout,
        .write_stages = arrival.stages ? arrival.stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .write_access = rg_access_table[access].writes,
    };
    if (access == RG_ACCESS_NONE)
        s.write_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
    if (arrival.flags & ACCESS_WRITES || access == RG_ACCESS_NONE)
        return s;
    s.read_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    s.flags = CELL_AWAITED;
    s.visible = arrival.visibility & RG_VISIBLE_TO_ALL;
    return s;
}

/* ---- persistent resources begin a frame in the state in which the previous frame ended ---- */

static void simulate_access(struct compiler *c, const struct access *a)
{
    for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w)) {
        struct rg_barrier unused;
        uint32_t release;
        if (a->resource->queue_cells && cross_queues(c, w.cell, a, 0))
            continue;
        bool needed = needs_barrier(w.cell, a, &unused, &release);
        apply_access(w.cell, a, 0, needed);
    }
}

/* Applies the accesses of a frame to persistent resources, or only to those with a partner. */
static void simulate_frame(struct compiler *c, bool only_pairs)
{
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        const struct access *a = &c->accesses[pass->first_access];
        for (uint32_t i = 0; i < pass->access_count; i++) {
            if (a[i].resource->persistent && (a[i].resource->partner || !only_pairs))
                simulate_access(c, &a[i]);
        }
    }
    for (uint32_t i = 0; i < c->boundary_count; i++) {
        struct resource *r = c->resources[i];
        if (!r->persistent || r->output == RG_NONE || (only_pairs && !r->partner))
            continue;
        const struct access a = rg_boundary_access(r, c->params->outputs[r->output].access);
        simulate_access(c, &a);
    }
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

/* Handles the subresources of one access, as share_history_barriers(). */
static void share_history_barrier(struct compiler *c, const struct access *a, bool is_complete)
{
    const struct resource *r = rg_is_history(a->resource) ? a->resource->partner : a->resource;
    if (!r->persistent || r->queue_cells)
        return;
    for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w)) {
        struct cell *left = &r->cells[w.cell - a->resource->cells];
        const uint32_t added = a->visibility & RG_VISIBLE_TO_ALL & ~left->visible;
        const struct rg_barrier next = { r->plan_image, r->plan_buffer,
                                         .range = rg_cell_range(&w) };
        if (a->flags & ACCESS_WRITES || left->layout != a->layout)
            w.cell->changed = true;
        if (w.cell->changed || !left->visible || !added)
            continue;
        if (!is_complete)
            left->visible |= added;
        else if (!widen(c, left, a, &next))
            assert(false);
    }
}

/* Handles the reads that depend on content or layout left by the previous frame, if that frame has
 * a barrier for another such read: marks them as synchronised or, if the barriers are complete,
 * extends the one of this frame to cover such a read in the next frame. */
static void share_history_barriers(struct compiler *c, bool is_complete)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++)
            r->cells[k].changed = false;
    }
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        const struct access *a = &c->accesses[pass->first_access];
        for (uint32_t i = 0; i < pass->access_count; i++)
            share_history_barrier(c, &a[i], is_complete);
    }
}

/* Converts the states at the end of a frame to those at the start of the next frame. */
static void begin_next_frame(struct compiler *c)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++) {
            struct cell *s = &r->cells[k];
            if (r->queue_cells)
                join_queues(s, &r->queue_cells[k]);
            s->written = s->touched = s->barrier_end = 0;
            s->flags &= ~(uint32_t)(CELL_CHANGED | CELL_CERTAIN);
        }
    }
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && rg_is_history(r); k++) {
            const struct cell end = r->cells[k];
            r->cells[k] = r->partner->cells[k];
            r->partner->cells[k] = end;
        }
    }
}

static void begin_cells(struct compiler *c)
{
    for (uint32_t i = 0; i < c->boundary_count; i++) {
        struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->import != RG_NONE; k++)
            r->cells[k] = import_state(c, r);
    }
    /* twice, since a history starts as its partner ends */
    for (int i = 0; i < 2 && c->persistent_count; i++) {
        simulate_frame(c, i > 0);
        share_history_barriers(c, false);
        begin_next_frame(c);
    }
}

/* ---- batches ---- */

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

/* Adds barrier c->barrier_count to the newest batch, or to a new one if it must come later. */
static void append_barrier(struct compiler *c, const struct cell_walk *w, struct resource *r,
                           uint32_t release, uint32_t deadline)
{
    uint32_t before = r->last_barrier;
    if (release >= c->batch_end || c->batch_queue != c->queue) {
        close_batch(c);
        c->batch_queue = c->queue;
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
    bool added = false;
    if (r->queue_cells && cross_queues(c, w->cell, a, pass))
        return false;
    bool needed = needs_barrier(w->cell, a, b, &release);
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
    apply_access(w->cell, a, pass, needed);
    return added;
}

static bool has_room(struct compiler *c)
{
    return ARENA_ROOM(c->arena, c->barriers, c->barrier_count, c->barrier_room, c->row_count * 4);
}

/* Returns true if the frame changes the state in which an import's subresource arrived. read_stages
 * lacks the main queue's reads of what another queue wrote, because a semaphore orders them. */
static bool must_be_restored(const struct cell *s, const struct access *arrival)
{
    const struct resource *r = arrival->resource;
    const struct cell_queues *q = r->queue_cells ? &r->queue_cells[s - r->cells] : NULL;
    if (!(arrival->flags & ACCESS_WRITES))
        return s->flags & CELL_CHANGED;
    return s->layout != arrival->layout || s->write_stages != arrival->stages ||
           s->write_access != rg_access_table[arrival->kind].writes || s->read_stages ||
           (q && q->home != RG_QUEUE_MAIN && q->touched[RG_QUEUE_MAIN]);
}

static void add_barriers(struct compiler *c, const struct access *a, uint32_t pass,
                         bool restores_import)
{
    struct resource *r = a->resource;
    bool writes = a->flags & ACCESS_WRITES;
    uint32_t start = c->barrier_count;
    uint32_t mip = a->range.mip;
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
    enum rg_access access = r->output != RG_NONE ? c->params->outputs[r->output].access
                            : restores_import    ? c->params->imports[r->import].access
                                                 : RG_ACCESS_NONE;
    if (access == RG_ACCESS_NONE)
        return;
    const struct access a = rg_boundary_access(r, access);
    add_barriers(c, &a, c->plan->pass_count, restores_import);
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
        const struct cell *state = r->partner ? &r->partner->cells[w.cell - r->cells] : w.cell;
        VkImageLayout found = state->layout ? state->layout : VK_IMAGE_LAYOUT_GENERAL;
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

static void end_barriers(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    for (uint32_t i = 0; i < c->boundary_count; i++) {
        if (c->resources[i]->first != RG_NONE)
            end_resource(c, c->resources[i]);
    }
    if (c->persistent_count && !c->arena->failed)
        share_history_barriers(c, true);
    close_batch(c);
    plan->barrier_count = c->barrier_count;
    plan->first_initial_barrier = c->batch_first = c->barrier_count;
    for (uint32_t i = 0; i < c->resource_count && c->persistent_count; i++) {
        if (c->resources[i]->first != RG_NONE && c->resources[i]->persistent)
            begin_history(c, c->resources[i]);
    }
    plan->initial_barrier_count = c->barrier_count - plan->barrier_count;
    plan->barriers = c->barriers;
}

/* ---- passes ---- */

static const VkAttachmentLoadOp load_ops[] = {
    [RG_LOAD_KEEP] = VK_ATTACHMENT_LOAD_OP_LOAD,
    [RG_LOAD_CLEAR] = VK_ATTACHMENT_LOAD_OP_CLEAR,
    [RG_LOAD_DISCARD] = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
};

/* Writes an attachment field by field: copying a whole struct takes several times as long. */
static void write_target(struct rg_plan_target *target, const struct access *a)
{
    const struct rg_target *declared = a->declared;
    bool writes = a->flags & ACCESS_WRITES;
    target->image = a->resource->plan_image;
    target->mip = a->range.mip;
    target->layer = a->range.layer;
    target->load = writes ? load_ops[declared->load] : VK_ATTACHMENT_LOAD_OP_LOAD;
    target->store = !writes                    ? VK_ATTACHMENT_STORE_OP_NONE
                    : a->flags & ACCESS_NEEDED ? VK_ATTACHMENT_STORE_OP_STORE
                                               : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    target->layout = a->layout;
    target->resolve = RG_NONE;
    target->resolve_mip = target->resolve_layer = 0;
}

static void write_access(struct compiler *c, const struct access *a, struct rg_plan_pass *pass)
{
    struct rg_plan *plan = c->plan;
    if (a->kind == RG_COLOR) {
        write_target(&c->colors[plan->color_count++], a);
        pass->color_count++;
    } else if (a->kind == RG_RESOLVE) {
        struct rg_plan_target *newest = &c->colors[plan->color_count - 1];
        newest->resolve = a->resource->plan_image;
        newest->resolve_mip = a->range.mip;
        newest->resolve_layer = a->range.layer;
    } else if (a->kind == RG_DEPTH || a->kind == RG_DEPTH_READ) {
        write_target(&pass->depth, a);
    } else {
        struct rg_plan_use *use = &c->uses[plan->use_count++];
        use->use = a->declared;
        use->image = a->resource->plan_image;
        use->buffer = a->resource->plan_buffer;
        use->range =
            !a->resource->image
                ? (VkImageSubresourceRange){ 0 }
                : (VkImageSubresourceRange){ a->range.aspects, a->range.mip, a->range.mip_count,
                                             a->range.layer, a->range.layer_count };
        use->layout = a->layout;
        pass->use_count++;
    }
}

/* Writes a pass of the plan. Barriers for the first use of memory come last, because they may then
 * join a batch that the pass needs anyway, and acquire the memory as late as possible. */
static void write_pass(struct compiler *c, const struct pass *pass, uint32_t index)
{
    const struct access *first = &c->accesses[pass->first_access];
    const struct access *end = first + pass->access_count;
    struct rg_plan_pass *out = &c->plan_passes[index];
    out->first_barrier = out->barrier_count = 0;
    out->first_use = c->plan->use_count;
    out->use_count = 0;
    out->color = &c->colors[c->plan->color_count];
    out->color_count = 0;
    out->depth = (struct rg_plan_target){ .image = RG_NONE };
    bool any_first = false;
    for (const struct access *a = first; a < end; a++) {
        write_access(c, a, out);
        if (a->resource->first != index)
            add_barriers(c, a, index, false);
        else
            any_first = true;
    }
    for (const struct access *a = first; a < end && any_first; a++) {
        if (a->resource->first == index)
            add_barriers(c, a, index, false);
    }
}

/* Ends the frame on the main queue, which waits for the last submission of each other queue. */
static void join_all(struct compiler *c)
{
    const uint32_t last = c->plan->submission_count;
    c->queue = RG_QUEUE_MAIN;
    submit(c, c->plan->pass_count, 0);
    for (uint32_t i = 0; i < last && !c->arena->failed; i++) {
        if (c->submissions[i].queue != RG_QUEUE_MAIN)
            c->submissions[last].waits[c->submissions[i].queue] = i + 1;
    }
}

void rg_write_plan_passes(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    c->uses = ARENA_ARRAY(c->arena, struct rg_plan_use, c->access_count);
    c->colors = ARENA_ARRAY(c->arena, struct rg_plan_target, c->color_count);
    begin_cells(c);
    if (c->has_queues)
        submit(c, 0, 0);
    for (uint32_t p = 0; p < c->pass_count && !c->arena->failed; p++) {
        c->queue = c->passes[p].queue;
        for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++)
            c->waits[i] = 0;
        write_pass(c, &c->passes[p], p);
        if (c->has_queues)
            submit(c, p, 1);
    }
    plan->passes = c->plan_passes;
    plan->uses = c->uses;
    plan->colors = c->colors;
    plan->fallbacks = c->fallbacks;
    plan->fallback_count = c->fallback_count;
    if (c->has_queues)
        join_all(c);
    if (!c->arena->failed)
        end_barriers(c);
}
