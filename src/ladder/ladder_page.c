/* ladder_page.c: writes table, plot and contact sheet as one self-contained HTML file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/ladder/ladder_report.h"

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width\">\n<title>firn ladder</title>\n"
    "<style>\n:root{color-scheme:light dark}\n"
    "body{font:15px/1.5 sans-serif;max-width:76rem;margin:1.5rem auto;padding:0 1rem}\n"
    "table{border-collapse:collapse}\nth,td{padding:.25rem .8rem;text-align:right;"
    "border-bottom:1px solid rgb(128 128 128/.4)}\nth:first-child,td:first-child{text-align:left}\n"
    "svg,img{max-width:100%;height:auto;display:block}\nsvg{max-width:48rem}\n"
    "code{overflow-wrap:anywhere}\n</style>\n";

/* Writes a text with HTML's special characters escaped; names of files may have any characters. */
static void put_text(const char *text, FILE *out)
{
    for (; *text; text++) {
        if (*text == '<' || *text == '&' || *text == '>')
            fprintf(out, "&#%d;", *text);
        else
            putc((unsigned char)*text < ' ' ? ' ' : *text, out);
    }
}

/* Writes data in base64 (RFC 4648). */
static void put_base64(const uint8_t *data, size_t size, FILE *out)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const uint32_t bits = (uint32_t)data[i] << 16 |
                              (left > 1 ? (uint32_t)data[i + 1] << 8 : 0) |
                              (left > 2 ? (uint32_t)data[i + 2] : 0);
        putc(digits[bits >> 18], out);
        putc(digits[bits >> 12 & 63], out);
        putc(left > 1 ? digits[bits >> 6 & 63] : '=', out);
        putc(left > 2 ? digits[bits & 63] : '=', out);
    }
}

static void put_number(double number, int digits, FILE *out)
{
    if (isnan(number))
        fputs("<td>–", out);
    else
        fprintf(out, "<td>%.*f", digits, number);
}

static void put_table(const struct ladder *ladder, FILE *out)
{
    fputs("<table>\n<tr><th>rung<th>FLIP<th>MAE<th>refracted<th>reflected<th>trapped<th>RMSE<th>"
          "degrees<th>95 %<th>other class"
          "<th>ms<th>cost\n",
          out);
    for (uint32_t i = 0; i < ladder->rung_count; i++) {
        const struct ladder_rung *rung = &ladder->rungs[i];
        const struct ladder_error *e = &rung->error;
        fprintf(out, "<tr><td>%s", rung->rung->rung.name);
        put_number(e->flip, 4, out);
        put_number(e->mae, 4, out);
        for (int c = 0; c < LADDER_CAUSE_COUNT; c++)
            put_number(e->cause_mae[c], 4, out);
        put_number(e->rmse, 4, out);
        put_number(e->angle, 3, out);
        put_number(e->angle_95, 3, out);
        put_number(100.0 * e->tir_differs, 1, out);
        fputs(isnan(e->tir_differs) ? "" : " %", out);
        put_number(rung->cost > 0.0 ? rung->cost : (double)NAN, 2, out);
        put_number(ladder_cost_ratio(ladder, rung), 2, out);
        putc('\n', out);
    }
    fputs("</table>\n", out);
}

static void put_head(const struct ladder_report *report, FILE *out)
{
    const struct ladder *l = report->ladder;
    fputs(head, out);
    fputs("<h1>Error of each refraction rung against the ray traced reference</h1>\n<p><code>",
          out);
    put_text(report->command, out);
    fprintf(out,
            "</code>\n<p>%u × %u pixels; the object covers %llu, %llu of them without total "
            "reflection. Reference: ",
            l->width, l->height, (unsigned long long)l->object_count,
            (unsigned long long)l->straight_count);
    put_text(l->tracer, out);
    fprintf(out, ", %.1f s.", l->reference_cost * 1e-3);
    if (report->device) {
        fputs(" Rungs: ", out);
        put_text(report->device, out);
        putc('.', out);
    }
    putc('\n', out);
}

static const char notes[] =
    "<p>FLIP: over all pixels. MAE (clipped to 0 and 1) and RMSE: over the object's pixels. "
    "Refracted, reflected, trapped: MAE of the pixels whose light is totally reflected never, "
    "once, "
    "or more often before it leaves. Degrees: mean and 95th percentile of the angle between the "
    "exit directions, where there is no "
    "total reflection. Other class: pixels with total reflection in only one of the two pictures. "
    "Cost: median frame time relative to ";

static void put_page(const struct ladder_report *report, const char *svg, const uint8_t *sheet,
                     size_t sheet_size, FILE *out)
{
    const struct ladder_rung *base = ladder_base(report->ladder);
    put_head(report, out);
    put_table(report->ladder, out);
    fprintf(out, "%s%s, frames of all rungs in turns.\n%s<h2>Pictures</h2>\n", notes,
            base->rung->rung.name, base->cost > 0.0 ? svg : "");
    fputs("<p>Each picture is followed by its FLIP error, in the colours of the scale.\n<img "
          "alt=\"contact sheet\" src=\"data:image/png;base64,",
          out);
    put_base64(sheet, sheet_size, out);
    fputs("\">\n</html>\n", out);
}

enum status ladder_page(const struct ladder_report *report, char **text, size_t *size)
{
    void *sheet = NULL;
    char *svg = NULL;
    size_t sheet_size = 0, svg_size;
    *text = NULL;
    enum status status = ladder_sheet(report, &sheet, &sheet_size);
    if (status == STATUS_OK)
        status = ladder_svg(report, &svg, &svg_size);
    FILE *out = status == STATUS_OK ? open_memstream(text, size) : NULL;
    if (out)
        put_page(report, svg, sheet, sheet_size, out);
    if (status == STATUS_OK && (!out || fclose(out))) {
        free(*text);
        *text = NULL;
        status = log_out_of_memory(NULL);
    }
    free(svg);
    free(sheet);
    return status;
}
