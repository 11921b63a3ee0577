/* table.c: prints a profile as a text table. */
#include "src/lab/profile/table.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include "src/lab/profile/row_aggregation.h"
#include "src/lab/profile/utf8_text.h"

enum {
    NAME_COLUMNS = 32,
    MAX_OUTLIERS = 8,
    TEXT_SIZE = 1024
};

int profile_decimals(double greatest)
{
    if (greatest >= 1000)
        return greatest >= 10000 ? 0 : 1;
    if (greatest >= 100)
        return 2;
    return greatest >= 10 ? 3 : 4;
}

static void print_heading(const struct profile *p, FILE *out)
{
    char text[TEXT_SIZE];
    snprintf(text, sizeof(text), "%s, %s, %s, %" PRIu32 "x%" PRIu32 ", on %s", p->scene,
             p->refraction, p->material, p->width, p->height, p->device);
    profile_print_wrapped(text, 2, out);
    snprintf(text, sizeof(text), "%" PRIu32 " run%s after %" PRIu32 " warm-up runs; times in ms",
             p->run_count, p->run_count == 1 ? "" : "s", p->warmup);
    profile_print_wrapped(text, 2, out);
}

static void print_summary(const char *name, const struct profile_summary *s, double fraction,
                          int decimals, FILE *out)
{
    profile_print_name(name, NAME_COLUMNS, out);
    fprintf(out, " %8.*f %8.*f ± %7.*f %8.*f %8.*f %8.*f %6.1f %%\n", decimals, s->median, decimals,
            s->mean, decimals, s->sigma, decimals, s->min, decimals, s->p95, decimals, s->max,
            fraction * 100);
}

static void print_times(const struct profile_table_rows *lines, FILE *out)
{
    const int decimals = profile_decimals(lines->frame.max);
    char name[PROFILE_TABLE_ROW_NAME_SIZE];
    profile_print_name("pass", NAME_COLUMNS, out);
    fprintf(out, " %8s %8s ± %7s %8s %8s %8s %8s\n", "median", "mean", "sigma", "min", "p95", "max",
            "share");
    for (uint32_t i = 0; i < lines->count; i++) {
        const struct profile_table_row *line = &lines->lines[i];
        profile_table_row_name(line, name);
        print_summary(name, &line->summary, line->fraction, decimals, out);
    }
    print_summary("frame", &lines->frame, lines->frame.mean > 0 ? 1 : 0, decimals, out);
}

/* Prints a count with a unit prefix, or "-" if the count is 0. */
static void print_count(uint64_t count, int columns, FILE *out)
{
    static const char units[] = { 'M', 'G', 'T', 'P', 'E' };
    size_t unit = 0;
    double scaled = (double)count / 1e6;
    if (count == 0) {
        fprintf(out, " %*s", columns, "-");
    } else if (count < 10000000) {
        fprintf(out, " %*" PRIu64, columns, count);
    } else {
        for (; scaled >= 1000 && unit + 1 < sizeof(units); unit++)
            scaled /= 1000;
        fprintf(out, " %*.2f %c", columns - 2, scaled, units[unit]);
    }
}

static void print_work_of(const struct profile_table_row *line, const struct profile *p, FILE *out)
{
    char name[PROFILE_TABLE_ROW_NAME_SIZE], size[32] = "-";
    profile_table_row_name(line, name);
    profile_print_name(name, NAME_COLUMNS, out);
    if (line->row->width > 0)
        snprintf(size, sizeof(size), "%" PRIu32 "x%" PRIu32, line->row->width, line->row->height);
    fprintf(out, " %11s", size);
    print_count(line->target_bytes, 9, out);
    if (p->has_statistics) {
        const bool computes = line->row->kind == PROFILE_COMPUTE;
        print_count(line->covered, 10, out);
        print_count(line->vertices, 9, out);
        print_count(line->triangles, 9, out);
        print_count(computes ? line->invocations : line->fragments, 10, out);
    }
    fputc('\n', out);
}

static void print_work(const struct profile_table_rows *lines, const struct profile *p, FILE *out)
{
    fputc('\n', out);
    profile_print_name("pass", NAME_COLUMNS, out);
    fprintf(out, " %11s %9s", "targets", "bytes");
    if (p->has_statistics)
        fprintf(out, " %10s %9s %9s %10s", "covered", "vertices", "triangles", "shaded");
    fputc('\n', out);
    for (uint32_t i = 0; i < lines->pass_count; i++)
        print_work_of(&lines->lines[i], p, out);
    if (p->has_statistics)
        fputs("covered: samples that passed the depth test; shaded: fragments or invocations\n",
              out);
}

/* Sample outside the Tukey fences of its table line. */
struct outlier {
    const struct profile_table_row *line;
    uint32_t run;
};

static double excess(const struct outlier *outlier)
{
    return fabs(outlier->line->ms[outlier->run] - outlier->line->summary.median);
}

/* Inserts an outlier into the descending list `worst` of largest outliers. Returns count + 1. */
static uint32_t add_outlier(struct outlier *worst, uint32_t count, struct outlier outlier)
{
    uint32_t at = count < MAX_OUTLIERS ? count : MAX_OUTLIERS;
    while (at > 0 && excess(&worst[at - 1]) < excess(&outlier)) {
        if (at < MAX_OUTLIERS)
            worst[at] = worst[at - 1];
        at--;
    }
    if (at < MAX_OUTLIERS)
        worst[at] = outlier;
    return count + 1;
}

static void print_outlier(const struct outlier *outlier, FILE *out)
{
    const double ms = outlier->line->ms[outlier->run], median = outlier->line->summary.median;
    char name[PROFILE_TABLE_ROW_NAME_SIZE], text[TEXT_SIZE], times[32] = "";
    profile_table_row_name(outlier->line, name);
    if (median > 0)
        snprintf(times, sizeof(times), ", %.1fx its median", ms / median);
    snprintf(text, sizeof(text), "run %" PRIu32 ": %s %.*f ms%s", outlier->run, name,
             profile_decimals(ms), ms, times);
    profile_print_wrapped(text, 2, out);
}

/* Prints outliers that deviate from the line's median by more than 1 % of the frame time. */
static void print_outliers(const struct profile_table_rows *lines, uint32_t run_count, FILE *out)
{
    struct outlier worst[MAX_OUTLIERS];
    uint32_t count = 0;
    for (uint32_t i = 0; i < lines->count; i++) {
        const struct profile_table_row *line = &lines->lines[i];
        const struct profile_fences fences = profile_fences(line->ms, run_count);
        for (uint32_t run = 0; run < run_count; run++) {
            const struct outlier outlier = { line, run };
            const bool is_outside = line->ms[run] < fences.low || line->ms[run] > fences.high;
            if (is_outside && excess(&outlier) > 0.01 * lines->frame.median)
                count = add_outlier(worst, count, outlier);
        }
    }
    fprintf(out, "outliers (runs count from 0):%s\n", count ? "" : " none");
    for (uint32_t i = 0; i < count && i < MAX_OUTLIERS; i++)
        print_outlier(&worst[i], out);
    if (count > MAX_OUTLIERS)
        fprintf(out, "and %" PRIu32 " smaller ones\n", count - MAX_OUTLIERS);
}

static void print_rest(const struct profile_table_rows *lines, const struct profile *p, FILE *out)
{
    const double frame = lines->frame.median, plain = lines->plain.median;
    char text[TEXT_SIZE];

    const bool is_submits = strcmp(p->clock, "submits") == 0;
    fprintf(out, "clock: %s\n", is_submits ? "submits; each pass includes a submit" : p->clock);
    fprintf(
        out, "measurement overhead: %+.1f %% (median frame %.*f ms, without measurement %.*f ms)\n",
        profile_overhead(p) * 100, profile_decimals(frame), frame, profile_decimals(plain), plain);
    snprintf(text, sizeof(text),
             "setup: scene upload %.*f ms, graph %.*f ms, objects and pipelines %.*f ms, first "
             "frame %.*f ms",
             profile_decimals(p->upload), p->upload, profile_decimals(p->compile), p->compile,
             profile_decimals(p->realise), p->realise, profile_decimals(p->first_frame),
             p->first_frame);
    profile_print_wrapped(text, 2, out);
    if (p->bvh_triangles) {
        snprintf(text, sizeof(text), "BVH: %u triangles, %.*f ms, %.1f MiB", p->bvh_triangles,
                 profile_decimals(p->bvh_ms), p->bvh_ms, (double)p->bvh_size / (1 << 20));
        profile_print_wrapped(text, 2, out);
    }
    if (p->rays_size) {
        snprintf(text, sizeof(text), "acceleration structures: %.*f ms, %.1f MiB",
                 profile_decimals(p->rays), p->rays, (double)p->rays_size / (1 << 20));
        profile_print_wrapped(text, 2, out);
    }
    snprintf(text, sizeof(text),
             "memory: %" PRIu64 " bytes transient (%" PRIu64 " without aliasing, %" PRIu64
             " lower bound), %" PRIu64 " persistent",
             p->memory_used, p->memory_without_aliasing, p->memory_bound, p->memory_persistent);
    profile_print_wrapped(text, 2, out);
    print_outliers(lines, p->run_count, out);
}

enum status profile_table(const struct profile *p, bool each, FILE *out)
{
    struct profile_table_rows lines;
    const enum status status = profile_table_rows_init(&lines, p, each);
    if (status != STATUS_OK)
        return status;
    print_heading(p, out);
    fputc('\n', out);
    print_times(&lines, out);
    print_work(&lines, p, out);
    fputc('\n', out);
    print_rest(&lines, p, out);
    profile_table_rows_finish(&lines);
    return STATUS_OK;
}
