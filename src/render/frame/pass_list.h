/* pass_list.h: collects the passes of the techniques that settings and scene select. */
#ifndef FIRN_RENDER_FRAME_PASS_LIST_H
#define FIRN_RENDER_FRAME_PASS_LIST_H

#include "src/base/status.h"
#include "src/tech/inclusions/low_res_inclusions.h"
#include "src/tech/pass_arena.h"
#include "src/tech/technique.h"

/* Passes for one position in back-to-front order, whose object may change from frame to frame. */
struct frame_list_object {
    const struct rg_buffer *globals; /* replaces frame_globals in the passes */
    struct rg_pass *passes;
    const char **names; /* pass names, without the object's suffix */
    size_t pass_count;
    uint32_t depth_index; /* position in back-to-front order */
    bool is_for_layers;   /* the passes draw it for layers */
};

/* Passes of a frame. Groups and objects point to memory of the `builder` below. */
struct frame_list {
    struct rg_technique *pass_groups; /* in drawing order; owned */
    bool *is_of_object;               /* of each group; owned */
    size_t *others;                   /* indices of the groups that belong to no object */
    size_t count, other_count;
    struct frame_list_object *objects; /* per object: image, layers, faces */
    size_t object_count;
    bool is_nested; /* nested objects are not listed separately */
    /* True if the passes of all objects but the farthest draw only the area near their object. */
    bool is_local_to_objects;
    struct pass_arena builder;
    struct low_res_images small;
};

/* Collects a frame's passes. If out of memory, logs, zeroes *list and returns STATUS_TRY_AGAIN. If
 * the scene has too many objects to rasterise, logs and returns STATUS_DATA. */
MUST_USE enum status frame_list_init(struct frame_list *list,
                                     const struct technique_config *config);
void frame_list_finish(struct frame_list *list); /* {0} is fine */

/* Returns a pass's name without the suffix that identifies the object. */
const char *frame_list_pass_name(const struct frame_list *list, const struct rg_pass *pass);

/* Returns true if every frame draws the environment cube, because its content may change. */
bool frame_draws_cube(const struct settings *settings, const struct scene *scene);

/* Returns the settings after replacing those that the scene determines. */
struct settings frame_settings(const struct settings *settings, const struct scene *scene);

/* Returns the width of environment cube faces, in texels: env_cube.size, if set. Otherwise returns
 * the smallest power of two that is at least 0.9 * height, clamped to 128 to 2048. */
uint32_t frame_face_size(const struct settings *settings, uint32_t height);

/* Returns the settings that an image is drawn with. Values that follow from the scene are set, and
 * `auto` is resolved. `refraction` may be NULL. `height` is the image height in pixels. */
struct settings frame_resolve_settings(const struct settings *settings, const struct scene *scene,
                                       const struct technique *refraction, uint32_t height);

#endif
