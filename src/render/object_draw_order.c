/* object_draw_order.c: depth-sorts a scene's objects and groups them into layers drawn at once. */
#include "src/render/object_draw_order.h"
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

struct frame_object_distance {
    /* distance in metres of the box centre from the camera, or from the plane of an orthographic
     * camera */
    float distance;
    uint32_t object;
};

/* Margin around an object's screen area, as a fraction of its bounding radius. It is needed because
 * G-buffer lookups may land just outside the object (shaders/refract/refract_march_ray.glsl). */
#define LOOKUP_MARGIN 0.05f

enum status frame_objects_init(struct frame_objects *objects, const struct frame_list *list,
                               const struct scene *scene)
{
    *objects = (struct frame_objects){ .count = list->object_count };
    if (!objects->count)
        return STATUS_OK;
    objects->all = calloc(objects->count, sizeof(*objects->all));
    objects->order = calloc(scene->model.object_count, sizeof(*objects->order));
    objects->is_taken = malloc(objects->count + 2);
    if (objects->all && objects->order && objects->is_taken)
        return STATUS_OK;
    frame_objects_finish(objects);
    return log_out_of_memory("objects");
}

void frame_objects_finish(struct frame_objects *objects)
{
    free(objects->all);
    free(objects->order);
    free(objects->is_taken);
    *objects = (struct frame_objects){ 0 };
}

static int compare_back_to_front(const void *a, const void *b)
{
    const struct frame_object_distance *x = a;
    const struct frame_object_distance *y = b;
    if (x->distance != y->distance)
        return x->distance > y->distance ? -1 : 1;
    return x->object < y->object ? -1 : 1;
}

/* Sorts the scene's objects back to front, and returns their number. If `is_nested`, leaves out
 * objects that another object encloses. */
static uint32_t sort(struct frame_object_distance *order, const struct frame_view *view,
                     const struct globals *globals, bool is_nested)
{
    const struct model *model = &view->scene->model;
    uint32_t count = 0;
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (is_nested && model->objects[i].enclosing_object)
            continue;
        const vec3s center =
            glms_mat4_mulv3(globals->world_from_object, box_center(model->objects[i].box), 1.0f);
        order[count++] = (struct frame_object_distance){
            .distance = view->camera.height > 0.0f ? glms_vec3_dot(center, globals->forward)
                                                   : glms_vec3_distance(center, view->camera.eye),
            .object = i,
        };
    }
    qsort(order, count, sizeof(*order), compare_back_to_front);
    return count;
}

static bool overlap(VkRect2D a, VkRect2D b)
{
    return a.offset.x < b.offset.x + (int32_t)b.extent.width &&
           b.offset.x < a.offset.x + (int32_t)a.extent.width &&
           a.offset.y < b.offset.y + (int32_t)b.extent.height &&
           b.offset.y < a.offset.y + (int32_t)a.extent.height;
}

/* Returns true if rays through one object may look up faces of the other in screen space. */
static bool lookups_overlap(const struct frame_object *a, const struct frame_object *b)
{
    return overlap(a->reach, b->area) || overlap(b->reach, a->area);
}

/* Returns the bounding rectangle of two rectangles. */
static VkRect2D bounding_rectangle(VkRect2D a, VkRect2D b)
{
    const int32_t x[2] = { a.offset.x + (int32_t)a.extent.width,
                           b.offset.x + (int32_t)b.extent.width };
    const int32_t y[2] = { a.offset.y + (int32_t)a.extent.height,
                           b.offset.y + (int32_t)b.extent.height };
    VkRect2D both = a;
    both.offset.x = a.offset.x < b.offset.x ? a.offset.x : b.offset.x;
    both.offset.y = a.offset.y < b.offset.y ? a.offset.y : b.offset.y;
    both.extent.width = (uint32_t)((x[0] > x[1] ? x[0] : x[1]) - both.offset.x);
    both.extent.height = (uint32_t)((y[0] > y[1] ? y[0] : y[1]) - both.offset.y);
    return both;
}

/* Returns the lowest possible layer for an object. The layer must be above all farther objects that
 * overlap the object on screen. lookups_overlap() must be false for all objects in the layer. */
static uint32_t layer_of(const struct frame_objects *objects, uint32_t index)
{
    const struct frame_object *all = objects->all, *object = &all[index];
    uint32_t layer = 1;
    memset(objects->is_taken, 0, objects->count + 2);
    for (uint32_t i = 1; i < index; i++) {
        if (all[i].layer >= layer && overlap(all[i].area, object->area))
            layer = all[i].layer + 1;
        if (lookups_overlap(&all[i], object))
            objects->is_taken[all[i].layer] = true;
    }
    while (objects->is_taken[layer])
        layer++;
    return layer;
}

/* Assigns the objects, sorted back to front, to layers. The passes of a layer's first object draw
 * the whole layer, because this saves barriers. The farthest object is alone in layer 0, because
 * its passes also clear the G-buffer. */
static void assign_layers(const struct frame_objects *placed, uint32_t count)
{
    struct frame_object *objects = placed->all;
    for (uint32_t i = 1; i < count; i++) {
        struct frame_object *first = NULL, *last = NULL;
        objects[i].layer = layer_of(placed, i);
        for (uint32_t k = 1; k < i; k++) {
            if (objects[k].layer != objects[i].layer)
                continue;
            first = first ? first : &objects[k];
            last = &objects[k];
        }
        if (!first)
            continue;
        first->drawn = bounding_rectangle(first->drawn, objects[i].reach);
        last->next = &objects[i];
        objects[i].drawn = (VkRect2D){ 0 };
    }
}

void frame_objects_place(struct frame_objects *objects, const struct compiled_frame *compiled_frame,
                         uint32_t slot, const struct frame_view *view,
                         const struct globals *globals, float reach)
{
    const struct frame_list *list = &compiled_frame->frame->list;
    const VkExtent2D size = compiled_frame->frame->plan->view;
    struct frame_view drawn = *view; /* view of one interleaved tile */
    drawn.width = size.width;
    drawn.height = size.height;
    if (!objects->count)
        return;
    const uint32_t count = sort(objects->order, view, globals, list->is_nested);
    for (size_t i = 0; i < objects->count; i++) {
        const struct frame_list_object *entry = &list->objects[i];
        const uint32_t index = objects->order[entry->depth_index].object;
        const struct object *object = &view->scene->model.objects[index];
        const struct globals own = frame_view_object_globals(view, globals, index);
        void *memory = rg_exec_mapped(compiled_frame->exec, entry->globals, slot);
        if (memory)
            memcpy(memory, &own, sizeof(own));
        objects->all[i] = (struct frame_object){
            .passes = entry->passes,
            .pass_count = entry->pass_count,
            .first_index = object->first_index,
            .index_count = object->index_count,
            .area = frame_view_box_area(view, &own, object->box, size, 0.0f),
            .lookup_area = { .extent = size },
            .reach = frame_view_reach(&drawn, &own, reach),
        };
        objects->all[i].drawn = objects->all[i].reach;
        /* The farthest object, with depth_index 0, keeps the whole area to clear the G-buffer. */
        if (!(reach > 0.0f) && entry->depth_index)
            objects->all[i].lookup_area =
                frame_view_box_area(view, &own, object->box, size, LOOKUP_MARGIN);
    }
    if (list->is_local_to_objects)
        assign_layers(objects, count);
}
