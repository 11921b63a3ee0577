/*
 * opened.h: scenes that a window has shown and left, for undo to go back to.
 */
#ifndef FIRN_VIEW_OPENED_H
#define FIRN_VIEW_OPENED_H

#include "src/view/history.h"
#include "src/view/picture.h"

struct opened {
    struct opened *next;
    uint32_t number;          /* of a view_state */
    struct app_picture state; /* as it was left; its settings do not matter */
    struct camera camera;     /* the same */
    char *name, *environment; /* of the state; own */
};

/* Keeps a picture's scene, in the place of an older one of this number. Logs: STATUS_TRY_AGAIN. */
MUST_USE enum status opened_add(struct opened **list, uint32_t number, const struct picture *now);

/* The one of this number, or NULL. */
const struct opened *opened_find(const struct opened *list, uint32_t number);

/* Forgets those that no state is of; NULL: all. */
void opened_forget(struct opened **list, const struct history *history);

#endif
