/* view_frame_stats.c: statistics of frame times and input latency. */
#include "src/view/view_frame_stats.h"
#include <math.h>
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/gpu/gpu_swapchain.h"

void view_frame_stats_exclude(struct view_frame_stats *c, double start)
{
    c->idle += clock_seconds() - start;
}

void view_frame_stats_pause(struct view_frame_stats *c)
{
    c->last_end = 0.0;
}

static double passes_of(const struct rg_times *times)
{
    uint64_t end = 0;
    for (uint32_t i = 0; i < times->pass_count && times->passes; i++)
        end = times->passes[i].end > end ? times->passes[i].end : end;
    return (double)end * 1e-9;
}

void view_frame_stats_end(struct view_frame_stats *c, const struct rg_times *times,
                          uint32_t time_count, double presentation)
{
    const double end = clock_seconds();
    const double whole = end - c->last_end - c->idle;
    double passes = 0.0;
    bool is_measured = true;
    double slots = 0.0; /* seconds the host waited for an earlier frame's GPU work */
    for (uint32_t i = 0; i < time_count; i++) {
        passes += passes_of(&times[i]);
        slots += (double)times[i].begin * 1e-9;
        is_measured = is_measured && passes_of(&times[i]) > 0.0;
    }
    /* the first frames are not counted, because GPU times arrive some frames later */
    const bool counts = c->last_end > 0.0 && c->frame_count >= 2 * GPU_SWAPCHAIN_SLOT_COUNT;
    c->last = (struct ui_frame_pacing){
        .frame = counts ? whole : 0.0,
        .device = is_measured ? fmax(passes, slots) : -1.0,
        .screen = presentation,
    };
    if (counts) {
        c->summed_count++;
        c->frames += whole;
        c->passes += passes;
        c->host += whole - slots - presentation; /* `slots` belongs to an earlier frame */
    }
    c->frame_count++;
    c->idle = 0.0;
    c->last_end = end;
}

static void add(struct view_time_ring *times, double seconds)
{
    times->values[times->count++ % VIEW_TIME_COUNT] = (float)seconds;
}

void view_frame_stats_input(struct view_frame_stats *c, double moved, double released)
{
    if (moved > 0.0 && !(c->dragged_at > 0.0))
        c->dragged_at = moved;
    if (released > 0.0)
        c->released_at = c->ended_at = released;
}

void view_frame_stats_image(struct view_frame_stats *c, bool is_moving)
{
    if (is_moving && c->last.frame > 0.0)
        add(&c->interactive_frames, c->last.frame);
    if (is_moving && c->dragged_at > 0.0)
        add(&c->drag_latency, c->last_end - c->dragged_at);
    if (!is_moving && c->released_at > 0.0)
        add(&c->release_latency, c->last_end - c->released_at);
    c->dragged_at = 0.0;
    c->released_at = is_moving ? c->released_at : 0.0;
}

void view_frame_stats_sample(struct view_frame_stats *c)
{
    if (c->ended_at > 0.0)
        add(&c->complete_latency, c->last_end - c->ended_at);
    c->ended_at = 0.0;
}

void view_frame_stats_poll(struct view_frame_stats *c, bool refines)
{
    const double cpu = clock_cpu_seconds();
    const double spent = cpu - c->polled_cpu;
    if (refines && c->polled_cpu > 0.0) {
        add(&c->stretches, spent);
        c->longest = fmax(c->longest, spent);
    }
    c->polled_cpu = cpu;
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Returns a quantile of the recorded times, in milliseconds. For the median, `fraction` is 0.5. */
static double quantile(const struct view_time_ring *times, double fraction)
{
    struct view_time_ring sorted = *times;
    const uint32_t count = times->count < VIEW_TIME_COUNT ? times->count : VIEW_TIME_COUNT;
    qsort(sorted.values, count, sizeof(sorted.values[0]), compare);
    return count ? (double)sorted.values[(uint32_t)(fraction * (count - 1) + 0.5)] * 1e3 : 0.0;
}

static void print_moving(const struct view_frame_stats *c, FILE *out)
{
    if (!c->interactive_frames.count || !c->drag_latency.count)
        return;
    fprintf(out,
            "moving: %u images, median %.1f ms, 95 %% %.1f ms; input to image %.1f ms, 95 %% "
            "%.1f ms; full size after %.0f ms, a sample after %.0f ms\n",
            c->interactive_frames.count, quantile(&c->interactive_frames, 0.5),
            quantile(&c->interactive_frames, 0.95), quantile(&c->drag_latency, 0.5),
            quantile(&c->drag_latency, 0.95), quantile(&c->release_latency, 0.5),
            quantile(&c->complete_latency, 0.5));
}

static void print_refining(const struct view_frame_stats *c, FILE *out)
{
    if (!c->stretches.count)
        return;
    fprintf(out,
            "refining: input polled %u times, CPU time of all threads between polls: median "
            "%.1f ms, 95 %% %.1f ms, at most %.1f ms\n",
            c->stretches.count, quantile(&c->stretches, 0.5), quantile(&c->stretches, 0.95),
            c->longest * 1e3);
}

void view_frame_stats_print(const struct view_frame_stats *c, FILE *out)
{
    const double scale = c->summed_count ? 1e3 / c->summed_count : 0.0;
    if (!c->summed_count) {
        fprintf(out, "%u frame%s\n", c->frame_count, c->frame_count == 1 ? "" : "s");
        print_refining(c, out);
        return;
    }
    const double host = fmax(c->host, 0.0);
    const double beside = fmax(c->frames - c->passes - host, 0.0);
    fprintf(out,
            "%u frames, %.2f ms each: %.2f ms passes, %.2f ms frame loop, %.2f ms presentation\n",
            c->frame_count, c->frames * scale, c->passes * scale, host * scale, beside * scale);
    print_moving(c, out);
    print_refining(c, out);
}
