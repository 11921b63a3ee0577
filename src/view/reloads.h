/* reloads.h: what took longer than a frame, and why. */
#ifndef FIRN_VIEW_RELOADS_H
#define FIRN_VIEW_RELOADS_H

#include <stdint.h>

enum {
    RELOAD_COUNT = 8,  /* older ones are forgotten */
    RELOAD_SIZE = 200, /* bytes of the words about one; more are cut */
};

struct reloads {
    char words[RELOAD_COUNT][RELOAD_SIZE]; /* number n is at n modulo their count */
    uint32_t count;                        /* ever */
};

void reloads_add(struct reloads *reloads, const char *words);

/* The newest is 0; NULL: there are no more. */
const char *reloads_at(const struct reloads *reloads, uint32_t ago);

#endif
