/* ui_settings.c: rows as widgets. */
#include "src/view/ui/ui_settings.h"
#include <math.h>
#include <string.h>
#include "src/view/ui/imgui.h"

static const double wide = 50.0;    /* a range so many times the initial value, or 1 */
static const double too_wide = 1e4; /* for whole numbers to be found by sliding */

enum ui_widget ui_settings_widget(const struct setting *row)
{
    const double range = row->max - row->min;
    switch (row->type) {
    case SETTING_SWITCH:
        return UI_CHECKBOX;
    case SETTING_CHOICE:
        return UI_LIST;
    case SETTING_COUNT:
        return range > too_wide                          ? UI_NUMBER
               : range > wide * fmax(row->initial, 10.0) ? UI_LOGARITHMIC
                                                         : UI_SLIDER;
    case SETTING_FLOAT:
        break;
    }
    return range > wide * fmax(fabs(row->initial), 1.0) ? UI_LOGARITHMIC : UI_SLIDER;
}

/* ---- a row ---- */

static bool is_initial(const struct settings *settings, const struct setting *row)
{
    struct settings initial = *settings;
    settings_put(&initial, row, row->initial);
    return !memcmp(&initial, settings, sizeof(initial));
}

static const char *short_name(const struct setting *row)
{
    const char *dot = strchr(row->name, '.');
    return dot ? dot + 1 : row->name;
}

static bool slider(const char *label, const struct setting *row, float *value, bool logarithmic)
{
    char format[64];
    const char *unit = row->unit ? row->unit : "";
    snprintf(format, sizeof(format), "%s%s%s", logarithmic ? "%.4g" : "%.3f", *unit ? " " : "",
             unit);
    const struct imgui_slide slide = { (float)row->min, (float)row->max, format, logarithmic };
    return imgui_slider(label, value, &slide);
}

static bool count_slider(const char *label, const struct setting *row, uint32_t *value,
                         bool logarithmic)
{
    const struct imgui_slide slide = { (float)row->min, (float)row->max, "%u", logarithmic };
    return imgui_count_slider(label, value, &slide);
}

static uint32_t choice_count(const struct setting *row)
{
    uint32_t count = 0;
    while (row->choices[count])
        count++;
    return count;
}

/* Whether it was moved; *value is then the new one, in range. */
static bool widget(const struct setting *row, const char *label, double *value)
{
    const enum ui_widget kind = ui_settings_widget(row);
    float number = (float)*value;
    uint32_t count = row->type == SETTING_FLOAT ? 0 : (uint32_t)*value;
    bool on = count != 0;
    bool changed = false;
    switch (kind) {
    case UI_CHECKBOX:
        changed = imgui_checkbox(label, &on);
        count = on;
        break;
    case UI_LIST:
        changed = imgui_list(label, row->choices, choice_count(row), &count);
        break;
    case UI_NUMBER:
        changed = imgui_number(label, &count);
        break;
    case UI_SLIDER:
    case UI_LOGARITHMIC:
        changed = row->type == SETTING_COUNT
                      ? count_slider(label, row, &count, kind == UI_LOGARITHMIC)
                      : slider(label, row, &number, kind == UI_LOGARITHMIC);
        break;
    }
    *value = fmin(fmax(row->type == SETTING_FLOAT ? (double)number : count, row->min), row->max);
    return changed;
}

static void describe(const struct setting *row, char *text, size_t size)
{
    const char *unit = row->unit ? row->unit : "";
    if (row->type == SETTING_FLOAT || row->type == SETTING_COUNT)
        snprintf(text, size, "%s: %s\n%g to %g%s%s, default %g", row->name, row->help, row->min,
                 row->max, *unit ? " " : "", unit, row->initial);
    else
        snprintf(text, size, "%s: %s", row->name, row->help);
}

bool ui_settings_row(struct settings *settings, const struct setting *row, const char *label)
{
    double value = settings_get(settings, row);
    char text[256];
    imgui_id_begin(row);
    imgui_next_width(150.0f * imgui_scale());
    bool changed = widget(row, label, &value);
    describe(row, text, sizeof(text));
    imgui_tip(text);
    if (changed)
        settings_put(settings, row, value);
    if (!is_initial(settings, row)) {
        imgui_same_line(0.0f);
        if (imgui_small_button("reset")) {
            settings_put(settings, row, row->initial);
            changed = true;
        }
    }
    imgui_id_end();
    return changed;
}

/* ---- a group ---- */

static bool is_wanted(const struct setting *row, const char *filter)
{
    return strstr(row->name, filter) != NULL;
}

static bool reset_button(struct settings *settings, const struct setting_group *group, float x)
{
    bool initial = true;
    for (size_t r = 0; r < group->row_count; r++)
        initial = initial && is_initial(settings, &group->rows[r]);
    if (initial)
        return false;
    imgui_same_line(x);
    if (!imgui_small_button("reset all"))
        return false;
    for (size_t r = 0; r < group->row_count; r++)
        settings_put(settings, &group->rows[r], group->rows[r].initial);
    return true;
}

static bool group_panel(struct settings *settings, const struct setting_group *group,
                        const char *filter)
{
    bool any = false;
    for (size_t r = 0; r < group->row_count; r++)
        any = any || is_wanted(&group->rows[r], filter);
    if (!any)
        return false;
    const float x = imgui_room() - 65.0f * imgui_scale();
    imgui_id_begin(group);
    const bool open = imgui_group(group->name, *filter != '\0');
    bool changed = reset_button(settings, group, x);
    for (size_t r = 0; r < group->row_count && open; r++) {
        if (is_wanted(&group->rows[r], filter))
            changed =
                ui_settings_row(settings, &group->rows[r], short_name(&group->rows[r])) || changed;
    }
    imgui_id_end();
    return changed;
}

bool ui_settings_panel(struct settings *settings, const char *filter)
{
    bool changed = false;
    const struct setting_group *group;
    for (size_t g = 0; (group = settings_group(g)); g++)
        changed = group_panel(settings, group, filter) || changed;
    return changed;
}
