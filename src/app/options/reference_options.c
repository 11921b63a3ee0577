/* reference_options.c: setters and checks of the options of --refraction reference. */
#include "src/app/options/reference_options.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/tech/refract/cpu_reference_settings.h"

enum {
    SAMPLES_MAX = 65536 /* default sample count with a noise or time limit */
};

static enum status set_number(const struct option *option, double *at, const char *value, float min,
                              float max, const char *expected)
{
    float number;
    if (!option_parse_numbers(value, ',', &number, 1) || number < min || number > max)
        return option_refuse(option, value, expected);
    *at = (double)number;
    return STATUS_OK;
}

enum status option_noise(const struct option *option, void *at, const char *value)
{
    return set_number(option, at, value, 1e-6f, 0.5f, "a number from 1e-6 to 0.5");
}

enum status option_seconds(const struct option *option, void *at, const char *value)
{
    return set_number(option, at, value, 1e-3f, 1e9f, "seconds from 0.001 to 1e9");
}

const char *option_sums_image(const struct app_options *o)
{
    for (uint32_t i = 0; i < o->run.outputs.count; i++) {
        if (path_ends_in(o->run.outputs.paths[i], ".exr"))
            return o->run.outputs.paths[i];
    }
    return NULL;
}

char *option_sums_file(const char *image)
{
    static const char ending[] = ".sums.exr";
    const size_t length = strlen(image) - strlen(".exr");
    const size_t size = length + sizeof(ending);
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%.*s%s", (int)length, image, ending);
    return name;
}

enum status option_check_reference(struct app_options *o)
{
    const struct app_render *render = &o->render;
    const char *limit = render->noise > 0.0 ? "noise" : render->seconds > 0.0 ? "time" : NULL;
    const bool is_named = o->image.is_refraction_named;
    const uint32_t default_count = o->image.level_samples ? o->image.level_samples : 1;
    if (o->image.level_has_smooth_filter && !o->image.is_filter_named)
        o->image.filter = PIXEL_FILTER_BLACKMAN_HARRIS;
    if (!o->image.samples)
        o->image.samples = limit ? SAMPLES_MAX : default_count;
    if (o->image.refraction != &cpu_reference_settings && (limit || render->keep_sums)) {
        log_error("--%s: only available with --refraction reference%s%s%s; %s",
                  limit ? limit : "keep-sums", is_named ? ", not '" : "",
                  is_named ? o->image.refraction->refraction.name : "", is_named ? "'" : "",
                  limit ? "give --samples instead" : "leave it out");
        return STATUS_USAGE;
    }
    if (render->keep_sums && !option_sums_image(o)) {
        log_error(
            "--keep-sums: expected an .exr file as --output, beside which the sums are stored");
        return STATUS_USAGE;
    }
    return STATUS_OK;
}
