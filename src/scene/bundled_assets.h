/*
 * bundled_assets.h: finds the models, environments and images bundled with the program, by name.
 * Files are searched first in $FIRN_ASSETS, then in ../share/firn relative to the program's folder
 * (installation), and last in the folder `assets` beside the program (build tree).
 */
#ifndef FIRN_SCENE_BUNDLED_ASSETS_H
#define FIRN_SCENE_BUNDLED_ASSETS_H

#include <stdbool.h>
#include "src/base/status.h"

enum asset_kind {
    ASSET_SCENE,
    ASSET_ENVIRONMENT,
    ASSET_SHEET, /* sheet of preview images, made by `firn sheet` */
};

enum {
    ASSET_SETTING_COUNT = 16, /* including the terminating NULL */
};

struct asset {
    const char *name; /* asset name, without dots and slashes, so that "./NAME" is a file */
    const char *file; /* file name in the assets folder */
    enum asset_kind kind;
    const char *environment;                   /* default environment; NULL for the sky */
    const char *settings[ASSET_SETTING_COUNT]; /* a scene's default settings, "name=value" */
    const char *help;
};

/* Sets a folder in which the calling thread looks first, and returns the earlier one or NULL.
 * The text must outlive its use. */
const char *asset_set_folder(const char *folder);

extern const struct asset assets[]; /* terminated by a zero entry */

/* Returns true if the asset's file exists. Returns false if not, or when out of memory. */
bool asset_exists(const struct asset *asset);

/* Returns the asset of this name and kind, or NULL. */
const struct asset *asset_find(const char *name, enum asset_kind kind);

/* Returns true if an environment's name, "valley" or "sky", selects the built-in landscape. */
bool asset_is_valley(const char *name);

/* Finds an asset's file. The caller frees *path, which is NULL on failure. Logs errors. Returns
 * STATUS_NO_INPUT if the file does not exist, STATUS_TRY_AGAIN if out of memory. */
MUST_USE enum status asset_locate(const struct asset *asset, char **path);

#endif
