/*
 * history.h: undo stack of what the user changes in the viewer: settings, refraction model,
 * comparison.
 *
 * A state is stored whole, not as a difference. Panels are not part of a state; a camera is
 * restored only when undo returns to another scene (opened.h).
 */
#ifndef FIRN_VIEW_HISTORY_H
#define FIRN_VIEW_HISTORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/settings/settings.h"

enum {
    HISTORY_COUNT = 128, /* capacity, in states; the oldest ones are dropped */
};

struct technique;

/* Source of the image on the right of the divider (side B). */
enum view_other {
    VIEW_OTHER_NONE,
    VIEW_OTHER_RUNG,      /* another refraction model with the same settings */
    VIEW_OTHER_STATE,     /* a stored refraction model with settings of its own */
    VIEW_OTHER_FILE,      /* an image file */
    VIEW_OTHER_REFERENCE, /* the path-traced reference, rendered on the CPU */
};

/* Everything that undo restores. */
struct view_state {
    uint32_t scene; /* number that the viewer gives each scene or environment it opens */
    struct settings settings;
    struct settings stated;            /* set by the user or options, without the scene's own */
    bool is_set[SETTINGS_FIELD_COUNT]; /* settings that the user or options have set */
    const struct technique *rung;
    enum view_other other;
    const struct technique *split; /* refraction model of side B; NULL if there is none */
    struct settings right; /* settings of the right side with VIEW_OTHER_STATE; otherwise 0 */
    float env_rotate;      /* rotation of the panorama, degrees */
};

struct history {
    struct view_state states[HISTORY_COUNT];
    uint32_t count;   /* 0 if nothing has been pushed */
    uint32_t at;      /* index of the current state */
    uint32_t gesture; /* gesture that produced the current state; 0 if it cannot be continued */
};

bool history_same(const struct view_state *a, const struct view_state *b);

/* Pushes a state and drops all states that could be redone. States of one continuous gesture (not
 * 0), such as a slider drag, replace each other, so that they are undone in one step. */
void history_add(struct history *history, const struct view_state *state, uint32_t gesture);

/* Makes the previous or next state current and returns it; NULL if there is none. */
const struct view_state *history_undo(struct history *history);
const struct view_state *history_redo(struct history *history);

/* Describes the difference of two states for the status bar, such as "cracks.count 2 -> 5". */
void history_name(const struct view_state *before, const struct view_state *after, char *text,
                  size_t size);

#endif
