/* stderr_capture.h: captures error messages written to stderr, to be shown in the window. All
 * threads may log during the capture. */
#ifndef FIRN_VIEW_STDERR_CAPTURE_H
#define FIRN_VIEW_STDERR_CAPTURE_H

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>

enum {
    STDERR_CAPTURE_SIZE = 512, /* bytes; longer lines are truncated */
};

struct stderr_capture {
    FILE *original; /* original stderr; NULL before capturing */
    pthread_mutex_t lock;
    char line[STDERR_CAPTURE_SIZE]; /* last error, without "firn: " */
};

/* Starts to capture text written to stderr. The text is still printed. On failure, captures
 * nothing. *capture must not be moved before stderr_capture_end(). */
void stderr_capture_begin(struct stderr_capture *capture);
void stderr_capture_end(struct stderr_capture *capture); /* restores stderr; {0} is fine */

/* Writes to `line` the last error since the previous call. Returns false if there was none. */
bool stderr_capture_take(struct stderr_capture *capture, char line[static STDERR_CAPTURE_SIZE]);

#endif
