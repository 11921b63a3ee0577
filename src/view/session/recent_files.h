/* recent_files.h: recently opened files in "$XDG_STATE_HOME/firn/recent", one path per line. If
 * several windows write the list, only the entries of the last writer remain. */
#ifndef FIRN_VIEW_SESSION_RECENT_FILES_H
#define FIRN_VIEW_SESSION_RECENT_FILES_H

#include <stdint.h>

enum {
    RECENT_FILES_COUNT = 20, /* older entries are dropped */
};

/* Puts a file at the top of the list. Ignores paths that do not exist. If HOME is not set, does
 * nothing. If the list cannot be written, logs this. */
void recent_files_add(const char *path);

/* Returns the path of recent file i, malloc'd; NULL after the last. Deleted files are skipped. */
char *recent_files_at(uint32_t i);

#endif
