/*
 * The fewest batches that the tables' accesses need where no memory is shared: each change of a
 * cell's use must be stabbed by a batch between the pass before and the pass after it.
 */
#include "tests/support/hazard_private.h"

#include <stdlib.h>

/* Batches `first` to `last` can hold the barrier; that before pass p is number p, then the end. */
struct interval {
    uint32_t first, last;
};

/* What a cell is used for between two barriers. */
struct stay {
    bool any, writes;
    enum rg_access access; /* the last one */
    VkImageLayout layout;
    uint32_t stages; /* of all of it */
    uint32_t last;   /* pass */
};

struct intervals {
    struct interval *array;
    uint32_t count, room;
};

static void add(struct intervals *intervals, uint32_t first, uint32_t last)
{
    intervals->array = hazard_grow(intervals->array, &intervals->room, intervals->count + 1,
                                   sizeof(*intervals->array));
    intervals->array[intervals->count++] = (struct interval){ first, last };
}

static struct stay stay_of(const struct hazard_resource *resource, enum rg_access access,
                           uint32_t stages, uint32_t pass)
{
    const struct hazard_rule *rule = hazard_rule(access);
    return (struct stay){
        .any = true,
        .writes = rule->writes != 0 || access == RG_PRESENT,
        .access = access,
        .layout = resource->image ? rule->layout : VK_IMAGE_LAYOUT_UNDEFINED,
        .stages = rule->stages ? rule->stages : stages,
        .last = pass,
    };
}

/* Reads of one layout need nothing between them. */
static bool goes_on(const struct stay *before, const struct stay *after)
{
    return before->any && !before->writes && !after->writes && before->layout == after->layout;
}

/* The same, if the outside has seen to it; only for such accesses. */
static bool has_arrived(const struct hazard_resource *resource, const struct stay *stay)
{
    if (!resource->import || resource->import->access == RG_ACCESS_NONE)
        return false;
    struct stay arrival = stay_of(resource, resource->import->access, HAZARD_SHADERS, 0);
    return goes_on(&arrival, stay) && !(stay->stages & ~arrival.stages) &&
           hazard_rule(stay->access)->reads == hazard_rule(arrival.access)->reads;
}

/* Whether the first access of a frame needs a barrier; it may come before any pass up to it. */
static bool begins(const struct hazard_resource *resource, const struct stay *first,
                   const struct stay *last)
{
    if (resource->buffer && resource->buffer->memory != RG_MEMORY_DEVICE)
        return false;
    if (resource->persistent) {
        struct stay out = *last;
        if (resource->output)
            out = stay_of(resource, resource->output->access, HAZARD_SHADERS, last->last);
        return !goes_on(&out, first); /* or a barrier of the frame before can have served it */
    }
    return !has_arrived(resource, first);
}

static void end(struct intervals *intervals, const struct hazard_resource *resource,
                const struct stay *last, uint32_t pass_count)
{
    enum rg_access access = RG_ACCESS_NONE;
    if (resource->output)
        access = resource->output->access;
    else if (resource->import)
        access = resource->import->access;
    if (access == RG_ACCESS_NONE)
        return;
    struct stay out = stay_of(resource, access, HAZARD_SHADERS, pass_count);
    bool same = !resource->output && last->access == access && last->stages == out.stages;
    if (!goes_on(last, &out) && !same)
        add(intervals, last->last + 1, pass_count);
}

/* A cell that comes and goes and that no pass touches. */
static void pass_through(struct intervals *intervals, const struct hazard_resource *resource,
                         uint32_t pass_count)
{
    if (!resource->output || !resource->import)
        return;
    struct stay out = stay_of(resource, resource->output->access, HAZARD_SHADERS, pass_count);
    if (resource->import->access != resource->output->access && !has_arrived(resource, &out))
        add(intervals, 0, pass_count);
}

/* Sees one access of a cell. `stays`: of each cell, the first one and the one it is in. */
static void see(struct intervals *intervals, struct stay stays[2], const struct stay *now)
{
    uint32_t stages = now->stages;
    if (!stays[0].any)
        stays[0] = *now;
    else if (goes_on(&stays[1], now))
        stages |= stays[1].stages;
    else
        add(intervals, stays[1].last + 1, now->last);
    stays[1] = *now;
    stays[1].stages = stages;
}

static int compare(const void *a, const void *b)
{
    uint32_t x = ((const struct interval *)a)->last, y = ((const struct interval *)b)->last;
    return (x > y) - (x < y);
}

static uint32_t stab(const struct intervals *intervals)
{
    uint32_t count = 0, next = 0; /* no batch from `next` on has been taken yet */
    if (intervals->count)
        qsort(intervals->array, intervals->count, sizeof(*intervals->array), compare);
    for (uint32_t i = 0; i < intervals->count; i++)
        if (intervals->array[i].first >= next) {
            next = intervals->array[i].last + 1;
            count++;
        }
    return count;
}

uint32_t hazard_batches(const struct hazard *h)
{
    struct intervals intervals = { 0 };
    uint32_t room = 0;
    struct stay(*stays)[2] = hazard_grow(NULL, &room, h->cell_count + 1, sizeof(*stays));
    for (uint32_t p = 0; p < h->plan->pass_count; p++) {
        const struct hazard_pass *pass = &h->passes[h->plan_passes[p]];
        for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++) {
            const struct hazard_use *use = &h->uses[u];
            const struct hazard_resource *resource = &h->resources[use->resource];
            struct stay now = stay_of(resource, use->access, use->stages, p);
            uint32_t cell;
            for (uint32_t i = 0; (cell = hazard_next_cell(resource, &use->range, &i)) != RG_NONE;)
                see(&intervals, stays[cell], &now);
        }
    }
    for (uint32_t i = 0; i < h->cell_count; i++) {
        const struct hazard_resource *resource = &h->resources[h->cells[i].resource];
        if (!stays[i][0].any) {
            pass_through(&intervals, resource, h->plan->pass_count);
            continue;
        }
        if (begins(resource, &stays[i][0], &stays[i][1]))
            add(&intervals, 0, stays[i][0].last);
        end(&intervals, resource, &stays[i][1], h->plan->pass_count);
    }
    uint32_t count = stab(&intervals);
    free(intervals.array);
    free(stays);
    return count;
}
