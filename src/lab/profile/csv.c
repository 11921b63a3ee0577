/* csv.c: writes a profile's samples as comma-separated values. */
#include "src/lab/profile/csv.h"
#include <inttypes.h>
#include <locale.h>
#include <string.h>
#include "src/lab/profile/json_key_tables.h"

static void write_text(const char *text, FILE *out)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

static void write_number(double number, const char *end, FILE *out)
{
    const char *point = localeconv()->decimal_point;
    char text[64];
    snprintf(text, sizeof(text), "%.17g", number);
    char *at = strstr(text, point);
    if (at)
        fprintf(out, "%.*s.%s%s", (int)(at - text), text, at + strlen(point), end);
    else
        fprintf(out, "%s%s", text, end);
}

static void write_row(const struct profile_row *row, uint32_t run, FILE *out)
{
    fprintf(out, "%" PRIu32 ",", run);
    write_text(row->name, out);
    fputc(',', out);
    write_text(row->technique, out);
    fprintf(out, ",%" PRIu32 ",%s,", row->repetition, profile_kind_names[row->kind]);
    write_number(row->ms[run], ",", out);
    write_number(row->begin_ms[run], ",", out);
    write_number(row->record_ms[run], "\r\n", out);
}

static void write_frame_row(const char *name, double ms, uint32_t run, FILE *out)
{
    fprintf(out, "%" PRIu32 ",%s,,0,whole,", run, name);
    write_number(ms, ",0,0\r\n", out);
}

void profile_csv(const struct profile *p, FILE *out)
{
    fputs("run,row,technique,repetition,kind,ms,begin_ms,record_ms\r\n", out);
    for (uint32_t run = 0; run < p->run_count; run++) {
        for (uint32_t i = 0; i < p->row_count; i++)
            write_row(&p->rows[i], run, out);
        write_frame_row("frame", p->frame[run], run, out);
        write_frame_row("plain", p->plain[run], run, out);
        write_frame_row("wait", p->wait[run], run, out);
    }
}
