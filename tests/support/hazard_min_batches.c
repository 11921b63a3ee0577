/*
 * hazard_min_batches.c: lower bound of barrier batches, without memory aliasing.
 *
 * Each change of a subresource's use needs a barrier in a batch between the two passes. The fewest
 * batches are a minimum set of points that stabs these intervals, found greedily by interval end.
 */
#include "tests/support/hazard_private.h"

#include <stdlib.h>

/* Range of batches, one of which must have a barrier; batch p precedes pass p. */
struct interval {
    uint32_t first, last;
};

/* The accesses to a subresource since its last barrier. */
struct state {
    bool any, writes;
    enum rg_access access; /* the last access */
    VkImageLayout layout;
    uint32_t stages; /* stages of all accesses */
    uint32_t last;   /* index of the last pass */
    bool is_initial; /* no barrier since the start of the frame */
};

struct intervals {
    struct interval *array;
    uint32_t count, capacity;
};

static void add(struct intervals *intervals, uint32_t first, uint32_t last)
{
    intervals->array = hazard_grow(intervals->array, &intervals->capacity, intervals->count + 1,
                                   sizeof(*intervals->array));
    intervals->array[intervals->count++] = (struct interval){ first, last };
}

static struct state state_of(const struct hazard_resource *resource, enum rg_access access,
                             uint32_t stages, uint32_t pass)
{
    const struct hazard_rule *rule = hazard_rule(access);
    return (struct state){
        .any = true,
        .writes = rule->writes != 0 || access == RG_PRESENT,
        .access = access,
        .layout = resource->image ? rule->layout : VK_IMAGE_LAYOUT_UNDEFINED,
        .stages = rule->stages ? rule->stages : stages,
        .last = pass,
    };
}

/* Returns true if both accesses are reads in the same layout, which need no barrier. */
static bool needs_no_barrier(const struct state *before, const struct state *after)
{
    return before->any && !before->writes && !after->writes && before->layout == after->layout;
}

/* Returns true if an import already has the layout, stages and access that a read needs. */
static bool has_arrived(const struct hazard_resource *resource, const struct state *state)
{
    if (!resource->import || resource->import->access == RG_ACCESS_NONE)
        return false;
    struct state arrival = state_of(resource, resource->import->access, HAZARD_SHADERS, 0);
    return needs_no_barrier(&arrival, state) && !(state->stages & ~arrival.stages) &&
           hazard_rule(state->access)->reads == hazard_rule(arrival.access)->reads;
}

/* Returns true if a frame needs a barrier before its first access to the resource. */
static bool begins(const struct hazard_resource *resource, const struct state *first,
                   const struct state *last)
{
    if (resource->buffer && resource->buffer->memory != RG_MEMORY_DEVICE)
        return false;
    if (resource->persistent) {
        struct state out = *last;
        if (resource->output)
            out = state_of(resource, resource->output->access, HAZARD_SHADERS, last->last);
        /* if false, a barrier of the previous frame suffices */
        return !needs_no_barrier(&out, first);
    }
    return !has_arrived(resource, first);
}

static void end(struct intervals *intervals, const struct hazard_resource *resource,
                const struct state *last, uint32_t pass_count)
{
    enum rg_access access = RG_ACCESS_NONE;
    if (resource->output)
        access = resource->output->access;
    else if (resource->import)
        access = resource->import->access;
    if (access == RG_ACCESS_NONE)
        return;
    struct state out = state_of(resource, access, HAZARD_SHADERS, pass_count);
    bool same = !resource->output && last->access == access && last->stages == out.stages;
    if (!needs_no_barrier(last, &out) && !same)
        add(intervals, last->last + 1, pass_count);
}

/* Adds a barrier for an imported output that no pass accesses, if its final access differs. */
static void pass_through(struct intervals *intervals, const struct hazard_resource *resource,
                         uint32_t pass_count)
{
    if (!resource->output || !resource->import)
        return;
    struct state out = state_of(resource, resource->output->access, HAZARD_SHADERS, pass_count);
    if (resource->import->access != resource->output->access && !has_arrived(resource, &out))
        add(intervals, 0, pass_count);
}

/* Adds an access to a subresource with first state states[0] and current state states[1]. If
 * earlier reads of an import need no barrier, but this one does, this one counts as the first. */
static void add_access(struct intervals *intervals, const struct hazard_resource *resource,
                       struct state states[2], const struct state *now)
{
    uint32_t stages = now->stages;
    bool is_initial = !states[0].any;
    if (is_initial) {
        states[0] = *now;
    } else if (needs_no_barrier(&states[1], now)) {
        stages |= states[1].stages;
        is_initial = states[1].is_initial;
        if (is_initial && has_arrived(resource, &states[0]) && !has_arrived(resource, now))
            states[0] = *now;
    } else {
        add(intervals, states[1].last + 1, now->last);
    }
    states[1] = *now;
    states[1].stages = stages;
    states[1].is_initial = is_initial;
}

static int compare(const void *a, const void *b)
{
    uint32_t x = ((const struct interval *)a)->last, y = ((const struct interval *)b)->last;
    return (x > y) - (x < y);
}

static uint32_t stab(const struct intervals *intervals)
{
    uint32_t count = 0, next = 0; /* `next`: first batch after the last chosen one */
    if (intervals->count)
        qsort(intervals->array, intervals->count, sizeof(*intervals->array), compare);
    for (uint32_t i = 0; i < intervals->count; i++)
        if (intervals->array[i].first >= next) {
            next = intervals->array[i].last + 1;
            count++;
        }
    return count;
}

uint32_t hazard_min_batches(const struct hazard *h)
{
    struct intervals intervals = { 0 };
    uint32_t capacity = 0;
    struct state(*states)[2] = hazard_grow(NULL, &capacity, h->cell_count + 1, sizeof(*states));
    for (uint32_t p = 0; p < h->plan->pass_count; p++) {
        const struct hazard_pass *pass = &h->passes[h->plan_passes[p]];
        for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++) {
            const struct hazard_use *use = &h->uses[u];
            const struct hazard_resource *resource = &h->resources[use->resource];
            struct state now = state_of(resource, use->access, use->stages, p);
            if (use->use && use->access == RG_SAMPLED && pass->pass->depth_read_only &&
                pass->pass->depth.image == use->use->image && use->use->image)
                now.layout = hazard_rule(RG_DEPTH_READ)->layout;
            uint32_t cell;
            for (uint32_t i = 0;
                 (cell = hazard_next_subresource(resource, &use->range, &i)) != RG_NONE;)
                add_access(&intervals, resource, states[cell], &now);
        }
    }
    for (uint32_t i = 0; i < h->cell_count; i++) {
        const struct hazard_resource *resource = &h->resources[h->cells[i].resource];
        if (!states[i][0].any) {
            pass_through(&intervals, resource, h->plan->pass_count);
            continue;
        }
        const uint32_t partner = hazard_partner(h, i);
        const struct state *left = &states[states[partner][1].any ? partner : i][1];
        if (begins(&h->resources[h->cells[partner].resource], &states[i][0], left))
            add(&intervals, 0, states[i][0].last);
        end(&intervals, resource, &states[i][1], h->plan->pass_count);
    }
    uint32_t count = stab(&intervals);
    free(intervals.array);
    free(states);
    return count;
}
