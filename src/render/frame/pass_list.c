/*
 * pass_list.c: collects the passes of all techniques, phase by phase.
 *
 * Several refractive objects are drawn back to front with copies of the passes of a single object.
 * Each copy has its own uniform buffer and overwrites the G-buffer of the previous object. Targets
 * that other passes read, above all colour and depth, keep their content from object to object.
 */
#include "src/render/frame/pass_list.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/scene.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/techniques.h"

/* Limits of the automatically chosen face size of the environment cube, texels. */
enum {
    FACE_SIZE_MIN = 128,
    FACE_SIZE_MAX = 2048,
};

enum {
    OBJECTS_MAX = 4096, /* objects drawn one after the other; placing them is quadratic */
};

static bool is_applicable(const struct technique *technique,
                          const struct technique_pass_group *group,
                          const struct technique_config *config)
{
    const uint32_t purposes = group->purposes ? group->purposes : 1u << TECHNIQUE_IMAGE;
    const enum technique_scene scene = config->scene->has_pool ? SCENE_OF_POOL : SCENE_OF_OBJECT;
    if (!(purposes & 1u << config->purpose))
        return false;
    if (group->scene != SCENE_OF_ANY && group->scene != scene)
        return false;
    return !technique->refraction.name || technique == config->refraction;
}

/* Returns the passes of a pass group, or none if the technique is off. */
static struct rg_technique passes_of_group(const struct technique *technique,
                                           const struct technique_pass_group *group,
                                           const struct technique_config *config,
                                           struct pass_arena *builder)
{
    const bool is_traced =
        technique->is_hit && config->refraction && config->refraction->refraction.traces_bvh;

    if (is_traced || !is_applicable(technique, group, config))
        return (struct rg_technique){ 0 };
    if (group->make_passes)
        return group->make_passes(config, builder);
    if ((technique->is_on && !technique->is_on(config->settings)) ||
        (group->is_drawn && !group->is_drawn(config)))
        return (struct rg_technique){ 0 };
    return group->graph;
}

static bool add_phase(struct frame_list *list, const struct technique_config *config,
                      enum technique_phase phase)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        for (size_t p = 0; p < TECHNIQUE_PASS_GROUP_COUNT; p++) {
            const struct technique_pass_group *group = &(*t)->pass_groups[p];
            if (group->phase != phase || (!group->make_passes && !group->graph.passes))
                continue;
            struct rg_technique *added = &list->pass_groups[list->count];
            *added = passes_of_group(*t, group, config, &list->builder);
            if (!added->pass_count)
                continue;
            added[1] = low_res_inclusions_apply(&list->small, config, phase, added);
            list->count += added[1].pass_count ? 2 : 1;
        }
    }
    return !list->builder.failed;
}

/* Returns the uniform buffer of the object at a position in back-to-front order. */
static const struct rg_buffer *globals_at(struct frame_list *list, uint32_t depth_index)
{
    char number[16];
    snprintf(number, sizeof(number), "%u", depth_index);
    if (depth_index < list->object_count) /* the pass belongs to an earlier phase */
        return list->objects[depth_index].globals;
    struct rg_buffer *buffer = pass_arena_alloc(&list->builder, sizeof(*buffer));
    if (!buffer)
        return NULL;
    *buffer = frame_globals;
    buffer->name = pass_arena_name(&list->builder, frame_globals.name, number);
    return buffer;
}

/* Returns a copy of a pass's resource uses with frame_globals replaced by another buffer. */
static const struct rg_use *uses_with(struct pass_arena *builder, const struct rg_use *uses,
                                      const struct rg_buffer *globals)
{
    struct rg_use *copy = pass_arena_copy_uses(builder, uses);
    for (struct rg_use *use = copy; use && use->access; use++) {
        if (use->buffer == &frame_globals)
            use->buffer = globals;
    }
    return copy;
}

/* Replaces the passes of the groups from `first` on by copies with one object's uniform buffer.
 * `depth_index` is the object's position in back-to-front order. */
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
        object.pass_count += list->pass_groups[i].pass_count;
    object.passes =
        pass_arena_alloc(&list->builder, (object.pass_count + 1) * sizeof(*object.passes));
    object.names =
        pass_arena_alloc(&list->builder, (object.pass_count + 1) * sizeof(*object.names));
    if (!object.passes || !object.names || !object.globals)
        return false;
    size_t count = 0;
    for (size_t i = first; i < list->count; i++) {
        struct rg_technique *group = &list->pass_groups[i];
        struct rg_pass *passes = &object.passes[count];
        memcpy(passes, group->passes, group->pass_count * sizeof(*passes));
        group->passes = passes;
        count += group->pass_count;
        list->is_of_object[i] = true;
    }
    for (size_t r = 0; r < count; r++) {
        struct rg_pass *pass = &object.passes[r];
        object.names[r] =
            for_layers ? pass_arena_name(&list->builder, pass->name, "layers") : pass->name;
        if (depth_index || for_layers)
            pass->name = pass_arena_name(&list->builder, pass->name, suffix);
        pass->uses = uses_with(&list->builder, pass->uses, object.globals);
    }
    list->objects[list->object_count++] = object;
    return !list->builder.failed;
}

/* Adds passes per object: G-buffer passes (except for PHASE_FACES), then those of phase `last`,
 * unless the pass of the image writes the layers of the refraction model. */
static bool add_objects(struct frame_list *list, const struct technique_config *config,
                        enum technique_phase last)
{
    struct technique_config copy = *config;
    const bool for_layers = last != PHASE_REFRACTION;
    const bool is_packed = last == PHASE_LAYERS && config->refraction->refraction.packs_layers;
    bool done = true;
    copy.keeps_depth = for_layers;
    for (uint32_t depth_index = 0; depth_index < config->object_count && done; depth_index++) {
        const size_t first = list->count;
        copy.is_limited = depth_index && !for_layers;
        if (last != PHASE_FACES)
            done = add_phase(list, &copy, PHASE_DEPTHS) && add_phase(list, &copy, PHASE_NORMALS);
        done = done && (is_packed || add_phase(list, &copy, last)) &&
               assign_to_object(list, first, depth_index, for_layers);
    }
    return done;
}

static bool uses_image(const struct rg_pass *pass, const struct rg_image *image)
{
    bool found = pass->depth.image == image;
    for (uint32_t i = 0; i < pass->color_count; i++)
        found = found || pass->color[i].image == image;
    for (const struct rg_use *use = pass->uses; use && use->access; use++)
        found = found || use->image == image;
    return found;
}

/* Returns true if passes that belong to no object use the image. */
static bool is_used_elsewhere(const struct frame_list *list, const struct rg_image *image)
{
    for (size_t i = 0; i < list->other_count; i++) {
        const struct rg_technique *group = &list->pass_groups[list->others[i]];
        for (size_t p = 0; p < group->pass_count; p++) {
            if (uses_image(&group->passes[p], image))
                return true;
        }
    }
    return false;
}

static bool reads(const struct frame_list_object *object, const struct rg_image *image)
{
    for (size_t r = 0; r < object->pass_count; r++) {
        for (const struct rg_use *use = object->passes[r].uses; use && use->access; use++) {
            if (use->image == image)
                return true;
        }
    }
    return false;
}

/* Returns true if all objects draw to `image`: colour, depth, a drawn layer, or an image that only
 * passes outside the objects read. */
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

/* Returns true if drawing to a target may be limited to the area near the object. The target must
 * have the view's size. Its pixels elsewhere must be kept, or never read. */
static bool is_local(const struct frame_list *list, const struct rg_target *target)
{
    const struct rg_image *image = target->image;
    const bool is_of_view = !image || !(image->width || image->scale > 0.0f);
    return is_of_view &&
           (!image || target->load == RG_LOAD_KEEP || !is_used_elsewhere(list, image));
}

/* Makes a pass keep the content of images that all objects draw to. If possible, limits drawing to
 * the area near the object, because many small objects then cost no more than a few large ones. */
static void keep_shared_in_pass(struct frame_list *list, const struct frame_list_object *object,
                                struct rg_pass *pass)
{
    struct rg_target *color =
        pass_arena_copy_targets(&list->builder, pass->color, pass->color_count);
    for (uint32_t c = 0; color && c < pass->color_count; c++) {
        if (is_shared(list, object, color[c].image))
            color[c].load = RG_LOAD_KEEP;
    }
    pass->color = color;
    if (pass->depth.image && is_shared(list, object, pass->depth.image))
        pass->depth.load = RG_LOAD_KEEP;
    bool is_local_to_objects = is_local(list, &pass->depth);
    for (uint32_t c = 0; color && c < pass->color_count; c++)
        is_local_to_objects = is_local_to_objects && is_local(list, &color[c]);
    if (!is_local_to_objects || pass->kind != RG_RASTER) {
        list->is_local_to_objects = list->is_local_to_objects && object->is_for_layers;
        return;
    }
    pass->area = frame_object_drawn;
}

/* Lists the pass groups that belong to no object. */
static bool list_others(struct frame_list *list)
{
    list->others = pass_arena_alloc(&list->builder, (list->count + 1) * sizeof(*list->others));
    for (size_t i = 0; list->others && i < list->count; i++) {
        if (!list->is_of_object[i])
            list->others[list->other_count++] = i;
    }
    return list->others;
}

/* Makes the passes of all objects except the first keep the content of shared targets. */
static bool keep_shared(struct frame_list *list)
{
    if (!list_others(list))
        return false;
    list->is_local_to_objects = true;
    for (size_t i = 0; i < list->object_count; i++) {
        const struct frame_list_object *object = &list->objects[i];
        for (size_t r = 0; object->depth_index && r < object->pass_count; r++)
            keep_shared_in_pass(list, object, &object->passes[r]);
    }
    return !list->builder.failed;
}

/* Returns true if objects are drawn one after the other, by rasterisation. */
static bool draws_objects(const struct technique_config *config)
{
    return (config->object_count > 1 || config->is_nested) && config->refraction &&
           !config->refraction->refraction.traces_bvh;
}

static bool add_all(struct frame_list *list, const struct technique_config *config)
{
    const bool are_many = draws_objects(config);
    bool done = true;
    for (int i = 0; i < PHASE_COUNT && done; i++) {
        const enum technique_phase phase = (enum technique_phase)i;
        const bool is_before = phase == PHASE_DEPTHS || phase == PHASE_NORMALS;
        if (are_many &&
            (phase == PHASE_REFRACTION || phase == PHASE_LAYERS || phase == PHASE_FACES))
            done = add_objects(list, config, phase);
        else if (!are_many || !is_before)
            done = add_phase(list, config, phase);
    }
    return done && keep_shared(list);
}

enum status frame_list_init(struct frame_list *list, const struct technique_config *config)
{
    const size_t object_count =
        config->object_count > 1 || config->is_nested ? 3 * (size_t)config->object_count : 1;
    *list = (struct frame_list){ .small.builder = &list->builder, .is_nested = config->is_nested };
    if (draws_objects(config) && config->object_count > OBJECTS_MAX) {
        log_error("--refraction %s: the scene has %u refractive objects, but at most %d can be "
                  "rasterised: use --refraction trace",
                  config->refraction->refraction.name, config->object_count, OBJECTS_MAX);
        return STATUS_DATA;
    }
    /* inclusions.scale at most doubles the number of pass groups */
    const size_t group_max = 2 * techniques_count * TECHNIQUE_PASS_GROUP_COUNT * object_count + 1;
    list->pass_groups = calloc(group_max, sizeof(*list->pass_groups));
    list->is_of_object = calloc(group_max, sizeof(*list->is_of_object));
    list->objects = calloc(object_count, sizeof(*list->objects));
    if (list->pass_groups && list->is_of_object && list->objects && add_all(list, config))
        return STATUS_OK;
    frame_list_finish(list);
    return log_out_of_memory(NULL);
}

void frame_list_finish(struct frame_list *list)
{
    pass_arena_finish(&list->builder);
    free(list->pass_groups);
    free(list->is_of_object);
    free(list->objects);
    *list = (struct frame_list){ 0 };
}

bool frame_draws_cube(const struct settings *settings, const struct scene *scene)
{
    const struct env_cube_params *cube = settings_of(settings, &env_cube_settings);
    return cube->dynamic && !scene->background.cube.texels;
}

struct settings frame_settings(const struct settings *settings, const struct scene *scene)
{
    struct settings copy = *settings;
    settings_set_value(&copy,
                       settings_row(&env_cube_settings, offsetof(struct env_cube_params, dynamic)),
                       frame_draws_cube(settings, scene));
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->follow_scene)
            (*t)->follow_scene(&copy, scene);
    }
    return copy;
}

uint32_t frame_face_size(const struct settings *settings, uint32_t height)
{
    const struct env_cube_params *cube = settings_of(settings, &env_cube_settings);
    uint32_t size = FACE_SIZE_MIN;
    while (size < FACE_SIZE_MAX && 10 * (uint64_t)size < 9 * (uint64_t)height)
        size *= 2;
    return cube->size ? cube->size : size;
}

struct settings frame_resolve_settings(const struct settings *settings, const struct scene *scene,
                                       const struct technique *refraction, uint32_t height)
{
    struct settings copy = frame_settings(settings, scene);
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->resolve_auto)
            (*t)->resolve_auto(&copy, refraction);
    }
    settings_set_value(&copy,
                       settings_row(&env_cube_settings, offsetof(struct env_cube_params, size)),
                       frame_face_size(settings, height));
    return copy;
}

/* Returns the object that owns the pass, or NULL. */
static const struct frame_list_object *owner(const struct frame_list *list,
                                             const struct rg_pass *pass)
{
    for (size_t i = 0; i < list->object_count; i++) {
        const struct frame_list_object *object = &list->objects[i];
        if (pass >= object->passes && pass < object->passes + object->pass_count)
            return object;
    }
    return NULL;
}

const char *frame_list_pass_name(const struct frame_list *list, const struct rg_pass *pass)
{
    const struct frame_list_object *object = owner(list, pass);
    return object ? object->names[pass - object->passes] : pass->name;
}
