/* progress.h: progress bar over all frames and their steps, shown only if stderr is a terminal. */
#ifndef FIRN_APP_PROGRESS_H
#define FIRN_APP_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    PROGRESS_COLUMNS = 78 /* maximum length of a line */
};

struct progress {
    uint32_t frames;        /* number of frames */
    uint32_t frame;         /* index of the frame being drawn */
    const char *frame_name; /* "frame" */
    const char *step_name;  /* "samples": the steps of a frame */
    double begin;           /* clock_seconds() */
    bool visible;
};

void progress_begin(struct progress *progress, uint32_t frames, const char *step_name, bool quiet);

/* Draws the bar after `done` of the frame's `all` steps, unless there is only one step in total. */
void progress_show(const struct progress *progress, uint32_t done, uint32_t all);

/* Writes the progress bar and the step count to `line`. `seconds` is the time since the start.
 * After 2 seconds, adds the estimated remaining time if there is room. */
void progress_print(char line[static PROGRESS_COLUMNS + 1], const struct progress *progress,
                    uint32_t done, uint32_t all, double seconds);

/* Erases the bar before other output is printed. */
void progress_clear(const struct progress *progress);

#endif
