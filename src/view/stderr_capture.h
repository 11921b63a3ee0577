/*
 * stderr_capture.h: captures error messages written to stderr, so that the window can show them.
 *
 * Thread-safety: other threads may log at any time.
 */
#ifndef FIRN_VIEW_STDERR_CAPTURE_H
#define FIRN_VIEW_STDERR_CAPTURE_H

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>

enum {
    STDERR_CAPTURE_SIZE =
        512, /* maximum bytes of a line, including '\0'; longer lines are truncated */
};

struct stderr_capture {
    FILE *before; /* original stderr; NULL if capturing has not begun */
    pthread_mutex_t lock;
    char line
        [STDERR_CAPTURE_SIZE]; /* last error without its "firn: " prefix; "" if there was none */
};

/* Starts capturing text written to stderr, which is still printed. Does nothing on failure. *echo
 * must not move until stderr_capture_end(). */
void stderr_capture_begin(struct stderr_capture *echo);
void stderr_capture_end(struct stderr_capture *echo); /* restores stderr; {0} is fine */

/* Moves the last error since the previous call to `line`. Returns false if there was none. */
bool stderr_capture_take(struct stderr_capture *echo, char line[static STDERR_CAPTURE_SIZE]);

#endif
