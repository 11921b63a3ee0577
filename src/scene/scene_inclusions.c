/* scene_inclusions.c: generates inclusions and the bump map of a scene's object. */
#include <cglm/struct.h>
#include <math.h>
#include "src/base/log.h"
#include "src/scene/import/greyscale_map.h"
#include "src/scene/scene.h"

/* Scales and moves a crack sheet into the unit ball. */
static void fit_sheet(struct mesh *sheet)
{
    const struct box box = mesh_box(sheet);
    const float scale = 2.0f / fmaxf(box_diagonal(box), 1e-30f);
    for (uint32_t i = 0; i < sheet->vertex_count; i++) {
        struct mesh_vertex *v = &sheet->vertices[i];
        v->position = glms_vec3_scale(glms_vec3_sub(v->position, box_center(box)), scale);
        v->color = glms_vec3_one();
    }
}

static enum status load_cracks(struct scene *scene, const struct scene_params *params)
{
    struct model model = { 0 };
    if (!params->cracks.file)
        return STATUS_OK;
    enum status status =
        sandboxed_load_model(&model, params->cracks.file, MODEL_SURROUNDINGS, NULL, params->decode);
    const struct mesh *found = &model.surroundings;
    if (status == STATUS_OK &&
        (!found->index_count || found->index_count / 3 > SCENE_CRACK_TRIANGLES)) {
        log_error("%s: expected 1 to %d triangles of a crack, got %u", params->cracks.file,
                  SCENE_CRACK_TRIANGLES, found->index_count / 3);
        status = STATUS_DATA;
    }
    if (status == STATUS_OK && !mesh_append(&scene->files.crack_sheet, found))
        status = log_out_of_memory("cracks");
    fit_sheet(&scene->files.crack_sheet);
    model_finish(&model);
    return status;
}

/* Returns the object's box before melting, because melting does not move inclusions. */
static struct box unmelted_box(const struct scene *scene)
{
    return scene->melted.lost_fraction > 0.0f ? scene->melted.box : scene->box;
}

static enum status add_air(struct scene *scene, const struct generate_air *air)
{
    bool done = generate_air_planes(&scene->inclusions.air, unmelted_box(scene), air) &&
                generate_air_clip(&scene->inclusions.air, &scene->model.object);
    return done ? STATUS_OK : log_out_of_memory("air");
}

#define CLEAR_RIM 0.12f /* relative width of the outer region that has no bubbles */

static enum status add_bubbles(struct scene *scene, const struct generate_bubbles *bubbles)
{
    const bool has_melted = scene->melted.lost_fraction > 0.0f;
    const struct mesh *unmelted = has_melted ? &scene->melted.unmelted : &scene->model.object;
    const struct model *model = &scene->model;
    const bool has_core =
        model->object_count > 0 &&
        model->materials[model->objects[0].material].scattering_optical_depth > 0.0f;
    struct generate_bubbles params = *bubbles;
    params.rim = has_core ? CLEAR_RIM : 0.0f;
    bool done = generate_bubbles(&scene->inclusions.bubbles, unmelted, &params) &&
                (!has_melted || melt_bubbles(&scene->inclusions.bubbles, &scene->model.object));
    return done ? STATUS_OK : log_out_of_memory("bubbles");
}

enum status scene_generate_cracks(struct scene *scene, const struct scene_cracks *cracks)
{
    mesh_finish(&scene->inclusions.cracks);
    const struct generate_cracks params = { cracks->count, cracks->seed, cracks->size };
    bool done = generate_cracks(&scene->inclusions.cracks, unmelted_box(scene), &params,
                                &scene->files.crack_sheet);
    if (done && cracks->count && scene->melted.lost_fraction > 0.0f)
        done = melt_cracks(&scene->inclusions.cracks, &scene->model.object,
                           scene->melted.lost_fraction);
    return done ? STATUS_OK : log_out_of_memory("cracks");
}

const char *scene_fill(struct scene *scene, const struct scene_params *params)
{
    if (scene->has_pool)
        return NULL;
    struct bump_maps_params maps = params->bump ? *params->bump : (struct bump_maps_params){ 0 };
    struct generate_air air = params->air;
    maps.heights = scene->files.heights;
    maps.smoothness = scene->files.smoothness;
    air.opacity = scene->files.air_opacity;
    if (params->bump && !bump_maps_init(&scene->bump, &maps))
        return "bump maps";
    if (air.count && !generate_air_layers(&scene->inclusions.air_layers, &air))
        return "air";
    struct model unmelted = scene->model; /* density depends on the shape before melting */
    if (scene->melted.lost_fraction > 0.0f)
        unmelted.object = scene->melted.unmelted;
    if (!scattering_media_fill(&scene->inclusions.media, &unmelted))
        return "scattering media";
    return NULL;
}

/* Sets the sizes of deferred textures, which are needed to compile render graphs. */
static void size_textures(struct scene *scene, const struct scene_params *params)
{
    if (params->bump)
        scene->bump.size = BUMP_MAPS_SIZE;
    if (params->air.count)
        scene->inclusions.air_layers = (struct air_layers){ .size = GENERATE_AIR_LAYER_SIZE,
                                                            .count = GENERATE_AIR_LAYER_COUNT };
}

static enum status read_maps(struct scene *scene, const struct scene_params *params)
{
    const struct {
        const char *path;
        float **greys;
        uint32_t side;
        bool is_unit_range;
    } inputs[] = {
        { params->image_files.heights, &scene->files.heights, BUMP_MAPS_SIZE, false },
        { params->image_files.smoothness, &scene->files.smoothness, BUMP_MAPS_SIZE, true },
        { params->image_files.air, &scene->files.air_opacity, GENERATE_AIR_LAYER_SIZE, true },
    };
    enum status status = STATUS_OK;
    for (size_t i = 0; i < sizeof(inputs) / sizeof(inputs[0]) && status == STATUS_OK; i++) {
        if (inputs[i].path)
            status = greyscale_map_read(inputs[i].greys, inputs[i].side, inputs[i].is_unit_range,
                                        inputs[i].path, params->decode);
    }
    return status;
}

enum status scene_fill_object(struct scene *scene, const struct scene_params *params)
{
    enum status status = params->previous_pose ? STATUS_OK : read_maps(scene, params);
    if (status != STATUS_OK)
        return status;
    if (params->previous_pose)
        scene->files = params->previous_pose->files;
    size_textures(scene, params);
    const char *failed_part = params->defers_texels ? NULL : scene_fill(scene, params);
    status = failed_part ? log_out_of_memory(failed_part) : STATUS_OK;
    if (status == STATUS_OK && params->air.count)
        status = add_air(scene, &params->air);
    if (status == STATUS_OK && params->bubbles.count)
        status = add_bubbles(scene, &params->bubbles);
    if (status == STATUS_OK && !params->previous_pose)
        status = load_cracks(scene, params);
    if (status == STATUS_OK)
        status = scene_generate_cracks(scene, &params->cracks);
    return status;
}
