/*
 * rg_batch.c: transitions, and the fewest batches of barriers that hold them all.
 *
 * A transition may happen anywhere between its release (whoever it waits for has been recorded)
 * and its deadline (the pass that waits for it). A batch is one vkCmdPipelineBarrier2 before a
 * pass. Greedy interval stabbing: in the order of deadlines, a transition joins the earliest batch
 * that its interval holds, and opens one at its deadline if there is none. No set of batches for
 * the same order of passes is smaller.
 */
#include <string.h>
#include "graph/rg_internal.h"

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

void rg_transition_join(struct transitions *list, uint32_t first)
{
    while (list->count >= first + 2) {
        struct transition *a = &list->items[list->count - 2];
        const struct transition *b = &list->items[list->count - 1];
        if (a->release != b->release || !same_words(&a->barrier, &b->barrier) ||
            !join_ranges(&a->barrier.range, &b->barrier.range))
            return;
        list->count--;
    }
}

void rg_transition_add(struct arena *scratch, struct transitions *list, const struct transition *t)
{
    if (list->count == list->room) {
        uint32_t room = list->room ? list->room * 2 : 64;
        struct transition *items = ARENA_ARRAY(scratch, struct transition, room);
        if (!items)
            return;
        if (list->count)
            memcpy(items, list->items, list->count * sizeof(*items));
        list->items = items;
        list->room = room;
    }
    list->items[list->count++] = *t;
}

/* The earliest of the batches, which rise, that is not before `release`; count if none. */
static uint32_t first_batch(const uint32_t *positions, uint32_t count, uint32_t release)
{
    uint32_t low = 0;
    uint32_t high = count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (positions[middle] < release)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Gives every transition its batch; deadlines rise along the list. Returns how many there are. */
static uint32_t choose_batches(const struct transitions *list, uint32_t *positions,
                               uint32_t *batch_of)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        const struct transition *t = &list->items[i];
        uint32_t batch = first_batch(positions, count, t->release);
        if (batch == count)
            positions[count++] = t->deadline;
        batch_of[i] = batch;
    }
    return count;
}

/* Copies a batch, joining what has become neighbours; returns the number of barriers left. */
static uint32_t join_batch(struct rg_barrier *to, const struct rg_barrier *from, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        bool joined = kept && same_words(&to[kept - 1], &from[i]) && from[i].image != RG_NONE &&
                      join_ranges(&to[kept - 1].range, &from[i].range);
        if (!joined)
            to[kept++] = from[i];
    }
    return kept;
}

/* The barriers of all transitions, batch by batch; first[b] is where batch b begins. */
static void sort_by_batch(const struct transitions *list, const uint32_t *batch_of,
                          uint32_t batch_count, struct rg_barrier *sorted, uint32_t *first)
{
    for (uint32_t i = 0; i < list->count; i++)
        first[batch_of[i] + 2]++;
    for (uint32_t b = 0; b < batch_count; b++)
        first[b + 2] += first[b + 1];
    for (uint32_t i = 0; i < list->count; i++)
        sorted[first[batch_of[i] + 1]++] = list->items[i].barrier;
}

void rg_batch(struct compiler *c, const struct transitions *list, struct rg_plan_pass *passes)
{
    struct rg_plan *plan = c->plan;
    uint32_t *positions = ARENA_ARRAY(&c->scratch, uint32_t, list->count);
    uint32_t *batch_of = ARENA_ARRAY(&c->scratch, uint32_t, list->count);
    uint32_t *first = ARENA_ARRAY(&c->scratch, uint32_t, (size_t)list->count + 2);
    struct rg_barrier *sorted = ARENA_ARRAY(&c->scratch, struct rg_barrier, list->count);
    struct rg_barrier *barriers = ARENA_ARRAY(c->arena, struct rg_barrier, list->count);
    if (c->scratch.failed || c->arena->failed)
        return;
    plan->batch_count = choose_batches(list, positions, batch_of);
    plan->barriers = barriers;
    sort_by_batch(list, batch_of, plan->batch_count, sorted, first);
    for (uint32_t b = 0; b < plan->batch_count; b++) {
        uint32_t begin = plan->barrier_count;
        uint32_t count = join_batch(&barriers[begin], &sorted[first[b]], first[b + 1] - first[b]);
        plan->barrier_count += count;
        if (positions[b] == plan->pass_count) {
            plan->first_final_barrier = begin;
            plan->final_barrier_count = count;
        } else {
            passes[positions[b]].first_barrier = begin;
            passes[positions[b]].barrier_count = count;
        }
    }
}
