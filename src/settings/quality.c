/* quality.c: table of the quality levels draft, normal and high. */
#include "src/settings/quality.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

enum {
    DRAFT,
    NORMAL,
    HIGH,
};

const struct quality qualities[QUALITY_COUNT] = {
    [DRAFT] = { "draft", "coarse surroundings and few reflections", 1 },
    [NORMAL] = { "normal", "default values of all settings", 1 },
    [HIGH] = { "high", "4 samples per pixel, all internal reflections, ray-traced soft shadows", 4,
               true },
};

const struct quality_row quality_rows[] = {
    { "env_cube.size", { [DRAFT] = "256" } },
    { "texture.anisotropy", { [DRAFT] = "1", [HIGH] = "16" } },
    { "refract.steps", { [HIGH] = "12" } },
    { "refract_bounce.exits", { [DRAFT] = "1" } },
    { "air.steps", { [DRAFT] = "2", [HIGH] = "8" } },
    { "ssr.steps", { [DRAFT] = "4", [HIGH] = "16" } },
    { "trace.min_branch", { [DRAFT] = "0.1" } },
    { "trace.footprint", { [HIGH] = "on" } },
    { "ground.light", { [HIGH] = "traced" } },
    { "ground.denoise", { [HIGH] = "on" } },
    { "tonemap.dither", { [HIGH] = "on" } },
    { "tonemap.resolve", { [HIGH] = "filtered" } },
    { "reference.photons", { [DRAFT] = "200000", [HIGH] = "4000000" } },
    { 0 },
};

double quality_value(const struct quality_row *row, uint32_t level)
{
    const struct setting *setting = settings_find(row->setting);
    struct settings settings = settings_default();
    char assignment[64];
    snprintf(assignment, sizeof(assignment), "%s=%s", row->setting,
             row->values[level] ? row->values[level] : "");
    const enum status status = row->values[level]
                                   ? settings_assign(&settings, assignment, SETTING_QUALITY, NULL)
                                   : STATUS_OK;
    assert(status == STATUS_OK);
    (void)status;
    return settings_get(&settings, setting);
}

static bool has_value(const struct settings *settings, const struct quality_row *row,
                      uint32_t level)
{
    const double a = settings_get(settings, settings_find(row->setting));
    const double b = quality_value(row, level);
    return !(a < b || a > b);
}

bool quality_is_of_level(const struct settings *settings, const struct quality_row *row)
{
    uint32_t level = 0;
    while (level < QUALITY_COUNT && !has_value(settings, row, level))
        level++;
    return level < QUALITY_COUNT;
}

void quality_apply(struct settings *settings, uint32_t level, enum setting_source source)
{
    for (const struct quality_row *row = quality_rows; row->setting; row++)
        settings_put(settings, settings_find(row->setting), quality_value(row, level), source);
}

uint32_t quality_find(const struct settings *settings)
{
    uint32_t level = 0;
    for (const struct quality_row *row = quality_rows; row->setting && level < QUALITY_COUNT;) {
        const bool is_equal = has_value(settings, row, level);
        level += !is_equal;
        row = is_equal ? row + 1 : quality_rows;
    }
    return level;
}

uint32_t quality_nearest(const struct settings *settings)
{
    uint32_t counts[QUALITY_COUNT] = { 0 };
    uint32_t nearest = NORMAL;
    for (uint32_t level = 0; level < QUALITY_COUNT; level++) {
        for (const struct quality_row *row = quality_rows; row->setting; row++)
            counts[level] += has_value(settings, row, level);
    }
    for (uint32_t level = 0; level < QUALITY_COUNT; level++)
        nearest = counts[level] > counts[nearest] ? level : nearest;
    return nearest;
}
