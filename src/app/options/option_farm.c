/* option_farm.c: what the options of firn farm set. */
#include "src/app/options/option_farm.h"
#include <string.h>
#include "src/app/options/option_values.h"

enum {
    TASKS_MAX = 1000 /* Slurm's MaxArraySize is 1001 where nobody has set it */
};

enum status option_farm_tasks(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, TASKS_MAX, &o->farm.task_count, &rest) || *rest)
        return option_refuse("tasks", value, "a whole number from 1 to 1000");
    return STATUS_OK;
}

enum status option_farm_submit(struct app_options *o, const char *value)
{
    (void)value;
    o->farm.submit = true;
    return STATUS_OK;
}

/* It becomes a line of a script. */
enum status option_farm_sbatch(struct app_options *o, const char *value)
{
    if (value[0] != '-' || strchr(value, '\n'))
        return option_refuse("sbatch", value, "an option of sbatch, which begins with -,");
    if (o->farm.sbatch_count == APP_SBATCH_COUNT)
        return option_refuse_more("sbatch", value, APP_SBATCH_COUNT);
    o->farm.sbatch[o->farm.sbatch_count++] = value;
    return STATUS_OK;
}

enum status option_farm_hosts(struct app_options *o, const char *value)
{
    if (!value[0] || strchr(value, '\n'))
        return option_refuse("hosts", value, "host names separated by commas");
    o->farm.hosts = value;
    return STATUS_OK;
}
