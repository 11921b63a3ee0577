/*
 * asset.h: models, panoramas and pictures that come with the program, by name.
 *
 * A file of theirs is looked for in $FIRN_ASSETS, then in ../share/firn from the program's folder,
 * where it is installed, then in assets in the program's folder, where a build puts it.
 */
#ifndef FIRN_SCENE_ASSET_H
#define FIRN_SCENE_ASSET_H

#include <stdbool.h>
#include "src/base/status.h"

enum asset_kind {
    ASSET_SCENE,
    ASSET_ENVIRONMENT,
    ASSET_SHEET, /* pictures of `firn sheet`, for the window's panel */
};

enum {
    ASSET_SETTING_COUNT = 16, /* the last one is NULL */
};

struct asset {
    const char *name; /* without a dot or a slash, so that "./NAME" is always a file */
    const char *file; /* its name in the folder of assets */
    enum asset_kind kind;
    const char *environment; /* of a scene: what it is in unless an option says; NULL: the sky */
    const char *settings[ASSET_SETTING_COUNT]; /* of a scene: its own defaults, "name=value" */
    const char *help;
};

extern const struct asset assets[]; /* ends at a row of zeros */

/* Returns whether a folder has the asset's file; false, too, when out of memory. */
bool asset_is_there(const struct asset *asset);

/* Returns the asset of this name and kind, or NULL. */
const struct asset *asset_find(const char *name, enum asset_kind kind);

/* Returns whether a name of an environment is that of the built-in landscape: valley, or sky. */
bool asset_is_valley(const char *name);

/*
 * Finds an asset's file. The caller frees *path, which is NULL on failure. Logs and returns
 * STATUS_NO_INPUT if no folder has the file, or STATUS_TRY_AGAIN when out of memory.
 */
MUST_USE enum status asset_locate(const struct asset *asset, char **path);

#endif
