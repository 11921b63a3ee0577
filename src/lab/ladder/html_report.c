/* html_report.c: writes table, plot, image slider and contact sheet as one HTML file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/png.h"
#include "src/lab/ladder/comparison_report.h"

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width\">\n<title>firn ladder</title>\n"
    "<style>\n:root{color-scheme:light dark}\n"
    "body{font:15px/1.5 sans-serif;max-width:76rem;margin:1.5rem auto;padding:0 1rem}\n"
    "table{border-collapse:collapse}\nth,td{padding:.25rem .8rem;text-align:right;"
    "border-bottom:1px solid rgb(128 128 128/.4)}\nth:first-child,td:first-child{text-align:left}\n"
    "svg,img{max-width:100%;height:auto;display:block}\nsvg{max-width:48rem}\n"
    "code{overflow-wrap:anywhere}\n"
    "#ab{position:relative;width:fit-content;max-width:100%;overflow:hidden;cursor:ew-resize;"
    "touch-action:pan-y}\n"
    "#ab .rung{position:absolute;inset:0;clip-path:inset(0 calc(100% - var(--at)) 0 0)}\n"
    "#ab::after{content:\"\";position:absolute;inset:0 auto 0 var(--at);border-left:1px solid #fff;"
    "mix-blend-mode:difference}\n"
    "#ab [hidden]{display:none}\n"
    "#at{width:16rem;vertical-align:middle}\nlabel{margin-right:1.5rem}\n</style>\n";

/* Script of the image slider. The mouse or the keyboard (range input) moves the divider. */
static const char script[] =
    "<script>\n\"use strict\";\n"
    "const ab = document.getElementById(\"ab\"), at = document.getElementById(\"at\");\n"
    "const rung = document.getElementById(\"rung\"), says = document.getElementById(\"says\");\n"
    "function show() {\n"
    "  ab.style.setProperty(\"--at\", at.value + \"%\");\n"
    "  for (const image of ab.querySelectorAll(\".rung\"))\n"
    "    image.hidden = image.alt !== rung.value;\n"
    "  says.textContent = rung.selectedOptions[0].dataset.says;\n"
    "}\n"
    "ab.addEventListener(\"pointermove\", event => {\n"
    "  const box = ab.getBoundingClientRect();\n"
    "  at.value = 100 * (event.clientX - box.left) / box.width;\n"
    "  show();\n"
    "});\n"
    "at.addEventListener(\"input\", show);\n"
    "rung.addEventListener(\"input\", show);\n"
    "show();\n</script>\n";

/* In-memory PNG of the reference or of a refraction model. */
struct encoded {
    void *data;
    size_t size;
};

/* Writes text with HTML escapes, since file names may contain any character. */
static void write_escaped(const char *text, FILE *out)
{
    for (; *text; text++) {
        if (*text == '<' || *text == '&' || *text == '>')
            fprintf(out, "&#%d;", *text);
        else
            putc((unsigned char)*text < ' ' ? ' ' : *text, out);
    }
}

/* Writes data in base64 (RFC 4648). */
static void write_base64(const uint8_t *data, size_t size, FILE *out)
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

static void write_number(double number, int digits, FILE *out)
{
    if (isnan(number))
        fputs("<td>–", out);
    else
        fprintf(out, "<td>%.*f", digits, number);
}

static void write_table(const struct ladder *ladder, FILE *out)
{
    fputs("<table>\n<tr><th>model<th>FLIP<th>MAE<th>refracted<th>reflected<th>trapped", out);
    for (int c = 0; c < LADDER_INCLUSION_COUNT && ladder->is_whole; c++)
        fprintf(out, "<th>%s", ladder_inclusion_names[c]);
    fputs("<th>RMSE<th>degrees<th>95 %<th>other class<th>ms<th>cost\n", out);
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++) {
        const struct ladder_model *model = &ladder->refraction_models[i];
        const struct ladder_error *e = &model->error;
        fprintf(out, "<tr><td>%s", model->refraction->refraction.name);
        write_number(e->flip, 4, out);
        write_number(e->mae, 4, out);
        for (int c = 0; c < LADDER_PATH_CLASS_COUNT; c++)
            write_number(e->path_class_mae[c], 4, out);
        for (int c = 0; c < LADDER_INCLUSION_COUNT && ladder->is_whole; c++)
            write_number(e->inclusion_mae[c], 4, out);
        write_number(e->rmse, 4, out);
        write_number(e->angle, 3, out);
        write_number(e->angle_95, 3, out);
        write_number(100.0 * e->tir_differs, 1, out);
        fputs(isnan(e->tir_differs) ? "" : " %", out);
        write_number(model->cost > 0.0 ? model->cost : (double)NAN, 2, out);
        write_number(ladder_cost_ratio(ladder, model), 2, out);
        putc('\n', out);
    }
    fputs("</table>\n", out);
}

static void write_header(const struct ladder_report *report, FILE *out)
{
    const struct ladder *l = report->ladder;
    fputs(head, out);
    fputs("<h1>Error of each refraction model against the path-traced reference</h1>\n<p><code>",
          out);
    write_escaped(report->command, out);
    fprintf(out,
            "</code>\n<p>%u × %u pixels; the object covers %llu, %llu of them without total "
            "reflection. Reference: ",
            l->width, l->height, (unsigned long long)l->object_count,
            (unsigned long long)l->angle_count);
    write_escaped(l->tracer, out);
    fprintf(out, ", %.1f s.", l->reference_cost * 1e-3);
    if (report->device) {
        fputs(" GPU: ", out);
        write_escaped(report->device, out);
        putc('.', out);
    }
    putc('\n', out);
}

static const char notes[] =
    "<p>FLIP: over all pixels. MAE (clamped to 0 and 1) and RMSE: over the object's pixels. "
    "Refracted, reflected, trapped: MAE of the pixels whose light undergoes total internal "
    "reflection never, "
    "once, "
    "or more often before it leaves. Degrees: mean and 95th percentile of the angle between the "
    "exit directions, where there is no "
    "total reflection. Other class: pixels with total reflection in only one of the two images. "
    "Cost: median frame time relative to ";

static void write_image(const char *attributes, const char *alt, const struct encoded *png,
                        FILE *out)
{
    fprintf(out, "<img %s alt=\"%s\" src=\"data:image/png;base64,", attributes, alt);
    write_base64(png->data, png->size, out);
    fputs("\">\n", out);
}

/* Writes the image slider. It shows a model on the left and the reference (image 0) on the right.
 * Without JavaScript the only model is the last one. */
static void write_slider(const struct ladder *ladder, const struct encoded *images, FILE *out)
{
    fputs("<h2>Side by side</h2>\n<p><label>Left of the divider: <select id=\"rung\">\n", out);
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++) {
        const struct ladder_model *model = &ladder->refraction_models[i];
        fprintf(out, "<option data-says=\"FLIP %.4f, MAE %.4f\"%s>%s\n", model->error.flip,
                model->error.mae, i + 1 == ladder->refraction_model_count ? " selected" : "",
                model->refraction->refraction.name);
    }
    fputs(
        "</select></label>\n<label>Divider: <input id=\"at\" type=\"range\" min=\"0\" max=\"100\" "
        "step=\"0.5\" value=\"50\"></label>\n<span id=\"says\" role=\"status\"></span>\n<p>Right "
        "of "
        "it is the reference. The divider follows the mouse, or the arrow keys.\n"
        "<div id=\"ab\" style=\"--at:50%\">\n",
        out);
    write_image("class=\"truth\"", "reference", &images[0], out);
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++)
        write_image("class=\"rung\"", ladder->refraction_models[i].refraction->refraction.name,
                    &images[i + 1], out);
    fprintf(out, "</div>\n%s", script);
}

static enum status encode_images(const struct ladder *ladder, struct encoded *images)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i <= ladder->refraction_model_count && status == STATUS_OK; i++) {
        const struct png_image_source picture = {
            .rgba = i ? ladder->refraction_models[i - 1].result.rgba : ladder->reference.rgba,
            .width = ladder->width,
            .height = ladder->height,
        };
        status = png_encode(&picture, &images[i].data, &images[i].size);
    }
    return status;
}

static void write_page(const struct ladder_report *report, const char *svg,
                       const struct encoded *images, const struct encoded *sheet, FILE *out)
{
    const struct ladder_model *base = ladder_base(report->ladder);
    write_header(report, out);
    write_table(report->ladder, out);
    fprintf(out, "%s%s, with the frames of all models interleaved.\n%s", notes,
            base->refraction->refraction.name, base->cost > 0.0 ? svg : "");
    write_slider(report->ladder, images, out);
    fputs("<h2>Images</h2>\n<p>Each image is followed by its FLIP error map in the colours of the "
          "scale.\n",
          out);
    write_image("id=\"sheet\"", "contact sheet", sheet, out);
    fputs("</html>\n", out);
}

enum status ladder_page(const struct ladder_report *report, char **text, size_t *size)
{
    struct encoded images[LADDER_MODEL_COUNT + 1] = { 0 };
    struct encoded sheet = { 0 };
    char *svg = NULL;
    size_t svg_size;
    *text = NULL;
    enum status status = ladder_sheet(report, &sheet.data, &sheet.size);
    if (status == STATUS_OK)
        status = encode_images(report->ladder, images);
    if (status == STATUS_OK)
        status = ladder_svg(report, &svg, &svg_size);
    FILE *out = status == STATUS_OK ? open_memstream(text, size) : NULL;
    if (out)
        write_page(report, svg, images, &sheet, out);
    if (status == STATUS_OK && (!out || fclose(out))) {
        free(*text);
        *text = NULL;
        status = log_out_of_memory(NULL);
    }
    free(svg);
    free(sheet.data);
    for (uint32_t i = 0; i <= report->ladder->refraction_model_count; i++)
        free(images[i].data);
    return status;
}
