/*
 * echo.h: captures error messages written to stderr, so that the window can show them.
 *
 * Thread-safety: other threads may log at any time.
 */
#ifndef FIRN_VIEW_ECHO_H
#define FIRN_VIEW_ECHO_H

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>

enum {
    ECHO_SIZE = 512, /* maximum bytes of a line, including '\0'; longer lines are truncated */
};

struct echo {
    FILE *before; /* original stderr; NULL if capturing has not begun */
    pthread_mutex_t lock;
    char line[ECHO_SIZE]; /* last error without its "firn: " prefix; "" if there was none */
};

/* Starts capturing text written to stderr, which is still printed. Does nothing on failure. *echo
 * must not move until echo_end(). */
void echo_begin(struct echo *echo);
void echo_end(struct echo *echo); /* restores stderr; {0} is fine */

/* Moves the last error since the previous call to `line`. Returns false if there was none. */
bool echo_take(struct echo *echo, char line[static ECHO_SIZE]);

#endif
