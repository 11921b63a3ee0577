/* report.c: the same numbers for people and for programs. */
#include "tests/bench/graph/report.h"
#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>

#ifdef __OPTIMIZE__
#define IS_OPTIMIZED true
#else
#define IS_OPTIMIZED false
#endif
#ifdef NDEBUG
#define HAS_ASSERTS false
#else
#define HAS_ASSERTS true
#endif

static const struct {
    const char *words, *key;
} sharings[MEASURE_SHARING_COUNT] = {
    [RG_SHARE_FEWEST_BATCHES] = { "fewest batches", "fewest_batches" },
    [RG_SHARE_LEAST_MEMORY] = { "least memory", "least_memory" },
    [RG_SHARE_NOTHING] = { "nothing", "nothing" },
};

static const struct {
    const char *words, *key;
} orders[MEASURE_ORDER_COUNT] = {
    [MEASURE_IN_TURN] = { "in turn", "in_turn" },
    [MEASURE_IN_A_ROW] = { "in a row", "in_a_row" },
};

static const char *const shapes[MEASURE_SHAPE_COUNT] = {
    [MEASURE_COMPUTE] = "compute",
    [MEASURE_FRAME] = "frame",
};

static double ns_per_pass(const struct measure_graph *graph, const struct measure_times *times)
{
    return times->total.median * 1e3 / graph->pass_count;
}

/* ---- tables ---- */

void report_begin(void)
{
    printf(
        "Compiled with%s optimisation, with%s assertions. Microseconds: median (least).\n"
        "ns: of set-up and compiling, a pass; x: of the two, to the yardstick.\n\n"
        "passes shape   runs     shared                 set-up us            compile us        ns"
        "      x\n",
        IS_OPTIMIZED ? "" : "out", HAS_ASSERTS ? "" : "out");
}

static void print_times(const struct measure_graph *graph, const struct measure_times *times,
                        double yardstick)
{
    printf(" %9.2f (%8.2f) %10.2f (%9.2f) %9.1f %6.2f\n", times->setup.median, times->setup.min,
           times->compile.median, times->compile.min, ns_per_pass(graph, times),
           times->total.median / yardstick);
}

void report_times(const struct measure_graph *graph)
{
    for (uint32_t order = 0; order < MEASURE_ORDER_COUNT; order++) {
        double yardstick = graph->yardstick[order].total.median;
        printf("%6.0u %-7s %-8s %-14s", order ? 0 : graph->pass_count,
               order ? "" : shapes[graph->shape], orders[order].words, "(yardstick)");
        print_times(graph, &graph->yardstick[order], yardstick);
        for (uint32_t i = 0; i < MEASURE_SHARING_COUNT; i++) {
            printf("%23s %-14s", "", sharings[i].words);
            print_times(graph, &graph->sharing[i].times[order], yardstick);
        }
    }
    fflush(stdout); /* the longer graphs take a while */
}

static void print_plan(const struct measure_graph *graph, const struct measure_sharing *plan)
{
    printf(" %6u %7u %7.3f %10.3f %10.3f %11.3f %4llu %9llu\n", plan->live_count, plan->batch_count,
           measure_divide(plan->batch_count, graph->fewest_batch_count),
           measure_divide(plan->memory_used, plan->memory_bound),
           measure_divide(plan->memory_used, plan->memory_least),
           measure_divide(plan->memory_without_aliasing, plan->memory_bound),
           (unsigned long long)plan->allocation_count, (unsigned long long)plan->arena_size / 1024);
}

void report_plans(const struct report *report)
{
    puts("\npasses shape   shared           live batches /fewest used/bound used/least alone/bound "
         "heap"
         " arena KiB");
    for (uint32_t i = 0; i < report->graph_count; i++) {
        const struct measure_graph *graph = &report->graphs[i];
        for (uint32_t k = 0; k < MEASURE_SHARING_COUNT; k++) {
            printf("%6.0u %-7s %-14s", k ? 0 : graph->pass_count, k ? "" : shapes[graph->shape],
                   sharings[k].words);
            print_plan(graph, &graph->sharing[k]);
        }
    }
}

void report_packings(const struct report *report)
{
    puts("\npasses shared         graphs  used/bound: mean  worst  used/least: mean  worst");
    for (uint32_t i = 0; i < report->packing_count; i++) {
        const struct measure_packing *packing = &report->packings[i];
        for (uint32_t k = 0; k < RG_SHARE_NOTHING; k++) {
            const struct measure_ratio *bound = &packing->sharing[k].used_to_bound;
            const struct measure_ratio *least = &packing->sharing[k].used_to_least;
            printf("%6.0u %-14s %6u %17.3f %6.3f %17.3f %6.3f\n", k ? 0 : packing->pass_count,
                   sharings[k].words, packing->graph_count, bound->mean, bound->worst, least->mean,
                   least->worst);
        }
    }
}

/* ---- JSON: a NULL passed on makes a NULL of the whole ---- */

static json_t *time_json(const struct measure_time *time)
{
    return json_pack("{s:f, s:f}", "median", time->median, "min", time->min);
}

static json_t *times_json(const struct measure_graph *graph, const struct measure_times *times)
{
    json_t *object = json_object();
    for (uint32_t order = 0; order < MEASURE_ORDER_COUNT; order++) {
        const struct measure_times *t = &times[order];
        json_t *value =
            json_pack("{s:o, s:o, s:o, s:f, s:f}", "setup_us", time_json(&t->setup), "compile_us",
                      time_json(&t->compile), "total_us", time_json(&t->total), "ns_per_pass",
                      ns_per_pass(graph, t), "to_yardstick",
                      t->total.median / graph->yardstick[order].total.median);
        if (json_object_set_new(object, orders[order].key, value)) {
            json_decref(object);
            return NULL;
        }
    }
    return object;
}

static json_t *plan_json(const struct measure_graph *graph, const struct measure_sharing *plan)
{
    return json_pack(
        "{s:o, s:I, s:I, s:I, s:f, s:I, s:I, s:I, s:I, s:f, s:f, s:f, s:I}", "times",
        times_json(graph, plan->times), "allocations", (json_int_t)plan->allocation_count,
        "live_passes", (json_int_t)plan->live_count, "batches", (json_int_t)plan->batch_count,
        "batches_to_fewest", measure_divide(plan->batch_count, graph->fewest_batch_count),
        "memory_used", (json_int_t)plan->memory_used, "memory_bound",
        (json_int_t)plan->memory_bound, "memory_least", (json_int_t)plan->memory_least,
        "memory_without_aliasing", (json_int_t)plan->memory_without_aliasing, "used_to_bound",
        measure_divide(plan->memory_used, plan->memory_bound), "used_to_least",
        measure_divide(plan->memory_used, plan->memory_least), "without_aliasing_to_bound",
        measure_divide(plan->memory_without_aliasing, plan->memory_bound), "arena_size",
        (json_int_t)plan->arena_size);
}

static json_t *graph_json(const struct measure_graph *graph)
{
    json_t *plans = json_object();
    for (uint32_t i = 0; i < MEASURE_SHARING_COUNT; i++) {
        if (json_object_set_new(plans, sharings[i].key, plan_json(graph, &graph->sharing[i]))) {
            json_decref(plans);
            return NULL;
        }
    }
    return json_pack("{s:s, s:I, s:I, s:I, s:I, s:o, s:o}", "shape", shapes[graph->shape], "passes",
                     (json_int_t)graph->pass_count, "seed", (json_int_t)MEASURE_SEED, "repetitions",
                     (json_int_t)graph->repetitions, "fewest_batches",
                     (json_int_t)graph->fewest_batch_count, "yardstick",
                     times_json(graph, graph->yardstick), "shared", plans);
}

static json_t *ratio_json(const struct measure_ratio *ratio)
{
    return json_pack("{s:f, s:f}", "mean", ratio->mean, "worst", ratio->worst);
}

static json_t *packing_json(const struct measure_packing *packing)
{
    json_t *object = json_pack("{s:I, s:I}", "passes", (json_int_t)packing->pass_count, "graphs",
                               (json_int_t)packing->graph_count);
    for (uint32_t i = 0; i < RG_SHARE_NOTHING; i++) {
        json_t *ratios =
            json_pack("{s:o, s:o}", "used_to_bound", ratio_json(&packing->sharing[i].used_to_bound),
                      "used_to_least", ratio_json(&packing->sharing[i].used_to_least));
        if (json_object_set_new(object, sharings[i].key, ratios)) {
            json_decref(object);
            return NULL;
        }
    }
    return object;
}

static json_t *whole_json(const struct report *report)
{
    json_t *graphs = json_array(), *packings = json_array();
    json_t *whole = json_pack("{s:b, s:b, s:o, s:o}", "optimized", IS_OPTIMIZED, "assertions",
                              HAS_ASSERTS, "graphs", graphs, "packing", packings);
    bool failed = !whole;
    for (uint32_t i = 0; !failed && i < report->graph_count; i++)
        failed = json_array_append_new(graphs, graph_json(&report->graphs[i]));
    for (uint32_t i = 0; !failed && i < report->packing_count; i++)
        failed = json_array_append_new(packings, packing_json(&report->packings[i]));
    if (!failed)
        return whole;
    json_decref(whole);
    return NULL;
}

bool report_json(const struct report *report, const char *path)
{
    json_t *whole = whole_json(report);
    bool done = whole && !json_dump_file(whole, path, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    if (!done)
        fprintf(stderr, "%s: %s\n", path, whole ? strerror(errno) : "out of memory");
    json_decref(whole);
    return done;
}
