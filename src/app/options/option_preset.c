/* option_preset.c: the settings of --preset. */
#include "src/app/options/option_preset.h"
#include "src/reader/preset.h"

static enum status apply_line(struct app_scene *scene, const struct preset_line *line)
{
    const struct settings_source source = { scene->preset, line->number };
    struct settings settings = scene->settings;
    const struct setting *row;
    const enum status status = settings_assign(&settings, line->assignment, &source, &row);
    if (status != STATUS_OK || scene->is_set[settings_index(row)])
        return status;
    scene->settings = settings;
    scene->is_preset[settings_index(row)] = true;
    return STATUS_OK;
}

enum status option_preset_read(struct app_scene *scene)
{
    struct preset preset = { 0 };
    if (!scene->preset)
        return STATUS_OK;
    enum status status = preset_read(&preset, scene->preset, &scene->reader);
    for (uint32_t i = 0; i < preset.count && status == STATUS_OK; i++)
        status = apply_line(scene, &preset.lines[i]);
    preset_finish(&preset);
    return status;
}
