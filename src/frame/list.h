/* list.h: the rows of a frame, from the techniques that the settings and the scene choose. */
#ifndef FIRN_FRAME_LIST_H
#define FIRN_FRAME_LIST_H

#include "src/base/status.h"
#include "src/tech/row_builder.h"
#include "src/tech/technique.h"

/* Points into itself where it is filled: rows that were made live in its builder. */
struct frame_list {
    struct rg_technique *parts; /* in the order of drawing; the list owns them */
    size_t count;
    struct row_builder builder;
};

/* Logs and returns STATUS_TRY_AGAIN when memory is short; *list is then {0}. */
MUST_USE enum status frame_list_init(struct frame_list *list,
                                     const struct technique_choice *choice);
void frame_list_finish(struct frame_list *list); /* {0} is fine */

/* The environment cube is drawn by pictures' own frames, as it changes. */
bool frame_draws_cube(const struct settings *settings, const struct scene *scene);

/* The settings with switches as the scene has them: what is recorded with its pictures. */
struct settings frame_settings(const struct settings *settings, const struct scene *scene);

#endif
