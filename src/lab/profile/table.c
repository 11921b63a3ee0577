/* table.c: prints profiles as text tables. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/profile/profile_reports.h"
#include "src/lab/profile/row_aggregation.h"

enum {
    NAME_COLUMNS = 32,
    VALUE_COLUMNS = 10
};

static void print_name(const struct profile_line *line, FILE *out)
{
    char name[PROFILE_NAME_SIZE + 16];
    if (line->row_count > 1) {
        snprintf(name, sizeof(name), "%s x%" PRIu32, line->name, line->row_count);
        fprintf(out, "%-*s", NAME_COLUMNS, name);
    } else {
        fprintf(out, "%-*s", NAME_COLUMNS, line->name);
    }
}

static void print_times(const struct profile_lines *lines, FILE *out)
{
    const double frame = lines->lines[lines->count - 1].summary.mean;
    fprintf(out, "%-*s %8s %8s ± %7s %8s %8s %8s %8s\n", NAME_COLUMNS, "pass", "median", "mean",
            "sigma", "min", "p95", "max", "share");
    for (uint32_t i = 0; i < lines->count; i++) {
        const struct profile_summary *s = &lines->lines[i].summary;
        print_name(&lines->lines[i], out);
        fprintf(out, " %8.3f %8.3f ± %7.3f %8.3f %8.3f %8.3f %6.1f %%\n", s->median, s->mean,
                s->sigma, s->min, s->p95, s->max, frame > 0 ? 100 * s->mean / frame : 0);
    }
}

static void print_work(const struct profile_lines *lines, const struct profile *p, FILE *out)
{
    fprintf(out, "\n%-*s %11s %11s", NAME_COLUMNS, "pass", "targets", "bytes");
    if (p->has_statistics)
        fprintf(out, " %11s %9s %9s %11s", "covered", "vertices", "triangles", "shaded");
    fputc('\n', out);
    for (uint32_t i = 0; i < lines->count; i++) {
        const struct profile_line *line = &lines->lines[i];
        char size[32] = "-";
        if (!line->row || line->row->kind >= PROFILE_HOST)
            continue;
        if (line->row->width > 0)
            snprintf(size, sizeof(size), "%" PRIu32 "x%" PRIu32, line->row->width,
                     line->row->height);
        print_name(line, out);
        fprintf(out, " %11s %11" PRIu64, size, line->target_bytes);
        if (p->has_statistics)
            fprintf(out, " %11" PRIu64 " %9" PRIu64 " %9" PRIu64 " %11" PRIu64, line->covered,
                    line->vertices, line->triangles,
                    line->row->kind == PROFILE_COMPUTE ? line->invocations : line->fragments);
        fputc('\n', out);
    }
    if (p->has_statistics)
        fputs("covered: samples that passed the depth test; shaded: fragments or invocations\n",
              out);
}

static void print_rest(const struct profile *p, FILE *out)
{
    const double mib = 1 << 20;
    fprintf(out, "\nclock: %s%s\n", p->clock,
            strcmp(p->clock, "submits") == 0 ? "; each pass includes a submit" : "");
    fprintf(out, "measurement overhead: %+.1f %%\n", profile_overhead(p) * 100);
    fprintf(out, "setup: scene upload %.3f ms, graph %.3f ms, objects and pipelines %.3f ms\n",
            p->upload, p->compile, p->realise);
    fprintf(out, "first frame: %.3f ms\n", p->first_frame);
    if (p->bvh_triangles)
        fprintf(out, "BVH: %" PRIu32 " triangles, %.3f ms, %.1f MiB\n", p->bvh_triangles, p->bvh_ms,
                (double)p->bvh_size / mib);
    if (p->rays_size)
        fprintf(out, "acceleration structures: %.3f ms, %.1f MiB\n", p->rays,
                (double)p->rays_size / mib);
    fprintf(out, "transient memory: %.1f MiB (%.1f without aliasing, %.1f lower bound)\n",
            (double)p->memory_used / mib, (double)p->memory_without_aliasing / mib,
            (double)p->memory_bound / mib);
    fprintf(out, "persistent memory: %.1f MiB\n", (double)p->memory_persistent / mib);
}

/* Compares two lines for a descending order of medians. */
static int compare_medians(const void *a, const void *b)
{
    const double x = ((const struct profile_line *)a)->summary.median;
    const double y = ((const struct profile_line *)b)->summary.median;
    return (x < y) - (x > y);
}

static enum status print_profile(const struct profile *p, bool slowest_first, FILE *out)
{
    struct profile_lines lines;
    const enum status status = profile_lines_init(&lines, p);
    if (status != STATUS_OK)
        return status;
    if (slowest_first) /* the last line is the frame */
        qsort(lines.lines, lines.count - 1, sizeof(*lines.lines), compare_medians);
    fprintf(out, "%s, %s, %s, %" PRIu32 "x%" PRIu32 "\n%s\n", p->scene, p->refraction, p->material,
            p->width, p->height, p->device);
    fprintf(out, "%" PRIu32 " run%s after %" PRIu32 " warm-up runs; times in ms\n\n", p->run_count,
            p->run_count == 1 ? "" : "s", p->warmup);
    print_times(&lines, out);
    print_work(&lines, p, out);
    print_rest(p, out);
    profile_lines_finish(&lines);
    return STATUS_OK;
}

/* Prints the median times of one pass at all points; "-" where the pass does not exist. */
static void print_medians(const struct profile_lines *points, uint32_t count, const char *name,
                          FILE *out)
{
    fprintf(out, "%-*s", NAME_COLUMNS, name);
    for (uint32_t i = 0; i < count; i++) {
        const struct profile_line *line = profile_line_find(&points[i], name);
        if (line)
            fprintf(out, " %*.3f", VALUE_COLUMNS, line->summary.median);
        else
            fprintf(out, " %*s", VALUE_COLUMNS, "-");
    }
    fputc('\n', out);
}

/* Returns true if one of the points has a line of this name. */
static bool is_known(const struct profile_lines *points, uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++)
        if (profile_line_find(&points[i], name))
            return true;
    return false;
}

static void print_sweep(const struct profile_sweep *sweep, const struct profile_lines *points,
                        FILE *out)
{
    fprintf(out, "median of ms\n");
    for (uint32_t i = 0; i < sweep->parameter_count; i++) {
        fprintf(out, "%-*s", NAME_COLUMNS, sweep->parameters[i].name);
        for (uint32_t k = 0; k < sweep->point_count; k++)
            fprintf(out, " %*s", VALUE_COLUMNS, profile_sweep_value(sweep, k, i));
        fputc('\n', out);
    }
    for (uint32_t i = 0; i < sweep->point_count; i++) {
        for (uint32_t k = 0; k + 1 < points[i].count; k++)
            if (!is_known(points, i, points[i].lines[k].name))
                print_medians(points, sweep->point_count, points[i].lines[k].name, out);
    }
    print_medians(points, sweep->point_count, "frame", out);
}

enum status profile_table(const struct profile_sweep *sweep, FILE *out)
{
    if (sweep->parameter_count == 0)
        return print_profile(sweep->points, sweep->slowest_first, out);
    struct profile_lines *points = calloc(sweep->point_count, sizeof(*points));
    enum status status = points ? STATUS_OK : log_out_of_memory(NULL);
    for (uint32_t i = 0; i < sweep->point_count && status == STATUS_OK; i++)
        status = profile_lines_init(&points[i], &sweep->points[i]);
    if (status == STATUS_OK)
        print_sweep(sweep, points, out);
    for (uint32_t i = 0; i < sweep->point_count && points; i++)
        profile_lines_finish(&points[i]);
    free(points);
    return status;
}
