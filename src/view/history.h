/*
 * history.h: what hands have changed, to be taken back and done again.
 *
 * A list of whole states: the one in use and those before and after it. Panels are not in it, and a
 * camera only as it was when its scene was left (opened.h).
 */
#ifndef FIRN_VIEW_HISTORY_H
#define FIRN_VIEW_HISTORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/settings/settings.h"

enum {
    HISTORY_COUNT = 128, /* states; older ones are forgotten */
};

struct technique;

/* What is right of the divider. */
enum view_other {
    VIEW_OTHER_NONE,
    VIEW_OTHER_RUNG,      /* another rung with the same settings */
    VIEW_OTHER_STATE,     /* a rung with settings of its own */
    VIEW_OTHER_FILE,      /* a picture */
    VIEW_OTHER_REFERENCE, /* the truth, traced on the CPU */
};

/* All that undo brings back. */
struct view_state {
    uint32_t scene; /* a number of the view's for each scene, or environment, that it opens */
    struct settings settings;
    struct settings stated;            /* without what the scene brings, and */
    bool is_set[SETTINGS_FIELD_COUNT]; /* which of it options and hands have said */
    const struct technique *rung;
    enum view_other other;
    const struct technique *split; /* the rung on the right; NULL: it has none */
    struct settings right;         /* of VIEW_OTHER_STATE; else 0 */
    float env_rotate;              /* of the panorama, degrees */
};

struct history {
    struct view_state states[HISTORY_COUNT];
    uint32_t count;   /* 0: not begun */
    uint32_t at;      /* the state in use */
    uint32_t gesture; /* that made it; 0: none that goes on */
};

bool history_same(const struct view_state *a, const struct view_state *b);

/* A new state is in use; what had been undone is forgotten. While a gesture (not 0) goes on, the
 * state takes the place of the one that the same gesture has made before. */
void history_add(struct history *history, const struct view_state *state, uint32_t gesture);

/* The state to be used now, or NULL: there is none before or after. It is in use then. */
const struct view_state *history_undo(struct history *history);
const struct view_state *history_redo(struct history *history);

/* What makes one of the other, in words: "cracks.count 2 -> 5". */
void history_name(const struct view_state *before, const struct view_state *after, char *text,
                  size_t size);

#endif
