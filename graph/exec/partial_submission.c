/* partial_submission.c: submits a frame in parts of bounded duration, between which the host can do
 * other work. Durations are predicted from the times of earlier parts. */
#include <math.h>
#include "graph/exec/executor_internal.h"

enum {
    UNKNOWN_ROWS = 8, /* greatest height of a band of unknown cost */
    MAX_DOUBLINGS = 16,
    FIRST_TRIAL = 2, /* frame in bands from which their height is tried; compiles no shaders */
};

/* If bands of twice the height take less than this fraction of the time, vertices, which each band
 * processes, dominate the cost of a pass. */
static const double vertex_bound = 0.7;

static bool can_be_divided(const struct rg_exec *exec, uint32_t pass)
{
    const struct rg_plan_pass *plan = &exec->plan->passes[pass];
    bool is_divisible =
        plan->pass->kind == RG_RASTER && !exec->slots[exec->slot].times.measure.statistics;
    for (uint32_t i = 0; i < plan->use_count; i++) {
        const enum rg_access access = exec->plan->uses[plan->first_use + i].use->access;
        is_divisible =
            is_divisible && access != RG_STORAGE_WRITE && access != RG_STORAGE_READ_WRITE;
    }
    return is_divisible;
}

/* Returns the cost of a row of a pass, for reading and writing. */
static float *row_cost(const struct rg_exec *exec, uint32_t pass, uint32_t row)
{
    const uint32_t height = exec->plan->passes[pass].extent.height;
    const uint64_t zone = (uint64_t)row * RG_ZONE_COUNT / (height ? height : 1);
    return &exec->costs[pass].rows[zone < RG_ZONE_COUNT ? zone : RG_ZONE_COUNT - 1];
}

static uint32_t end_of(VkRect2D area)
{
    return (uint32_t)area.offset.y + area.extent.height;
}

/* Returns the predicted cost of a pass in seconds: 0 if it does not run, HUGE_VAL if unknown. */
static double predict(const struct rg_exec *exec, uint32_t pass, VkRect2D area)
{
    double sum = 0.0;
    if (!area.extent.width || !area.extent.height)
        return 0.0;
    if (!can_be_divided(exec, pass))
        return exec->costs[pass].pass > 0.0f ? (double)exec->costs[pass].pass : HUGE_VAL;
    for (uint32_t row = (uint32_t)area.offset.y; row < end_of(area); row++) {
        const float cost = *row_cost(exec, pass, row);
        sum += cost > 0.0f ? (double)cost : HUGE_VAL;
    }
    return sum;
}

/* Sets part->row_end so that the band takes about `seconds`. A row of unknown cost counts like the
 * row before, at least as 1/UNKNOWN_ROWS of the band. Bands end at even rows, because fragment
 * derivatives are computed for 2x2 pixels. */
static void find_band(const struct rg_exec *exec, struct exec_part *part, uint32_t end,
                      double seconds)
{
    const double limit = seconds * (double)(1u << exec->costs[part->first].doublings);
    double sum = 0.0, last = 0.0;
    uint32_t row = part->row;
    if (row)
        last = (double)*row_cost(exec, part->first, row - 1);
    while (row < end && (sum < limit || row < part->row + 2)) {
        const double cost = (double)*row_cost(exec, part->first, row++);
        if (cost > 0.0)
            last = cost;
        else if (last < seconds / UNKNOWN_ROWS)
            last = seconds / UNKNOWN_ROWS;
        sum += last;
    }
    row += row & 1u;
    part->row_end = row < end && can_be_divided(exec, part->first) ? row : end;
    part->ends = part->row_end == end;
}

/* Returns the part that begins at exec->next_part and takes about `seconds`. */
static struct exec_part find_part(struct rg_exec *exec, const struct rg_frame *frame,
                                  double seconds)
{
    struct exec_part part = exec->next_part;
    const VkRect2D area = rg_exec_pass_area(exec, part.first, frame);
    double sum = predict(exec, part.first, area);
    if (!part.begins || (sum > seconds && can_be_divided(exec, part.first))) {
        part.row = part.begins ? (uint32_t)area.offset.y : part.row;
        find_band(exec, &part, end_of(area), seconds);
        return part;
    }
    for (part.count = 1; part.first + part.count < exec->plan->pass_count; part.count++) {
        const uint32_t next = part.first + part.count;
        sum += predict(exec, next, rg_exec_pass_area(exec, next, frame));
        if (sum > seconds)
            break;
    }
    part.ends = true;
    return part;
}

/* Multiplies the costs of a pass by `factor`. */
static void scale(struct exec_pass_cost *cost, double factor)
{
    cost->pass *= (float)factor;
    for (uint32_t i = 0; i < RG_ZONE_COUNT; i++)
        cost->rows[i] *= (float)factor;
}

/* Stores the time of a part that consists of one pass or of some of its rows. */
static void learn_pass(struct rg_exec *exec, const struct exec_part *part, VkRect2D area,
                       double taken)
{
    const uint32_t begin = part->row_end ? part->row : (uint32_t)area.offset.y;
    const uint32_t end = part->row_end ? part->row_end : end_of(area);
    exec->costs[part->first].pass = (float)taken;
    for (uint32_t row = begin; row < end; row++)
        *row_cost(exec, part->first, row) = (float)(taken / (end - begin));
}

/* Doubles the height of a pass's bands as long as that makes the pass much faster. */
static void learn_height(struct exec_pass_cost *cost, const struct exec_part *part, double taken)
{
    cost->sum = (part->begins ? 0.0f : cost->sum) + (float)taken;
    if (!part->ends || cost->has_height)
        return;
    cost->frames++;
    if (cost->frames < FIRST_TRIAL)
        return;
    const bool is_faster = (double)cost->sum < vertex_bound * (double)cost->last_sum;
    if (cost->frames > FIRST_TRIAL && !is_faster) {
        cost->doublings--;
        cost->has_height = true;
        return;
    }
    cost->last_sum = cost->sum;
    cost->doublings += cost->doublings < MAX_DOUBLINGS;
    cost->has_height = cost->doublings == MAX_DOUBLINGS;
}

/* Stores the time of a part. */
static void learn(struct rg_exec *exec, const struct rg_frame *frame, const struct exec_part *part,
                  double taken)
{
    double predicted = 0.0;
    if (part->row_end)
        learn_height(&exec->costs[part->first], part, taken);
    if (part->count == 1) {
        learn_pass(exec, part, rg_exec_pass_area(exec, part->first, frame), taken);
        return;
    }
    for (uint32_t p = part->first; p < part->first + part->count; p++)
        predicted += predict(exec, p, rg_exec_pass_area(exec, p, frame));
    for (uint32_t p = part->first;
         p < part->first + part->count && predicted > 0.0 && predicted < HUGE_VAL; p++)
        scale(&exec->costs[p], taken / predicted);
}

/* Records, submits and waits for a part. Moves exec->next_part behind it. */
static VkResult run(struct rg_exec *exec, const struct rg_frame *frame,
                    const struct exec_part *part)
{
    const bool is_last = part->ends && part->first + part->count == exec->plan->pass_count;
    VkResult result;
    RG_TRY(rg_exec_submit_recorded(exec, frame, part));
    RG_TRY(rg_exec_wait_fence(exec));
    exec->next_part = (struct exec_part){
        .first = part->ends ? part->first + part->count : part->first,
        .count = !is_last,
        .row = part->ends ? 0 : part->row_end,
        .begins = part->ends,
    };
    exec->initialized = true;
    if (is_last)
        rg_exec_end_frame(exec);
fail:
    return result;
}

VkResult rg_exec_submit_part(struct rg_exec *exec, const struct rg_frame *frame, double seconds)
{
    VkResult result;
    if (!exec->begun)
        return rg_exec_refuse(exec, "rg_exec_submit_part() without rg_exec_begin()");
    if (exec->plan->submission_count)
        return rg_exec_refuse(exec, "rg_exec_submit_part() of a plan for several queues");
    if (rg_exec_refuse_plan(exec))
        return VK_ERROR_VALIDATION_FAILED_EXT;
    if (!exec->costs && !RG_MAKE_ARRAY(exec, exec->costs, exec->plan->pass_count))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    if (!exec->next_part.count) {
        exec->next_part = (struct exec_part){ .count = 1, .begins = true };
        exec->external_sync = (struct rg_exec_external_sync){ 0 };
        rg_exec_select_images(exec, 0);
        RG_TRY(rg_exec_sync_host(exec, exec->slot, RG_MEMORY_UPLOAD));
    }
    const struct exec_part part = find_part(exec, frame, seconds);
    const uint64_t start = rg_time_now();
    RG_TRY(run(exec, frame, &part));
    learn(exec, frame, &part, (double)(rg_time_now() - start) * 1e-9);
    exec->begun = exec->next_part.count;
    return exec->begun ? VK_NOT_READY : VK_SUCCESS;
fail:
    exec->next_part.count = 0;
    exec->begun = false;
    return result;
}

VkResult rg_exec_abandon(struct rg_exec *exec)
{
    struct exec_part part = exec->next_part;
    VkResult result = VK_SUCCESS;
    if (!part.count)
        return result;
    exec->next_part.count = 0;
    exec->begun = false;
    part.is_empty = part.ends = true;
    if (!part.begins) {
        RG_TRY(run(exec, NULL, &part)); /* ends the pass's measurement */
        part = exec->next_part;
    }
    part.count = exec->plan->pass_count - part.first;
    part.is_empty = part.begins = part.ends = true;
    if (part.count)
        RG_TRY(run(exec, NULL, &part));
fail:
    exec->next_part.count = 0;
    return result;
}
