/* partial_submission.c: submits a frame in parts of bounded duration, between which the host can do
 * other work. Durations are predicted from the times of earlier parts. */
#include <math.h>
#include <string.h>
#include "graph/exec/executor_internal.h"

enum {
    UNKNOWN_ROWS = 8, /* greatest height of a band of unknown cost */
    LEAST_WIDTH = 16, /* of a part of two rows */
    TRIAL_COUNT = 2,  /* parts of this width that find the fixed cost; the first compiles shaders */
};

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* Seconds of a row that is known to take no time. */
static const double least_cost = 1e-9;

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

static uint32_t right_of(VkRect2D area)
{
    return (uint32_t)area.offset.x + area.extent.width;
}

/* Returns the predicted cost of a pass in seconds: 0 if it does not run, HUGE_VAL if unknown. */
static double predict(const struct rg_exec *exec, uint32_t pass, VkRect2D area)
{
    const struct exec_pass_cost *known = &exec->costs[pass];
    const double unknown = known->highest > 0.0f ? (double)known->highest : HUGE_VAL;
    double sum = (double)known->fixed;
    if (!area.extent.width || !area.extent.height)
        return 0.0;
    if (!can_be_divided(exec, pass))
        return known->pass > 0.0f ? (double)known->pass : HUGE_VAL;
    for (uint32_t row = (uint32_t)area.offset.y; row < end_of(area); row++) {
        const float cost = *row_cost(exec, pass, row);
        sum += cost > 0.0f ? (double)cost : unknown;
    }
    return sum;
}

/* Returns the cost of a row. If it is unknown, the row counts like the row before, at least as half
 * of the highest cost and as 1/UNKNOWN_ROWS of the limit. */
static double expect(const struct rg_exec *exec, uint32_t pass, uint32_t row, double limit)
{
    const double cost = (double)*row_cost(exec, pass, row);
    const double before = row ? (double)*row_cost(exec, pass, row - 1) : 0.0;
    const double least = larger((double)exec->costs[pass].highest / 2.0, limit / UNKNOWN_ROWS);
    return cost > 0.0 ? cost : larger(before, least);
}

/* Limits a part of two rows, which take `cost` seconds in total, to some columns. Their cost per
 * pixel is expected to be at least that of the columns before. */
static void find_columns(const struct exec_pass_cost *known, struct exec_part *part, VkRect2D area,
                         double cost, double limit)
{
    const uint32_t done = part->left - (uint32_t)area.offset.x;
    const double density = larger(cost / area.extent.width, done ? part->spent / done : 0.0);
    const double width = known->trials < TRIAL_COUNT ? 0.0 : limit / density;
    part->left_end = part->left + (uint32_t)smaller(larger(width, LEAST_WIDTH), area.extent.width);
    part->left_end += part->left_end & 1u;
    if (part->left_end > right_of(area))
        part->left_end = right_of(area);
}

/* Sets the rectangle of a part that takes about `seconds`: rows, or columns of two rows. If its
 * fixed cost, mostly that of vertices, is more than half of that, it may take longer. It ends at
 * even rows and columns, because fragment derivatives are computed for 2x2 pixels. */
static void find_rectangle(const struct rg_exec *exec, struct exec_part *part, VkRect2D area,
                           double seconds)
{
    const struct exec_pass_cost *known = &exec->costs[part->first];
    const double limit = larger(seconds - (double)known->fixed, (double)known->fixed);
    const uint32_t first = (uint32_t)area.offset.x;
    const bool has_columns = part->left > first || known->trials < TRIAL_COUNT;
    double sum = 0.0;
    part->left = part->left > first ? part->left : first;
    part->left_end = right_of(area);
    part->row_end = part->row;
    while (part->row_end < end_of(area)) {
        const uint32_t next = part->row_end + 2 - (part->row_end & 1u);
        double cost = 0.0;
        for (uint32_t row = part->row_end; row < next; row++)
            cost += expect(exec, part->first, row, limit);
        if (part->row_end > part->row && (sum + cost > limit || has_columns))
            break;
        sum += cost;
        part->row_end = next < end_of(area) ? next : end_of(area);
    }
    if (has_columns || sum > limit)
        find_columns(known, part, area, sum, limit);
    part->ends_rows = part->left_end == right_of(area);
    part->ends = part->ends_rows && part->row_end == end_of(area);
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
        find_rectangle(exec, &part, area, seconds);
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

/* Stores the time of a rectangle of a pass; of columns once all of their rows are drawn. */
static void learn_rectangle(struct rg_exec *exec, const struct exec_part *part, double taken)
{
    struct exec_pass_cost *known = &exec->costs[part->first];
    if (known->trials < TRIAL_COUNT) {
        known->fixed = (float)taken;
        known->trials++;
        return;
    }
    known->fixed = (float)smaller((double)known->fixed, taken);
    const double spent = part->spent + taken - (double)known->fixed;
    if (!part->ends_rows) {
        exec->next_part.spent = spent;
        return;
    }
    for (uint32_t row = part->row; row < part->row_end; row++)
        *row_cost(exec, part->first, row) =
            (float)larger(spent / (part->row_end - part->row), least_cost);
    known->highest = part->ends ? 0.0f : known->highest;
    for (uint32_t i = 0; i < RG_ZONE_COUNT; i++)
        known->highest = (float)larger((double)known->highest, (double)known->rows[i]);
}

/* Multiplies the costs of a pass by `factor`, or forgets them if they were far too low. */
static void scale(struct exec_pass_cost *known, double factor, bool is_far_off)
{
    known->pass *= (float)factor;
    known->highest *= is_far_off ? 0.0f : (float)factor;
    for (uint32_t i = 0; i < RG_ZONE_COUNT; i++)
        known->rows[i] *= is_far_off ? 0.0f : (float)factor;
}

/* Stores the time of a part. */
static void learn(struct rg_exec *exec, const struct rg_frame *frame, const struct exec_part *part,
                  double taken, double seconds)
{
    const uint32_t end = part->first + part->count;
    double predicted = 0.0;
    if (part->row_end) {
        learn_rectangle(exec, part, taken);
        return;
    }
    if (part->count == 1 && !can_be_divided(exec, part->first)) {
        exec->costs[part->first].pass = (float)taken;
        return;
    }
    for (uint32_t p = part->first; p < end; p++)
        predicted += predict(exec, p, rg_exec_pass_area(exec, p, frame));
    for (uint32_t p = part->first; p < end && predicted > 0.0 && predicted < HUGE_VAL; p++)
        scale(&exec->costs[p], taken / predicted, taken > 2.0 * larger(predicted, seconds));
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
        .row = part->ends_rows ? part->row_end : part->row,
        .left = part->ends_rows ? 0 : part->left_end,
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
    learn(exec, frame, &part, (double)(rg_time_now() - start) * 1e-9, seconds);
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
    for (uint32_t i = 0; exec->costs && i < exec->plan->pass_count; i++)
        memset(exec->costs[i].rows, 0, sizeof(exec->costs[i].rows));
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
