/* contact_sheet.c: encodes all images as a PNG contact sheet or as layers of an EXR file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/exr.h"
#include "src/file/png.h"
#include "src/lab/ladder/canvas.h"
#include "src/lab/ladder/comparison_report.h"
#include "src/lab/metric/heat_map.h"

enum {
    COLUMNS = 2,    /* cells per row */
    MARGIN = 8,     /* pixels */
    LABEL = 330,    /* label width at scale 1, pixels */
    TEXT_SCALE = 2, /* text scale in wide cells */
    GREY = 34,
    TICKS = 5,       /* of the colour bar */
    TICK_LENGTH = 8, /* pixels */
};

static uint32_t cell_width(const struct ladder *ladder)
{
    const uint32_t width = 2 * ladder->width + MARGIN;
    return width > LABEL ? width : LABEL;
}

static uint32_t letter_scale(const struct ladder *ladder)
{
    return cell_width(ladder) >= TEXT_SCALE * LABEL ? TEXT_SCALE : 1;
}

static uint32_t label_height(const struct ladder *ladder)
{
    return letter_scale(ladder) * CANVAS_TEXT_HEIGHT + 4;
}

/* Computes the top left corner of a cell. */
static void cell_origin(const struct ladder *ladder, uint32_t index, uint32_t *x, uint32_t *y)
{
    *x = MARGIN + index % COLUMNS * (cell_width(ladder) + 2 * MARGIN);
    *y = MARGIN + index / COLUMNS * (ladder->height + label_height(ladder) + MARGIN);
}

static void write_label(struct canvas *canvas, uint32_t x, uint32_t y, const struct ladder *ladder,
                        const struct ladder_model *model)
{
    const double ratio = ladder_cost_ratio(ladder, model);
    char angle[32] = "";
    char cost[32] = "";
    char text[128];
    if (!isnan(model->error.angle))
        snprintf(angle, sizeof(angle), "   %.2f degrees", model->error.angle);
    if (!isnan(ratio))
        snprintf(cost, sizeof(cost), "   cost %.2f", ratio);
    snprintf(text, sizeof(text), "%s   FLIP %.3f%s%s", model->refraction->refraction.name,
             model->error.flip, angle, cost);
    canvas_draw_text(canvas, x, y, letter_scale(ladder), text);
}

static bool draw_errors(struct canvas *canvas, uint32_t x, uint32_t y, const struct ladder *ladder,
                        const float *errors)
{
    struct canvas picture;
    if (!canvas_init(&picture, ladder->width, ladder->height, 0))
        return false;
    for (size_t i = 0; i < (size_t)picture.width * picture.height; i++)
        heat_map_srgb(errors[i], &picture.rgba[4 * i]);
    canvas_draw_image(canvas, x, y, &picture);
    free(picture.rgba);
    return true;
}

/* Draws the heat map's colour bar in a box: left, top, width and height in pixels. The value is 1
 * at the top and 0 at the bottom. Numbers are to its right, only two if it is short. */
static void draw_legend(struct canvas *canvas, const uint32_t box[static 4], uint32_t scale)
{
    const uint32_t x = box[0], y = box[1], width = box[2], height = box[3];
    const uint32_t line = scale * CANVAS_TEXT_HEIGHT;
    const uint32_t ticks = height >= TICKS * line ? TICKS : 2;
    uint8_t rgb[3];
    for (uint32_t row = 0; row < height; row++) {
        heat_map_srgb(1.0f - ((float)row + 0.5f) / (float)height, rgb);
        canvas_fill(canvas, (const uint32_t[]){ x, y + row, width, 1 }, rgb);
    }
    for (uint32_t i = 0; i < ticks; i++) {
        char text[16];
        const uint32_t at = i * (height - 1) / (ticks - 1);
        const uint32_t lift = i * line / (ticks - 1);
        snprintf(text, sizeof(text), "%.2f", 1.0 - (double)i / (ticks - 1));
        canvas_draw_text(canvas, x + width + TICK_LENGTH, y + at - (lift < at ? lift : at), scale,
                         text);
    }
}

static void draw_reference(struct canvas *canvas, const struct ladder *ladder)
{
    const struct canvas picture = { ladder->width, ladder->height, ladder->reference.rgba };
    uint32_t x, y;
    cell_origin(ladder, 0, &x, &y);
    canvas_draw_text(canvas, x, y, letter_scale(ladder), "reference   FLIP:");
    canvas_draw_image(canvas, x, y + label_height(ladder), &picture);
    draw_legend(canvas,
                (const uint32_t[]){ x + ladder->width + MARGIN, y + label_height(ladder),
                                    ladder->width / 8 + 1, ladder->height },
                letter_scale(ladder));
}

static bool draw_model(struct canvas *canvas, const struct ladder *ladder, uint32_t index)
{
    const struct ladder_model *model = &ladder->refraction_models[index];
    const struct canvas picture = { ladder->width, ladder->height, model->result.rgba };
    uint32_t x, y;
    cell_origin(ladder, index + 1, &x, &y);
    write_label(canvas, x, y, ladder, model);
    canvas_draw_image(canvas, x, y + label_height(ladder), &picture);
    return draw_errors(canvas, x + ladder->width + MARGIN, y + label_height(ladder), ladder,
                       model->flip);
}

enum status ladder_sheet(const struct ladder_report *report, void **data, size_t *size)
{
    const struct ladder *l = report->ladder;
    /* the reference occupies a cell, too */
    const uint32_t rows = (l->refraction_model_count + COLUMNS) / COLUMNS;
    struct canvas canvas;
    *data = NULL;
    bool ok = canvas_init(&canvas, COLUMNS * (cell_width(l) + 2 * MARGIN),
                          rows * (l->height + label_height(l) + MARGIN) + MARGIN, GREY);
    if (ok)
        draw_reference(&canvas, l);
    for (uint32_t i = 0; i < l->refraction_model_count && ok; i++)
        ok = draw_model(&canvas, l, i);
    const struct png_image_source picture = {
        .rgba = canvas.rgba,
        .width = canvas.width,
        .height = canvas.height,
    };
    enum status status = ok ? png_encode(&picture, data, size) : log_out_of_memory(NULL);
    free(canvas.rgba);
    return status;
}

/* Adds a plane that borrows `texels`, which are never modified. */
static void add_plane(struct image *image, const char *layer, const char *name,
                      float *texels) /* NOLINT(readability-non-const-parameter) */
{
    struct image_plane *plane = &image->planes[image->plane_count++];
    *plane = (struct image_plane){ .texels = texels };
    snprintf(plane->name, sizeof(plane->name), "%s%s%s", layer, *layer ? "." : "", name);
}

static void add_color(struct image *image, const char *layer, const struct render_result *result)
{
    static const char *const names[] = { "R", "G", "B" };
    for (int i = 0; i < 3; i++)
        add_plane(image, layer, names[i], image_find(&result->image, names[i]));
}

enum status ladder_exr(const struct ladder_report *report, void **data, size_t *size)
{
    const struct ladder *l = report->ladder;
    const struct image_text texts[] = { { "firn/command", report->command } };
    struct image_plane planes[3 + 4 * LADDER_MODEL_COUNT];
    struct image image = { .width = l->width, .height = l->height, .planes = planes };
    add_color(&image, "", &l->reference);
    for (uint32_t i = 0; i < l->refraction_model_count; i++) {
        add_color(&image, l->refraction_models[i].refraction->refraction.name,
                  &l->refraction_models[i].result);
        add_plane(&image, l->refraction_models[i].refraction->refraction.name, "flip.Z",
                  l->refraction_models[i].flip);
    }
    return exr_encode(&image, &(struct exr_header){ .texts = texts, .text_count = 1 }, data, size);
}
