/*
 * undo_stack.h: undo stack of what the user changes in the viewer: settings, refraction model,
 * comparison.
 *
 * A state is stored whole, not as a difference. Panels are not part of a state; a camera is
 * restored only when undo returns to another scene (undo_scenes.h).
 */
#ifndef FIRN_VIEW_UNDO_STACK_H
#define FIRN_VIEW_UNDO_STACK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/settings/settings.h"

enum {
    UNDO_STACK_COUNT = 128, /* capacity, in states; the oldest ones are dropped */
};

struct technique;

/* Source of the image on the right of the divider (side B). */
enum view_side_b {
    VIEW_SIDE_B_NONE,
    VIEW_SIDE_B_MODEL,     /* another refraction model with the same settings */
    VIEW_SIDE_B_STATE,     /* a stored refraction model with settings of its own */
    VIEW_SIDE_B_FILE,      /* an image file */
    VIEW_SIDE_B_REFERENCE, /* the path-traced reference, rendered on the CPU */
};

/* Everything that undo restores. */
struct view_state {
    uint32_t scene; /* number that the viewer gives each scene or environment it opens */
    struct settings settings;
    struct settings stated;            /* set by the user or options, without the scene's own */
    bool is_set[SETTINGS_FIELD_COUNT]; /* settings that the user or options have set */
    const struct technique *refraction;
    enum view_side_b other;
    const struct technique *split; /* refraction model of side B; NULL if there is none */
    struct settings right; /* settings of the right side with VIEW_SIDE_B_STATE; otherwise 0 */
    float env_rotate;      /* rotation of the panorama, degrees */
};

struct undo_stack {
    struct view_state states[UNDO_STACK_COUNT];
    uint32_t count;   /* 0 if nothing has been pushed */
    uint32_t at;      /* index of the current state */
    uint32_t gesture; /* gesture that produced the current state; 0 if it cannot be continued */
};

bool undo_stack_same_state(const struct view_state *a, const struct view_state *b);

/* Pushes a state and drops all states that could be redone. States of one continuous gesture (not
 * 0), such as a slider drag, replace each other, so that they are undone in one step. */
void undo_stack_push(struct undo_stack *history, const struct view_state *state, uint32_t gesture);

/* Makes the previous or next state current and returns it; NULL if there is none. */
const struct view_state *undo_stack_undo(struct undo_stack *history);
const struct view_state *undo_stack_redo(struct undo_stack *history);

/* Describes the difference of two states for the status bar, such as "cracks.count 2 -> 5". */
void undo_stack_describe(const struct view_state *before, const struct view_state *after,
                         char *text, size_t size);

#endif
