/* table_and_json.c: writes errors and costs as a text table and as JSON. */
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"
#include "src/file/json_text.h"
#include "src/lab/ladder/comparison_report.h"

enum {
    NAME_COLUMNS = 10
};

static void print_number(double number, int digits, FILE *out)
{
    if (isnan(number))
        fprintf(out, " %9s", "-");
    else
        fprintf(out, " %9.*f", digits, number);
}

static void print_head(const struct ladder_report *report, FILE *out)
{
    const struct ladder *l = report->ladder;
    const double percent =
        l->object_count ? 100.0 * (double)l->angle_count / (double)l->object_count : 0.0;
    fprintf(out, "scene      %s\n", report->scene);
    fprintf(
        out,
        "pixels     %u x %u, %u sample%s; object: %llu, %.1f %% of them without total reflection\n",
        l->width, l->height, report->samples, report->samples == 1 ? "" : "s",
        (unsigned long long)l->object_count, percent);
    fprintf(out, "reference  %s, %.1f s\n", l->tracer, l->reference_cost * 1e-3);
    if (report->device)
        fprintf(out, "device     %s\n", report->device);
}

/* Prints a refraction model's table line. `ratio` is the model's cost relative to ladder_base(). */
static void print_row(const char *name, const struct ladder_error *e, double ms, double ratio,
                      FILE *out)
{
    fprintf(out, "%-*s", NAME_COLUMNS, name);
    print_number(e->flip, 4, out);
    print_number(e->mae, 4, out);
    print_number(e->mae_unclipped, 4, out);
    print_number(e->rmse, 4, out);
    print_number(e->angle, 3, out);
    print_number(e->angle_95, 3, out);
    print_number(100.0 * e->tir_differs, 1, out);
    if (!isnan(e->truth))
        print_number(e->truth, 4, out);
    print_number(ms, 2, out);
    print_number(ratio, 2, out);
    putc('\n', out);
}

static void print_rows(const struct ladder *l, FILE *out)
{
    const double base = ladder_base(l)->cost;
    const double none = (double)NAN;
    for (uint32_t i = 0; i < l->refraction_model_count; i++)
        print_row(l->refraction_models[i].refraction->refraction.name,
                  &l->refraction_models[i].error,
                  l->refraction_models[i].cost > 0.0 ? l->refraction_models[i].cost : none,
                  ladder_cost_ratio(l, &l->refraction_models[i]), out);
    print_row("reference", &l->reference_error, l->reference_cost,
              base > 0.0 ? l->reference_cost / base : none, out);
}

/* MAE table with one column per pixel class. */
struct columns {
    const char *title;
    const char *const *names;
    const uint64_t *counts;
    int count;
    size_t offset; /* byte offset in struct ladder_error */
};

static void print_columns(const struct ladder *l, const struct columns *columns, FILE *out)
{
    fprintf(out, "\n%-*s", NAME_COLUMNS, columns->title);
    for (int c = 0; c < columns->count; c++)
        fprintf(out, " %9s", columns->names[c]);
    fprintf(out, "\n%-*s", NAME_COLUMNS, "pixels");
    for (int c = 0; c < columns->count; c++)
        fprintf(out, " %9llu", (unsigned long long)columns->counts[c]);
    putc('\n', out);
    for (uint32_t i = 0; i < l->refraction_model_count; i++) {
        const char *error = (const char *)&l->refraction_models[i].error + columns->offset;
        fprintf(out, "%-*s", NAME_COLUMNS, l->refraction_models[i].refraction->refraction.name);
        for (int c = 0; c < columns->count; c++)
            print_number(((const double *)(const void *)error)[c], 4, out);
        putc('\n', out);
    }
}

/* Prints MAE by pixel class in separate tables, to keep lines below 100 characters. */
static void print_classes(const struct ladder *l, FILE *out)
{
    const struct columns paths = { "MAE, path", ladder_path_class_names, l->path_class_counts,
                                   LADDER_PATH_CLASS_COUNT,
                                   offsetof(struct ladder_error, path_class_mae) };
    const struct columns inclusions = { "MAE, hits", ladder_inclusion_names, l->inclusion_counts,
                                        LADDER_INCLUSION_COUNT,
                                        offsetof(struct ladder_error, inclusion_mae) };
    print_columns(l, &paths, out);
    fputs("\nrefracted: light exits at the first inner surface; reflected: one total internal "
          "reflection before\nit exits; trapped: two or more.\n",
          out);
    if (!l->is_whole)
        return;
    print_columns(l, &inclusions, out);
    fputs("\nhits: inclusions along this path; clear: none. A pixel may be counted more than "
          "once.\n",
          out);
}

void ladder_table(const struct ladder_report *report, FILE *out)
{
    const struct ladder *l = report->ladder;
    const bool has_truth = !isnan(l->reference_error.truth);
    print_head(report, out);
    fprintf(out, "\n%-*s %9s %9s %9s %9s %9s %9s %9s", NAME_COLUMNS, "model", "FLIP", "MAE",
            "unclipped", "RMSE", "degrees", "95 %", "TIR %");
    fprintf(out, "%s %9s %9s\n", has_truth ? "     truth" : "", "ms", "cost");
    print_rows(l, out);
    fprintf(
        out,
        "\nFLIP: over all pixels. MAE (clipped to 0 and 1; unclipped), RMSE: linear, over the "
        "object's\npixels. degrees: error of the exit direction where there is no total "
        "reflection. TIR %%: pixels\nwith total reflection in only one of the two images. cost: "
        "median frame time relative to %s,\nframes of all models interleaved.\n",
        ladder_base(l)->refraction->refraction.name);
    for (uint32_t i = 0; i < l->refraction_model_count; i++) {
        if (l->refraction_models[i].error.not_finite)
            fprintf(out, "%s: %llu values are not finite\n",
                    l->refraction_models[i].refraction->refraction.name,
                    (unsigned long long)l->refraction_models[i].error.not_finite);
    }
    if (has_truth)
        fputs("truth: MAE against the image given with --truth.\n", out);
    print_classes(l, out);
}

/* Adds a number to a JSON object. Adds null if it is not finite, as JSON has no such numbers. */
static bool add_number(json_t *object, const char *key, double number)
{
    return !json_object_set_new(object, key, isfinite(number) ? json_real(number) : json_null());
}

static bool add_count(json_t *object, const char *key, uint64_t count)
{
    return !json_object_set_new(object, key, json_integer((json_int_t)count));
}

static bool add_text(json_t *object, const char *key, const char *text)
{
    return !json_object_set_new(object, key, json_text_string(text));
}

/* Adds one key per class, such as "mae_refracted" for errors or "refracted_pixels" for counts. */
static bool add_named(json_t *object, const char *const *names, int count, const double *errors,
                      const uint64_t *counts)
{
    bool ok = true;
    for (int c = 0; c < count && ok; c++) {
        char key[32];
        snprintf(key, sizeof(key), errors ? "mae_%s" : "%s_pixels", names[c]);
        ok = errors ? add_number(object, key, errors[c]) : add_count(object, key, counts[c]);
    }
    return ok;
}

/* Adds the MAE of each pixel class. If `error` is NULL, adds the numbers of pixels instead. */
static bool add_classes(json_t *object, const struct ladder *l, const struct ladder_error *error)
{
    return add_named(object, ladder_path_class_names, LADDER_PATH_CLASS_COUNT,
                     error ? error->path_class_mae : NULL, l->path_class_counts) &&
           (!l->is_whole || add_named(object, ladder_inclusion_names, LADDER_INCLUSION_COUNT,
                                      error ? error->inclusion_mae : NULL, l->inclusion_counts));
}

static json_t *make_model(const struct ladder *ladder, const struct ladder_model *model)
{
    const struct ladder_error *e = &model->error;
    json_t *object = json_object();
    const bool ok =
        add_text(object, "name", model->refraction->refraction.name) &&
        add_number(object, "flip", e->flip) && add_number(object, "mae", e->mae) &&
        add_number(object, "mae_unclipped", e->mae_unclipped) &&
        add_number(object, "rmse", e->rmse) && add_classes(object, ladder, e) &&
        add_number(object, "angle", e->angle) && add_number(object, "angle_95", e->angle_95) &&
        add_number(object, "tir", e->tir_differs) && add_number(object, "truth", e->truth) &&
        add_count(object, "not_finite", e->not_finite) &&
        add_number(object, "ms", model->cost > 0.0 ? model->cost : (double)NAN) &&
        add_number(object, "cost", ladder_cost_ratio(ladder, model));
    if (ok)
        return object;
    json_decref(object);
    return NULL;
}

static bool fill(json_t *root, const struct ladder_report *report)
{
    const struct ladder *l = report->ladder;
    json_t *refraction_models = json_array();
    bool ok = add_text(root, "scene", report->scene) &&
              add_text(root, "command", report->command) && add_count(root, "width", l->width) &&
              add_count(root, "height", l->height) && add_count(root, "samples", report->samples) &&
              add_count(root, "object_pixels", l->object_count) &&
              add_count(root, "straight_pixels", l->angle_count) && add_classes(root, l, NULL) &&
              add_text(root, "reference", l->tracer) &&
              add_number(root, "reference_ms", l->reference_cost) &&
              add_number(root, "reference_truth", l->reference_error.truth) &&
              add_text(root, "device", report->device ? report->device : "");
    for (uint32_t i = 0; i < l->refraction_model_count && ok; i++)
        ok = !json_array_append_new(refraction_models, make_model(l, &l->refraction_models[i]));
    return !json_object_set_new(root, "rungs", refraction_models) && ok;
}

enum status ladder_json(const struct ladder_report *report, char **text, size_t *size)
{
    json_t *root = json_object();
    *text = fill(root, report) ? json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(root);
    if (!*text)
        return log_out_of_memory(NULL);
    *size = 0;
    while ((*text)[*size])
        ++*size;
    return STATUS_OK;
}
