/* option_profile.c: what the options of firn profile set. */
#include "src/app/options/option_profile.h"
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/log.h"

enum status option_runs(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 100000, &o->run_count, &rest) || *rest)
        return option_refuse("runs", value, "a whole number from 1 to 100000");
    return STATUS_OK;
}

enum status option_warmup(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 0, 100000, &o->warmup, &rest) || *rest)
        return option_refuse("warmup", value, "a whole number from 0 to 100000");
    return STATUS_OK;
}

enum status option_time_step(struct app_options *o, const char *value)
{
    float seconds;
    if (!option_parse_numbers(value, ',', &seconds, 1) || seconds < 0.0f || seconds > 3600.0f)
        return option_refuse("time-step", value, "seconds from 0 to 3600");
    o->time_step = (double)seconds;
    return STATUS_OK;
}

enum status option_clock(struct app_options *o, const char *value)
{
    static const char *const names[] = {
        [RG_CLOCK_NONE] = "auto",
        [RG_CLOCK_EXACT] = "timestamps",
        [RG_CLOCK_SUBMITS] = "submits",
    };
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        if (names[i] && !strcmp(value, names[i])) {
            o->clock = (enum rg_clock)i;
            return STATUS_OK;
        }
    }
    return option_refuse("clock", value, "auto, timestamps or submits");
}

enum status option_sweep(struct app_options *o, const char *value)
{
    if (o->sweep_count == APP_SWEEP_COUNT)
        return option_refuse_more("sweep", value, APP_SWEEP_COUNT);
    o->sweeps[o->sweep_count++] = value;
    return STATUS_OK;
}

enum status option_baseline(struct app_options *o, const char *value)
{
    o->baseline = value;
    return STATUS_OK;
}

enum status option_each(struct app_options *o, const char *value)
{
    (void)value;
    o->each = true;
    return STATUS_OK;
}

enum status option_json(struct app_options *o, const char *value)
{
    o->reports.json = value;
    return STATUS_OK;
}

enum status option_csv(struct app_options *o, const char *value)
{
    o->reports.csv = value;
    return STATUS_OK;
}

enum status option_trace(struct app_options *o, const char *value)
{
    o->reports.trace = value;
    return STATUS_OK;
}

enum status option_html(struct app_options *o, const char *value)
{
    o->reports.html = value;
    return STATUS_OK;
}

enum status option_capture(struct app_options *o, const char *value)
{
    (void)value;
    o->capture = true;
    return STATUS_OK;
}
