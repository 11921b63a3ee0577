/* option_reference.c: what the options of --refraction reference set. */
#include "src/app/options/option_reference.h"
#include "src/app/options/option_values.h"
#include "src/base/log.h"
#include "src/tech/refract_reference.h"

enum {
    SAMPLES_MAX = 65536 /* where noise or time is the limit */
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

enum status option_settle_reference(struct app_options *o)
{
    const struct app_render *render = &o->render;
    const char *name = render->noise > 0.0 ? "noise" : render->seconds > 0.0 ? "time" : NULL;
    if (!o->picture.samples)
        o->picture.samples = name ? SAMPLES_MAX : 1;
    if (!name || o->picture.rung == &refract_reference)
        return STATUS_OK;
    log_error("--%s: only --refraction reference has it, not '%s'; give --samples instead", name,
              o->picture.rung->rung.name);
    return STATUS_USAGE;
}
