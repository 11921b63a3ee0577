/* option_quality.c: the table of levels, and what --quality sets. */
#include "src/app/options/option_quality.h"
#include <stdio.h>
#include "src/app/options/option_values.h"

enum {
    DRAFT,
    NORMAL,
    HIGH,
};

const struct quality qualities[QUALITY_COUNT] = {
    [DRAFT] = { "draft", "coarse surroundings, infinitely far away, and few reflections", 1 },
    [NORMAL] = { "normal", "the defaults of all settings", 1 },
    [HIGH] = { "high", "16 samples, and all reflections inside", 16 },
};

const struct quality_row quality_rows[] = {
    { "env_cube.size", { [DRAFT] = "256" } },
    { "texture.anisotropy", { [DRAFT] = "1", [HIGH] = "16" } },
    { "refract.lookup", { [DRAFT] = "infinite" } },
    { "refract.steps", { [HIGH] = "16" } },
    { "refract_bounce.exits", { [DRAFT] = "1" } },
    { "trace.branch", { [DRAFT] = "0.1", [HIGH] = "0.005" } },
    { "reference.photons", { [DRAFT] = "200000", [HIGH] = "4000000" } },
    { 0 },
};

/* Puts the level's value, or the default, unless a person has set another one. */
static enum status put(struct app_scene *scene, const struct quality_row *row, uint32_t level)
{
    const struct settings defaults = settings_default();
    const struct setting *setting = settings_find(row->setting);
    const size_t index = settings_index(setting);
    char assignment[64];
    if (scene->is_set[index] || scene->is_preset[index])
        return STATUS_OK;
    settings_put(&scene->settings, setting, settings_get(&defaults, setting));
    if (!row->values[level])
        return STATUS_OK;
    snprintf(assignment, sizeof(assignment), "%s=%s", row->setting, row->values[level]);
    return settings_set(&scene->settings, assignment);
}

enum status option_quality(const struct option *option, void *at, const char *value)
{
    const char *const names[] = { qualities[0].name, qualities[1].name, qualities[2].name };
    struct app_picture *picture = at;
    const int level = option_find_word(names, QUALITY_COUNT, value);
    if (level < 0)
        return option_refuse(option, value, "draft, normal or high");
    picture->level_samples = qualities[level].samples;
    enum status status = STATUS_OK;
    for (const struct quality_row *row = quality_rows; row->setting && status == STATUS_OK; row++)
        status = put(&picture->scene, row, (uint32_t)level);
    return status;
}
