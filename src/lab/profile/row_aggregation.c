/* row_aggregation.c: aggregates the rows of a profile into table lines. */
#include "src/lab/profile/row_aggregation.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

struct profile_line *profile_line_find(const struct profile_lines *lines, const char *name)
{
    for (uint32_t i = 0; i < lines->count; i++)
        if (strcmp(lines->lines[i].name, name) == 0)
            return &lines->lines[i];
    return NULL;
}

/* Adds samples to the line of this name, which is created if needed. Returns NULL if out of memory.
 */
static struct profile_line *add_samples(struct profile_lines *lines, const char *name,
                                        const double *ms, uint32_t run_count)
{
    struct profile_line *line = profile_line_find(lines, name);
    if (!line) {
        line = &lines->lines[lines->count];
        line->name = name;
        line->ms = calloc(run_count, sizeof(*line->ms));
        if (!line->ms)
            return NULL;
        lines->count++;
    }
    for (uint32_t run = 0; run < run_count; run++)
        line->ms[run] += ms[run];
    return line;
}

static bool add_row(struct profile_lines *lines, const struct profile *p, uint32_t index)
{
    const struct profile_row *row = &p->rows[index];
    struct profile_line *line = add_samples(lines, row->name, row->ms, p->run_count);
    if (!line)
        return false;
    if (!line->row)
        line->row = row;
    line->row_count++;
    line->target_bytes += row->target_bytes;
    line->vertices += row->vertices;
    line->triangles += row->triangles;
    line->fragments += row->fragments;
    line->invocations += row->invocations;
    line->covered += row->covered;
    return true;
}

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum status profile_lines_init(struct profile_lines *lines, const struct profile *p)
{
    *lines = (struct profile_lines){
        .lines = calloc((size_t)p->row_count + 1, sizeof(*lines->lines)),
    };
    bool ok = lines->lines;
    for (uint32_t i = 0; i < p->row_count && ok; i++)
        ok = add_row(lines, p, i);
    if (!ok || !add_samples(lines, "frame", p->frame, p->run_count)) {
        profile_lines_finish(lines);
        return log_out_of_memory(NULL);
    }
    for (uint32_t i = 0; i < lines->count; i++) {
        struct profile_line *line = &lines->lines[i];
        qsort(line->ms, p->run_count, sizeof(*line->ms), compare_numbers);
        line->summary = profile_summarize(line->ms, p->run_count);
    }
    return STATUS_OK;
}

void profile_lines_finish(struct profile_lines *lines)
{
    for (uint32_t i = 0; i < lines->count; i++)
        free(lines->lines[i].ms);
    free(lines->lines);
    *lines = (struct profile_lines){ 0 };
}

double profile_overhead(const struct profile *p)
{
    const double frame = profile_summarize(p->frame, p->run_count).median;
    const double plain = profile_summarize(p->plain, p->run_count).median;
    return plain > 0 ? frame / plain - 1 : 0;
}
