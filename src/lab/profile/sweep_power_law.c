/* sweep_power_law.c: parses sweep parameters and fits power laws to the growth of costs. */
#include "src/lab/profile/sweep_power_law.h"
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/profile/row_aggregation.h"

/* Fraction of the frame time that a row must exceed for a power-law fit. */
static const double fit_fraction_min = 0.02;

static enum status usage(const char *text, const char *what)
{
    log_error("--sweep %s: %s; write it like --sweep cracks.count=0,8,64", text, what);
    return STATUS_USAGE;
}

static enum status no_memory(void)
{
    return log_out_of_memory(NULL);
}

/* Returns an error message if a name or value of this length is invalid, else NULL. */
static const char *find_fault(size_t length)
{
    if (length == 0)
        return "a name or value is empty";
    return length < PROFILE_NAME_SIZE ? NULL : "a name or value is too long";
}

static void copy_text(char to[static PROFILE_NAME_SIZE], const char *from, size_t length)
{
    memcpy(to, from, length);
    to[length] = '\0';
}

/* Splits a list at its commas. Returns an error message if a value is invalid, else NULL. */
static const char *split_values(struct profile_parameter *parameter, const char *text)
{
    for (uint32_t i = 0; i < parameter->value_count; i++) {
        const size_t length = strcspn(text, ",");
        const char *what = find_fault(length);
        if (what)
            return what;
        copy_text(parameter->values[i], text, length);
        text += length + 1;
    }
    return NULL;
}

static uint32_t count_values(const char *text)
{
    uint32_t count = 1;
    for (; *text && count <= PROFILE_SWEEP_POINTS; text++)
        count += *text == ',';
    return count;
}

static const char *read_name(const struct profile_sweep *sweep, const char *text,
                             struct profile_parameter *parameter)
{
    const size_t length = strcspn(text, "=");
    const char *what = text[length] ? find_fault(length) : "'=' is missing";
    if (what)
        return what;
    copy_text(parameter->name, text, length);
    for (uint32_t i = 0; i < sweep->parameter_count; i++)
        if (strcmp(sweep->parameters[i].name, parameter->name) == 0)
            return "the parameter is given twice";
    return NULL;
}

enum status profile_sweep_add(struct profile_sweep *sweep, const char *text)
{
    const uint32_t before = sweep->parameter_count ? sweep->point_count : 1;
    struct profile_parameter *parameter = &sweep->parameters[sweep->parameter_count];
    if (sweep->parameter_count == PROFILE_SWEEP_PARAMETERS)
        return usage(text, "expected at most 4 parameters");
    const char *what = read_name(sweep, text, parameter);
    if (what)
        return usage(text, what);

    const char *values = strchr(text, '=') + 1;
    const uint32_t count = count_values(values);
    if (count > PROFILE_SWEEP_POINTS / before)
        return usage(text, "expected at most 1000 combinations of values");
    parameter->values = calloc(count, sizeof(*parameter->values));
    parameter->value_count = count;
    sweep->parameter_count++; /* profile_sweep_finish() frees it from here on */
    free(sweep->points);
    sweep->points = calloc((size_t)before * count, sizeof(*sweep->points));
    sweep->point_count = sweep->points ? before * count : 0;
    if (!parameter->values || !sweep->points)
        return no_memory();
    what = split_values(parameter, values);
    return what ? usage(text, what) : STATUS_OK;
}

void profile_sweep_finish(struct profile_sweep *sweep)
{
    for (uint32_t i = 0; i < sweep->point_count; i++)
        profile_finish(&sweep->points[i]);
    for (uint32_t i = 0; i < sweep->parameter_count; i++)
        free(sweep->parameters[i].values);
    free(sweep->points);
    *sweep = (struct profile_sweep){ 0 };
}

const char *profile_sweep_value(const struct profile_sweep *sweep, uint32_t point,
                                uint32_t parameter)
{
    for (uint32_t i = sweep->parameter_count - 1; i > parameter; i--)
        point /= sweep->parameters[i].value_count;
    const struct profile_parameter *p = &sweep->parameters[parameter];
    return p->values[point % p->value_count];
}

static bool read_size(const char *text, double *pixels)
{
    char *at = NULL;
    if (!isdigit((unsigned char)text[0]))
        return false;
    *pixels = (double)strtoul(text, &at, 10);
    if (*at != 'x' || !isdigit((unsigned char)at[1]))
        return false;
    *pixels *= (double)strtoul(at + 1, &at, 10);
    return *at == '\0';
}

static bool read_number(const char *text, double *number)
{
    char *end = NULL;
    if (text[strspn(text, "+-.0123456789eE")]) /* strtod() also accepts "inf" and "0x10" */
        return false;
    *number = strtod(text, &end);
    return end > text && *end == '\0' && isfinite(*number);
}

bool profile_sweep_number(const struct profile_sweep *sweep, uint32_t point, uint32_t parameter,
                          double *number)
{
    const char *value = profile_sweep_value(sweep, point, parameter);
    return strcmp(sweep->parameters[parameter].name, "size") == 0 ? read_size(value, number)
                                                                  : read_number(value, number);
}

/* State of the power-law fits over one numeric parameter. */
struct fitting {
    struct profile_table_rows *lines; /* one per point */
    double *x, *used_x, *y;           /* one per point */
    struct profile_growth *growths;   /* frame first */
    uint32_t count;
};

static bool has_growth(const struct fitting *fitting, const char *name)
{
    for (uint32_t i = 1; i < fitting->count; i++)
        if (strcmp(fitting->growths[i].name, name) == 0)
            return true;
    return false;
}

/* Lists the names of all rows to fit, in order of first occurrence. */
static bool name_growths(struct fitting *fitting, uint32_t point_count)
{
    size_t capacity = 1;
    for (uint32_t i = 0; i < point_count; i++)
        capacity += fitting->lines[i].count;
    fitting->growths = calloc(capacity, sizeof(*fitting->growths));
    if (!fitting->growths)
        return false;
    snprintf(fitting->growths[0].name, PROFILE_NAME_SIZE, "frame");
    fitting->count = 1;
    for (uint32_t i = 0; i < point_count; i++) {
        for (uint32_t k = 0; k < fitting->lines[i].count; k++) {
            const struct profile_table_row *line = &fitting->lines[i].lines[k];
            if (line->fraction > fit_fraction_min && line->row->kind != PROFILE_UNATTRIBUTED &&
                !has_growth(fitting, line->row->name))
                snprintf(fitting->growths[fitting->count++].name, PROFILE_NAME_SIZE, "%s",
                         line->row->name);
        }
    }
    return true;
}

/* Returns the median of a named row at a point, or NULL if the point has no such row. */
static const double *find_median(const struct profile_table_rows *lines, const char *name)
{
    for (uint32_t i = 0; i < lines->count; i++)
        if (strcmp(lines->lines[i].row->name, name) == 0)
            return &lines->lines[i].summary.median;
    return NULL;
}

static void fit_growth(const struct fitting *fitting, uint32_t index, uint32_t point_count)
{
    struct profile_growth *growth = &fitting->growths[index];
    uint32_t used = 0;
    for (uint32_t i = 0; i < point_count; i++) {
        const double *median = index == 0 ? &fitting->lines[i].frame.median
                                          : find_median(&fitting->lines[i], growth->name);
        if (!median)
            continue;
        fitting->used_x[used] = fitting->x[i];
        fitting->y[used] = *median;
        used++;
    }
    growth->fit = profile_fit(fitting->used_x, fitting->y, used);
}

/* Fits power laws to all rows and drops rows without a valid fit. */
static void fit_all(struct fitting *fitting, uint32_t point_count)
{
    uint32_t fitted_count = 0;
    for (uint32_t i = 0; i < fitting->count; i++) {
        fit_growth(fitting, i, point_count);
        if (fitting->growths[i].fit.point_count > 0)
            fitting->growths[fitted_count++] = fitting->growths[i];
    }
    fitting->count = fitted_count;
}

static enum status fitting_init(struct fitting *fitting, const struct profile_sweep *sweep)
{
    enum status status = STATUS_OK;
    *fitting = (struct fitting){
        .lines = calloc(sweep->point_count, sizeof(*fitting->lines)),
        .x = calloc(3 * (size_t)sweep->point_count, sizeof(*fitting->x)),
    };
    if (!fitting->lines || !fitting->x)
        return no_memory();
    fitting->used_x = fitting->x + sweep->point_count;
    fitting->y = fitting->used_x + sweep->point_count;
    for (uint32_t i = 0; i < sweep->point_count && status == STATUS_OK; i++)
        status = profile_table_rows_init(&fitting->lines[i], &sweep->points[i], false);
    return status;
}

static void fitting_finish(struct fitting *fitting, uint32_t point_count)
{
    for (uint32_t i = 0; i < point_count && fitting->lines; i++)
        profile_table_rows_finish(&fitting->lines[i]);
    free(fitting->lines);
    free(fitting->x);
    free(fitting->growths);
}

enum status profile_sweep_fit(const struct profile_sweep *sweep, struct profile_growth **growths,
                              uint32_t *count)
{
    struct fitting fitting;
    double number;
    *growths = NULL;
    *count = 0;
    if (sweep->parameter_count != 1 || sweep->point_count == 0)
        return STATUS_OK;
    for (uint32_t i = 0; i < sweep->point_count; i++)
        if (!profile_sweep_number(sweep, i, 0, &number))
            return STATUS_OK;

    enum status status = fitting_init(&fitting, sweep);
    for (uint32_t i = 0; i < sweep->point_count && status == STATUS_OK; i++)
        (void)profile_sweep_number(sweep, i, 0, &fitting.x[i]);
    if (status == STATUS_OK && !name_growths(&fitting, sweep->point_count))
        status = no_memory();
    if (status == STATUS_OK)
        fit_all(&fitting, sweep->point_count);
    if (status == STATUS_OK && fitting.count > 0) {
        *growths = fitting.growths;
        *count = fitting.count;
        fitting.growths = NULL;
    }
    fitting_finish(&fitting, sweep->point_count);
    return status;
}
