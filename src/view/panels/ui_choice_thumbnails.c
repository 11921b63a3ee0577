/* ui_choice_thumbnails.c: loads the thumbnails of materials and refraction models. */
#include "src/view/panels/ui_choice_thumbnails.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/image_receive.h"
#include "src/file/srgb.h"
#include "src/lab/ladder/sheet_grid.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/material_presets.h"
#include "src/tech/techniques.h"

enum {
    WIDTH = 128, /* of a thumbnail in both sheets, texels: twice the size on screen at scale 1 */
    HEIGHT = 96,
    THUMBNAIL_SIZE = 4 * WIDTH * HEIGHT, /* bytes */
};

static const struct sheet_grid grid = { SHEET_COLUMNS, WIDTH, HEIGHT };

/* Returns the position of the label "PARAMETER=NAME" in a list separated by commas, or
 * UI_THUMBNAIL_NONE. */
static uint32_t find_label(const char *labels, const char *parameter, const char *name)
{
    char label[64];
    const int length = snprintf(label, sizeof(label), "%s=%s", parameter, name);
    uint32_t i = 0;
    for (const char *at = labels; at; i++) {
        const char *end = strchr(at, ',');
        const size_t size = end ? (size_t)(end - at) : strlen(at);
        if (size == (size_t)length && !strncmp(at, label, size))
            return i;
        at = end ? end + 1 : NULL;
    }
    return UI_THUMBNAIL_NONE;
}

/* Image and labels of a sheet; {0} if it cannot be used. */
struct sheet {
    struct image image;
    struct image_header head;
    const char *labels;
};

static void finish_sheet(struct sheet *sheet)
{
    image_finish(&sheet->image);
    image_header_finish(&sheet->head);
    *sheet = (struct sheet){ 0 };
}

static void read_sheet(struct sheet *sheet, const char *name, const struct reader_params *reader)
{
    const struct asset *asset = asset_find(name, ASSET_SHEET);
    char *path = NULL;
    enum status status = asset_locate(asset, &path);
    *sheet = (struct sheet){ 0 };
    if (status == STATUS_OK)
        status = image_reader_check(&sheet->head, path, reader);
    if (status == STATUS_OK)
        status = image_reader_read(&sheet->image, path, reader);
    sheet->labels = image_header_text(&sheet->head, SHEET_LABELS);
    if (status == STATUS_OK && sheet->image.width == sheet_width(&grid) && sheet->labels) {
        free(path);
        return;
    }
    if (status == STATUS_OK)
        log_warning("%s: expected a labelled sheet of images of %u x %u pixels: buttons are shown "
                    "without thumbnails",
                    path, WIDTH, HEIGHT);
    finish_sheet(sheet);
    free(path);
}

/* Adds a thumbnail from a sheet. Returns its index, or UI_THUMBNAIL_NONE if there is none. */
static uint32_t add(struct ui_thumbnails *p, const struct sheet *sheet, const char *parameter,
                    const char *name)
{
    const float *planes[3] = { image_find(&sheet->image, "R"), image_find(&sheet->image, "G"),
                               image_find(&sheet->image, "B") };
    const uint32_t i = find_label(sheet->labels, parameter, name);
    const uint32_t index = p->list.count;
    if (i >= IMGUI_THUMBNAIL_MAX || index == IMGUI_THUMBNAIL_MAX ||
        sheet->image.height < sheet_height(&grid, i + 1))
        return UI_THUMBNAIL_NONE;
    const uint32_t top = sheet_top(&grid, i) + sheet_label_height(&grid);
    uint8_t *rgba = p->rgba + (size_t)THUMBNAIL_SIZE * index;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        const size_t row = (size_t)(top + y) * sheet->image.width + sheet_left(&grid, i);
        for (uint32_t x = 0; x < WIDTH; x++, rgba += 4) {
            for (size_t c = 0; c < 3; c++)
                rgba[c] = (uint8_t)(srgb_encode(planes[c][row + x]) * 255.0f + 0.5f);
            rgba[3] = 255;
        }
    }
    p->list.count++;
    return index;
}

void ui_thumbnails_load(struct ui_thumbnails *p, const struct reader_params *reader)
{
    struct sheet sheet;
    *p = (struct ui_thumbnails){ .rgba = malloc((size_t)THUMBNAIL_SIZE * IMGUI_THUMBNAIL_MAX) };
    if (!p->rgba)
        return;
    p->list = (struct imgui_thumbnails){ p->rgba, WIDTH, HEIGHT, 0 };
    read_sheet(&sheet, "materials", reader);
    for (uint32_t i = 0; material_presets[i].name && i < IMGUI_THUMBNAIL_MAX; i++)
        p->materials[i] = add(p, &sheet, "material", material_presets[i].name);
    finish_sheet(&sheet);
    read_sheet(&sheet, "rungs", reader);
    for (uint32_t i = 0; techniques_refraction(i) && i < IMGUI_THUMBNAIL_MAX; i++)
        p->models[i] = add(p, &sheet, "refraction", techniques_refraction(i)->refraction.name);
    finish_sheet(&sheet);
}

void ui_thumbnails_finish(struct ui_thumbnails *p)
{
    free(p->rgba);
    *p = (struct ui_thumbnails){ 0 };
}
