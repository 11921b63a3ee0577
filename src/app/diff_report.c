/* diff_report.c: prints the differences between two images as text and JSON. */
#include "src/app/diff_report.h"
#include <ctype.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- text ---- */

enum {
    COLUMNS = 100
};

/* Prints a channel name with control characters replaced. Returns its width in columns. */
static int print_name(const char *name, FILE *out)
{
    int columns = 0;
    for (; name[columns]; columns++)
        putc(iscntrl((unsigned char)name[columns]) ? '?' : name[columns], out);
    return columns;
}

static void print_names(const char *title, const char *const *names, uint32_t count, FILE *out)
{
    int at = fprintf(out, "%s", title);
    for (uint32_t i = 0; i < count; i++) {
        if (at + (int)strlen(names[i]) + 2 > COLUMNS)
            at = fprintf(out, "\n ") - 1;
        putc(' ', out);
        at += print_name(names[i], out) + 2;
        if (i + 1 < count)
            putc(',', out);
    }
    fputs("\n", out);
}

static void print_head(const struct diff_report *report, FILE *out)
{
    const struct app_options *o = report->options;
    fputs("reference  ", out);
    print_name(o->positionals[0], out);
    fputs("\ntest       ", out);
    print_name(o->positionals[1], out);
    fprintf(out, "\npixels     %u x %u", report->width, report->height);
    if (o->mask.file)
        fprintf(out, ", %zu selected by the mask", report->comparison->counted);
    fputs("\n\n", out);
}

static void print_flip(const struct diff_report *report, FILE *out)
{
    const struct comparison *c = report->comparison;
    const struct app_diff *o = &report->options->diff;
    fprintf(out, "FLIP       %-12.6f ", c->flip);
    if (c->is_hdr)
        fprintf(out, "HDR, %u exposures by %s, %+.2f to %+.2f stops", c->exposures.count,
                flip_curve_names[o->curve], c->exposures.first, c->exposures.last);
    else
        fputs("LDR", out);
    if (o->has_exposure)
        fprintf(out, ", exposed %+g stops", (double)o->exposure);
    fprintf(out, ", %.4g pixels per degree\n", report->ppd);
}

/* Prints a number in a fixed width, or "-" for NaN. */
static void print_number(double number, FILE *out)
{
    if (isnan(number))
        fprintf(out, "%-12s ", "-");
    else
        fprintf(out, "%-12.6g ", number);
}

static void print_metrics(const struct diff_report *report, FILE *out)
{
    const struct comparison_layer *beauty;
    double rmse, relmse, mae;
    if (!comparison_metric(report->comparison, COMPARISON_RMSE, &rmse) ||
        !comparison_metric(report->comparison, COMPARISON_RELMSE, &relmse) ||
        !(beauty = comparison_metric(report->comparison, COMPARISON_MAE, &mae)))
        return;
    print_flip(report, out);
    fputs("RMSE       ", out);
    print_number(rmse, out);
    fputs("linear\nrelMSE     ", out);
    print_number(relmse, out);
    fputs("linear\nMAE        ", out);
    print_number(mae, out);
    fputs("linear, clipped to 0 and 1\nMAE        ", out);
    print_number(difference_mae_unclipped(&beauty->difference), out);
    fputs("linear, unclipped\n\n", out);
}

static void print_layers(const struct comparison *c, FILE *out)
{
    fprintf(out, "%-20s %-12s %-12s %s\n", "layer", "RMSE", "largest", "not finite");
    for (uint32_t i = 0; i < c->layer_count; i++) {
        const struct difference *difference = &c->layers[i].difference;
        const int columns = print_name(c->layers[i].name, out);
        fprintf(out, "%*s", columns < 20 ? 21 - columns : 1, "");
        print_number(difference_rmse(difference), out);
        print_number(difference->count ? difference->largest : (double)NAN, out);
        fprintf(out, "%llu\n", (unsigned long long)difference->not_finite);
    }
}

static double fraction(uint64_t part, uint64_t all)
{
    return all ? (double)part / (double)all : 0.0;
}

static void print_exit(const struct angle *angle, FILE *out)
{
    const unsigned long long both = angle->both, r = angle->only_reference, t = angle->only_test;
    fprintf(out, "\nexit       ");
    if (both)
        fprintf(out, "mean %.4g, median %.4g, 95 %% %.4g, largest %.4g degrees; ", angle->mean,
                angle->median, angle->percentile_95, angle->largest);
    fprintf(out, "pixels: %llu\n", both);
    fprintf(out, "           only in the reference: %llu; only in the test: %llu; %.4g %% of all\n",
            r, t, 100.0 * fraction(r + t, both + r + t));
}

void diff_report_text(const struct diff_report *report, FILE *out)
{
    const struct comparison *c = report->comparison;
    print_head(report, out);
    print_metrics(report, out);
    print_layers(c, out);
    if (c->has_exit)
        print_exit(&c->angle, out);
    if (c->has_tir)
        fprintf(out, "\ntir        differs in %.4g %% of %llu pixels\n",
                100.0 * fraction(c->tir_differs, c->tir_count), (unsigned long long)c->tir_count);
    if (c->only_reference_count || c->only_test_count)
        fputs("\n", out);
    if (c->only_reference_count)
        print_names("only in the reference:", c->only_reference, c->only_reference_count, out);
    if (c->only_test_count)
        print_names("only in the test:", c->only_test, c->only_test_count, out);
}

/* ---- JSON ---- */

/* Adds a value to a JSON object, or to an array if `key` is NULL. On failure frees the value. */
static bool append(json_t *json, const char *key, json_t *value)
{
    return (key ? json_object_set_new(json, key, value) : json_array_append_new(json, value)) == 0;
}

/* Returns a JSON string. If `text` is not UTF-8, its non-ASCII bytes become '?'. */
static json_t *make_text(const char *text)
{
    json_t *json = json_string(text);
    char *plain = json ? NULL : strdup(text);
    for (char *c = plain; c && *c; c++) {
        if ((unsigned char)*c > 0x7e)
            *c = '?';
    }
    if (plain)
        json = json_string(plain);
    free(plain);
    return json;
}

/* Returns a number, or null if it is not finite, because JSON has no NaN. */
static json_t *make_number(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}

static json_t *make_count(uint64_t count)
{
    return json_integer((json_int_t)count);
}

static bool append_names(json_t *json, const char *key, const char *const *names, uint32_t count)
{
    json_t *array = json_array();
    bool ok = append(json, key, array);
    for (uint32_t i = 0; i < count && ok; i++)
        ok = append(array, NULL, make_text(names[i]));
    return ok;
}

static bool append_beauty(json_t *json, const struct diff_report *report)
{
    const struct comparison *c = report->comparison;
    const struct app_diff *o = &report->options->diff;
    const struct comparison_layer *beauty;
    double rmse, relmse, mae;
    if (!comparison_metric(c, COMPARISON_RMSE, &rmse) ||
        !comparison_metric(c, COMPARISON_RELMSE, &relmse) ||
        !(beauty = comparison_metric(c, COMPARISON_MAE, &mae)))
        return true;
    json_t *flip = json_object();
    bool ok = append(json, "flip", flip) && append(flip, "mean", make_number(c->flip)) &&
              append(flip, "kind", json_string(c->is_hdr ? "hdr" : "ldr")) &&
              append(flip, "ppd", make_number(report->ppd));
    if (c->is_hdr)
        ok = ok && append(flip, "curve", json_string(flip_curve_names[o->curve])) &&
             append(flip, "first_stop", make_number(c->exposures.first)) &&
             append(flip, "last_stop", make_number(c->exposures.last)) &&
             append(flip, "exposures", make_count(c->exposures.count));
    else
        ok = ok && append(flip, "exposure", make_number((double)o->exposure));
    return ok && append(json, "rmse", make_number(rmse)) &&
           append(json, "relmse", make_number(relmse)) && append(json, "mae", make_number(mae)) &&
           append(json, "mae_unclipped",
                  make_number(difference_mae_unclipped(&beauty->difference)));
}

static bool append_layers(json_t *json, const struct comparison *c)
{
    json_t *layers = json_array();
    bool ok = append(json, "layers", layers);
    for (uint32_t i = 0; i < c->layer_count && ok; i++) {
        const struct difference *d = &c->layers[i].difference;
        json_t *layer = json_object();
        ok = append(layers, NULL, layer) && append(layer, "name", make_text(c->layers[i].name)) &&
             append(layer, "rmse", make_number(difference_rmse(d))) &&
             append(layer, "largest", make_number(d->count ? d->largest : (double)NAN)) &&
             append(layer, "values", make_count(d->count)) &&
             append(layer, "not_finite", make_count(d->not_finite));
    }
    return ok;
}

static bool append_exit_code(json_t *json, const struct angle *angle)
{
    const uint64_t one = angle->only_reference + angle->only_test;
    json_t *exit = json_object();
    return append(json, "exit", exit) && append(exit, "pixels", make_count(angle->both)) &&
           append(exit, "mean", make_number(angle->mean)) &&
           append(exit, "median", make_number(angle->median)) &&
           append(exit, "most_95", make_number(angle->percentile_95)) &&
           append(exit, "largest", make_number(angle->largest)) &&
           append(exit, "only_reference", make_count(angle->only_reference)) &&
           append(exit, "only_test", make_count(angle->only_test)) &&
           append(exit, "mismatch", make_number(fraction(one, one + angle->both)));
}

static bool append_tir(json_t *json, const struct comparison *c)
{
    json_t *tir = json_object();
    return append(json, "tir", tir) && append(tir, "pixels", make_count(c->tir_count)) &&
           append(tir, "differs", make_count(c->tir_differs)) &&
           append(tir, "mismatch", make_number(fraction(c->tir_differs, c->tir_count)));
}

static bool fill_json(json_t *json, const struct diff_report *report)
{
    const struct app_options *o = report->options;
    const struct comparison *c = report->comparison;
    bool ok = append(json, "reference", make_text(o->positionals[0])) &&
              append(json, "test", make_text(o->positionals[1])) &&
              append(json, "width", make_count(report->width)) &&
              append(json, "height", make_count(report->height)) &&
              append(json, "pixels", make_count(c->counted)) &&
              (!o->mask.file || append(json, "mask", make_text(o->mask.file))) &&
              append_beauty(json, report) && append_layers(json, c) &&
              (!c->has_exit || append_exit_code(json, &c->angle)) &&
              (!c->has_tir || append_tir(json, c)) &&
              append_names(json, "only_reference", c->only_reference, c->only_reference_count) &&
              append_names(json, "only_test", c->only_test, c->only_test_count);
    json_t *failed = json_array();
    ok = append(json, "failed", failed) && ok;
    for (int i = 0; i < COMPARISON_METRIC_COUNT && ok; i++)
        ok = !report->failed[i] || append(failed, NULL, json_string(comparison_metric_names[i]));
    return ok;
}

bool diff_report_json(const struct diff_report *report, FILE *out)
{
    json_t *json = json_object();
    char *text = fill_json(json, report) ? json_dumps(json, JSON_INDENT(2)) : NULL;
    if (text)
        fprintf(out, "%s\n", text);
    free(text);
    json_decref(json);
    return text != NULL;
}
