/* progress.c: progress bar on a terminal, with an estimate of the remaining time. */
#include "src/app/progress.h"
#include <stdio.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/standard_streams.h"

enum {
    BAR = 30
};

void progress_begin(struct progress *progress, uint32_t frames, const char *step_name, bool quiet)
{
    *progress = (struct progress){
        .frames = frames,
        .frame_name = "frame",
        .step_name = step_name,
        .begin = clock_seconds(),
        .visible = !quiet && standard_streams_is_terminal(),
    };
}

/* Appends a text to the line if all of it fits. */
static void add(char *line, const char *text)
{
    const size_t used = strlen(line), length = strlen(text);
    if (used + length <= PROGRESS_COLUMNS)
        memcpy(line + used, text, length + 1);
}

/* Appends the remaining time: "0:09 left" or "1:05:00 left". */
static void add_time(char *line, double seconds)
{
    const unsigned left = (unsigned)(seconds + 0.5), minutes = left / 60 % 60;
    char text[64];
    if (left >= 3600)
        snprintf(text, sizeof(text), ", %u:%02u:%02u left", left / 3600, minutes, left % 60);
    else
        snprintf(text, sizeof(text), ", %u:%02u left", minutes, left % 60);
    add(line, text);
}

void progress_print(char line[static PROGRESS_COLUMNS + 1], const struct progress *p, uint32_t done,
                    uint32_t all, double seconds)
{
    const double min_seconds = 2.0, max_seconds = 3.6e6; /* limits of elapsed and remaining time */
    const double fraction = (p->frame + (double)done / all) / p->frames;
    const int filled = (int)(fraction * BAR);
    char text[128];
    snprintf(line, PROGRESS_COLUMNS + 1, "[%.*s%*s]", filled, "##############################",
             BAR - filled, "");
    if (p->frames > 1) {
        snprintf(text, sizeof(text), " %s %u/%u", p->frame_name, p->frame + 1, p->frames);
        add(line, text);
    }
    if (all > 1) {
        snprintf(text, sizeof(text), "%s %u/%u %s", p->frames > 1 ? "," : "", done, all,
                 p->step_name);
        add(line, text);
    }
    if (seconds >= min_seconds && fraction > 0.0 &&
        seconds * (1.0 - fraction) / fraction < max_seconds)
        add_time(line, seconds * (1.0 - fraction) / fraction);
}

void progress_show(const struct progress *p, uint32_t done, uint32_t all)
{
    char line[PROGRESS_COLUMNS + 1];
    if (!p->visible || (p->frames == 1 && all == 1))
        return;
    progress_print(line, p, done, all, clock_seconds() - p->begin);
    fprintf(stderr, "\r%-*s", PROGRESS_COLUMNS, line);
    fflush(stderr);
}

void progress_clear(const struct progress *p)
{
    if (p->visible)
        fprintf(stderr, "\r%*s\r", PROGRESS_COLUMNS, "");
}
