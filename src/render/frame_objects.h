/* frame_objects.h: which of a scene's objects the rows of a frame draw, and their uniform data. */
#ifndef FIRN_RENDER_FRAME_OBJECTS_H
#define FIRN_RENDER_FRAME_OBJECTS_H

#include "src/frame/list.h"
#include "src/frame/view.h"
#include "src/render/frame_exec.h"

/* Memory for the objects of a plan's frames; {0}: a plan without rows for several objects. */
struct frame_objects {
    struct frame_object *all; /* those of the plan's list */
    size_t count;
    struct frame_object_distance *order; /* of the scene's objects, farthest first */
};

/* Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status frame_objects_init(struct frame_objects *objects,
                                        const struct frame_list *list, const struct scene *scene);
void frame_objects_finish(struct frame_objects *objects);

/* Chooses an object for each place, and writes the uniform data of a frame's slot. `reach` is the
 * rung's (src/tech/technique.h). */
void frame_objects_place(struct frame_objects *objects, const struct frame_exec *frame_exec,
                         uint32_t slot, const struct frame_view *view,
                         const struct globals *globals, float reach);

#endif
