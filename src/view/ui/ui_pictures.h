/*
 * ui_pictures.h: pictures of materials and rungs, for their buttons.
 *
 * They come with the program, as sheets that `firn sheet` has drawn: assets/README.md.
 */
#ifndef FIRN_VIEW_UI_UI_PICTURES_H
#define FIRN_VIEW_UI_UI_PICTURES_H

#include "src/reader/reader.h"
#include "src/view/ui/imgui.h"

#define UI_PICTURE_NONE UINT32_MAX

/* Of each material preset, and then of each rung, in the order of their tables. {0}: there are
 * none, and buttons have words alone. */
struct ui_pictures {
    struct imgui_pictures list;
    uint8_t *rgba; /* its texels */
    uint32_t material_count;
};

/* Reads the sheets. Where that fails, which is logged, there are no pictures. */
void ui_pictures_load(struct ui_pictures *pictures, const struct reader_params *reader);
void ui_pictures_finish(struct ui_pictures *pictures); /* {0} is fine */

/* The picture of preset or rung i, for imgui_picture(); UI_PICTURE_NONE: there is none. */
uint32_t ui_pictures_material(const struct ui_pictures *pictures, uint32_t i);
uint32_t ui_pictures_rung(const struct ui_pictures *pictures, uint32_t i);

#endif
