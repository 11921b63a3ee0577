/*
 * pass_list.c: collects the passes of all techniques, phase by phase.
 *
 * Several refractive objects are drawn back to front with copies of the passes of a single object.
 * Each copy has its own uniform buffer and overwrites the G-buffer of the previous object. Targets
 * that other passes read, above all colour and depth, keep their content from object to object.
 */
#include "src/frame/pass_list.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/scene.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame.h"
#include "src/tech/techniques.h"

/* Limits of the automatically chosen face size of the environment cube, texels. */
enum {
    FACE_SIZE_MIN = 128,
    FACE_SIZE_MAX = 2048,
};

static bool is_applicable(const struct technique *technique, const struct technique_part *part,
                          const struct technique_choice *choice)
{
    const uint32_t purposes = part->purposes ? part->purposes : 1u << TECHNIQUE_IMAGE;
    const enum technique_scene scene = choice->has_pool ? SCENE_OF_POOL : SCENE_OF_OBJECT;
    if (!(purposes & 1u << choice->purpose))
        return false;
    if (part->scene != SCENE_OF_ANY && part->scene != scene)
        return false;
    return !technique->refraction.name || technique == choice->refraction;
}

/* Returns the passes of a technique's part, or none if it is disabled. */
static struct rg_technique part_rows(const struct technique *technique,
                                     const struct technique_part *part,
                                     const struct technique_choice *choice,
                                     struct pass_builder *builder)
{
    const bool is_traced =
        technique->is_hit && choice->refraction && choice->refraction->refraction.traces_bvh;

    if (is_traced || !is_applicable(technique, part, choice))
        return (struct rg_technique){ 0 };
    if (part->rows)
        return part->rows(choice, builder);
    if (technique->is_on && !technique->is_on(choice->settings))
        return (struct rg_technique){ 0 };
    return part->graph;
}

static bool add_phase(struct frame_list *list, const struct technique_choice *choice,
                      enum technique_phase phase)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        for (size_t p = 0; p < TECHNIQUE_PART_COUNT; p++) {
            const struct technique_part *part = &(*t)->parts[p];
            if (part->phase != phase || (!part->rows && !part->graph.passes))
                continue;
            struct rg_technique *made = &list->parts[list->count];
            *made = part_rows(*t, part, choice, &list->builder);
            if (!made->pass_count)
                continue;
            made[1] = low_res_inclusions_apply(&list->small, choice, phase, made);
            list->count += made[1].pass_count ? 2 : 1;
        }
    }
    return !list->builder.failed;
}

/* ---- several objects ---- */

/* Returns the uniform buffer of the object at a position in the depth order. */
static const struct rg_buffer *globals_at(struct frame_list *list, uint32_t depth_index)
{
    char number[16];
    snprintf(number, sizeof(number), "%u", depth_index);
    for (size_t i = 0; i < list->object_count; i++) {
        if (list->objects[i].depth_index == depth_index)
            return list->objects[i].globals;
    }
    struct rg_buffer *buffer = pass_builder_alloc(&list->builder, sizeof(*buffer));
    if (!buffer)
        return NULL;
    *buffer = frame_globals;
    buffer->name = pass_builder_name(&list->builder, frame_globals.name, number);
    return buffer;
}

/* Returns a copy of a pass's resource uses with another uniform buffer than frame_globals. */
static const struct rg_use *uses_with(struct pass_builder *builder, const struct rg_use *uses,
                                      const struct rg_buffer *globals)
{
    struct rg_use *own = pass_builder_copy_uses(builder, uses);
    for (struct rg_use *use = own; use && use->access; use++) {
        if (use->buffer == &frame_globals)
            use->buffer = globals;
    }
    return own;
}

/* Assigns the parts from `first` on to the object at a position in the depth order: copies their
 * passes, with the object's uniform buffer and unique names. */
static bool assign_to_object(struct frame_list *list, size_t first, uint32_t depth_index,
                             bool for_layers)
{
    struct frame_list_object object = {
        .globals = globals_at(list, depth_index),
        .depth_index = depth_index,
        .is_for_layers = for_layers,
    };
    char suffix[24];
    snprintf(suffix, sizeof(suffix), for_layers ? "%u.layers" : "%u", depth_index);
    for (size_t i = first; i < list->count; i++)
        object.row_count += list->parts[i].pass_count;
    object.rows = pass_builder_alloc(&list->builder, (object.row_count + 1) * sizeof(*object.rows));
    object.names =
        pass_builder_alloc(&list->builder, (object.row_count + 1) * sizeof(*object.names));
    if (!object.rows || !object.names || !object.globals)
        return false;
    size_t count = 0;
    for (size_t i = first; i < list->count; i++) {
        struct rg_technique *part = &list->parts[i];
        struct rg_pass *rows = &object.rows[count];
        memcpy(rows, part->passes, part->pass_count * sizeof(*rows));
        part->passes = rows;
        count += part->pass_count;
    }
    for (size_t r = 0; r < count; r++) {
        struct rg_pass *row = &object.rows[r];
        object.names[r] =
            for_layers ? pass_builder_name(&list->builder, row->name, "layers") : row->name;
        if (depth_index || for_layers)
            row->name = pass_builder_name(&list->builder, row->name, suffix);
        row->uses = uses_with(&list->builder, row->uses, object.globals);
    }
    list->objects[list->object_count++] = object;
    return !list->builder.failed;
}

/* Adds each object's passes up to phase `last`, for the image or, if that is later, for layers. */
static bool add_objects(struct frame_list *list, const struct technique_choice *choice,
                        enum technique_phase last)
{
    struct technique_choice own = *choice;
    const bool for_layers = last != PHASE_REFRACTION;
    bool done = true;
    own.keeps_depth = for_layers;
    for (uint32_t depth_index = 0; depth_index < choice->object_count && done; depth_index++) {
        const size_t first = list->count;
        own.is_limited = depth_index && !for_layers;
        if (last != PHASE_FACES)
            done = add_phase(list, &own, PHASE_DEPTHS) && add_phase(list, &own, PHASE_NORMALS);
        done = done && add_phase(list, &own, last) &&
               assign_to_object(list, first, depth_index, for_layers);
    }
    return done;
}

/* Returns the object whose passes contain `row`, or NULL. */
static const struct frame_list_object *owner(const struct frame_list *list,
                                             const struct rg_pass *row)
{
    for (size_t i = 0; i < list->object_count; i++) {
        const struct frame_list_object *object = &list->objects[i];
        if (row >= object->rows && row < object->rows + object->row_count)
            return object;
    }
    return NULL;
}

static bool touches(const struct rg_pass *row, const struct rg_image *image)
{
    bool found = row->depth.image == image;
    for (uint32_t i = 0; i < row->color_count; i++)
        found = found || row->color[i].image == image;
    for (const struct rg_use *use = row->uses; use && use->access; use++)
        found = found || use->image == image;
    return found;
}

/* Returns true if passes that belong to no object use the image. */
static bool is_used_elsewhere(const struct frame_list *list, const struct rg_image *image)
{
    for (size_t i = 0; i < list->count; i++) {
        const struct rg_technique *part = &list->parts[i];
        for (size_t p = 0; p < part->pass_count && !owner(list, part->passes); p++) {
            if (touches(&part->passes[p], image))
                return true;
        }
    }
    return false;
}

static bool reads(const struct frame_list_object *object, const struct rg_image *image)
{
    for (size_t r = 0; r < object->row_count; r++) {
        for (const struct rg_use *use = object->rows[r].uses; use && use->access; use++) {
            if (use->image == image)
                return true;
        }
    }
    return false;
}

/* Returns true if an image is shared by all objects instead of being the G-buffer of one object:
 * colour, depth, a layer being drawn, or an image that only other passes read. */
static bool is_shared(const struct frame_list *list, const struct frame_list_object *object,
                      const struct rg_image *image)
{
    const struct frame_layer *layer;
    if (image == &frame_color || image == &frame_depth)
        return true;
    for (size_t i = 0; object->is_for_layers && (layer = techniques_layer(i)); i++) {
        if (layer->image == image)
            return true;
    }
    return !reads(object, image) && is_used_elsewhere(list, image);
}

/* Returns true if drawing to a target may be limited to the object's pixels: the target has the
 * view's size, and its content elsewhere is kept or never read. */
static bool is_local(const struct frame_list *list, const struct rg_target *target)
{
    const struct rg_image *image = target->image;
    const bool is_of_view = !image || !(image->width || image->scale > 0.0f);
    return is_of_view &&
           (!image || target->load == RG_LOAD_KEEP || !is_used_elsewhere(list, image));
}

/* Makes a pass keep the content of shared targets, and limits its drawing to the pixels that rays
 * look up, so that many small objects cost no more than a few large ones. */
static void keep_shared_in_row(struct frame_list *list, const struct frame_list_object *object,
                               struct rg_pass *row)
{
    struct rg_target *color =
        pass_builder_copy_targets(&list->builder, row->color, row->color_count);
    for (uint32_t c = 0; color && c < row->color_count; c++) {
        if (is_shared(list, object, color[c].image))
            color[c].load = RG_LOAD_KEEP;
    }
    row->color = color;
    if (row->depth.image && is_shared(list, object, row->depth.image))
        row->depth.load = RG_LOAD_KEEP;
    bool is_local_to_objects = is_local(list, &row->depth);
    for (uint32_t c = 0; color && c < row->color_count; c++)
        is_local_to_objects = is_local_to_objects && is_local(list, &color[c]);
    if (!is_local_to_objects || row->kind != RG_RASTER) {
        list->is_local_to_objects = list->is_local_to_objects && object->is_for_layers;
        return;
    }
    row->area = frame_object_drawn;
    row->more = frame_object_more;
}

/* Makes the passes of all objects except the first keep the content of shared targets. */
static bool keep_shared(struct frame_list *list)
{
    list->is_local_to_objects = true;
    for (size_t i = 0; i < list->object_count; i++) {
        const struct frame_list_object *object = &list->objects[i];
        for (size_t r = 0; object->depth_index && r < object->row_count; r++)
            keep_shared_in_row(list, object, &object->rows[r]);
    }
    return !list->builder.failed;
}

static bool add_all(struct frame_list *list, const struct technique_choice *choice)
{
    const bool are_many = (choice->object_count > 1 || choice->is_nested) && choice->refraction &&
                          !choice->refraction->refraction.is_whole;
    bool done = true;
    for (int i = 0; i < PHASE_COUNT && done; i++) {
        const enum technique_phase phase = (enum technique_phase)i;
        const bool is_before = phase == PHASE_DEPTHS || phase == PHASE_NORMALS;
        if (are_many &&
            (phase == PHASE_REFRACTION || phase == PHASE_LAYERS || phase == PHASE_FACES))
            done = add_objects(list, choice, phase);
        else if (!are_many || !is_before)
            done = add_phase(list, choice, phase);
    }
    return done && keep_shared(list);
}

enum status frame_list_init(struct frame_list *list, const struct technique_choice *choice)
{
    const size_t object_count =
        choice->object_count > 1 || choice->is_nested ? 3 * (size_t)choice->object_count : 1;
    *list = (struct frame_list){ .small.builder = &list->builder, .is_nested = choice->is_nested };
    /* inclusions.scale at most doubles the number of parts */
    list->parts = calloc(2 * techniques_count * TECHNIQUE_PART_COUNT * object_count + 1,
                         sizeof(*list->parts));
    list->objects = calloc(object_count, sizeof(*list->objects));
    if (list->parts && list->objects && add_all(list, choice))
        return STATUS_OK;
    frame_list_finish(list);
    return log_out_of_memory(NULL);
}

void frame_list_finish(struct frame_list *list)
{
    pass_builder_finish(&list->builder);
    free(list->parts);
    free(list->objects);
    *list = (struct frame_list){ 0 };
}

bool frame_draws_cube(const struct settings *settings, const struct scene *scene)
{
    const struct env_cube_params *cube = settings_of(settings, &env_cube_settings);
    return cube->dynamic && !scene->cube.texels;
}

struct settings frame_settings(const struct settings *settings, const struct scene *scene)
{
    struct settings own = *settings;
    settings_set_value(&own,
                       settings_row(&env_cube_settings, offsetof(struct env_cube_params, dynamic)),
                       frame_draws_cube(settings, scene));
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->follow_scene)
            (*t)->follow_scene(&own, scene);
    }
    return own;
}

uint32_t frame_face_size(const struct settings *settings, uint32_t height)
{
    const struct env_cube_params *cube = settings_of(settings, &env_cube_settings);
    uint32_t size = FACE_SIZE_MIN;
    while (size < FACE_SIZE_MAX && 10 * (uint64_t)size < 9 * (uint64_t)height)
        size *= 2;
    return cube->size ? cube->size : size;
}

struct settings frame_resolve_settings(const struct settings *settings,
                                       const struct technique *refraction, uint32_t height)
{
    struct settings own = *settings;
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->settle)
            (*t)->settle(&own, refraction);
    }
    settings_set_value(&own,
                       settings_row(&env_cube_settings, offsetof(struct env_cube_params, size)),
                       frame_face_size(settings, height));
    return own;
}

const char *frame_list_row_name(const struct frame_list *list, const struct rg_pass *row)
{
    const struct frame_list_object *object = owner(list, row);
    return object ? object->names[row - object->rows] : row->name;
}
