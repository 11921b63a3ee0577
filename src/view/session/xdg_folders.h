/* xdg_folders.h: folders of the viewer's own files (XDG), and the next file in a folder. Strings
 * are malloc'd; the caller frees them. */
#ifndef FIRN_VIEW_SESSION_XDG_FOLDERS_H
#define FIRN_VIEW_SESSION_XDG_FOLDERS_H

#include <stdbool.h>

/* Returns the folder of presets, "$XDG_DATA_HOME/firn/presets". With `make`, creates it. Returns
 * NULL, without logging, if HOME is not set, creation fails or memory runs out. */
char *user_files_presets(bool make);

char *user_files_sessions(bool make); /* folder of session files, "$XDG_DATA_HOME/firn/sessions" */

/* Returns the folder for state such as recent files, "$XDG_STATE_HOME/firn". */
char *user_files_state(bool make);

/* Returns the first unused file name "STEM-0001.ENDING" in a folder; NULL on failure. */
char *user_files_new(const char *folder, const char *stem, const char *ending);

/* Sorts the files with `endings` by name. Returns the path of file i, or NULL after the last. */
char *user_files_at(const char *folder, const char *const *endings, unsigned i);

/* Returns the next (`step` 1) or previous (-1) model file in the folder of `path`, in cyclic order
 * of names. Built-in scenes form a cycle of their own. Returns NULL if there is no other model. */
char *user_files_next_model(const char *path, int step);

#endif
