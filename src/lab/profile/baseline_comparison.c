/* baseline_comparison.c: compares a profile with a baseline and tests each line for significance.
 */
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/profile/profile_reports.h"
#include "src/lab/profile/row_aggregation.h"

static const double significance = 0.01;

static void note_difference(const char *what, const char *base, const char *now, FILE *out)
{
    if (strcmp(base, now) != 0)
        fprintf(out, "warning: different %s: %s in the baseline, %s now\n", what, base, now);
}

static void note_numbers(const char *what, double base, double now, FILE *out)
{
    char numbers[2][32];
    snprintf(numbers[0], sizeof(numbers[0]), "%.9g", base);
    snprintf(numbers[1], sizeof(numbers[1]), "%.9g", now);
    note_difference(what, numbers[0], numbers[1], out);
}

static const char *find_setting(const struct profile *p, const char *name)
{
    for (uint32_t i = 0; i < p->setting_count; i++)
        if (strcmp(p->settings[i].name, name) == 0)
            return p->settings[i].value;
    return NULL;
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
    for (uint32_t i = 0; i < now->setting_count; i++) {
        const char *value = find_setting(base, now->settings[i].name);
        note_difference(now->settings[i].name, value ? value : "none", now->settings[i].value, out);
    }
}

struct comparison {
    struct profile_pair pair; /* the counts; the samples are those of the line being compared */
    uint32_t tested;          /* number of tests */
    double threshold;         /* smallest relevant change, fraction of the baseline */
    uint32_t slower_count;
};

/* Returns the verdict on a line, whose test has the corrected p-value `p`. */
static const char *judge(const struct comparison *c, double before, double after, double p)
{
    if (p > significance || after == before)
        return "within noise";
    if (fabs(after - before) < c->threshold * fabs(before))
        return "below threshold";
    return after > before ? "slower" : "faster";
}

/* Prints a line that both profiles have. Counts it in `c` if it is slower. */
static void print_pair(struct comparison *c, const struct profile_line *base,
                       const struct profile_line *now, FILE *out)
{
    const double before = base->summary.median, after = now->summary.median;
    c->pair.a = base->ms;
    c->pair.b = now->ms;
    const double p = fmin(1, profile_mann_whitney(&c->pair) * c->tested);
    const char *verdict = judge(c, before, after, p);
    c->slower_count += !strcmp(verdict, "slower");
    fprintf(out, "%-32s %10.3f %10.3f", now->name, before, after);
    if (before > 0 && after > 0)
        fprintf(out, " %8.3f", after / before);
    else
        fprintf(out, " %8s", "-");
    fprintf(out, " %8.2g  %s\n", p, verdict);
}

static void print_table(struct comparison *c, const struct profile_lines *base,
                        const struct profile_lines *now, FILE *out)
{
    for (uint32_t i = 0; i < now->count; i++)
        c->tested += profile_line_find(base, now->lines[i].name) != NULL;
    fprintf(out, "%-32s %10s %10s %8s %8s  %s\n", "median of ms", "baseline", "now", "ratio", "p",
            "verdict");
    for (uint32_t i = 0; i < now->count; i++) {
        const struct profile_line *line = &now->lines[i];
        const struct profile_line *before = profile_line_find(base, line->name);
        if (before)
            print_pair(c, before, line, out);
        else
            fprintf(out, "%-32s %10s %10.3f %19s new\n", line->name, "-", line->summary.median, "");
    }
    for (uint32_t i = 0; i < base->count; i++) {
        const struct profile_line *line = &base->lines[i];
        if (!profile_line_find(now, line->name))
            fprintf(out, "%-32s %10.3f %10s %19s gone\n", line->name, line->summary.median, "-",
                    "");
    }
    fprintf(out,
            "p: two-sided Mann-Whitney test, multiplied by the number of tests, %" PRIu32
            ";\nslower and faster: p is at most %g and the medians differ by at least %g %%.\n"
            "Runs: %" PRIu32 ", %" PRIu32 ". Slower rows: %" PRIu32 ".\n",
            c->tested, significance, 100 * c->threshold, c->pair.a_count, c->pair.b_count,
            c->slower_count);
}

/* Logs an error if no difference can be significant, however large it is. */
static enum status check_run_counts(const struct comparison *c)
{
    uint32_t needed = 1;
    if (profile_mann_whitney_min(c->pair.a_count, c->pair.b_count) * c->tested <= significance)
        return STATUS_OK;
    while (profile_mann_whitney_min(needed, needed) * c->tested > significance)
        needed++;
    log_error("--baseline: %" PRIu32 " and %" PRIu32 " runs are too few to find any difference; "
              "measure both profiles with at least --runs %" PRIu32,
              c->pair.a_count, c->pair.b_count, needed);
    return STATUS_USAGE;
}

enum status profile_compare(const struct profile *base, const struct profile *now, double threshold,
                            FILE *out, bool *is_slower)
{
    struct profile_lines base_lines, now_lines;
    struct comparison c = {
        .pair = { .a_count = base->run_count, .b_count = now->run_count },
        .threshold = threshold,
    };
    enum status status = profile_lines_init(&base_lines, base);
    if (status != STATUS_OK)
        return status;
    status = profile_lines_init(&now_lines, now);
    if (status == STATUS_OK) {
        note_differences(base, now, out);
        print_table(&c, &base_lines, &now_lines, out);
        *is_slower = c.slower_count > 0;
        status = check_run_counts(&c);
    }
    profile_lines_finish(&base_lines);
    profile_lines_finish(&now_lines);
    return status;
}
