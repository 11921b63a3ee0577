/* xdg_folders.h: paths of the viewer's own folders (XDG) and of files in a folder. Functions that
 * return a string allocate it; the caller frees it. */
#ifndef FIRN_VIEW_SESSION_XDG_FOLDERS_H
#define FIRN_VIEW_SESSION_XDG_FOLDERS_H

#include <stdbool.h>

/* Returns the folder "$XDG_DATA_HOME/firn/presets" if `what` is "preset", or that of sessions if it
 * is "session". If `make`, creates it. On failure, also if HOME is not set, returns NULL without
 * logging. */
char *user_files_data(const char *what, bool make);

/* Returns the folder for state such as recent files, "$XDG_STATE_HOME/firn". */
char *user_files_state(bool make);

/* Returns the first unused file name "STEM-0001.ENDING" in a folder; NULL on failure. */
char *user_files_new(const char *folder, const char *stem, const char *ending);

/* Sorts the files with `endings` by name. Returns the path of file i, or NULL after the last. */
char *user_files_at(const char *folder, const char *const *endings, unsigned i);

/* Returns the model file after (`step` 1) or before (-1) `path` in its folder, in cyclic order of
 * names. Built-in scenes form a separate cycle. Returns NULL if there is no further model. */
char *user_files_next_model(const char *path, int step);

#endif
