/* sweep.c: parses sweep parameters. */
#include "src/lab/profile/sweep.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

static enum status usage(const char *text, const char *what)
{
    log_error("--sweep %s: %s; write it like --sweep cracks.count=0,8,64", text, what);
    return STATUS_USAGE;
}

/* Returns true if a value of a list "a,b,c" is empty. */
static bool has_empty_value(const char *values)
{
    const size_t length = strlen(values);
    return length == 0 || values[0] == ',' || values[length - 1] == ',' || strstr(values, ",,");
}

enum status profile_sweep_add(struct profile_sweep *sweep, const char *text)
{
    assert(sweep->parameter_count < PROFILE_SWEEP_PARAMETERS);
    const uint32_t before = sweep->parameter_count ? sweep->point_count : 1;
    const size_t name_length = strcspn(text, "=");
    if (name_length == 0 || !text[name_length] || has_empty_value(text + name_length + 1))
        return usage(text, "a name or value is missing");

    struct profile_parameter *parameter = &sweep->parameters[sweep->parameter_count];
    parameter->name = strdup(text);
    if (!parameter->name)
        return log_out_of_memory(NULL);
    sweep->parameter_count++; /* profile_sweep_finish() frees it from here on */
    parameter->value_count = 1;
    parameter->name[name_length] = '\0';
    for (char *c = parameter->name + name_length + 1; (c = strchr(c, ',')); c++) {
        *c = '\0';
        parameter->value_count++;
    }
    for (uint32_t i = 0; i + 1 < sweep->parameter_count; i++)
        if (strcmp(sweep->parameters[i].name, parameter->name) == 0)
            return usage(text, "the parameter is given twice");
    if (parameter->value_count > PROFILE_SWEEP_POINTS / before)
        return usage(text, "expected at most 1000 combinations of values");
    sweep->point_count = before * parameter->value_count;
    return STATUS_OK;
}

void profile_sweep_finish(struct profile_sweep *sweep)
{
    for (uint32_t i = 0; i < sweep->point_count && sweep->points; i++)
        profile_finish(&sweep->points[i]);
    for (uint32_t i = 0; i < sweep->parameter_count; i++)
        free(sweep->parameters[i].name);
    free(sweep->points);
    *sweep = (struct profile_sweep){ 0 };
}

const char *profile_sweep_value(const struct profile_sweep *sweep, uint32_t point,
                                uint32_t parameter)
{
    for (uint32_t i = sweep->parameter_count - 1; i > parameter; i--)
        point /= sweep->parameters[i].value_count;
    const struct profile_parameter *p = &sweep->parameters[parameter];
    const char *value = p->name;
    for (uint32_t i = 0; i <= point % p->value_count; i++)
        value += strlen(value) + 1;
    return value;
}
