/* progress.c: how far it is. */
#include "src/app/progress.h"
#include <stdio.h>
#include <unistd.h>

enum {
    BAR = 30,
    COLUMNS = 78 /* at most, words and all */
};

void progress_begin(struct progress *progress, uint32_t frames, uint32_t samples, bool quiet)
{
    *progress = (struct progress){
        .frames = frames,
        .samples = samples,
        .frame_name = "frame",
        .sample_name = "samples",
        .visible = !quiet && (frames > 1 || samples > 1) && isatty(STDERR_FILENO),
    };
}

void progress_show(const struct progress *p, uint32_t samples)
{
    uint64_t done = (uint64_t)p->frame * p->samples + samples;
    int filled = (int)(done * BAR / ((uint64_t)p->frames * p->samples));
    if (!p->visible)
        return;
    fprintf(stderr, "\r[%.*s%*s]", filled, "##############################", BAR - filled, "");
    if (p->frames > 1)
        fprintf(stderr, " %s %u/%u", p->frame_name, p->frame + 1, p->frames);
    if (p->samples > 1)
        fprintf(stderr, "%s %u/%u %s", p->frames > 1 ? "," : "", samples, p->samples,
                p->sample_name);
    fflush(stderr);
}

void progress_clear(const struct progress *p)
{
    if (p->visible)
        fprintf(stderr, "\r%*s\r", COLUMNS, "");
}
