/* list.h: collects the rows of a frame from the techniques that settings and scene select. */
#ifndef FIRN_FRAME_LIST_H
#define FIRN_FRAME_LIST_H

#include "src/base/status.h"
#include "src/tech/row_builder.h"
#include "src/tech/target_scale.h"
#include "src/tech/technique.h"

/* Rows that draw one of several objects: in each frame another one, since the farthest is first. */
struct frame_list_object {
    const struct rg_buffer *globals; /* replaces frame_globals in the rows */
    struct rg_pass *rows;
    const char **names; /* of the rows, the same for each object: without its place */
    size_t row_count;
    uint32_t place; /* of the object among all, ordered by distance, farthest first */
    bool of_layers; /* they draw it again, for layers */
};

/* The parts and objects point to memory of the builder, so they live as long as the list. */
struct frame_list {
    struct rg_technique *parts; /* in the order of drawing; owned by the list */
    size_t count;
    struct frame_list_object *objects; /* three for each object; empty for a single one */
    size_t object_count;
    bool is_nested; /* objects are those that are within no other one */
    bool are_local; /* the rows of all objects but the first draw only where rays look them up */
    struct row_builder builder;
    struct small_images small;
};

/* Fills *list. Logs and returns STATUS_TRY_AGAIN when out of memory; *list is then {0}. */
MUST_USE enum status frame_list_init(struct frame_list *list,
                                     const struct technique_choice *choice);
void frame_list_finish(struct frame_list *list); /* {0} is fine */

/* Returns a row's name, without the place of the object that it draws. */
const char *frame_list_name(const struct frame_list *list, const struct rg_pass *row);

/* Returns whether each picture's frames draw the environment cube, because it may change. */
bool frame_draws_cube(const struct settings *settings, const struct scene *scene);

/* The settings with switches as the scene has them. */
struct settings frame_settings(const struct settings *settings, const struct scene *scene);

/* Returns the width of the environment cube's faces for pictures `height` pixels high, texels: what
 * env_cube.size says, or the power of two from nine tenths of the height on. */
uint32_t frame_face_size(const struct settings *settings, uint32_t height);

/* The settings with a rung's own values in place of `auto`, and those of pictures `height` pixels
 * high. `rung` may be NULL. */
struct settings frame_settle(const struct settings *settings, const struct technique *rung,
                             uint32_t height);

#endif
