/* ui_times.c: running means of the passes' times. */
#include "src/view/ui/ui_times.h"
#include <stdio.h>
#include <string.h>
#include "src/view/ui/imgui.h"

static const double share = 0.15; /* of the newest frame in the mean */

static bool is_same_row(const struct rg_plan *plan, uint32_t p)
{
    return p > 0 && plan->passes[p].pass == plan->passes[p - 1].pass;
}

static double milliseconds(const struct rg_pass_time *time)
{
    return (double)(time->end - time->begin) * 1e-6;
}

void ui_times_add(struct ui_times *times, const struct rg_plan *plan, const struct rg_times *frame)
{
    struct ui_times new = { .row_count = 0 };
    if (!frame->passes || frame->pass_count != plan->pass_count)
        return;
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        if (!is_same_row(plan, p)) {
            if (new.row_count == UI_TIMES_ROW_COUNT)
                break;
            snprintf(new.rows[new.row_count++].name, sizeof(new.rows->name), "%s",
                     plan->passes[p].pass->name);
        }
        struct ui_times_row *row = &new.rows[new.row_count - 1];
        row->repetition_count++;
        row->milliseconds += milliseconds(&frame->passes[p]);
    }
    for (uint32_t r = 0; r < new.row_count; r++) {
        const struct ui_times_row *old = &times->rows[r];
        struct ui_times_row *row = &new.rows[r];
        if (new.row_count == times->row_count && !strcmp(old->name, row->name))
            row->milliseconds = old->milliseconds + share * (row->milliseconds - old->milliseconds);
    }
    *times = new;
}

double ui_times_sum(const struct ui_times *times)
{
    double sum = 0.0;
    for (uint32_t r = 0; r < times->row_count; r++)
        sum += times->rows[r].milliseconds;
    return sum;
}

static double longest(const struct ui_times *times)
{
    double most = 1e-9;
    for (uint32_t r = 0; r < times->row_count; r++)
        most = times->rows[r].milliseconds > most ? times->rows[r].milliseconds : most;
    return most;
}

static void bar(const struct ui_times_row *row, double most)
{
    const float width = imgui_room();
    struct imgui_place place = imgui_canvas(width, imgui_line_height());
    char text[128];
    place.width *= (float)(row->milliseconds / most);
    imgui_rectangle(place, imgui_rgba(imgui_theme()->pressed));
    if (row->repetition_count > 1)
        snprintf(text, sizeof(text), "%s, %u times", row->name, row->repetition_count);
    else
        snprintf(text, sizeof(text), "%s", row->name);
    imgui_same_line(12.0f * imgui_scale());
    imgui_text_cut(text, width - 66.0f * imgui_scale());
    snprintf(text, sizeof(text), "%7.2f", row->milliseconds);
    imgui_same_line(width - 45.0f * imgui_scale());
    imgui_text(text);
}

void ui_times_panel(const char *what, const struct ui_times *times)
{
    char text[96];
    if (!times->row_count) {
        imgui_text_dim("this device has no timestamps");
        return;
    }
    snprintf(text, sizeof(text), "%s: %.2f ms", what, ui_times_sum(times));
    imgui_text_dim(text);
    imgui_tip("time on the device, as running means");
    for (uint32_t r = 0; r < times->row_count; r++)
        bar(&times->rows[r], longest(times));
}
