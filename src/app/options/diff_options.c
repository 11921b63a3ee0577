/* diff_options.c: setters of the options of firn diff. */
#include "src/app/options/diff_options.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/path.h"
#include "src/lab/metric/flip_filter.h"

enum status option_exposure(const struct option *option, void *at, const char *value)
{
    struct app_diff *diff = at;
    diff->has_exposure =
        option_parse_numbers(value, ',', &diff->exposure, 1) && fabsf(diff->exposure) <= 40.0f;
    return diff->has_exposure ? STATUS_OK : option_refuse(option, value, "stops from -40 to 40");
}

enum status option_curve(const struct option *option, void *at, const char *value)
{
    struct app_diff *diff = at;
    const int curve = option_find_word(flip_curve_names, FLIP_CURVE_COUNT, value);
    if (curve < 0)
        return option_refuse(option, value, "aces, hable or reinhard");
    diff->curve = (enum flip_curve)curve;
    return STATUS_OK;
}

enum status option_ppd(const struct option *option, void *at, const char *value)
{
    struct app_diff *diff = at;
    const bool ok = option_parse_numbers(value, ',', &diff->ppd, 1) && diff->ppd >= 1.0f &&
                    diff->ppd <= (float)FLIP_PPD_MAX;
    return ok ? STATUS_OK : option_refuse(option, value, "1 to 400 pixels per degree");
}

enum status option_error_image(const struct option *option, void *at, const char *value)
{
    if (!path_ends_in(value, ".exr") && !path_ends_in(value, ".png"))
        return option_refuse(option, value, "a file name that ends in .exr or .png");
    return option_add_output(option, at, value);
}

enum status option_fail_above(const struct option *option, void *at, const char *value)
{
    struct app_diff *diff = at;
    const size_t length = strcspn(value, "=");
    float limit;
    for (int i = 0; i < COMPARISON_METRIC_COUNT && value[length]; i++) {
        const char *name = comparison_metric_names[i];
        if (strlen(name) != length || strncmp(name, value, length) != 0 ||
            !option_parse_numbers(value + length + 1, ',', &limit, 1) || limit < 0.0f)
            continue;
        diff->has_limit[i] = true;
        diff->limits[i] = strtod(value + length + 1, NULL);
        return STATUS_OK;
    }
    return option_refuse(option, value,
                         "METRIC=N with METRIC flip, rmse, relmse, mae or angle, and N at least 0");
}
