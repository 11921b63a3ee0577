/* undo_stack.h: undo stack of the viewer's settings, refraction model and comparison. Each entry is
 * a complete state, but without the panels. Undo restores the camera only if it returns to a
 * different scene (undo_scenes.h). */
#ifndef FIRN_VIEW_SESSION_UNDO_STACK_H
#define FIRN_VIEW_SESSION_UNDO_STACK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/settings/settings.h"

enum {
    UNDO_STACK_COUNT = 128, /* maximum states; the oldest are dropped */
};

struct technique;

/* Source of the image on the right of the divider (side B). */
enum view_side_b {
    VIEW_SIDE_B_NONE,
    VIEW_SIDE_B_MODEL,     /* another refraction model with the same settings */
    VIEW_SIDE_B_STATE,     /* a stored refraction model and its stored settings */
    VIEW_SIDE_B_FILE,      /* an image file */
    VIEW_SIDE_B_REFERENCE, /* the path-traced reference, rendered on the CPU */
};

/* Everything that undo restores. */
struct view_state {
    uint32_t scene; /* scene number; each opened scene or environment gets a new one */
    struct settings settings;
    struct settings user_settings; /* without the scene's own settings */
    const struct technique *refraction;
    enum view_side_b side_b;
    const struct technique *split;  /* model of side B, or NULL */
    struct settings right_settings; /* only with VIEW_SIDE_B_STATE; otherwise 0 */
    float env_rotate;               /* rotation of the panorama, degrees */
};

struct undo_stack {
    struct view_state states[UNDO_STACK_COUNT];
    uint32_t count;   /* 0 if nothing has been pushed */
    uint32_t at;      /* index of the current state */
    uint32_t gesture; /* gesture in progress, or 0 */
};

bool undo_stack_same_state(const struct view_state *a, const struct view_state *b);

/* Pushes a state and drops all states that could be redone. If the newest state has an equal,
 * nonzero `gesture`, replaces it, because one undo must revert a whole slider drag. */
void undo_stack_push(struct undo_stack *h, const struct view_state *state, uint32_t gesture);

/* Makes the previous state current and returns this state. Returns NULL if there is none. */
const struct view_state *undo_stack_undo(struct undo_stack *h);
const struct view_state *undo_stack_redo(struct undo_stack *h); /* next state instead */

/* Describes the difference of two states for the status bar, such as "cracks.count 2 -> 5". */
void undo_stack_describe(const struct view_state *before, const struct view_state *after,
                         char *text, size_t size);

#endif
