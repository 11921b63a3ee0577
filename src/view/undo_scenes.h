/*
 * undo_scenes.h: scenes that the viewer has shown and left, kept so that undo can return to them.
 */
#ifndef FIRN_VIEW_UNDO_SCENES_H
#define FIRN_VIEW_UNDO_SCENES_H

#include "src/view/undo_stack.h"
#include "src/view/viewport.h"

struct undo_scene {
    struct undo_scene *next;
    uint32_t number;        /* scene number in struct view_state */
    struct app_image state; /* options of the scene; settings unused */
    struct camera camera;
    char *name, *environment; /* strings of `state`, owned */
};

/* Saves the viewport's scene under a number, replacing an older scene with that number. Logs and
 * returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status undo_scenes_add(struct undo_scene **list, uint32_t number,
                                     const struct viewport *now);

/* Returns the scene saved under this number; NULL if there is none. */
const struct undo_scene *undo_scenes_find(const struct undo_scene *list, uint32_t number);

/* Frees the scenes that no state of the undo stack refers to; all scenes if `stack` is NULL. */
void undo_scenes_prune(struct undo_scene **list, const struct undo_stack *stack);

#endif
