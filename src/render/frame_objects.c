/* frame_objects.c: sorts the objects of a scene for a frame. */
#include "src/render/frame_objects.h"
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

struct frame_object_distance {
    float distance; /* from the eye, or an orthographic camera's plane, to the middle of the
                       object's box, metres */
    uint32_t object;
};

/* Share of an object's radius that lookups may miss it by (shaders/refract_inside.glsl). */
#define LOOKUP_ROOM 0.05f

enum status frame_objects_init(struct frame_objects *objects, const struct frame_list *list,
                               const struct scene *scene)
{
    *objects = (struct frame_objects){ .count = list->object_count };
    if (!objects->count)
        return STATUS_OK;
    objects->all = calloc(objects->count, sizeof(*objects->all));
    objects->order = calloc(scene->model.object_count, sizeof(*objects->order));
    if (objects->all && objects->order)
        return STATUS_OK;
    frame_objects_finish(objects);
    return log_out_of_memory("objects");
}

void frame_objects_finish(struct frame_objects *objects)
{
    free(objects->all);
    free(objects->order);
    *objects = (struct frame_objects){ 0 };
}

static int farthest_first(const void *a, const void *b)
{
    const struct frame_object_distance *x = a;
    const struct frame_object_distance *y = b;
    if (x->distance != y->distance)
        return x->distance > y->distance ? -1 : 1;
    return x->object < y->object ? -1 : 1;
}

static void sort(struct frame_object_distance *order, const struct frame_view *view,
                 const struct globals *globals)
{
    const struct model *model = &view->scene->model;
    for (uint32_t i = 0; i < model->object_count; i++) {
        const vec3s middle =
            glms_mat4_mulv3(globals->world_from_object, box_center(model->objects[i].box), 1.0f);
        order[i] = (struct frame_object_distance){
            .distance = view->camera.height > 0.0f ? glms_vec3_dot(middle, globals->forward)
                                                   : glms_vec3_distance(middle, view->camera.eye),
            .object = i,
        };
    }
    qsort(order, model->object_count, sizeof(*order), farthest_first);
}

void frame_objects_place(struct frame_objects *objects, const struct frame_exec *frame_exec,
                         uint32_t slot, const struct frame_view *view,
                         const struct globals *globals, float reach)
{
    const struct frame_list *list = &frame_exec->frame->list;
    const VkExtent2D size = frame_exec->frame->plan->view;
    struct frame_view drawn = *view; /* with the pixels of an interleaved tile */
    drawn.width = size.width;
    drawn.height = size.height;
    if (!objects->count)
        return;
    sort(objects->order, view, globals);
    for (size_t i = 0; i < objects->count; i++) {
        const struct frame_list_object *rows = &list->objects[i];
        const uint32_t index = objects->order[rows->place].object;
        const struct object *object = &view->scene->model.objects[index];
        const struct globals own = frame_view_object_globals(view, globals, index);
        void *memory = rg_exec_mapped(frame_exec->exec, rows->globals, slot);
        if (memory)
            memcpy(memory, &own, sizeof(own));
        objects->all[i] = (struct frame_object){
            .rows = rows->rows,
            .row_count = rows->row_count,
            .first_index = object->first_index,
            .index_count = object->index_count,
            .area = frame_view_box_area(view, &own, object->box, size, 0.0f),
            .lookup_area = { .extent = size },
            .reach = frame_view_reach(&drawn, &own, reach),
        };
        /* The first one resets the maps everywhere, because they may be layers. */
        if (!(reach > 0.0f) && rows->place)
            objects->all[i].lookup_area =
                frame_view_box_area(view, &own, object->box, size, LOOKUP_ROOM);
    }
}
