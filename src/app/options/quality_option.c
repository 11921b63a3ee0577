/* quality_option.c: applies the quality level of --quality. */
#include "src/app/options/quality_option.h"
#include "src/app/options/option_values.h"
#include "src/settings/quality.h"

static void apply_level(struct setup_image *image, uint32_t level)
{
    image->level_samples = qualities[level].samples;
    image->level_has_smooth_filter = qualities[level].is_smooth;
    quality_apply(&image->scene.settings, level, SETTING_QUALITY);
}

enum status option_quality(const struct option *option, void *at, const char *value)
{
    const char *const names[] = { qualities[0].name, qualities[1].name, qualities[2].name };
    const int level = option_find_word(names, QUALITY_COUNT, value);
    if (level < 0)
        return option_refuse(option, value, "draft, normal or high");
    apply_level(at, (uint32_t)level);
    return STATUS_OK;
}

void option_default_quality(struct app_options *o)
{
    const struct setup_image *image = &o->image;
    const bool has_limit = o->render.noise > 0.0 || o->render.seconds > 0.0;
    if (!image->level_samples && !image->samples && !image->scene.preset && !has_limit)
        apply_level(&o->image, QUALITY_RENDER_DEFAULT);
}
