/* progress.h: a bar over the steps of all frames, drawn over itself, on terminals only. */
#ifndef FIRN_APP_PROGRESS_H
#define FIRN_APP_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    PROGRESS_COLUMNS = 78 /* of a line, at most */
};

struct progress {
    uint32_t frames;        /* there are */
    uint32_t frame;         /* index of the one at work */
    const char *frame_name; /* "frame" */
    const char *step_name;  /* "samples": what a frame is made of */
    double begin;           /* clock_seconds() */
    bool visible;
};

void progress_begin(struct progress *progress, uint32_t frames, const char *step_name, bool quiet);

/* Draws it with so many of the frame's steps done. One step of one frame is not worth a bar. */
void progress_show(const struct progress *progress, uint32_t done, uint32_t all);

/* Fills `line` with the line after so many seconds: the bar, the steps and, after 2 seconds, the
 * time that the rest takes at the same speed, where there is room for it. */
void progress_print(char line[static PROGRESS_COLUMNS + 1], const struct progress *progress,
                    uint32_t done, uint32_t all, double seconds);

/* Makes room for words. */
void progress_clear(const struct progress *progress);

#endif
