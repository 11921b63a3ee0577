/* ui_preset_thumbnails.c: loads the thumbnails of materials and refraction models. */
#include "src/view/ui/ui_preset_thumbnails.h"
#include <stdlib.h>
#include "src/base/log.h"
#include "src/image/srgb.h"
#include "src/ladder/sheet_grid.h"
#include "src/reader/image_receive.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/material.h"
#include "src/tech/techniques.h"

/* Size of the thumbnails in both sheets, in texels: twice the size on screen at scale 1. */
static const struct sheet_grid grid = { .columns = SHEET_COLUMNS, .width = 128, .height = 96 };

static size_t texel_count(uint32_t count)
{
    return (size_t)count * grid.width * grid.height;
}

static void cut(const struct image *sheet, uint32_t i, uint8_t *rgba)
{
    const float *planes[3] = { image_find(sheet, "R"), image_find(sheet, "G"),
                               image_find(sheet, "B") };
    const uint32_t left = sheet_left(&grid, i);
    const uint32_t top = sheet_top(&grid, i) + sheet_label_height(&grid);
    for (uint32_t y = 0; y < grid.height; y++) {
        const size_t row = (size_t)(top + y) * sheet->width + left;
        for (uint32_t x = 0; x < grid.width; x++, rgba += 4) {
            for (size_t c = 0; c < 3; c++)
                rgba[c] = (uint8_t)(srgb_encode(planes[c][row + x]) * 255.0f + 0.5f);
            rgba[3] = 255;
        }
    }
}

/* Reads a sheet, which must contain exactly `count` thumbnails. */
static bool read_sheet(const char *name, uint32_t count, uint8_t *rgba,
                       const struct reader_params *reader)
{
    const struct asset *asset = asset_find(name, ASSET_SHEET);
    struct image sheet = { 0 };
    char *path = NULL;
    enum status status = asset_locate(asset, &path);
    if (status == STATUS_OK)
        status = image_reader_read(&sheet, path, reader);
    const bool fits = status == STATUS_OK && sheet.width == sheet_width(&grid) &&
                      sheet.height == sheet_height(&grid, count);
    if (status == STATUS_OK && !fits)
        log_warning("%s: expected an image of %u thumbnails: buttons are shown without thumbnails",
                    path, count);
    for (uint32_t i = 0; i < count && fits; i++)
        cut(&sheet, i, rgba + 4 * texel_count(i));
    image_finish(&sheet);
    free(path);
    return fits;
}

void ui_thumbnails_load(struct ui_thumbnails *p, const struct reader_params *reader)
{
    uint32_t material_count = 0;
    uint32_t refraction_model_count = 0;
    *p = (struct ui_thumbnails){ 0 };
    while (material_presets[material_count].name)
        material_count++;
    while (techniques_refraction(refraction_model_count))
        refraction_model_count++;
    const uint32_t count = material_count + refraction_model_count;
    uint8_t *rgba = count && count <= IMGUI_THUMBNAIL_MAX ? malloc(4 * texel_count(count)) : NULL;
    if (!rgba)
        return;
    if (read_sheet("materials", material_count, rgba, reader) &&
        read_sheet("rungs", refraction_model_count, rgba + 4 * texel_count(material_count),
                   reader)) {
        p->list = (struct imgui_thumbnails){ rgba, grid.width, grid.height, count };
        p->rgba = rgba;
        p->material_count = material_count;
    } else {
        free(rgba);
    }
}

void ui_thumbnails_finish(struct ui_thumbnails *p)
{
    free(p->rgba);
    *p = (struct ui_thumbnails){ 0 };
}

uint32_t ui_thumbnails_material(const struct ui_thumbnails *p, uint32_t i)
{
    return i < p->material_count ? i : UI_THUMBNAIL_NONE;
}

uint32_t ui_thumbnails_model(const struct ui_thumbnails *p, uint32_t i)
{
    const uint32_t at = p->material_count + i;
    return at < p->list.count ? at : UI_THUMBNAIL_NONE;
}
