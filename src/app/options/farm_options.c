/* farm_options.c: setters of the options of firn farm. */
#include "src/app/options/farm_options.h"
#include <string.h>
#include "src/app/options/option_values.h"

/* Adds an option of sbatch, which becomes a line of the generated script. */
enum status option_farm_sbatch(const struct option *option, void *at, const char *value)
{
    struct app_farm *farm = at;
    if (value[0] != '-' || strchr(value, '\n'))
        return option_refuse(option, value, "an sbatch option, which begins with -");
    if (farm->sbatch_count == APP_SBATCH_COUNT)
        return option_refuse_more(option, value, APP_SBATCH_COUNT);
    farm->sbatch[farm->sbatch_count++] = value;
    return STATUS_OK;
}

enum status option_farm_hosts(const struct option *option, void *at, const char *value)
{
    struct app_farm *farm = at;
    if (!value[0] || strchr(value, '\n'))
        return option_refuse(option, value, "host names separated by commas");
    farm->hosts = value;
    return STATUS_OK;
}
