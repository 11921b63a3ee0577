/* option_quality.c: what --quality sets. */
#include "src/app/options/option_quality.h"
#include "src/app/options/option_values.h"
#include "src/settings/quality.h"

enum status option_quality(const struct option *option, void *at, const char *value)
{
    const char *const names[] = { qualities[0].name, qualities[1].name, qualities[2].name };
    struct app_picture *picture = at;
    struct app_scene *scene = &picture->scene;
    const int level = option_find_word(names, QUALITY_COUNT, value);
    if (level < 0)
        return option_refuse(option, value, "draft, normal or high");
    picture->level_samples = qualities[level].samples;
    picture->level_is_smooth = qualities[level].is_smooth;
    for (const struct quality_row *row = quality_rows; row->setting; row++) {
        const size_t index = settings_index(settings_find(row->setting));
        if (!scene->is_set[index] && !scene->is_preset[index])
            quality_put(&scene->settings, row, (uint32_t)level);
    }
    return STATUS_OK;
}
