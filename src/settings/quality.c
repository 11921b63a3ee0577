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
    [DRAFT] = { "draft", "coarse surroundings, treated as infinitely distant, and few reflections",
                1 },
    [NORMAL] = { "normal", "default values of all settings", 1 },
    [HIGH] = { "high", "5 samples per pixel, all internal reflections, ray-traced soft shadows", 5,
               true },
};

const struct quality_row quality_rows[] = {
    { "env_cube.size", { [DRAFT] = "256" } },
    { "texture.anisotropy", { [DRAFT] = "1", [HIGH] = "16" } },
    { "refract.lookup", { [DRAFT] = "infinite" } },
    { "refract.steps", { [HIGH] = "12" } },
    { "refract_bounce.exits", { [DRAFT] = "1" } },
    { "refract_bounce.inclusions", { [DRAFT] = "off", [HIGH] = "all" } },
    { "air.steps", { [DRAFT] = "0", [HIGH] = "8" } },
    { "ssr.steps", { [DRAFT] = "0", [HIGH] = "16" } },
    { "trace.min_branch", { [DRAFT] = "0.1", [HIGH] = "0.005" } },
    { "trace.footprint", { [HIGH] = "on" } },
    { "ground.light", { [HIGH] = "traced" } },
    { "ground.denoise", { [HIGH] = "on" } },
    { "tonemap.dither", { [HIGH] = "on" } },
    { "reference.photons", { [DRAFT] = "200000", [HIGH] = "4000000" } },
    { 0 },
};

void quality_apply_row(struct settings *settings, const struct quality_row *row, uint32_t level)
{
    const struct settings defaults = settings_default();
    const struct setting *setting = settings_find(row->setting);
    char assignment[64];
    settings_set_value(settings, setting, settings_get(&defaults, setting));
    if (!row->values[level])
        return;
    snprintf(assignment, sizeof(assignment), "%s=%s", row->setting, row->values[level]);
    const enum status status = settings_set(settings, assignment);
    assert(status == STATUS_OK);
    (void)status;
}

uint32_t quality_find(const struct settings *settings)
{
    for (uint32_t level = 0; level < QUALITY_COUNT; level++) {
        struct settings applied = *settings;
        for (const struct quality_row *row = quality_rows; row->setting; row++)
            quality_apply_row(&applied, row, level);
        if (!memcmp(&applied, settings, sizeof(applied)))
            return level;
    }
    return QUALITY_COUNT;
}
