/* progress.c: how far it is. */
#include "src/app/progress.h"
#include <stdio.h>
#include <unistd.h>

enum {
    BAR = 30,
    COLUMNS = 78 /* at most, words and all */
};

void progress_begin(struct progress *progress, uint32_t frames, const char *step_name, bool quiet)
{
    *progress = (struct progress){
        .frames = frames,
        .frame_name = "frame",
        .step_name = step_name,
        .visible = !quiet && isatty(STDERR_FILENO),
    };
}

void progress_show(const struct progress *p, uint32_t done, uint32_t all)
{
    const double share = (p->frame + (double)done / all) / p->frames;
    const int filled = (int)(share * BAR);
    if (!p->visible || (p->frames == 1 && all == 1))
        return;
    fprintf(stderr, "\r[%.*s%*s]", filled, "##############################", BAR - filled, "");
    if (p->frames > 1)
        fprintf(stderr, " %s %u/%u", p->frame_name, p->frame + 1, p->frames);
    if (all > 1)
        fprintf(stderr, "%s %u/%u %s", p->frames > 1 ? "," : "", done, all, p->step_name);
    fflush(stderr);
}

void progress_clear(const struct progress *p)
{
    if (p->visible)
        fprintf(stderr, "\r%*s\r", COLUMNS, "");
}
