/*
 * opened.h: scenes that the viewer has shown and left, kept so that undo can return to them.
 */
#ifndef FIRN_VIEW_OPENED_H
#define FIRN_VIEW_OPENED_H

#include "src/view/history.h"
#include "src/view/picture.h"

struct opened {
    struct opened *next;
    uint32_t number;          /* scene number in struct view_state */
    struct app_picture state; /* options when the scene was left; the settings in it are ignored */
    struct camera camera;     /* camera when the scene was left */
    char *name, *environment; /* strings of `state`, owned */
};

/* Saves the scene of the current viewport under a number, replacing an older entry of this number.
 * Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status opened_add(struct opened **list, uint32_t number, const struct picture *now);

/* Returns the entry of this number, or NULL. */
const struct opened *opened_find(const struct opened *list, uint32_t number);

/* Frees the entries that no state of the undo stack refers to; all of them if it is NULL. */
void opened_forget(struct opened **list, const struct history *history);

#endif
