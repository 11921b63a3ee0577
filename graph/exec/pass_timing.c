/* pass_timing.c: measures each pass by GPU timestamps, pipeline statistics or the host's clock. A
 * pass's timestamp comes before the next barriers. After them, a tile-based software rasteriser may
 * write the timestamp only when the next pass has finished. */
#include <string.h>
#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <time.h>
#endif
#include "graph/exec/executor_internal.h"

/* Pipeline statistics to query. The results of a query are in the order of these bits. */
enum {
    COUNTED = VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
              VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
              VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
              VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT,
    COUNTED_COUNT = 4,
};

struct exec_time {
    struct rg_measure measure; /* of future frames */
    VkQueryPool stamps;        /* per slot: pass count plus 1 */
    VkQueryPool counts, samples;
    uint64_t stamp_mask;           /* valid timestamp bits; 0 if none */
    double period;                 /* nanoseconds per tick */
    uint64_t *results;             /* results of one slot's queries */
    struct rg_pass_time *passes;   /* of all slots */
    uint32_t *ends;                /* end timestamp per slot and pass */
    struct rg_pass_time *finished; /* of the frame that finished last */
    struct rg_times times;
};

#ifdef _WIN32
uint64_t rg_time_now(void)
{
    LARGE_INTEGER count, frequency;
    QueryPerformanceCounter(&count);
    QueryPerformanceFrequency(&frequency);
    const uint64_t ticks = (uint64_t)count.QuadPart, second = (uint64_t)frequency.QuadPart;
    return ticks / second * 1000000000u + ticks % second * 1000000000u / second;
}
#else
uint64_t rg_time_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}
#endif

static VkResult make_pool(struct rg_exec *exec, VkQueryType type, uint32_t count, VkQueryPool *pool)
{
    VkResult result;
    RG_MAKE(exec, NULL, QUERY_POOL, CreateQueryPool, pool,
            &(VkQueryPoolCreateInfo){
                .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                .queryType = type,
                .queryCount = count,
                .pipelineStatistics = type == VK_QUERY_TYPE_PIPELINE_STATISTICS ? COUNTED : 0,
            });
fail:
    return result;
}

/* Returns a mask of the bits that are valid in a timestamp. Supports 64 queue families. */
static uint64_t stamp_mask(const struct rg_exec *exec)
{
    VkQueueFamilyProperties families[64];
    uint32_t count = 64;
    exec->vk.GetPhysicalDeviceQueueFamilyProperties(exec->params.physical, &count, families);
    if (exec->params.queue_family >= count)
        return 0;
    uint32_t bits = families[exec->params.queue_family].timestampValidBits;
    return bits >= 64 ? UINT64_MAX : ((uint64_t)1 << bits) - 1;
}

VkResult rg_exec_make_time(struct rg_exec *exec)
{
    VkPhysicalDeviceProperties properties;
    const uint32_t pass_count = exec->plan->pass_count;
    const uint32_t query_count = exec->slot_count * pass_count;
    struct exec_time *time;
    VkResult result = VK_SUCCESS;
    if (!exec->params.measured)
        return result;
    if (!RG_MAKE_ARRAY(exec, time, 1) || !RG_MAKE_ARRAY(exec, time->passes, query_count) ||
        !RG_MAKE_ARRAY(exec, time->ends, query_count) ||
        !RG_MAKE_ARRAY(exec, time->finished, pass_count) ||
        !RG_MAKE_ARRAY(exec, time->results, (size_t)pass_count * COUNTED_COUNT + 1))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    exec->time = time;
    exec->vk.GetPhysicalDeviceProperties(exec->params.physical, &properties);
    time->period = (double)properties.limits.timestampPeriod;
    time->stamp_mask = stamp_mask(exec);
    if (time->stamp_mask)
        RG_TRY(make_pool(exec, VK_QUERY_TYPE_TIMESTAMP, query_count + exec->slot_count,
                         &time->stamps));
    if (exec->params.statistics) {
        RG_TRY(make_pool(exec, VK_QUERY_TYPE_PIPELINE_STATISTICS, query_count, &time->counts));
        RG_TRY(make_pool(exec, VK_QUERY_TYPE_OCCLUSION, query_count, &time->samples));
    }
fail:
    return result;
}

bool rg_exec_has_clock(const struct rg_exec *exec, enum rg_clock clock)
{
    bool is_stamped = clock == RG_CLOCK_STREAM || clock == RG_CLOCK_EXACT;
    return exec->time && (!is_stamped || exec->time->stamps) && !exec->plan->submission_count;
}

void rg_exec_measure(struct rg_exec *exec, const struct rg_measure *measure)
{
    if (!exec->time)
        return;
    exec->time->measure = (struct rg_measure){
        .clock = rg_exec_has_clock(exec, measure->clock) ? measure->clock : RG_CLOCK_NONE,
        .statistics = measure->statistics && exec->time->counts,
    };
}

void rg_time_keep(struct rg_exec *exec, const struct rg_exec *former)
{
    if (exec->time)
        exec->time->measure = former->time->measure;
}

struct rg_times rg_exec_times(const struct rg_exec *exec)
{
    return exec->time ? exec->time->times : (struct rg_times){ 0 };
}

/* ---- recording ---- */

static uint32_t first_stamp(const struct rg_exec *exec, uint32_t slot)
{
    return slot * (exec->plan->pass_count + 1);
}

void rg_time_begin(struct rg_exec *exec, uint64_t start)
{
    struct exec_slot *slot = &exec->slots[exec->slot];
    slot->times = (struct rg_times){ .start = start, .begin = rg_time_now() - start };
    if (!exec->time || exec->plan->submission_count)
        return;
    slot->times.measure = exec->time->measure;
    slot->times.pass_count = exec->plan->pass_count;
    slot->passes = &exec->time->passes[(size_t)exec->slot * exec->plan->pass_count];
}

static bool is_stamped(const struct exec_slot *slot)
{
    return slot->times.measure.clock == RG_CLOCK_STREAM ||
           slot->times.measure.clock == RG_CLOCK_EXACT;
}

static void stamp(struct rg_exec *exec, VkCommandBuffer commands)
{
    const uint32_t index = exec->slots[exec->slot].stamp_count++;
    exec->vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_BOTTOM_OF_PIPE_BIT,
                                exec->time->stamps, first_stamp(exec, exec->slot) + index);
    if (exec->slots[exec->slot].times.measure.clock == RG_CLOCK_EXACT)
        rg_exec_record_wait(exec, commands);
}

void rg_time_begin_frame(struct rg_exec *exec, VkCommandBuffer commands)
{
    struct exec_slot *slot = &exec->slots[exec->slot];
    const uint32_t pass_count = exec->plan->pass_count;
    const uint32_t first = exec->slot * pass_count;
    slot->stamp_count = 0;
    if (is_stamped(slot)) {
        exec->vk.CmdResetQueryPool(commands, exec->time->stamps, first_stamp(exec, exec->slot),
                                   pass_count + 1);
        stamp(exec, commands);
    }
    if (slot->times.measure.statistics) {
        exec->vk.CmdResetQueryPool(commands, exec->time->counts, first, pass_count);
        exec->vk.CmdResetQueryPool(commands, exec->time->samples, first, pass_count);
    }
}

/* Returns true if queries cannot count in a pass: secondary command buffers would have to inherit
 * them, and multiview rendering would use one query for each view. */
static bool is_uncounted(const struct rg_exec *exec, uint32_t pass)
{
    return exec->plan->passes[pass].pass->secondary || exec->plan->passes[pass].pass->multiview;
}

static void end_queries(const struct rg_exec *exec, VkCommandBuffer commands, uint32_t query)
{
    if (!exec->slots[exec->slot].times.measure.statistics)
        return;
    exec->vk.CmdEndQuery(commands, exec->time->samples, query);
    exec->vk.CmdEndQuery(commands, exec->time->counts, query);
}

void rg_time_begin_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass)
{
    const struct exec_slot *slot = &exec->slots[exec->slot];
    const uint32_t query = exec->slot * exec->plan->pass_count + pass;
    if (!slot->passes)
        return;
    slot->passes[pass] = (struct rg_pass_time){ .record_begin = rg_time_now() - slot->times.start };
    if (slot->times.measure.statistics) {
        exec->vk.CmdBeginQuery(commands, exec->time->counts, query, 0);
        exec->vk.CmdBeginQuery(commands, exec->time->samples, query, VK_QUERY_CONTROL_PRECISE_BIT);
    }
    if (is_uncounted(exec, pass))
        end_queries(exec, commands, query);
}

/* Ends the measurement of a pass. A skipped pass writes no timestamp, because llvmpipe flushes all
 * pending work at each timestamp. */
void rg_time_end_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass, bool drawn)
{
    const struct exec_slot *slot = &exec->slots[exec->slot];
    const uint32_t query = exec->slot * exec->plan->pass_count + pass;
    if (!slot->passes)
        return;
    if (!is_uncounted(exec, pass))
        end_queries(exec, commands, query);
    if (is_stamped(slot)) {
        if (drawn)
            stamp(exec, commands);
        exec->time->ends[query] = slot->stamp_count - 1;
    }
    struct rg_pass_time *time = &slot->passes[pass];
    time->record = rg_time_now() - slot->times.start - time->record_begin;
}

/* Reads the results of `count` queries. Each result consists of `values` 64-bit numbers. */
static VkResult read_pool(struct rg_exec *exec, VkQueryPool pool, uint32_t first, uint32_t count,
                          uint32_t values)
{
    const size_t stride = values * sizeof(uint64_t);
    VkResult result;
    RG_CALL(exec, NULL, GetQueryPoolResults, exec->device, pool, first, count, count * stride,
            exec->time->results, stride, VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
fail:
    return result;
}

static VkResult read_results(struct rg_exec *exec, uint32_t slot)
{
    const struct exec_time *time = exec->time;
    const uint64_t *results = time->results;
    const uint32_t pass_count = exec->plan->pass_count;
    const uint32_t *ends = &time->ends[(size_t)slot * pass_count];
    struct rg_pass_time *passes = exec->slots[slot].passes;
    VkResult result = VK_SUCCESS;
    if (is_stamped(&exec->slots[slot]))
        RG_TRY(read_pool(exec, time->stamps, first_stamp(exec, slot), exec->slots[slot].stamp_count,
                         1));
    for (uint32_t p = 0; p < pass_count && is_stamped(&exec->slots[slot]); p++) {
        uint64_t end = (results[ends[p]] - results[0]) & time->stamp_mask;
        passes[p].begin = p ? passes[p - 1].end : 0;
        passes[p].end = (uint64_t)((double)end * time->period);
    }
    if (!exec->slots[slot].times.measure.statistics)
        return result;
    RG_TRY(read_pool(exec, time->counts, slot * pass_count, pass_count, COUNTED_COUNT));
    for (uint32_t p = 0; p < pass_count; p++) {
        const uint64_t *counts = &results[(size_t)p * COUNTED_COUNT];
        passes[p].vertices = counts[0];
        passes[p].triangles = counts[1];
        passes[p].fragments = counts[2];
        passes[p].invocations = counts[3];
    }
    RG_TRY(read_pool(exec, time->samples, slot * pass_count, pass_count, 1));
    for (uint32_t p = 0; p < pass_count; p++)
        passes[p].samples = results[p];
fail:
    return result;
}

VkResult rg_time_finish(struct rg_exec *exec, uint32_t index, uint64_t wait_start)
{
    struct exec_slot *slot = &exec->slots[index];
    struct exec_time *time = exec->time;
    const uint64_t end = rg_time_now();
    VkResult result = VK_SUCCESS;
    slot->times.wait += end - wait_start;
    slot->times.whole = end - slot->times.start;
    if (!time || !slot->passes) /* the frame belongs to a previous plan */
        return result;
    RG_TRY(read_results(exec, index));
    memcpy(time->finished, slot->passes, exec->plan->pass_count * sizeof(*slot->passes));
    time->times = slot->times;
    time->times.passes = time->finished;
fail:
    return result;
}
