/* reloads.h: log of the latest changes that took longer than a frame, with their reasons. */
#ifndef FIRN_VIEW_RELOADS_H
#define FIRN_VIEW_RELOADS_H

#include <stdint.h>

enum {
    RELOAD_COUNT = 8,  /* older messages are dropped */
    RELOAD_SIZE = 200, /* maximum bytes of a message; longer ones are truncated */
};

struct reloads {
    char words[RELOAD_COUNT][RELOAD_SIZE]; /* message n is at n modulo RELOAD_COUNT */
    uint32_t count;                        /* messages added in total */
};

void reloads_add(struct reloads *reloads, const char *words);

/* Returns the message that was added `ago` messages before the newest; NULL if there is none. */
const char *reloads_at(const struct reloads *reloads, uint32_t ago);

#endif
