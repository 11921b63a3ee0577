/*
 * echo.h: what the program says on stderr, for the window, too.
 *
 * Thread-safety: any thread may log meanwhile.
 */
#ifndef FIRN_VIEW_ECHO_H
#define FIRN_VIEW_ECHO_H

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>

enum {
    ECHO_SIZE = 512, /* bytes of a line, '\0' included; longer ones are cut */
};

struct echo {
    FILE *before; /* that stderr was; NULL: not begun */
    pthread_mutex_t lock;
    char line[ECHO_SIZE]; /* the last error, without "firn: "; "": none */
};

/* From now on what is written to stderr is also heard. If that cannot be, nothing is. It must not
 * move until echo_end(). */
void echo_begin(struct echo *echo);
void echo_end(struct echo *echo); /* {0} is fine */

/* The last error that was logged since the last call. False: there was none. */
bool echo_take(struct echo *echo, char line[static ECHO_SIZE]);

#endif
