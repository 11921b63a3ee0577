/*
 * place.h: folders of the viewer's own files (XDG), and the next file in a folder.
 *
 * Strings are malloc'd; the caller frees them.
 */
#ifndef FIRN_VIEW_PLACE_H
#define FIRN_VIEW_PLACE_H

#include <stdbool.h>

/* Returns the folder of presets, "$XDG_DATA_HOME/firn/presets", and creates it if `make`. Returns
 * NULL, without logging, if there is no HOME, it cannot be created, or memory is out. */
char *place_presets(bool make);

char *place_sessions(bool make); /* folder of session files, "$XDG_DATA_HOME/firn/sessions" */

/* Returns the folder of persistent state such as recent files, "$XDG_STATE_HOME/firn". */
char *place_state(bool make);

/* Returns the first unused file name "STEM-0001.ENDING" in a folder; NULL on failure. */
char *place_new(const char *folder, const char *stem, const char *ending);

/* Returns file i of a folder, by name, with one of the NULL-terminated extensions; NULL if none. */
char *place_file(const char *folder, const char *const *endings, unsigned i);

/* Returns the built-in scene, or the model in the folder of `path`, that follows this one by name
 * (`step` 1) or precedes it (-1); wraps around. NULL if there is no other. */
char *place_next(const char *path, int step);

#endif
