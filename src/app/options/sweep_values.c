/* sweep_values.c: parses --sweep and applies the values of each sweep point to the options. */
#include "src/app/options/sweep_values.h"

enum status sweep_values_parse(struct profile_sweep *sweep, const struct app_sweeps *sweeps,
                               const struct setup_image *image)
{
    struct setup_image at_point;
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < sweeps->count && status == STATUS_OK; i++)
        status = profile_sweep_add(sweep, sweeps->texts[i]);
    for (uint32_t i = 0; i < sweep->point_count && status == STATUS_OK; i++)
        status = sweep_values_apply(sweep, i, image, &at_point);
    return status;
}

enum status sweep_values_apply(const struct profile_sweep *sweep, uint32_t point,
                               const struct setup_image *image, struct setup_image *at_point)
{
    enum status status = STATUS_OK;
    *at_point = *image;
    for (uint32_t i = 0; i < sweep->parameter_count && status == STATUS_OK; i++)
        status = app_set_option(at_point, sweep->parameters[i].name,
                                profile_sweep_value(sweep, point, i));
    return status;
}
