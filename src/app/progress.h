/* progress.h: a bar over the samples of all frames, drawn over itself, on terminals only. */
#ifndef FIRN_APP_PROGRESS_H
#define FIRN_APP_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct progress {
    uint32_t frames, samples;             /* there are, and of each frame */
    uint32_t frame;                       /* index of the one at work */
    const char *frame_name, *sample_name; /* "frame", "samples" */
    bool visible;
};

void progress_begin(struct progress *progress, uint32_t frames, uint32_t samples, bool quiet);

/* Draws it with so many samples of the frame done. */
void progress_show(const struct progress *progress, uint32_t samples);

/* Makes room for words. */
void progress_clear(const struct progress *progress);

#endif
