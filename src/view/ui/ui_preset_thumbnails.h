/* ui_preset_thumbnails.h: thumbnails of materials and refraction models for buttons. They are
 * installed as sheets, which `firn sheet` draws; see assets/README.md. */
#ifndef FIRN_VIEW_UI_UI_PRESET_THUMBNAILS_H
#define FIRN_VIEW_UI_UI_PRESET_THUMBNAILS_H

#include "src/reader/reader_process.h"
#include "src/view/ui/imgui.h"

#define UI_THUMBNAIL_NONE UINT32_MAX

/* Thumbnails of all material presets, followed by those of all refraction models. If there are no
 * thumbnails, all members are 0 and buttons show only labels. */
struct ui_thumbnails {
    struct imgui_thumbnails list;
    uint8_t *rgba; /* texels of `list` */
    uint32_t material_count;
};

/* Reads the sheets. On failure, logs and leaves the thumbnails empty. */
void ui_thumbnails_load(struct ui_thumbnails *p, const struct reader_params *reader);
void ui_thumbnails_finish(struct ui_thumbnails *p); /* {0} is fine */

/* Returns the thumbnail of material preset i; UI_THUMBNAIL_NONE if there is none. */
uint32_t ui_thumbnails_material(const struct ui_thumbnails *p, uint32_t i);
uint32_t ui_thumbnails_model(const struct ui_thumbnails *p, uint32_t i); /* of refraction model i */

#endif
