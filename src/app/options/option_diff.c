/* option_diff.c: what the options of firn diff set. */
#include "src/app/options/option_diff.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/path.h"
#include "src/metric/flip_filter.h"

enum status option_mask(struct app_options *o, const char *value)
{
    o->diff.mask = value;
    return STATUS_OK;
}

enum status option_mask_channel(struct app_options *o, const char *value)
{
    o->diff.mask_channel = value;
    return STATUS_OK;
}

enum status option_exposure(struct app_options *o, const char *value)
{
    o->diff.has_exposure =
        option_parse_numbers(value, ',', &o->diff.exposure, 1) && fabsf(o->diff.exposure) <= 40.0f;
    return o->diff.has_exposure ? STATUS_OK
                                : option_refuse("exposure", value, "stops from -40 to 40");
}

enum status option_curve(struct app_options *o, const char *value)
{
    for (int i = 0; i < FLIP_CURVE_COUNT; i++) {
        if (!strcmp(value, flip_curve_names[i])) {
            o->diff.curve = (enum flip_curve)i;
            return STATUS_OK;
        }
    }
    return option_refuse("curve", value, "aces, hable or reinhard");
}

enum status option_ppd(struct app_options *o, const char *value)
{
    const bool ok = option_parse_numbers(value, ',', &o->diff.ppd, 1) && o->diff.ppd >= 1.0f &&
                    o->diff.ppd <= (float)FLIP_PPD_MAX;
    return ok ? STATUS_OK : option_refuse("ppd", value, "1 to 400 pixels per degree");
}

enum status option_error_picture(struct app_options *o, const char *value)
{
    if (!path_ends_in(value, ".exr") && !path_ends_in(value, ".png"))
        return option_refuse("output", value, "a file name that ends in .exr or .png");
    if (o->output_count == APP_OUTPUT_COUNT)
        return option_refuse_more("output", value, APP_OUTPUT_COUNT);
    o->outputs[o->output_count++] = value;
    return STATUS_OK;
}

enum status option_fail_above(struct app_options *o, const char *value)
{
    const size_t length = strcspn(value, "=");
    float limit;
    for (int i = 0; i < COMPARISON_METRIC_COUNT && value[length]; i++) {
        const char *name = comparison_metric_names[i];
        if (strlen(name) != length || strncmp(name, value, length) != 0 ||
            !option_parse_numbers(value + length + 1, ',', &limit, 1) || limit < 0.0f)
            continue;
        o->diff.has_limit[i] = true;
        o->diff.limits[i] = strtod(value + length + 1, NULL);
        return STATUS_OK;
    }
    return option_refuse("fail-above", value,
                         "METRIC=N, METRIC one of flip, rmse, relmse, mae, angle and N at least 0");
}
