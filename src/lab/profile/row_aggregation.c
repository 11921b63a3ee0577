/* row_aggregation.c: aggregates the rows of a profile into table lines. */
#include "src/lab/profile/row_aggregation.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

static struct profile_table_row *find_line(struct profile_table_rows *lines, const char *name)
{
    for (uint32_t i = 0; i < lines->count; i++)
        if (strcmp(lines->lines[i].row->name, name) == 0)
            return &lines->lines[i];
    return NULL;
}

static bool add_row(struct profile_table_rows *lines, const struct profile *p, uint32_t index,
                    bool each)
{
    const struct profile_row *row = &p->rows[index];
    struct profile_table_row *line = each ? NULL : find_line(lines, row->name);
    if (!line) {
        line = &lines->lines[lines->count];
        line->row = row;
        line->ms = calloc(p->run_count, sizeof(*line->ms));
        if (!line->ms)
            return false;
        lines->count++;
        lines->pass_count += index < p->pass_count;
    }
    for (uint32_t run = 0; run < p->run_count; run++)
        line->ms[run] += row->ms[run];
    line->row_count++;
    line->target_bytes += row->target_bytes;
    line->vertices += row->vertices;
    line->triangles += row->triangles;
    line->fragments += row->fragments;
    line->invocations += row->invocations;
    line->covered += row->covered;
    return true;
}

enum status profile_table_rows_init(struct profile_table_rows *lines, const struct profile *p,
                                    bool each)
{
    *lines = (struct profile_table_rows){
        .lines = calloc(p->row_count, sizeof(*lines->lines)),
        .frame = profile_summarize(p->frame, p->run_count),
        .plain = profile_summarize(p->plain, p->run_count),
    };
    bool ok = lines->lines;
    for (uint32_t i = 0; i < p->row_count && ok; i++)
        ok = add_row(lines, p, i, each);
    if (!ok) {
        profile_table_rows_finish(lines);
        return log_out_of_memory(NULL);
    }
    for (uint32_t i = 0; i < lines->count; i++) {
        struct profile_table_row *line = &lines->lines[i];
        line->summary = profile_summarize(line->ms, p->run_count);
        line->fraction = lines->frame.mean > 0 ? line->summary.mean / lines->frame.mean : 0;
    }
    return STATUS_OK;
}

void profile_table_rows_finish(struct profile_table_rows *lines)
{
    for (uint32_t i = 0; i < lines->count; i++)
        free(lines->lines[i].ms);
    free(lines->lines);
    *lines = (struct profile_table_rows){ 0 };
}

void profile_table_row_name(const struct profile_table_row *line,
                            char name[static PROFILE_TABLE_ROW_NAME_SIZE])
{
    const struct profile_row *row = line->row;
    if (line->row_count > 1)
        snprintf(name, PROFILE_TABLE_ROW_NAME_SIZE, "%s x%" PRIu32, row->name, line->row_count);
    else if (row->repetition_count > 1)
        snprintf(name, PROFILE_TABLE_ROW_NAME_SIZE, "%s [%" PRIu32 "]", row->name, row->repetition);
    else
        snprintf(name, PROFILE_TABLE_ROW_NAME_SIZE, "%s", row->name);
}

double profile_overhead(const struct profile *p)
{
    const double frame = profile_summarize(p->frame, p->run_count).median;
    const double plain = profile_summarize(p->plain, p->run_count).median;
    return plain > 0 ? frame / plain - 1 : 0;
}
