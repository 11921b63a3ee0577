/*
 * recent.h: the files that were opened last, in "$XDG_STATE_HOME/firn/recent", one path a line.
 *
 * Several windows may write it: the last one counts.
 */
#ifndef FIRN_VIEW_RECENT_H
#define FIRN_VIEW_RECENT_H

#include <stdint.h>

enum {
    RECENT_COUNT = 20, /* older ones are forgotten */
};

/* A file was opened: it comes first. What is no file is no matter. Without HOME nothing is kept; a
 * file that cannot be written is logged. */
void recent_add(const char *path);

/* File i of those that are still there, malloc'd; NULL: there are no more. */
char *recent_find(uint32_t i);

#endif
