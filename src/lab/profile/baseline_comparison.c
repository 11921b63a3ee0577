/* baseline_comparison.c: compares a profile with a baseline and tests each line for significance.
 */
#include "src/lab/profile/baseline_comparison.h"
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/profile/row_aggregation.h"
#include "src/lab/profile/table.h"
#include "src/lab/profile/utf8_text.h"

enum {
    NAME_COLUMNS = 30,
    TEXT_SIZE = 1024,
    NUMBER_SIZE = 32
};

static const double significance = 0.01;

/* Line of the comparison table; its name occurs in one or both profiles. */
struct pair {
    char name[PROFILE_TABLE_ROW_NAME_SIZE];
    double *base, *now; /* ascending samples, owned; may be NULL */
    struct profile_ratio ratio;
    double p; /* adjusted for multiple tests */
};

struct comparison {
    const struct profile *base, *now;
    struct pair *pairs;
    uint32_t count, tested;
};

static void note_difference(const char *what, const char *base, const char *now, FILE *out)
{
    char message[TEXT_SIZE];
    if (strcmp(base, now) == 0)
        return;
    snprintf(message, sizeof(message), "warning: different %s: %s in the baseline, %s now", what,
             base, now);
    profile_print_wrapped(message, 2, out);
}

static void note_numbers(const char *what, double base, double now, FILE *out)
{
    char numbers[2][NUMBER_SIZE];
    snprintf(numbers[0], NUMBER_SIZE, "%.9g", base);
    snprintf(numbers[1], NUMBER_SIZE, "%.9g", now);
    note_difference(what, numbers[0], numbers[1], out);
}

static const char *find_setting(const struct profile *p, const char *name)
{
    for (uint32_t i = 0; i < p->setting_count; i++)
        if (strcmp(p->settings[i].name, name) == 0)
            return p->settings[i].value;
    return NULL;
}

static void note_settings(const struct profile *base, const struct profile *now, FILE *out)
{
    static const char none[] = "none";
    for (uint32_t i = 0; i < base->setting_count; i++) {
        const char *value = find_setting(now, base->settings[i].name);
        note_difference(base->settings[i].name, base->settings[i].value, value ? value : none, out);
    }
    for (uint32_t i = 0; i < now->setting_count; i++)
        if (!find_setting(base, now->settings[i].name))
            note_difference(now->settings[i].name, none, now->settings[i].value, out);
}

static void note_differences(const struct profile *base, const struct profile *now, FILE *out)
{
    note_difference("scene", base->scene, now->scene, out);
    note_difference("refraction", base->refraction, now->refraction, out);
    note_difference("material", base->material, now->material, out);
    note_numbers("width", base->width, now->width, out);
    note_numbers("height", base->height, now->height, out);
    note_difference("device", base->device, now->device, out);
    note_difference("driver", base->driver, now->driver, out);
    note_difference("host", base->host, now->host, out);
    note_difference("clock", base->clock, now->clock, out);
    note_numbers("time of the first run", base->time, now->time, out);
    note_numbers("time step", base->time_step, now->time_step, out);
    note_settings(base, now, out);
}

static double *sorted_copy(const double *samples, uint32_t count)
{
    double *copy = calloc(count, sizeof(*copy));
    if (copy) {
        memcpy(copy, samples, count * sizeof(*copy));
        profile_sort(copy, count);
    }
    return copy;
}

/* Adds a line to the table. `base` or `now` is NULL if that profile has no line of this name. */
static bool add_pair(struct comparison *c, const char *name, const double *base, const double *now)
{
    struct pair *pair = &c->pairs[c->count++];
    snprintf(pair->name, sizeof(pair->name), "%s", name);
    pair->base = base ? sorted_copy(base, c->base->run_count) : NULL;
    pair->now = now ? sorted_copy(now, c->now->run_count) : NULL;
    return (!base || pair->base) && (!now || pair->now);
}

static bool is_same(const struct profile_table_row *a, const struct profile_table_row *b, bool each)
{
    return strcmp(a->row->name, b->row->name) == 0 &&
           (!each || a->row->repetition == b->row->repetition);
}

static const struct profile_table_row *find_line(const struct profile_table_rows *lines,
                                                 const struct profile_table_row *like, bool each)
{
    for (uint32_t i = 0; i < lines->count; i++)
        if (is_same(&lines->lines[i], like, each))
            return &lines->lines[i];
    return NULL;
}

/* Adds the lines of `now`, then the lines that only `base` has, then a line for the frame time. */
static bool add_pairs(struct comparison *c, const struct profile_table_rows *base,
                      const struct profile_table_rows *now, bool each)
{
    char name[PROFILE_TABLE_ROW_NAME_SIZE];
    bool ok = true;
    for (uint32_t i = 0; i < now->count && ok; i++) {
        const struct profile_table_row *other = find_line(base, &now->lines[i], each);
        profile_table_row_name(&now->lines[i], name);
        ok = add_pair(c, name, other ? other->ms : NULL, now->lines[i].ms);
    }
    for (uint32_t i = 0; i < base->count && ok; i++) {
        if (find_line(now, &base->lines[i], each))
            continue;
        profile_table_row_name(&base->lines[i], name);
        ok = add_pair(c, name, base->lines[i].ms, NULL);
    }
    return ok && add_pair(c, "frame", c->base->frame, c->now->frame);
}

static bool test_pairs(struct comparison *c)
{
    double *p = calloc(2 * (size_t)c->count, sizeof(*p));
    double *adjusted = p + c->count;
    if (!p)
        return false;
    for (uint32_t i = 0; i < c->count; i++) {
        struct pair *pair = &c->pairs[i];
        if (!pair->base || !pair->now)
            continue;
        const struct profile_pair samples = {
            .a = pair->base,
            .b = pair->now,
            .a_count = c->base->run_count,
            .b_count = c->now->run_count,
        };
        pair->ratio = profile_ratio(&samples);
        p[c->tested++] = profile_mann_whitney(&samples);
    }
    profile_holm(p, adjusted, c->tested);
    for (uint32_t i = 0, test = 0; i < c->count; i++)
        if (c->pairs[i].base && c->pairs[i].now)
            c->pairs[i].p = adjusted[test++];
    free(p);
    return true;
}

static double median_of(const double *samples, const struct profile *p)
{
    return profile_quantile(samples, p->run_count, 0.5);
}

/* Returns 1 if a line is significantly slower, -1 if significantly faster, else 0. */
static int verdict_of(const struct pair *pair, const struct comparison *c)
{
    if (!pair->base || !pair->now || pair->p > significance)
        return 0;
    if (pair->ratio.ratio > 0)
        return pair->ratio.ratio > 1 ? 1 : -1;
    return median_of(pair->now, c->now) > median_of(pair->base, c->base) ? 1 : -1;
}

static void print_factor(double factor, const char *before, const char *after, FILE *out)
{
    char text[NUMBER_SIZE];
    int decimals = 3;
    for (double size = factor; size >= 10 && decimals > 0; size /= 10)
        decimals--;
    if (factor >= 100000)
        snprintf(text, sizeof(text), "%.1e", factor);
    else
        snprintf(text, sizeof(text), "%.*f", decimals, factor);
    fprintf(out, "%s%6s%s", before, text, after);
}

static void print_median(const double *samples, const struct profile *p, int decimals, FILE *out)
{
    if (samples)
        fprintf(out, " %8.*f", decimals, median_of(samples, p));
    else
        fprintf(out, " %8s", "-");
}

static void print_pair(const struct pair *pair, const struct comparison *c, int decimals, FILE *out)
{
    static const char *const verdicts[] = { "faster", "within noise", "slower" };
    profile_print_name(pair->name, NAME_COLUMNS, out);
    print_median(pair->base, c->base, decimals, out);
    print_median(pair->now, c->now, decimals, out);
    if (!pair->base || !pair->now) {
        fprintf(out, "%35s%s\n", "", pair->now ? "new" : "gone");
        return;
    }
    if (pair->ratio.ratio > 0) {
        print_factor(pair->ratio.ratio, " ", " ", out);
        print_factor(pair->ratio.low, "[", ", ", out);
        print_factor(pair->ratio.high, "", "]", out);
    } else {
        fprintf(out, " %6s %16s", "-", "");
    }
    fprintf(out, " %8.2g  %s\n", pair->p, verdicts[1 + verdict_of(pair, c)]);
}

/* Prints a warning if there are too few runs for any difference to be significant. */
static void print_least(const struct comparison *c, FILE *out)
{
    char message[TEXT_SIZE];
    uint32_t runs = 2;
    if (profile_mann_whitney_min(c->base->run_count, c->now->run_count) * c->tested <= significance)
        return;
    while (profile_mann_whitney_min(runs, runs) * c->tested > significance)
        runs++;
    snprintf(message, sizeof(message),
             "With %" PRIu32 " and %" PRIu32 " runs no difference can be significant in %" PRIu32
             " tests: measure at least %" PRIu32 " runs for both.",
             c->base->run_count, c->now->run_count, c->tested, runs);
    profile_print_wrapped(message, 0, out);
}

static void print_table(const struct comparison *c, FILE *out)
{
    const int decimals =
        profile_decimals(fmax(profile_quantile(c->base->frame, c->base->run_count, 1),
                              profile_quantile(c->now->frame, c->now->run_count, 1)));
    char message[TEXT_SIZE];
    profile_print_name("median of ms", NAME_COLUMNS, out);
    fprintf(out, " %8s %8s %6s %16s %8s  %s\n", "baseline", "now", "ratio", "[99 % interval]", "p",
            "verdict");
    for (uint32_t i = 0; i < c->count; i++)
        print_pair(&c->pairs[i], c, decimals, out);
    snprintf(message, sizeof(message),
             "ratio: median of now / baseline over all pairs of runs. p: two-sided Mann-Whitney "
             "test, after Holm's correction for %" PRIu32 " tests; slower and faster: p is "
             "at most %g. Runs: %" PRIu32 ", %" PRIu32 ".",
             c->tested, significance, c->base->run_count, c->now->run_count);
    profile_print_wrapped(message, 0, out);
    print_least(c, out);
}

static void comparison_finish(struct comparison *c)
{
    for (uint32_t i = 0; i < c->count; i++) {
        free(c->pairs[i].base);
        free(c->pairs[i].now);
    }
    free(c->pairs);
}

enum status profile_compare(const struct profile *base, const struct profile *now, bool each,
                            FILE *out, bool *is_slower)
{
    struct profile_table_rows base_lines = { 0 }, now_lines = { 0 };
    struct comparison c = { .base = base, .now = now };
    enum status status = profile_table_rows_init(&base_lines, base, each);
    bool any = false;

    if (status == STATUS_OK)
        status = profile_table_rows_init(&now_lines, now, each);
    if (status != STATUS_OK)
        goto fail;
    c.pairs = calloc((size_t)base_lines.count + now_lines.count + 1, sizeof(*c.pairs));
    if (!c.pairs || !add_pairs(&c, &base_lines, &now_lines, each) || !test_pairs(&c)) {
        status = log_out_of_memory(NULL);
        goto fail;
    }
    note_differences(base, now, out);
    print_table(&c, out);
    for (uint32_t i = 0; i < c.count; i++)
        any = any || verdict_of(&c.pairs[i], &c) > 0;
    if (is_slower)
        *is_slower = any;
fail:
    comparison_finish(&c);
    profile_table_rows_finish(&base_lines);
    profile_table_rows_finish(&now_lines);
    return status;
}
