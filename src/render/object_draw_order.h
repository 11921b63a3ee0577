/* object_draw_order.h: assigns a scene's objects to the passes of a frame, with uniform data. */
#ifndef FIRN_RENDER_OBJECT_DRAW_ORDER_H
#define FIRN_RENDER_OBJECT_DRAW_ORDER_H

#include "src/render/compiled_frame.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/render/frame/pass_list.h"

/* Objects drawn by the frames of a plan. Empty if the plan has no per-object passes. */
struct frame_objects {
    struct frame_object *all; /* one per object of the plan */
    size_t count;
    struct frame_object_distance *order; /* the scene's objects, back to front */
    bool *is_taken;                      /* of each layer, while a layer is searched */
};

/* Allocates memory for the plan's objects. Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status frame_objects_init(struct frame_objects *objects,
                                        const struct frame_list *list, const struct scene *scene);
void frame_objects_finish(struct frame_objects *objects);

/* Sorts objects back to front, assigns them to the plan's passes, and writes their uniform data to
 * a frame slot. `reach` is how far rays look up from an object's centre, in bounding radii. */
void frame_objects_place(struct frame_objects *objects, const struct compiled_frame *compiled_frame,
                         uint32_t slot, const struct frame_view *view,
                         const struct globals *globals, float reach);

#endif
