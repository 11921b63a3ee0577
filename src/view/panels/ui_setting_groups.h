/* ui_setting_groups.h: groups of the settings panel, and which settings belong to them. */
#ifndef FIRN_VIEW_PANELS_UI_SETTING_GROUPS_H
#define FIRN_VIEW_PANELS_UI_SETTING_GROUPS_H

#include <stdint.h>
#include "src/settings/settings.h"

enum ui_setting_group {
    UI_OBJECT,
    UI_MATERIAL,
    UI_INSIDE,
    UI_LIGHT,
    UI_CAMERA,
    UI_QUALITY,
    UI_WATER,
    UI_EXPERT, /* settings in no other group */
    UI_GROUP_COUNT,
};

const char *ui_setting_groups_name(enum ui_setting_group group);

/* Returns the group of a setting. */
enum ui_setting_group ui_setting_groups_of(const struct setting *row);

/* Returns setting i of a group, the most useful ones first; NULL after the last. */
const struct setting *ui_setting_groups_row(enum ui_setting_group group, uint32_t i);

#endif
