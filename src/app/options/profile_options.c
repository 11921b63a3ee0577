/* profile_options.c: setters of the options of firn profile. */
#include "src/app/options/profile_options.h"
#include "src/app/options/option_values.h"

enum status option_time_step(const struct option *option, void *at, const char *value)
{
    double *time_step = at;
    float seconds;
    if (!option_parse_numbers(value, ',', &seconds, 1) || seconds < 0.0f || seconds > 3600.0f)
        return option_refuse(option, value, "seconds from 0 to 3600");
    *time_step = (double)seconds;
    return STATUS_OK;
}

enum status option_clock(const struct option *option, void *at, const char *value)
{
    static const enum rg_clock clocks[] = { RG_CLOCK_NONE, RG_CLOCK_EXACT, RG_CLOCK_SUBMITS };

    static const char *const names[] = { "auto", "timestamps", "submits" };
    enum rg_clock *clock = at;
    const int i = option_find_word(names, sizeof(names) / sizeof(names[0]), value);
    if (i < 0)
        return option_refuse(option, value, "auto, timestamps or submits");
    *clock = clocks[i];
    return STATUS_OK;
}

enum status option_sweep(const struct option *option, void *at, const char *value)
{
    struct app_sweeps *sweeps = at;
    if (sweeps->count == APP_SWEEP_COUNT)
        return option_refuse_more(option, value, APP_SWEEP_COUNT);
    sweeps->texts[sweeps->count++] = value;
    return STATUS_OK;
}
