/*
 * bench.c: whether a profile tells a heavy pass from a light one: their ratio in one frame, by
 * every clock, beside the ratio of the two in frames of their own, by the host's clock around them.
 *
 * Fails if the clock that the device's test chooses is more than a tenth off.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "tests/support/assertions.h"

#include "shaders/embedded.h"
#include "shaders/output/timestamp_check.h"
#include "src/lab/profile/timestamp_check.h"
#include "tests/support/run_graph.h"

enum {
    SIDE = 512,
    HEAVY_ROUNDS = 240,
    LIGHT_ROUNDS = 30,
    ROUNDS = 120,
};

static const struct rg_image heavy_image = {
    .name = "heavy_image",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};
static const struct rg_image light_image = {
    .name = "light_image",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};

static void record_heavy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_push(cmd, &(struct timestamp_check_push){ HEAVY_ROUNDS },
                sizeof(struct timestamp_check_push));
    rg_cmd_draw(cmd, 3);
}

static void record_light(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_push(cmd, &(struct timestamp_check_push){ LIGHT_ROUNDS },
                sizeof(struct timestamp_check_push));
    rg_cmd_draw(cmd, 3);
}

#define SCREEN(target, record_function) \
    { \
        .name = #target, .color = RG_TARGETS({ &(target), RG_LOAD_DISCARD }), \
        .vert = &fullscreen_vert, .frag = &timestamp_check_frag, \
        .push_size = sizeof(struct timestamp_check_push), .record = (record_function), \
    }

static const struct rg_pass both[] = {
    SCREEN(heavy_image, record_heavy),
    SCREEN(light_image, record_light),
};

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* A graph of `count` rows from `rows` on. */
static void open_graph(struct run *run, struct gpu *gpu, const struct rg_pass *rows, size_t count)
{
    struct run_params params = {
        .technique = { .name = "bench", .passes = rows, .pass_count = count },
        .view = { SIDE, SIDE },
        .measure = { RG_CLOCK_EXACT, false },
    };
    for (size_t i = 0; i < count; i++)
        params.kept[i] =
            (struct rg_output){ .image = rows[i].color[0].image, .access = RG_SAMPLED };
    run_open(run, gpu, &params);
}

/* The least times of the heavy pass and the light one: nothing disturbed these. */
struct least {
    double heavy, light;
};

/* Both passes in one frame by a clock. */
static void time_passes(struct run *run, enum rg_clock clock, struct least *least)
{
    rg_exec_measure(run->exec, &(struct rg_measure){ clock, false });
    run_frame(run, NULL);
    const struct rg_times times = rg_exec_times(run->exec);
    least->heavy = fmin(least->heavy, 1e-6 * (double)(times.passes[0].end - times.passes[0].begin));
    least->light = fmin(least->light, 1e-6 * (double)(times.passes[1].end - times.passes[1].begin));
}

/* A frame by the host's clock around it. */
static void time_frame(struct run *run, double *least)
{
    rg_exec_measure(run->exec, &(struct rg_measure){ RG_CLOCK_NONE, false });
    const double start = now_ms();
    run_frame(run, NULL);
    *least = fmin(*least, now_ms() - start);
}

static double report(const char *name, struct least times, struct least alone, const char *note)
{
    const double off = times.heavy / times.light / (alone.heavy / alone.light) - 1;
    printf("%-22s %9.3f %9.3f %7.2f %7.1f %%%s\n", name, times.heavy, times.light,
           times.heavy / times.light, 100 * off, note);
    return fabs(off);
}

int main(void)
{
    static const char *const names[RG_CLOCK_COUNT] = {
        [RG_CLOCK_STREAM] = "timestamps alone",
        [RG_CLOCK_EXACT] = "timestamps, barriers",
        [RG_CLOCK_SUBMITS] = "submits",
    };
    struct gpu gpu;
    struct run frame;
    struct run heavy;
    struct run light;
    struct profile_clock chosen;
    struct least alone = { (double)INFINITY, (double)INFINITY };
    struct least times[RG_CLOCK_COUNT] = { alone, alone, alone, alone };
    double off = (double)INFINITY;
    if (gpu_create(&gpu, &(struct gpu_params){ 0 }) != STATUS_OK ||
        timestamp_check_run(&gpu, RG_CLOCK_NONE, &chosen) != STATUS_OK)
        return EXIT_FAILURE;
    open_graph(&frame, &gpu, both, 2);
    open_graph(&heavy, &gpu, &both[0], 1);
    open_graph(&light, &gpu, &both[1], 1);
    for (int i = 0; i < ROUNDS; i++) {
        time_frame(&heavy, &alone.heavy);
        time_frame(&light, &alone.light);
        for (enum rg_clock clock = RG_CLOCK_STREAM; clock < RG_CLOCK_COUNT; clock++) {
            if (rg_exec_has_clock(frame.exec, clock))
                time_passes(&frame, clock, &times[clock]);
        }
    }
    printf("%-22s %9s %9s %7s %7s\n", "least of frames, ms", "heavy", "light", "ratio", "off");
    (void)report("alone, host's clock", alone, alone, "");
    for (enum rg_clock clock = RG_CLOCK_STREAM; clock < RG_CLOCK_COUNT; clock++) {
        const bool is_chosen = clock == chosen.clock;
        if (!rg_exec_has_clock(frame.exec, clock))
            continue;
        const double error = report(names[clock], times[clock], alone, is_chosen ? " <-" : "");
        off = is_chosen ? error : off;
    }
    run_close(&frame);
    run_close(&heavy);
    run_close(&light);
    gpu_destroy(&gpu);
    return off <= 0.1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
