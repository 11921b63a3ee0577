/* ui_settings.c: draws settings as widgets, with reset buttons, and searches them. */
#include "src/view/panels/ui_settings.h"
#include <ctype.h>
#include <math.h>
#include <string.h>
#include <strings.h>
#include "src/view/panels/imgui.h"

enum {
    ROWS_FIRST = 8, /* rows shown per group before "more" */
    LABEL_SIZE = 64,
};

static const double wide = 50.0;    /* a slider is logarithmic if max - min > wide * default */
static const double too_wide = 1e4; /* maximum integer range of a slider */
static const float label_fraction = 0.49f; /* widget start / row width */
static const float narrow = 200.0f;        /* below this width, widgets are below their labels */

/* Unit symbols. Widgets show these, because unit names would be wider than the numbers. */
static const struct {
    const char *name, *sign;
} units[] = {
    { "degrees", "\xc2\xb0" },
    { "degrees per second", "\xc2\xb0/s" },
    { "radians per second", "rad/s" },
    { "metres", "m" },
    { "1/metre", "1/m" },
    { "seconds", "s" },
    { "half widths per second", "half widths/s" },
};

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

static void reset(const struct ui_settings *settings, const struct setting *row)
{
    settings_set_value(settings->current, row, settings_get(settings->defaults, row));
}

static bool is_scene_value(const struct ui_settings *settings, const struct setting *row)
{
    struct settings unchanged = *settings->current;
    reset(&(struct ui_settings){ &unchanged, settings->defaults, settings->scene }, row);
    return settings_equal(&unchanged, settings->current);
}

static const char *sign_of(const char *unit)
{
    for (size_t i = 0; i < sizeof(units) / sizeof(units[0]) && unit; i++) {
        if (!strcmp(units[i].name, unit))
            return units[i].sign;
    }
    return unit ? unit : "";
}

static bool slider(const char *label, const struct setting *row, float *value, bool logarithmic)
{
    char format[64];
    const char *unit = sign_of(row->unit);
    snprintf(format, sizeof(format), "%%.4g%s%s", isalnum((unsigned char)*unit) ? " " : "", unit);
    const double low = row->has_auto ? row->min - 0.05 * (row->max - row->min) : row->min;
    const struct imgui_slider_range slide = { (float)low, (float)row->max,
                                              setting_is_auto(row, (double)*value) ? "auto"
                                                                                   : format,
                                              logarithmic };
    return imgui_slider(label, value, &slide);
}

static bool count_slider(const char *label, const struct setting *row, uint32_t *value,
                         bool logarithmic)
{
    const struct imgui_slider_range slide = { row->has_auto ? 0.0f : (float)row->min,
                                              (float)row->max,
                                              row->has_auto && *value == 0 ? "auto" : "%u",
                                              logarithmic };
    return imgui_count_slider(label, value, &slide);
}

static uint32_t choice_count(const struct setting *row)
{
    uint32_t count = 0;
    while (row->choices[count])
        count++;
    return count;
}

/* Draws the widget of a setting. Returns true if the user has set *value to another valid value. */
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
        changed = imgui_combo(label, row->choice_labels ? row->choice_labels : row->choices,
                              choice_count(row), &count);
        break;
    case UI_NUMBER:
        changed = imgui_number_field(label, &count);
        break;
    case UI_SLIDER:
    case UI_LOGARITHMIC:
        changed = row->type == SETTING_COUNT
                      ? count_slider(label, row, &count, kind == UI_LOGARITHMIC)
                      : slider(label, row, &number, kind == UI_LOGARITHMIC);
        break;
    }
    const double moved = row->type == SETTING_FLOAT ? (double)number : count;
    *value =
        setting_is_auto(row, moved) ? setting_auto(row) : fmin(fmax(moved, row->min), row->max);
    return changed;
}

static void describe(const struct setting *row, char *text, size_t size)
{
    static const char *const effects[] = {
        [SETTING_AFFECTS_NOTHING] = "",
        [SETTING_AFFECTS_FRAME] = "",
        [SETTING_AFFECTS_PLAN] = "\nRecompiles the plan.",
        [SETTING_AFFECTS_SCENE] = "\nRebuilds the scene.",
    };
    const char *unit = row->unit ? row->unit : "";
    if (row->has_auto)
        snprintf(text, size, "%s: %s\n%g to %g%s%s, default auto%s", row->name, row->help, row->min,
                 row->max, *unit ? " " : "", unit, effects[row->affects]);
    else if (row->type == SETTING_FLOAT || row->type == SETTING_COUNT)
        snprintf(text, size, "%s: %s\n%g to %g%s%s, default %g%s", row->name, row->help, row->min,
                 row->max, *unit ? " " : "", unit, row->initial, effects[row->affects]);
    else
        snprintf(text, size, "%s: %s%s", row->name, row->help, effects[row->affects]);
}

/* Draws a setting's label on the left of a widget that starts at `x`. Marks changed settings. */
static void head(const struct setting *row, bool changed, float x)
{
    const struct theme *theme = imgui_theme();
    struct imgui_rect mark = imgui_cursor();
    const float scale = imgui_scale();
    mark.width = 3.0f * scale;
    mark.height = imgui_row_height();
    if (changed)
        imgui_rectangle(mark, imgui_rgba(theme->changed));
    imgui_indent(8.0f * scale);
    imgui_align();
    const bool is_narrow = imgui_available_width() < narrow * scale;
    imgui_text_elided(row->label, is_narrow ? imgui_available_width() : x - 14.0f * scale);
    char text[400];
    describe(row, text, sizeof(text));
    imgui_tooltip(text);
    if (is_narrow)
        imgui_indent(8.0f * scale);
    else
        imgui_same_line(x);
}

bool ui_settings_row(const struct ui_settings *settings, const struct setting *row)
{
    const double before = settings_get(settings->current, row);
    const bool unchanged = is_scene_value(settings, row);
    const float button = imgui_width("\xc3\x97");
    const float x = imgui_available_width() * label_fraction;
    double value = before;
    char id[LABEL_SIZE + 16];
    char text[400];
    head(row, !unchanged, x);
    imgui_next_width(imgui_available_width() - button - 6.0f * imgui_scale());
    snprintf(id, sizeof(id), "##%s", row->name);
    const char *reason = ui_setting_no_effect(row, settings->current, settings->scene);
    imgui_disabled_begin(reason);
    bool changed = widget(row, id, &value);
    imgui_disabled_end();
    describe(row, text, sizeof(text));
    imgui_tooltip(reason ? reason : text);
    if (changed)
        settings_set_value(settings->current, row, value);
    if (!unchanged) {
        imgui_same_line(0.0f);
        snprintf(id, sizeof(id), "\xc3\x97##reset %s", row->name);
        if (imgui_button(id)) {
            reset(settings, row);
            changed = true;
        }
        const double usually = settings_get(settings->defaults, row);
        if (setting_is_auto(row, usually))
            snprintf(text, sizeof(text), "reset %s to auto", row->label);
        else
            snprintf(text, sizeof(text), "reset %s to %g", row->label, usually);
        imgui_tooltip(row->type == SETTING_CHOICE ? "reset to the scene's value" : text);
    }
    return changed;
}

static bool contains_word(const char *text, const char *word, size_t length, bool at_start)
{
    for (const char *at = text; *at; at++) {
        const bool inside = at > text && isalnum((unsigned char)at[-1]);
        if (!strncasecmp(at, word, length) && !(at_start && inside))
            return true;
    }
    return false;
}

bool ui_settings_contain(const char *const *texts, size_t count, const char *query, bool at_start)
{
    for (query += strspn(query, " "); *query; query += strspn(query, " ")) {
        const size_t length = strcspn(query, " ");
        size_t i = 0;
        while (i < count && !contains_word(texts[i], query, length, at_start))
            i++;
        if (i == count)
            return false;
        query += length;
    }
    return true;
}

bool ui_settings_match(const struct setting *row, const char *query)
{
    const char *const texts[] = { row->name, row->label, row->help,
                                  ui_setting_groups_name(ui_setting_groups_of(row)) };
    return ui_settings_contain(texts, sizeof(texts) / sizeof(texts[0]), query, false);
}

static bool reset_button(const struct ui_settings *settings, enum ui_setting_group group, float x)
{
    const struct setting *row;
    bool unchanged = true;
    char id[LABEL_SIZE];
    for (uint32_t i = 0; (row = ui_setting_groups_row(group, i)); i++)
        unchanged = unchanged && is_scene_value(settings, row);
    if (unchanged)
        return false;
    imgui_same_line(x);
    snprintf(id, sizeof(id), "\xc3\x97##reset %s", ui_setting_groups_name(group));
    const bool pressed = imgui_small_button(id);
    imgui_tooltip("reset this group to the scene's values");
    for (uint32_t i = 0; pressed && (row = ui_setting_groups_row(group, i)); i++)
        reset(settings, row);
    return pressed;
}

bool ui_settings_heading(const struct ui_settings *settings, enum ui_setting_group group,
                         bool *open)
{
    const float x = imgui_available_width() - imgui_width("\xc3\x97");
    imgui_collapsing_header(ui_setting_groups_name(group), open);
    return reset_button(settings, group, x);
}

bool ui_settings_group(const struct ui_settings *settings, enum ui_setting_group group, bool *more)
{
    const struct setting *row;
    bool changed = false;
    char id[LABEL_SIZE];
    uint32_t i = 0;
    for (; (row = ui_setting_groups_row(group, i)) && (*more || i < ROWS_FIRST); i++)
        changed = ui_settings_row(settings, row) || changed;
    if (!row && !*more)
        return changed;
    snprintf(id, sizeof(id), "%s##%s", *more ? "fewer" : "more ...", ui_setting_groups_name(group));
    if (i >= ROWS_FIRST && imgui_small_button(id))
        *more = !*more;
    return changed;
}

/* Draws the settings whose name or label contains the query or, if not `named`, other matches. */
static uint32_t show_found(const struct ui_settings *settings, const char *query, bool named,
                           bool *changed)
{
    const struct setting *row;
    uint32_t count = 0;
    for (enum ui_setting_group g = UI_OBJECT; g < UI_GROUP_COUNT; g++) {
        for (uint32_t i = 0; (row = ui_setting_groups_row(g, i)); i++) {
            const char *const names[] = { row->name, row->label };
            if (ui_settings_contain(names, 2, query, false) != named ||
                !ui_settings_match(row, query))
                continue;
            *changed = ui_settings_row(settings, row) || *changed;
            count++;
        }
    }
    return count;
}

bool ui_settings_matches(const struct ui_settings *settings, const char *query)
{
    bool changed = false;
    uint32_t count = show_found(settings, query, true, &changed);
    count += show_found(settings, query, false, &changed);
    if (!count)
        imgui_text_dim("no matching setting");
    return changed;
}
