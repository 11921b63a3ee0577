/* csv.c: writes profiles as comma-separated values. */
#include <inttypes.h>
#include <string.h>
#include "src/lab/profile/json_fields.h"
#include "src/lab/profile/profile_reports.h"
#include "src/lab/profile/row_aggregation.h"

static void write_text(const char *text, FILE *out)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fprintf(out, "%s,", text);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    fputs("\",", out);
}

static void write_samples(const struct profile *p, FILE *out)
{
    fputs("run,row,technique,repetition,kind,ms,begin_ms,record_ms\r\n", out);
    for (uint32_t run = 0; run < p->run_count; run++) {
        for (uint32_t i = 0; i < p->row_count; i++) {
            const struct profile_row *row = &p->rows[i];
            fprintf(out, "%" PRIu32 ",", run);
            write_text(row->name, out);
            write_text(row->technique, out);
            fprintf(out, "%" PRIu32 ",%s,%.17g,%.17g,%.17g\r\n", row->repetition,
                    profile_kind_names[row->kind], row->ms[run], row->begin_ms[run],
                    row->record_ms[run]);
        }
        fprintf(out, "%" PRIu32 ",frame,,0,whole,%.17g,0,0\r\n", run, p->frame[run]);
        fprintf(out, "%" PRIu32 ",plain,,0,whole,%.17g,0,0\r\n", run, p->plain[run]);
        fprintf(out, "%" PRIu32 ",wait,,0,whole,%.17g,0,0\r\n", run, p->wait[run]);
    }
}

static enum status write_medians(const struct profile_sweep *sweep, uint32_t point, FILE *out)
{
    struct profile_lines lines;
    const enum status status = profile_lines_init(&lines, &sweep->points[point]);
    for (uint32_t i = 0; i < lines.count; i++) {
        for (uint32_t k = 0; k < sweep->parameter_count; k++)
            write_text(profile_sweep_value(sweep, point, k), out);
        write_text(lines.lines[i].name, out);
        fprintf(out, "%.17g\r\n", lines.lines[i].summary.median);
    }
    profile_lines_finish(&lines);
    return status;
}

enum status profile_csv(const struct profile_sweep *sweep, FILE *out)
{
    enum status status = STATUS_OK;
    if (sweep->parameter_count == 0) {
        write_samples(sweep->points, out);
        return STATUS_OK;
    }
    for (uint32_t i = 0; i < sweep->parameter_count; i++)
        write_text(sweep->parameters[i].name, out);
    fputs("row,median_ms\r\n", out);
    for (uint32_t i = 0; i < sweep->point_count && status == STATUS_OK; i++)
        status = write_medians(sweep, i, out);
    return status;
}
