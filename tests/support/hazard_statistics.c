/* hazard_statistics.c: recomputes the plan's statistics of memory and barrier batches. */
#include "tests/support/hazard_private.h"

/* Returns the first pass in which a resource occupies memory: that of its first barrier or use. */
static uint32_t occupied_from(const struct hazard *h, const struct hazard_resource *resource)
{
    for (uint32_t p = 0; p < resource->first && p < h->plan->pass_count; p++)
        for (uint32_t i = 0; i < h->plan->passes[p].barrier_count; i++) {
            const struct rg_barrier *barrier =
                &h->plan->barriers[h->plan->passes[p].first_barrier + i];
            if ((resource->image ? barrier->image : barrier->buffer) == resource->plan)
                return p;
        }
    return resource->first;
}

/* Returns a block's peak memory in bytes. With `by_barriers`, lifetimes begin at barriers. */
static VkDeviceSize peak_memory(const struct hazard *h, uint32_t block, bool by_barriers)
{
    VkDeviceSize most = 0;
    for (uint32_t pass = 0; pass <= h->plan->pass_count; pass++) {
        VkDeviceSize bytes = 0;
        for (uint32_t r = 0; r < h->resource_count; r++) {
            const struct hazard_resource *resource = &h->resources[r];
            struct hazard_binding place = hazard_memory_binding(h, resource);
            if (place.block == block && pass <= resource->last &&
                pass >= (by_barriers ? occupied_from(h, resource) : resource->first))
                bytes += place.size;
        }
        most = bytes > most ? bytes : most;
    }
    return most;
}

static void check_bytes(struct hazard *h)
{
    const struct rg_plan *plan = h->plan;
    VkDeviceSize used = 0, bound = 0, apart = 0, persistent = 0;
    for (uint32_t i = 0; i < plan->block_count; i++) {
        bound += peak_memory(h, i, h->params->sharing == RG_SHARE_FEWEST_BATCHES);
        used += plan->blocks[i].size;
    }
    for (uint32_t r = 0; r < h->resource_count; r++) {
        const struct hazard_resource *resource = &h->resources[r];
        if (resource->plan == RG_NONE || resource->import)
            continue;
        struct hazard_binding place = hazard_memory_binding(h, resource);
        apart += place.block == RG_NONE ? 0 : place.size;
        persistent += place.block == RG_NONE ? place.size : 0;
    }
    if (used != plan->memory_used)
        hazard_report(h, "memory_used is not the sum of the blocks");
    if (bound != plan->memory_bound || bound > used)
        hazard_report(h, "memory_bound is %ju, but %ju bytes are taken at once",
                      (uintmax_t)plan->memory_bound, (uintmax_t)bound);
    if (plan->memory_without_aliasing < apart || plan->memory_without_aliasing < used)
        hazard_report(h, "memory_without_aliasing is less than it can be");
    if (h->params->sharing == RG_SHARE_NOTHING && used != plan->memory_without_aliasing)
        hazard_report(h, "nothing is shared, but memory_used is not memory_without_aliasing");
    if (plan->memory_persistent != persistent)
        hazard_report(h, "memory_persistent is not the sum of dedicated memory");
}

void hazard_check_statistics(struct hazard *h)
{
    const struct rg_plan *plan = h->plan;
    check_bytes(h);
    uint32_t batches = plan->final_barrier_count != 0;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        batches += plan->passes[i].barrier_count != 0;
    if (plan->batch_count != batches)
        hazard_report(h, "%u batches are counted as %u", batches, plan->batch_count);
    uint32_t enough = hazard_min_batches(h);
    if (batches > enough && !plan->submission_count)
        hazard_report(h, "%u batches, but %u are enough", batches, enough);
}
