/* ui_pass_times.c: running means and history of pass times, and their panel. */
#include "src/view/panels/ui_pass_times.h"
#include <math.h>
#include <stdio.h>
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
    times->frames[times->frame_count++ % UI_PASS_TIMES_FRAME_COUNT] =
        (float)ui_pass_times_sum(times);
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

static double longest(const struct ui_pass_times *times)
{
    double most = 1e-9;
    for (uint32_t r = 0; r < times->row_count; r++)
        most = times->rows[r].milliseconds > most ? times->rows[r].milliseconds : most;
    return most;
}

static void bar(const struct ui_pass_times_row *row, double most)
{
    const float width = imgui_available_width();
    struct imgui_rect area = imgui_reserve(width, imgui_line_height());
    char text[128];
    area.width *= (float)(row->milliseconds / most);
    imgui_rectangle(area, imgui_rgba(imgui_theme()->pressed));
    if (row->repetition_count > 1)
        snprintf(text, sizeof(text), "%s, %u times", row->name, row->repetition_count);
    else
        snprintf(text, sizeof(text), "%s", row->name);
    imgui_same_line(8.0f * imgui_scale());
    imgui_text_elided(text, width - 68.0f * imgui_scale());
    snprintf(text, sizeof(text), "%7.2f", row->milliseconds);
    imgui_same_line(width - 52.0f * imgui_scale());
    imgui_text(text);
}

/* Draws the recorded frames as bars. The newest is at the right edge. The top is limited to 3 times
 * the mean, because shader compilation can make a single frame extremely long. */
static void strip(const struct ui_pass_times *times)
{
    char text[96];
    float most = 0.0f;
    for (uint32_t f = 0; f < UI_PASS_TIMES_FRAME_COUNT; f++)
        most = fmaxf(most, times->frames[f]);
    imgui_histogram("##frames", times->frames, UI_PASS_TIMES_FRAME_COUNT,
                    times->frame_count % UI_PASS_TIMES_FRAME_COUNT,
                    fminf(most, 3.0f * (float)ui_pass_times_sum(times)),
                    strip_height * imgui_scale());
    snprintf(text, sizeof(text), "the last %u frames, up to %.1f ms", UI_PASS_TIMES_FRAME_COUNT,
             (double)most);
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
