/* pass_list.h: collects the passes of a frame from the techniques that settings and scene select.
 */
#ifndef FIRN_FRAME_PASS_LIST_H
#define FIRN_FRAME_PASS_LIST_H

#include "src/base/status.h"
#include "src/tech/inclusions/low_res_inclusions.h"
#include "src/tech/pass_builder.h"
#include "src/tech/technique.h"

/* Passes that draw the object at one position in the depth order, which varies between frames. */
struct frame_list_object {
    const struct rg_buffer *globals; /* uniform buffer that replaces frame_globals in the passes */
    struct rg_pass *rows;
    const char **names; /* names of the passes, without the suffix for the object's position */
    size_t row_count;
    uint32_t depth_index; /* position of the object in the depth order, farthest first */
    bool is_for_layers;   /* the passes draw the object once more, for the layers */
};

/* Passes of a frame. Parts and objects point to memory of the builder, which the list owns. */
struct frame_list {
    struct rg_technique *parts; /* in drawing order; owned by the list */
    size_t count;
    struct frame_list_object *objects; /* three per object (image, layers, cube); none for one */
    size_t object_count;
    bool is_nested; /* objects that are inside another object are not in the list */
    bool
        /* passes of all objects but the first only draw the pixels that rays look up */
        is_local_to_objects;
    struct pass_builder builder;
    struct low_res_images small;
};

/* Fills *list. Logs and returns STATUS_TRY_AGAIN when out of memory; *list is then {0}. */
MUST_USE enum status frame_list_init(struct frame_list *list,
                                     const struct technique_choice *choice);
void frame_list_finish(struct frame_list *list); /* {0} is fine */

/* Returns a pass's name, without the suffix for the position of the object that it draws. */
const char *frame_list_row_name(const struct frame_list *list, const struct rg_pass *row);

/* Returns true if every frame draws the environment cube, because its content may change. */
bool frame_draws_cube(const struct settings *settings, const struct scene *scene);

/* Returns the settings with those replaced that the scene determines. */
struct settings frame_settings(const struct settings *settings, const struct scene *scene);

/* Returns the width of the environment cube's faces for images `height` pixels high, texels: the
 * setting env_cube.size or, if it is 0, the smallest power of two of at least 0.9 * height. */
uint32_t frame_face_size(const struct settings *settings, uint32_t height);

/* Returns the settings with `auto` resolved for a refraction model (or NULL) and height, pixels. */
struct settings frame_resolve_settings(const struct settings *settings,
                                       const struct technique *refraction, uint32_t height);

#endif
