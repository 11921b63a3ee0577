/* ui_choice_thumbnails.h: thumbnails of materials and refraction models for buttons. They are
 * installed as sheets, which `firn sheet` draws; see assets/README.md. */
#ifndef FIRN_VIEW_PANELS_UI_CHOICE_THUMBNAILS_H
#define FIRN_VIEW_PANELS_UI_CHOICE_THUMBNAILS_H

#include "src/file/reader_process.h"
#include "src/view/panels/imgui.h"

#define UI_THUMBNAIL_NONE UINT32_MAX

/* Thumbnails of material presets and refraction models. If no thumbnails are installed,
 * `list.count` is 0 and the buttons show only labels. */
struct ui_thumbnails {
    struct imgui_thumbnails list;
    uint8_t *rgba; /* texels of `list` */
    /* index in `list` for each preset and model, in the order of their tables; UI_THUMBNAIL_NONE if
     * the sheet lacks its name */
    uint32_t materials[IMGUI_THUMBNAIL_MAX], models[IMGUI_THUMBNAIL_MAX];
};

/* Reads the sheets. Logs a warning for each that cannot be used. */
void ui_thumbnails_load(struct ui_thumbnails *p, const struct reader_params *reader);
void ui_thumbnails_finish(struct ui_thumbnails *p); /* {0} is fine */

#endif
