/*
 * place.h: where the window's own files are, and which file is next to another.
 *
 * Strings are malloc'd; the caller frees them.
 */
#ifndef FIRN_VIEW_PLACE_H
#define FIRN_VIEW_PLACE_H

#include <stdbool.h>

/* The folder of presets, "$XDG_DATA_HOME/firn/presets"; with `make` it is made if it is not there.
 * NULL: there is no HOME, it cannot be made, or out of memory; not logged. */
char *place_presets(bool make);

char *place_sessions(bool make); /* the same of sessions, "$XDG_DATA_HOME/firn/sessions" */

/* The same of what the window remembers, "$XDG_STATE_HOME/firn". */
char *place_state(bool make);

/* A file "STEM-0001.ENDING" in a folder, with the first number that is not taken. NULL: out of
 * memory, or all are taken. */
char *place_new(const char *folder, const char *stem, const char *ending);

/* File number i of a folder, by name, with one of the endings, which end at NULL. NULL: there are
 * no more. */
char *place_file(const char *folder, const char *const *endings, unsigned i);

/* The scene that comes with firn, or the model in the folder of `path`, that is `step` (1 or -1)
 * after this one, by name; after the last comes the first. NULL: there is no other. */
char *place_next(const char *path, int step);

#endif
