/* ui_pass_times.c: running means and history of pass times, and their panel. */
#include "src/view/panels/ui_pass_times.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/view/panels/imgui.h"

static const double smoothing = 0.15;    /* weight of the newest frame */
static const float strip_height = 64.0f; /* chart height, pixels at scale 1 */

static bool is_same_row(const struct rg_plan *plan, uint32_t p)
{
    return p > 0 && plan->passes[p].pass == plan->passes[p - 1].pass;
}

static double milliseconds(const struct rg_pass_time *time)
{
    return (double)(time->end - time->begin) * 1e-6;
}

uint32_t ui_pass_times_key(const char *name)
{
    uint32_t key = 2166136261u; /* 32-bit FNV-1a hash */
    for (; *name; name++)
        key = (key ^ (unsigned char)*name) * 16777619u;
    return key;
}

/* Reads the pass times of one frame, summed over consecutive repetitions of a pass. */
static void read_rows(struct ui_pass_times *new, const struct rg_plan *plan,
                      const struct rg_times *frame)
{
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        if (!is_same_row(plan, p)) {
            if (new->row_count == UI_PASS_TIMES_ROW_COUNT)
                break;
            snprintf(new->rows[new->row_count++].name, sizeof(new->rows->name), "%s",
                     plan->passes[p].pass->name);
        }
        struct ui_pass_times_row *row = &new->rows[new->row_count - 1];
        row->repetition_count++;
        row->milliseconds += milliseconds(&frame->passes[p]);
    }
}

static void keep_frame(struct ui_pass_times *times)
{
    struct ui_pass_times_frame *f =
        &times->frames[times->frame_count++ % UI_PASS_TIMES_FRAME_COUNT];
    f->row_count = times->row_count;
    for (uint32_t r = 0; r < times->row_count; r++) {
        f->milliseconds[r] = (float)times->rows[r].milliseconds;
        f->keys[r] = ui_pass_times_key(times->rows[r].name);
    }
}

void ui_pass_times_add(struct ui_pass_times *times, const struct rg_plan *plan,
                       const struct rg_times *frame)
{
    struct ui_pass_times_row old[UI_PASS_TIMES_ROW_COUNT];
    const uint32_t old_count = times->row_count;
    if (!frame->passes || frame->pass_count != plan->pass_count ||
        (times->frame_count && frame->start == times->start))
        return;
    memcpy(old, times->rows, sizeof(old));
    memset(times->rows, 0, sizeof(times->rows));
    times->row_count = 0;
    times->start = frame->start;
    read_rows(times, plan, frame);
    keep_frame(times);
    for (uint32_t r = 0; r < times->row_count && times->row_count == old_count; r++) {
        struct ui_pass_times_row *row = &times->rows[r];
        if (!strcmp(old[r].name, row->name))
            row->milliseconds =
                old[r].milliseconds + smoothing * (row->milliseconds - old[r].milliseconds);
    }
}

double ui_pass_times_sum(const struct ui_pass_times *times)
{
    double sum = 0.0;
    for (uint32_t r = 0; r < times->row_count; r++)
        sum += times->rows[r].milliseconds;
    return sum;
}

/* Returns the frame recorded `ago` frames before the newest; NULL if there is none. */
static const struct ui_pass_times_frame *frame_at(const struct ui_pass_times *times, uint32_t ago)
{
    if (ago >= times->frame_count || ago >= UI_PASS_TIMES_FRAME_COUNT)
        return NULL;
    return &times->frames[(times->frame_count - 1 - ago) % UI_PASS_TIMES_FRAME_COUNT];
}

static double sum_of(const struct ui_pass_times_frame *frame)
{
    double sum = 0.0;
    for (uint32_t r = 0; r < frame->row_count; r++)
        sum += (double)frame->milliseconds[r];
    return sum;
}

double ui_pass_times_frame(const struct ui_pass_times *times, uint32_t ago)
{
    const struct ui_pass_times_frame *frame = frame_at(times, ago);
    return frame ? sum_of(frame) : -1.0;
}

static double longest(const struct ui_pass_times *times)
{
    double most = 1e-9;
    for (uint32_t r = 0; r < times->row_count; r++)
        most = times->rows[r].milliseconds > most ? times->rows[r].milliseconds : most;
    return most;
}

/* Returns a colour derived from a pass key, so that most passes differ in colour. */
static uint32_t color_of(uint32_t key)
{
    const float around = (float)(key % 1021u) * (6.0f / 1021.0f);
    const float bright = key >> 16 & 1 ? 220.0f : 170.0f;
    float rgb[3];
    for (size_t c = 0; c < 3; c++) {
        const float at = fabsf(fmodf(around + 2.0f * (float)c, 6.0f) - 3.0f) - 1.0f;
        rgb[c] = bright * (0.35f + 0.65f * fminf(fmaxf(at, 0.0f), 1.0f));
    }
    return IMGUI_RGBA(rgb[0], rgb[1], rgb[2], 255);
}

static void bar(const struct ui_pass_times_row *row, double most)
{
    const float width = imgui_available_width();
    struct imgui_rect area = imgui_reserve(width, imgui_line_height());
    struct imgui_rect sign = area;
    char text[128];
    area.width *= (float)(row->milliseconds / most);
    imgui_rectangle(area, imgui_rgba(imgui_theme()->pressed));
    sign.width = 4.0f * imgui_scale();
    imgui_rectangle(sign, color_of(ui_pass_times_key(row->name)));
    if (row->repetition_count > 1)
        snprintf(text, sizeof(text), "%s, %u times", row->name, row->repetition_count);
    else
        snprintf(text, sizeof(text), "%s", row->name);
    imgui_same_line(14.0f * imgui_scale());
    imgui_text_elided(text, width - 74.0f * imgui_scale());
    snprintf(text, sizeof(text), "%7.2f", row->milliseconds);
    imgui_same_line(width - 52.0f * imgui_scale());
    imgui_text(text);
}

/* Returns the name of a frame's longest pass, or a note if the current plan lacks that pass. */
static const char *name_longest(const struct ui_pass_times *times,
                                const struct ui_pass_times_frame *frame)
{
    uint32_t at = 0;
    for (uint32_t r = 1; r < frame->row_count; r++)
        at = frame->milliseconds[r] > frame->milliseconds[at] ? r : at;
    for (uint32_t r = 0; r < times->row_count; r++) {
        if (frame->row_count && ui_pass_times_key(times->rows[r].name) == frame->keys[at])
            return times->rows[r].name;
    }
    return "a pass of a previous plan";
}

/* Draws the pass times of one recorded frame as a stacked column, clipped at the top. */
static void draw_column(const struct ui_pass_times *times, uint32_t ago, struct imgui_rect whole,
                        float scale)
{
    const struct ui_pass_times_frame *frame = frame_at(times, ago);
    struct imgui_rect part = whole;
    char text[160];
    part.y += part.height;
    for (uint32_t r = 0; r < frame->row_count; r++) {
        part.height = fminf(frame->milliseconds[r] * scale, part.y - whole.y);
        part.y -= part.height;
        imgui_rectangle(part, color_of(frame->keys[r]));
    }
    if (!imgui_is_hovered(whole))
        return;
    imgui_rectangle(whole, IMGUI_RGBA(255, 255, 255, 60));
    snprintf(text, sizeof(text), "%u frame%s ago: %.2f ms\nlongest pass: %s", ago,
             ago == 1 ? "" : "s", sum_of(frame), name_longest(times, frame));
    imgui_cursor_tooltip(text);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Returns the time at the top of the chart, milliseconds. This is the longest frame time, limited
 * to 3 times the median, because shader compilation can make a single frame extremely long. */
static double height_of(const struct ui_pass_times *times, uint32_t count, double most)
{
    double sums[UI_PASS_TIMES_FRAME_COUNT];
    for (uint32_t ago = 0; ago < count; ago++)
        sums[ago] = ui_pass_times_frame(times, ago);
    qsort(sums, count, sizeof(sums[0]), compare);
    return fmin(most, 3.0 * sums[count / 2] + 1e-9);
}

/* Draws the recorded frames as columns; the newest is at the right edge. */
static void strip(const struct ui_pass_times *times)
{
    const struct imgui_rect all =
        imgui_reserve(imgui_available_width(), strip_height * imgui_scale());
    const float step = all.width / UI_PASS_TIMES_FRAME_COUNT;
    double most = 1e-9;
    char text[96];
    uint32_t count = 0;
    for (; frame_at(times, count); count++)
        most = fmax(most, ui_pass_times_frame(times, count));
    const double high = height_of(times, count, most);
    imgui_rectangle(all, imgui_rgba(imgui_theme()->raised));
    for (uint32_t ago = 0; ago < count; ago++)
        draw_column(times, ago,
                    (struct imgui_rect){ all.x + all.width - (float)(ago + 1) * step, all.y, step,
                                         all.height },
                    all.height / (float)high);
    snprintf(text, sizeof(text), "the last %u frame%s, up to %.1f ms", count, count == 1 ? "" : "s",
             most);
    imgui_text_wrapped(text);
}

void ui_pass_times_panel(const char *what, const struct ui_pass_times *times)
{
    char text[96];
    if (!times->row_count) {
        imgui_text_dim("this device does not support timestamps");
        return;
    }
    snprintf(text, sizeof(text), "%s: %.2f ms", what, ui_pass_times_sum(times));
    imgui_text(text);
    imgui_tooltip("device time, running mean");
    strip(times);
    for (uint32_t r = 0; r < times->row_count; r++)
        bar(&times->rows[r], longest(times));
}
