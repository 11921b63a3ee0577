/*
 * undo_scenes.h: scenes shown earlier in the viewer, kept so that undo can show them again.
 */
#ifndef FIRN_VIEW_SESSION_UNDO_SCENES_H
#define FIRN_VIEW_SESSION_UNDO_SCENES_H

#include "src/view/session/undo_stack.h"
#include "src/view/view_renderers.h"

struct undo_scene {
    struct undo_scene *next;
    uint32_t number;          /* scene number in struct view_state */
    struct setup_image state; /* options of the scene; settings unused */
    struct camera camera;
    char *name, *environment, *material; /* strings of `state`, owned */
    char change[96]; /* how it differs from the scene before; "" for another file */
};

/* Saves the viewport's scene under `number`. Replaces any older scene with this number. If out of
 * memory, logs an error and returns STATUS_TRY_AGAIN. */
MUST_USE enum status undo_scenes_add(struct undo_scene **list, uint32_t number,
                                     const struct viewport *now, const char *change);

/* Returns the scene saved under this number; NULL if there is none. */
const struct undo_scene *undo_scenes_find(const struct undo_scene *list, uint32_t number);

/* Frees the scenes to which no state of `stack` refers. If `stack` is NULL, frees all scenes. */
void undo_scenes_prune(struct undo_scene **list, const struct undo_stack *stack);

#endif
