/* sweep_report.c: writes a sweep as text table and JSON. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/profile/json_key_tables.h"
#include "src/lab/profile/row_aggregation.h"
#include "src/lab/profile/sweep_power_law.h"
#include "src/lab/profile/table.h"
#include "src/lab/profile/utf8_text.h"

enum {
    PARAMETERS_COLUMNS = 42, /* maximum of all parameters together */
    TIMES_COLUMNS = 20,
    COSTLIEST_COUNT = 3,
    FRACTION_COLUMNS = 8, /* "  ", name, "  64 %" */
    NAME_COLUMNS_MIN = 10,
    FIT_NAME_COLUMNS = 40,
    TEXT_SIZE = 1024
};

struct columns {
    uint32_t parameter[PROFILE_SWEEP_PARAMETERS];
    uint32_t passes; /* columns left for the passes */
};

/* Chooses the widths of the parameter columns. Widths are limited, so long values may be cut.
 * Widths are counted in bytes, so columns with non-ASCII text may be too wide. */
static struct columns make_columns(const struct profile_sweep *sweep)
{
    struct columns columns = { 0 };
    uint32_t sum = 0;
    for (uint32_t i = 0; i < sweep->parameter_count; i++) {
        const struct profile_parameter *parameter = &sweep->parameters[i];
        const uint32_t most = PARAMETERS_COLUMNS / sweep->parameter_count - 1;
        size_t width = strlen(parameter->name);
        for (uint32_t k = 0; k < parameter->value_count; k++)
            if (strlen(parameter->values[k]) > width)
                width = strlen(parameter->values[k]);
        columns.parameter[i] = width < most ? (uint32_t)width : most;
        sum += columns.parameter[i] + 1;
    }
    columns.passes = PROFILE_COLUMNS - TIMES_COLUMNS - sum;
    return columns;
}

/* Finds the most expensive passes, in descending order of time. Returns their number. */
static uint32_t find_costliest(const struct profile_table_rows *lines,
                               const struct profile_table_row *costliest[static COSTLIEST_COUNT])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < lines->pass_count; i++) {
        uint32_t at = count < COSTLIEST_COUNT ? count++ : COSTLIEST_COUNT;
        for (; at > 0 && costliest[at - 1]->fraction < lines->lines[i].fraction; at--)
            if (at < COSTLIEST_COUNT)
                costliest[at] = costliest[at - 1];
        if (at < COSTLIEST_COUNT)
            costliest[at] = &lines->lines[i];
    }
    return count;
}

/* Prints the most expensive passes that fit into a line; the last name may be shortened. */
static void print_costliest(const struct profile_table_rows *lines, uint32_t room, FILE *out)
{
    const struct profile_table_row *costliest[COSTLIEST_COUNT];
    const uint32_t count = find_costliest(lines, costliest);
    char name[PROFILE_TABLE_ROW_NAME_SIZE];
    for (uint32_t i = 0; i < count && room >= NAME_COLUMNS_MIN + FRACTION_COLUMNS; i++) {
        profile_table_row_name(costliest[i], name);
        const uint32_t most = room - FRACTION_COLUMNS;
        const uint32_t width = strlen(name) < most ? (uint32_t)strlen(name) : most;
        fputs("  ", out);
        profile_print_name(name, width, out);
        fprintf(out, " %3.0f %%", costliest[i]->fraction * 100);
        room -= width + FRACTION_COLUMNS;
    }
}

static enum status print_point(const struct profile_sweep *sweep, uint32_t point,
                               const struct columns *columns, FILE *out)
{
    struct profile_table_rows lines;
    const enum status status = profile_table_rows_init(&lines, &sweep->points[point], false);
    if (status != STATUS_OK)
        return status;
    for (uint32_t i = 0; i < sweep->parameter_count; i++) {
        profile_print_name(profile_sweep_value(sweep, point, i), columns->parameter[i], out);
        fputc(' ', out);
    }
    const int decimals = profile_decimals(lines.frame.median);
    fprintf(out, "%9.*f ± %8.*f", decimals, lines.frame.median, decimals, lines.frame.sigma);
    print_costliest(&lines, columns->passes, out);
    fputc('\n', out);
    profile_table_rows_finish(&lines);
    return STATUS_OK;
}

static void print_fits(const struct profile_sweep *sweep, const struct profile_growth *growths,
                       uint32_t count, FILE *out)
{
    char message[TEXT_SIZE];
    if (count == 0)
        return;
    snprintf(
        message, sizeof(message),
        "median in ms = factor * %s ^ exponent: least squares of the logarithms, of points above 0",
        strcmp(sweep->parameters[0].name, "size") == 0 ? "pixels" : sweep->parameters[0].name);
    fputc('\n', out);
    profile_print_wrapped(message, 2, out);
    profile_print_name("", FIT_NAME_COLUMNS, out);
    fprintf(out, " %10s %12s %8s %8s\n", "exponent", "factor", "R²", "points");
    for (uint32_t i = 0; i < count; i++) {
        const struct profile_fit *fit = &growths[i].fit;
        profile_print_name(growths[i].name, FIT_NAME_COLUMNS, out);
        fprintf(out, " %10.3f %12.4g %7.4f %8" PRIu32 "\n", fit->exponent, fit->factor, fit->r2,
                fit->point_count);
    }
}

enum status profile_sweep_table(const struct profile_sweep *sweep, FILE *out)
{
    const struct columns columns = make_columns(sweep);
    struct profile_growth *growths = NULL;
    uint32_t growth_count = 0;
    enum status status = profile_sweep_fit(sweep, &growths, &growth_count);
    for (uint32_t i = 0; i < sweep->parameter_count && status == STATUS_OK; i++) {
        profile_print_name(sweep->parameters[i].name, columns.parameter[i], out);
        fputc(' ', out);
    }
    if (status == STATUS_OK)
        fprintf(out, "%9s ± %8s  %s\n", "frame ms", "sigma", "most expensive passes");
    for (uint32_t i = 0; i < sweep->point_count && status == STATUS_OK; i++)
        status = print_point(sweep, i, &columns, out);
    if (status == STATUS_OK)
        print_fits(sweep, growths, growth_count, out);
    free(growths);
    return status;
}

static bool add_parameters(json_t *root, const struct profile_sweep *sweep)
{
    json_t *array = profile_json_put(root, "parameters", json_array());
    bool ok = array;
    for (uint32_t i = 0; i < sweep->parameter_count; i++)
        ok = profile_json_put(array, NULL, profile_json_string(sweep->parameters[i].name)) && ok;
    return ok;
}

static bool add_point(json_t *points, const struct profile_sweep *sweep, uint32_t point)
{
    json_t *json = profile_json_put(points, NULL, json_object());
    json_t *values = profile_json_put(json, "values", json_array());
    json_t *numbers = profile_json_put(json, "numbers", json_array());
    json_t *profile = profile_json_put(json, "profile", json_object());
    bool ok = values && numbers && profile;
    for (uint32_t i = 0; i < sweep->parameter_count; i++) {
        const char *value = profile_sweep_value(sweep, point, i);
        double number;
        const bool is_number = profile_sweep_number(sweep, point, i, &number);
        ok = profile_json_put(values, NULL, profile_json_string(value)) && ok;
        ok = profile_json_put(numbers, NULL, is_number ? json_real(number) : json_null()) && ok;
    }
    return ok && profile_json_add_all(profile, &sweep->points[point], false);
}

static bool add_fit(json_t *fits, const struct profile_growth *growth)
{
    json_t *json = profile_json_put(fits, NULL, json_object());
    const struct profile_fit *fit = &growth->fit;
    return profile_json_put(json, "name", profile_json_string(growth->name)) &&
           profile_json_put(json, "exponent", json_real(fit->exponent)) &&
           profile_json_put(json, "factor", json_real(fit->factor)) &&
           profile_json_put(json, "r2", json_real(fit->r2)) &&
           profile_json_put(json, "point_count", json_integer(fit->point_count));
}

static bool add_contrast(json_t *contrasts, const struct profile_contrast *contrast)
{
    json_t *json = profile_json_put(contrasts, NULL, json_object());
    return profile_json_put(json, "where", json_string(contrast->where)) &&
           profile_json_put(json, "what", json_string(contrast->what)) &&
           profile_json_put(json, "said", json_string(contrast->claim)) &&
           profile_json_put(json, "before", json_integer(contrast->before)) &&
           profile_json_put(json, "after", json_integer(contrast->after)) &&
           profile_json_put(json, "rate", json_real(contrast->rate.ratio)) &&
           profile_json_put(json, "low", json_real(contrast->rate.low)) &&
           profile_json_put(json, "high", json_real(contrast->rate.high)) &&
           profile_json_put(json, "p", json_real(contrast->p));
}

enum status profile_write_sweep_json(const struct profile_sweep *sweep, char **text, size_t *size)
{
    struct profile_growth *growths = NULL;
    uint32_t growth_count = 0;
    const enum status status = profile_sweep_fit(sweep, &growths, &growth_count);
    *text = NULL;
    *size = 0;
    if (status != STATUS_OK)
        return status;

    json_t *root = json_object();
    bool ok = profile_json_put(root, "format", json_integer(PROFILE_JSON_FORMAT)) &&
              profile_json_put(root, "type", json_string("sweep")) && add_parameters(root, sweep);
    json_t *points = profile_json_put(root, "points", json_array());
    for (uint32_t i = 0; i < sweep->point_count && ok; i++)
        ok = add_point(points, sweep, i);
    json_t *fits = profile_json_put(root, "fits", json_array());
    for (uint32_t i = 0; i < growth_count && ok; i++)
        ok = add_fit(fits, &growths[i]);
    json_t *contrasts = profile_json_put(root, "contrasts", json_array());
    for (uint32_t i = 0; i < sweep->contrast_count && ok; i++)
        ok = add_contrast(contrasts, &sweep->contrasts[i]);
    free(growths);
    return profile_json_end(root, ok && fits && contrasts, PROFILE_JSON_DIGITS, text, size);
}
