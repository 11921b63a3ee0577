/* setting.h: description of a user setting (type, range, help) and of groups of settings. */
#ifndef FIRN_SETTINGS_SETTING_H
#define FIRN_SETTINGS_SETTING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/settings/setting_groups.h"

enum setting_type {
    SETTING_FLOAT,
    SETTING_COUNT,  /* uint32_t */
    SETTING_SWITCH, /* uint32_t, 0 (off) or 1 (on) */
    SETTING_CHOICE, /* uint32_t, index into choices */
};

/* Work to redo after a setting's change. Each value includes the work of all earlier values. */
enum setting_effect {
    SETTING_AFFECTS_NOTHING,
    SETTING_AFFECTS_FRAME, /* read in every frame */
    SETTING_AFFECTS_PLAN,  /* graph plan, specialisation constants */
    SETTING_AFFECTS_SCENE, /* loaded or generated scene data */
};

struct setting {
    const char *name;         /* "<group>.<parameter>" */
    const char *renamed_from; /* former name, still accepted; or NULL */
    const char *label;        /* label in the window, "Refractive index" */
    enum setting_type type;
    size_t offset; /* of the member in its struct */
    double initial, min, max;
    bool has_auto;                    /* accepts "auto", stored as setting_auto() */
    const char *unit;                 /* "degrees"; NULL if there is none */
    const char *const *choices;       /* terminated by NULL */
    const char *const *choice_labels; /* labels in the window; NULL: `choices` */
    const char *help;                 /* one line, no full stop */
    enum setting_effect affects;      /* any change's effect; SETTING_AFFECTS_NOTHING means FRAME */
    enum setting_effect switches;     /* effect of leaving or reaching 0 */
};

/* Returns the value that represents "auto", which is below `min`. */
static inline double setting_auto(const struct setting *row)
{
    return row->type == SETTING_FLOAT ? -1.0 : 0.0;
}

/* Returns true if a value represents "auto". */
static inline bool setting_is_auto(const struct setting *row, double value)
{
    return row->has_auto && value < row->min;
}

enum {
    SETTING_GROUP_SIZE = 96, /* maximum size of a group's struct, bytes; a multiple of 16 */
};

/* Settings whose values are the members of one struct. */
struct setting_group {
    const char *name;
    const struct setting *rows;
    size_t row_count;
    size_t params_size; /* size of the struct, bytes; at most SETTING_GROUP_SIZE */
    size_t index;       /* position in setting_groups[] */
};

/* Initialises name, type and offset of a struct setting: a member of a group's struct. */
#define SETTING_FIELD(full_name, kind, params, member) \
    .name = (full_name), .type = SETTING_##kind, .offset = offsetof(params, member)

/* Defines the group GROUP_settings. It must be listed in the root meson.build. */
#define SETTING_GROUP(group, table, type) \
    extern const struct setting_group group##_settings; \
    const struct setting_group group##_settings = { \
        .name = #group, \
        .rows = (table), \
        .row_count = sizeof(table) / sizeof((table)[0]), \
        .params_size = sizeof(type), \
        .index = SETTING_GROUP_##group, \
    }; \
    _Static_assert(sizeof(type) <= SETTING_GROUP_SIZE, "the struct fits")

#endif
