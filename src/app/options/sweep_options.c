/* sweep_options.c: parses --sweep and applies the values of each sweep point to the options. */
#include "src/app/options/sweep_options.h"

enum status sweep_options_parse(struct profile_sweep *sweep, const struct app_sweeps *sweeps,
                                const struct app_picture *picture)
{
    struct app_picture at_point;
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < sweeps->count && status == STATUS_OK; i++)
        status = profile_sweep_add(sweep, sweeps->words[i]);
    for (uint32_t i = 0; i < sweep->point_count && status == STATUS_OK; i++)
        status = sweep_options_at(sweep, i, picture, &at_point);
    return status;
}

enum status sweep_options_at(const struct profile_sweep *sweep, uint32_t point,
                             const struct app_picture *picture, struct app_picture *at_point)
{
    enum status status = STATUS_OK;
    *at_point = *picture;
    for (uint32_t i = 0; i < sweep->parameter_count && status == STATUS_OK; i++)
        status = app_set(at_point, sweep->parameters[i].name, profile_sweep_value(sweep, point, i));
    return status;
}
