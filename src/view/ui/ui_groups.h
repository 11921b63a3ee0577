/*
 * ui_groups.h: what a person looks for, and which settings that is.
 */
#ifndef FIRN_VIEW_UI_UI_GROUPS_H
#define FIRN_VIEW_UI_UI_GROUPS_H

#include <stdint.h>
#include "src/settings/settings.h"

enum ui_group {
    UI_OBJECT,
    UI_MATERIAL,
    UI_INSIDE,
    UI_LIGHT,
    UI_CAMERA,
    UI_QUALITY,
    UI_WATER,
    UI_EXPERT, /* every setting that has no row in the table */
    UI_GROUP_COUNT,
};

const char *ui_group_name(enum ui_group group);

/* Where a setting is. */
enum ui_group ui_group_of(const struct setting *row);

/* Setting i of a group, those that are wanted most first; NULL: there are no more. */
const struct setting *ui_group_row(enum ui_group group, uint32_t i);

#endif
