/* measure.c: everything is allocated beforehand, so that only the work itself is timed. */
#include "tests/bench/graph/measure.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "tests/bench/graph/allocations.h"
#include "tests/bench/graph/synthetic_tables.h"
#include "tests/bench/graph/yardstick.h"

enum {
    SUBJECT_COUNT = MEASURE_SHARING_COUNT + 1, /* the last is the yardstick */
    YARDSTICK = MEASURE_SHARING_COUNT,
    ROW = 16,        /* runs in a row */
    ROW_COUNTED = 8, /* the last of them */
    FIRST_SEED = 1001,
    LAST_SEED = 1200,
};

/* Microseconds, one value a repetition. */
struct samples {
    double *setup, *compile, *total;
};

struct bench {
    struct synthetic graph;
    struct synthetic_tables tables;
    struct yardstick yardstick;
    struct samples samples[SUBJECT_COUNT];
    void *memory; /* for compiling */
    size_t memory_size;
};

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e6 + (double)time.tv_nsec * 1e-3;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static struct measure_time summarise(double *values, uint32_t count)
{
    qsort(values, count, sizeof(*values), compare);
    return (struct measure_time){ .median = values[count / 2], .min = values[0] };
}

static struct measure_times summarise_samples(const struct samples *samples, uint32_t count)
{
    return (struct measure_times){
        .setup = summarise(samples->setup, count),
        .compile = summarise(samples->compile, count),
        .total = summarise(samples->total, count),
    };
}

static void keep_sample(const struct samples *samples, uint32_t index, const double times[3])
{
    samples->setup[index] = times[1] - times[0];
    samples->compile[index] = times[2] - times[1];
    samples->total[index] = times[2] - times[0];
}

/* A plan without faults, or NULL and a line on stderr. */
static struct rg_plan *compile(const struct rg_compile_params *params)
{
    struct rg_plan *plan = rg_compile(params);
    char text[256];
    if (!plan) {
        fputs("out of memory\n", stderr);
        return NULL;
    }
    if (!plan->fault_count)
        return plan;
    rg_fault_text(plan->faults, text, sizeof(text));
    fprintf(stderr, "%s\n", text);
    rg_plan_destroy(plan);
    return NULL;
}

/* All that is to be said of a plan but times and allocations. */
static bool describe(struct bench *b, struct measure_sharing *result, enum rg_sharing sharing)
{
    b->tables.params.sharing = sharing;
    struct rg_plan *plan = compile(&b->tables.params);
    if (!plan)
        return false;
    *result = (struct measure_sharing){
        .live_count = plan->pass_count,
        .batch_count = plan->batch_count - (plan->final_barrier_count > 0),
        .arena_size = plan->arena_size,
        .memory_used = plan->memory_used,
        .memory_bound = plan->memory_bound,
        .memory_least = plan->memory_least,
        .memory_without_aliasing = plan->memory_without_aliasing,
    };
    rg_plan_destroy(plan);
    return true;
}

static bool count_allocations(struct bench *b, struct measure_sharing *result)
{
    void *memory = malloc(result->arena_size);
    if (!memory)
        return false;
    b->tables.params.memory = memory;
    b->tables.params.memory_size = result->arena_size;
    uint64_t before = allocations_count();
    struct rg_plan *plan = compile(&b->tables.params);
    bool done = plan;
    result->allocation_count = allocations_count() - before;
    rg_plan_destroy(plan);
    free(memory);
    b->tables.params.memory = NULL;
    return done;
}

/* The results besides times, and memory for any of the plans. */
static bool prepare(struct bench *b, struct measure_graph *result)
{
    size_t size = 0;
    if (result->shape == MEASURE_COMPUTE && !synthetic_memory(&b->graph, &result->memory))
        return false;
    result->live_count = b->graph.live_count;
    yardstick_declare(&b->yardstick, &b->graph);
    result->fewest_batch_count = yardstick_compile(&b->yardstick).fewest_batch_count;
    synthetic_tables_fill(&b->tables, &b->graph);
    for (uint32_t i = 0; i < MEASURE_SHARING_COUNT; i++) {
        struct measure_sharing *sharing = &result->sharing[i];
        if (!describe(b, sharing, (enum rg_sharing)i) || !count_allocations(b, sharing))
            return false;
        size = sharing->arena_size > size ? sharing->arena_size : size;
    }
    b->memory = malloc(size);
    b->memory_size = size;
    return b->memory;
}

/* ---- times ---- */

static bool run_yardstick(struct bench *b, double times[3])
{
    times[0] = now();
    yardstick_declare(&b->yardstick, &b->graph);
    times[1] = now();
    yardstick_compile(&b->yardstick);
    times[2] = now();
    return true;
}

static bool run_rg(struct bench *b, enum rg_sharing sharing, double times[3])
{
    times[0] = now();
    synthetic_tables_fill(&b->tables, &b->graph);
    times[1] = now();
    b->tables.params.sharing = sharing;
    b->tables.params.memory = b->memory;
    b->tables.params.memory_size = b->memory_size;
    struct rg_plan *plan = rg_compile(&b->tables.params);
    bool done = plan;
    rg_plan_destroy(plan);
    times[2] = now();
    return done;
}

static bool time_subject(struct bench *b, uint32_t subject, uint32_t repetition)
{
    double times[3];
    if (subject == YARDSTICK ? !run_yardstick(b, times)
                             : !run_rg(b, (enum rg_sharing)subject, times))
        return false;
    keep_sample(&b->samples[subject], repetition, times);
    return true;
}

static bool time_in_turn(struct bench *b, uint32_t repetitions)
{
    bool done = true;
    for (uint32_t k = 0; k < repetitions; k++) {
        for (uint32_t i = 0; i < SUBJECT_COUNT; i++)
            done = done && time_subject(b, i, k);
    }
    return done;
}

static bool time_in_a_row(struct bench *b, uint32_t repetitions)
{
    bool done = true;
    for (uint32_t k = 0; k < repetitions; k += ROW_COUNTED) {
        for (uint32_t i = 0; i < SUBJECT_COUNT; i++) {
            for (uint32_t run = 0; run < ROW; run++) {
                uint32_t index = k + run % ROW_COUNTED; /* what does not count is overwritten */
                done = done && time_subject(b, i, index < repetitions ? index : k);
            }
        }
    }
    return done;
}

static bool time_all(struct bench *b, struct measure_graph *result)
{
    uint32_t count = result->repetitions;
    for (uint32_t order = 0; count && order < MEASURE_ORDER_COUNT; order++) {
        if (order == MEASURE_IN_TURN ? !time_in_turn(b, count) : !time_in_a_row(b, count))
            return false;
        result->yardstick[order] = summarise_samples(&b->samples[YARDSTICK], count);
        for (uint32_t i = 0; i < MEASURE_SHARING_COUNT; i++)
            result->sharing[i].times[order] = summarise_samples(&b->samples[i], count);
    }
    return true;
}

static bool init_graph(struct synthetic *graph, enum measure_shape shape, uint32_t pass_count,
                       uint64_t seed)
{
    return shape == MEASURE_FRAME ? synthetic_frame_init(graph, pass_count)
                                  : synthetic_init(graph, pass_count, seed);
}

static bool bench_init(struct bench *b, enum measure_shape shape, uint32_t pass_count,
                       uint64_t seed, uint32_t repetitions)
{
    *b = (struct bench){ 0 };
    if (!init_graph(&b->graph, shape, pass_count, seed) ||
        !synthetic_tables_init(&b->tables, &b->graph) || !yardstick_init(&b->yardstick, &b->graph))
        return false;
    double *values = calloc(repetitions ? repetitions : 1, sizeof(double[SUBJECT_COUNT][3]));
    b->samples[0].setup = values;
    for (uint32_t i = 0; values && i < SUBJECT_COUNT; i++) {
        b->samples[i].setup = values;
        b->samples[i].compile = values + repetitions;
        b->samples[i].total = values + 2 * (size_t)repetitions;
        values += 3 * (size_t)repetitions;
    }
    return values;
}

static void bench_finish(struct bench *b)
{
    free(b->memory);
    free(b->samples[0].setup);
    yardstick_finish(&b->yardstick);
    synthetic_tables_finish(&b->tables);
    synthetic_finish(&b->graph);
}

bool measure_graph(struct measure_graph *result, enum measure_shape shape, uint32_t pass_count,
                   uint32_t repetitions)
{
    struct bench bench;
    *result = (struct measure_graph){ shape, pass_count, repetitions };
    bool done = bench_init(&bench, shape, pass_count, MEASURE_SEED, repetitions) &&
                prepare(&bench, result) && time_all(&bench, result);
    if (!done)
        fprintf(stderr, "%u passes could not be measured\n", pass_count);
    bench_finish(&bench);
    return done;
}

/* ---- packing ---- */

static void add_ratio(struct measure_ratio *ratio, uint64_t used, uint64_t least)
{
    double value = measure_divide(used, least);
    ratio->mean += value / (LAST_SEED - FIRST_SEED + 1);
    if (value > ratio->worst)
        ratio->worst = value;
}

static bool add_packing(struct bench *b, struct measure_packing *result)
{
    synthetic_tables_fill(&b->tables, &b->graph);
    for (uint32_t i = 0; i < MEASURE_SHARING_COUNT; i++) {
        struct measure_sharing plan;
        if (!describe(b, &plan, (enum rg_sharing)i))
            return false;
        add_ratio(&result->sharing[i].used_to_bound, plan.memory_used, plan.memory_bound);
        add_ratio(&result->sharing[i].used_to_least, plan.memory_used, plan.memory_least);
    }
    return true;
}

bool measure_packing(struct measure_packing *result, uint32_t pass_count)
{
    bool done = true;
    *result = (struct measure_packing){
        .pass_count = pass_count,
        .graph_count = LAST_SEED - FIRST_SEED + 1,
    };
    for (uint64_t seed = FIRST_SEED; done && seed <= LAST_SEED; seed++) {
        struct bench bench;
        done =
            bench_init(&bench, MEASURE_COMPUTE, pass_count, seed, 0) && add_packing(&bench, result);
        bench_finish(&bench);
    }
    if (!done)
        fprintf(stderr, "%u passes could not be packed\n", pass_count);
    return done;
}

double measure_divide(uint64_t a, uint64_t b)
{
    return b ? (double)a / (double)b : 0;
}
