/* scene.c: loads or generates scenes: objects, surroundings, background, materials. */
#include "src/scene/scene.h"
#include <cglm/struct.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/ice/ice_nested.h"
#include "shaders/trace/bvh_layout.h"
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/base/suggest.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/cache/loaded_files.h"
#include "src/scene/environment/image_based_lighting.h"
#include "src/scene/generate/generate.h"
#include "src/scene/geometry/mesh_depth_complexity.h"
#include "src/scene/gpu_material_table.h"

const struct scene_builtin scene_builtins[] = {
    {
        .name = "valley",
        .generate = generate_ice_cube,
        .triangles = GENERATE_ICE_CUBE_TRIANGLES,
        .help = "irregular cube of ice in a valley",
    },
    {
        .name = "sphere",
        .generate = generate_sphere,
        .triangles = GENERATE_SPHERE_TRIANGLES,
        .help = "sphere of radius 1, for comparison with closed forms",
    },
    {
        .name = "teapot",
        .generate = generate_teapot,
        .triangles = GENERATE_TEAPOT_TRIANGLES,
        .help = "Utah teapot, closed",
    },
    {
        .name = "room",
        .generate = generate_ice_cube,
        .surround = generate_room,
        .triangles = GENERATE_ICE_CUBE_TRIANGLES,
        .help = "irregular cube of ice on a table in a closed room",
    },
    {
        .name = "pool",
        .help = "pool of water with waves, and caustics on its floor",
    },
    { 0 },
};

const struct scene_builtin *scene_find_builtin(const char *name)
{
    for (const struct scene_builtin *b = scene_builtins; b->name; b++) {
        if (!strcmp(b->name, name))
            return b;
    }
    return NULL;
}

bool scene_is_known(const char *name)
{
    return scene_find_builtin(name) || asset_find(name, ASSET_SCENE);
}

bool scene_is_environment(const char *name)
{
    return !scene_is_known(name) && (asset_is_valley(name) || asset_find(name, ASSET_ENVIRONMENT));
}

const char *scene_name(uint32_t index)
{
    for (const struct scene_builtin *b = scene_builtins; b->name; b++) {
        if (!index--)
            return b->name;
    }
    for (const struct asset *a = assets; a->name; a++) {
        if (a->kind == ASSET_SCENE && !index--)
            return a->name;
    }
    return NULL;
}

/* Adds floating ice. The ice must fit in the pool at any rotation, with water below. */
static enum status add_floating_ice(struct scene *scene, const struct scene_params *params)
{
    const struct generate_pool *pool = &params->pool;
    const uint32_t triangles =
        params->object_triangles ? params->object_triangles : GENERATE_ICE_CUBE_TRIANGLES;
    if (!generate_floating_ice(&scene->model.object, pool, triangles))
        return log_out_of_memory("ice");
    scene->floating_ice = mesh_box(&scene->model.object);
    if (1.5f * pool->ice < pool->size && -scene->floating_ice.min.y < pool->depth)
        return STATUS_OK;
    log_error(
        "pool.ice=%g: expected pool.size above %g and pool.depth above %g for ice of this width",
        (double)pool->ice, 1.5 * (double)pool->ice, (double)-scene->floating_ice.min.y);
    return STATUS_USAGE;
}

/* Generates the pool, and a camera that looks into it. */
static enum status make_pool(struct scene *scene, const struct scene_params *params)
{
    const struct generate_pool *pool = &params->pool;
    const float half = 0.5f * pool->size;
    scene->has_pool = true;
    scene->box = (struct box){ { { -half, -pool->depth, -half } }, { { half, 0.0f, half } } };
    scene->model.has_camera = true;
    scene->model.camera = (struct camera){
        .eye = { { 0.55f * half, 1.05f * half, 1.75f * half } },
        .target = { { 0.02f * half, -0.3f * half, -0.02f * half } },
        .fov_deg = 45.0f,
    };
    if (!generate_pool(&scene->model.surroundings, pool))
        return log_out_of_memory("pool");
    return pool->ice > 0.0f ? add_floating_ice(scene, params) : STATUS_OK;
}

/* Checks that a file exists. If not, logs an error that suggests a similar name. */
static enum status check_file(const char *path, enum asset_kind kind)
{
    const bool is_scene = kind == ASSET_SCENE;
    char hint[SUGGEST_HINT_SIZE];
    struct suggest suggest = { .word = path };
    if (file_info_of(path).kind != FILE_MISSING || errno != ENOENT)
        return STATUS_OK; /* opening the file logs the error */
    for (const struct scene_builtin *b = scene_builtins; is_scene && b->name; b++)
        suggest_offer(&suggest, b->name);
    for (const struct asset *a = assets; a->name; a++) {
        if (a->kind == kind)
            suggest_offer(&suggest, a->name);
    }
    log_error("'%s' is neither a built-in %s nor a file%s (firn list %s)", path,
              is_scene ? "scene" : "environment", suggest_hint(&suggest, hint),
              is_scene ? "scenes" : "environments");
    return STATUS_NO_INPUT;
}

/* Resolves a name or path to a file path, which the caller frees. */
static enum status locate(const char *name, enum asset_kind kind, char **path)
{
    const struct asset *asset = asset_find(name, kind);
    *path = NULL;
    if (asset)
        return asset_locate(asset, path);
    const enum status status = check_file(name, kind);
    if (status == STATUS_OK)
        *path = strdup(name);
    return status == STATUS_OK && !*path ? log_out_of_memory(name) : status;
}

/* Loads the model from its file, or from the source that replaces the file. */
static enum status read_model(struct model *model, const struct scene_params *params,
                              const struct model_pose *pose)
{
    const enum model_role role = params->is_one_object ? MODEL_OBJECT : MODEL_BY_MATERIALS;
    struct loaded_files *files = params->previous_pose ? NULL : params->files;
    char *path;
    if (params->source && params->source->make_model)
        return params->source->make_model(params->source->user, model, role);
    if (files && loaded_files_copy_model(files, params->name, role, pose, model))
        return STATUS_OK;
    enum status status = locate(params->name, ASSET_SCENE, &path);
    if (status == STATUS_OK)
        status = sandboxed_load_model(model, path, role, pose, params->decode);
    if (status == STATUS_OK && files)
        loaded_files_keep_model(files, params->name, role, pose, model);
    free(path);
    return status;
}

static enum status load_file(struct scene *scene, const struct scene_params *params)
{
    struct model *model = &scene->model;
    struct model_pose pose = params->pose;
    char *names =
        material_override_names(params->material_overrides, params->material_override_count);
    if (!names)
        return log_out_of_memory(params->name);
    pose.objects = names;
    pose.origin = params->previous_pose ? params->previous_pose->file_origin : NULL;
    enum status status = read_model(model, params, &pose);
    memcpy(scene->file_origin, model->origin, sizeof(scene->file_origin));
    if (status == STATUS_OK)
        status = material_override_apply(model, params->material_overrides,
                                         params->material_override_count);
    if (status == STATUS_OK && params->model_transform)
        status = model_transform_apply(model, params->model_transform, params->name);
    if (status == STATUS_OK)
        status =
            object_transform_apply(model, params->object_transforms, params->object_transform_count,
                                   params->name, !params->previous_pose);
    if (status == STATUS_OK && params->source && params->source->change_materials)
        status = params->source->change_materials(params->source->user, model);
    free(names);
    return status;
}

/* Adds an object that consists of the whole mesh, with a material that the settings define. */
static enum status add_bare_object(struct model *model)
{
    model->objects = calloc(1, sizeof(*model->objects));
    model->materials = calloc(1, sizeof(*model->materials));
    if (!model->objects || !model->materials)
        return log_out_of_memory("object");
    model->objects[0].index_count = model->object.index_count;
    model->materials[0] = material_make("ice");
    model->materials[0].flags = MATERIAL_FROM_SETTINGS;
    model->materials[0].transmission = 1.0f;
    model->materials[0].roughness = 0.0f;
    model->object_count = 1;
    model->material_count = 1;
    return STATUS_OK;
}

static enum status load_object(struct scene *scene, const struct scene_params *params)
{
    const struct scene_builtin *builtin = scene_find_builtin(params->name);
    if (!builtin)
        return load_file(scene, params);
    if (!builtin->generate)
        return make_pool(scene, params);
    uint32_t triangles = params->object_triangles ? params->object_triangles : builtin->triangles;
    if (!builtin->generate(&scene->model.object, triangles))
        return log_out_of_memory(builtin->name);
    return add_bare_object(&scene->model);
}

/* Scales the landscape to the object's size. It is generated for objects 3.2 m across. */
static void fit_landscape(struct mesh *landscape, struct box box)
{
    float scale = box_diagonal(box) / 3.2f;
    vec3s center = box_center(box);
    for (uint32_t i = 0; i < landscape->vertex_count; i++) {
        vec3s *p = &landscape->vertices[i].position;
        *p = glms_vec3_add(glms_vec3_scale(*p, scale), center);
    }
}

static enum status add_landscape(struct scene *scene, const struct scene_params *params)
{
    uint32_t triangles =
        params->landscape_triangles ? params->landscape_triangles : GENERATE_LANDSCAPE_TRIANGLES;
    if (params->flat)
        return generate_floor(&scene->model.surroundings, scene->box) ? STATUS_OK
                                                                      : log_out_of_memory("floor");
    if (!generate_landscape(&scene->model.surroundings, triangles))
        return log_out_of_memory("landscape");
    if (!scene_find_builtin(params->name))
        fit_landscape(&scene->model.surroundings, scene->box);
    return STATUS_OK;
}

static enum status add_builtin_surroundings(struct scene *scene, const struct scene_builtin *b)
{
    return b->surround(&scene->model.surroundings, scene->box) ? STATUS_OK
                                                               : log_out_of_memory(b->name);
}

static enum status add_surroundings(struct scene *scene, const struct scene_params *params)
{
    struct model model = { 0 };
    enum status status = sandboxed_load_model(&model, params->surroundings, MODEL_SURROUNDINGS,
                                              NULL, params->decode);
    if (status == STATUS_OK)
        status = model_add_surroundings(&scene->model, &model);
    model_finish(&model);
    return status;
}

/* Loads the environment from its file, or from the source that replaces the file. */
static enum status read_environment(struct environment *environment,
                                    const struct scene_params *params)
{
    const char *name = params->environment;
    char *path;
    if (params->source && params->source->make_environment)
        return params->source->make_environment(params->source->user, environment);
    if (params->files && loaded_files_copy_environment(params->files, name, environment))
        return STATUS_OK;
    enum status status = locate(name, ASSET_ENVIRONMENT, &path);
    if (status == STATUS_OK)
        status = sandboxed_load_environment(environment, path, params->decode);
    if (status == STATUS_OK && params->files)
        loaded_files_keep_environment(params->files, name, environment);
    free(path);
    return status;
}

static enum status load_background(struct scene *scene, const struct scene_params *params)
{
    scene->background.is_hidden = params->is_hidden;
    if (params->background) {
        scene->background.kind = params->is_backdrop ? SCENE_SKY : SCENE_COLOR;
        scene->background.is_backdrop = params->is_backdrop;
        scene->background.color = *params->background;
    }
    if (!params->environment)
        return STATUS_OK;
    if (params->previous_pose) {
        scene->background = params->previous_pose->background;
        return STATUS_OK;
    }
    struct environment environment;
    const enum status status = read_environment(&environment, params);
    if (status != STATUS_OK)
        return status;
    if (params->environment_exposure < 0.0f || params->environment_exposure > 0.0f)
        environment_apply_exposure(&environment, params->environment_exposure);
    if (environment.is_cube) {
        scene->background.cube = environment;
        if (params->is_backdrop) /* a cube does not light surfaces: the colour does */
            scene->background.kind = SCENE_COLOR;
    } else {
        environment.turn = params->environment_turn;
        scene->background.kind = SCENE_ENVIRONMENT;
        scene->background.environment = environment;
    }
    return STATUS_OK;
}

static enum status add_movers(struct scene *scene, uint32_t count)
{
    struct mesh movers = { 0 };
    const uint32_t start = scene->model.surroundings.vertex_count;
    bool done = generate_orbiting_balls(&movers, scene->box, count) &&
                model_surroundings_add_object(&scene->model, "moving objects", start) &&
                mesh_append(&scene->model.surroundings, &movers);
    mesh_finish(&movers);
    return done ? STATUS_OK : log_out_of_memory("moving objects");
}

/* Builds the GPU table of the vertex extras, if there are any. */
static enum status add_extras(struct scene *scene)
{
    const struct mesh *mesh = &scene->model.surroundings;
    if (!mesh->extras)
        return STATUS_OK;
    if (mesh_extra_row_count(mesh->vertex_count) > MESH_EXTRA_HEIGHT) {
        log_error("expected at most %d vertices in surroundings with tangents or a second set of "
                  "texture coordinates, got %u: export the surroundings without these",
                  MESH_EXTRA_HEIGHT * (MESH_EXTRA_WIDTH / MESH_EXTRA_TEXELS), mesh->vertex_count);
        return STATUS_DATA;
    }
    scene->tables.vertex_extras = material_table_make_extras(mesh);
    return scene->tables.vertex_extras ? STATUS_OK : log_out_of_memory("texture coordinates");
}

static uint16_t *prefilter(const struct scene *scene, const struct scene_params *params)
{
    const struct environment *environment = &scene->background.environment;
    return params->files
               ? loaded_files_prefilter(params->files, environment, params->environment_exposure)
               : image_based_lighting_prefilter(environment);
}

/* Finds the scattering media, and builds the GPU tables of materials and lights. */
static enum status add_surfaces(struct scene *scene, const struct scene_params *params)
{
    if (scene->model.object.index_count)
        scene->inclusions.media =
            scattering_media_find(&scene->model, params->has_scattering_medium);
    if (params->has_scattering_medium && params->scatters_evenly)
        scene->inclusions.media.all[0].is_even = true;
    const bool is_lit =
        material_table_has_lit(&scene->model.surroundings) || scene_has_lit_object(scene);
    const bool has_lights = is_lit && scene->model.light_count > 0;
    const bool needs_light =
        (is_lit || scene->inclusions.media.count) && scene->background.kind == SCENE_ENVIRONMENT;
    const bool is_lit_by_table = has_lights || (is_lit && scene->background.kind != SCENE_SKY);
    if (needs_light && !scene->background.prefiltered)
        scene->background.prefiltered = prefilter(scene, params);
    if (needs_light && !scene->background.prefiltered)
        return log_out_of_memory("environment lighting");
    if (!is_lit_by_table && !material_table_needs_full_shading(&scene->model) &&
        !scene_has_textured_objects(scene))
        return STATUS_OK;
    scene->tables.materials = material_table_make(&scene->model);
    scene->tables.brdf = image_based_lighting_brdf_table();
    if (has_lights)
        scene->tables.punctual_lights =
            punctual_light_table_make(scene->model.lights, scene->model.light_count);
    const bool done = scene->tables.materials && scene->tables.brdf &&
                      (scene->tables.punctual_lights || !has_lights);
    if (!done)
        return log_out_of_memory("materials");
    return add_extras(scene);
}

static enum status allocate_bvh(struct scene *scene, const struct scene *before)
{
    const bool is_first = scene->is_animated && !(before && before->rest);
    scene->bvh = calloc(1, sizeof(*scene->bvh));
    scene->rest = is_first ? bvh_rest_pose_create(scene->model.animation) : NULL;
    return scene->bvh && (scene->rest || !is_first) ? STATUS_OK : log_out_of_memory(NULL);
}

/* Moves the rest pose from `before` to `scene`. If `before` is at rest, moves the meshes, too. */
static void move_rest_pose(struct scene *scene, struct scene *before)
{
    if (!before->rest || scene->rest)
        return;
    scene->rest = before->rest;
    before->rest = NULL;
    bvh_rest_pose_move_from(scene->rest, &before->model, &before->sorted);
}

/* Clears a scene's environment and prefiltered lighting, which another scene now owns. */
static void release_environment(struct scene *scene, const struct scene *before)
{
    if (scene == before || scene->background.prefiltered == before->background.prefiltered)
        scene->background.prefiltered = NULL;
    scene->background.environment = (struct environment){ 0 };
    scene->background.cube = (struct environment){ 0 };
}

/* Loads the surroundings that the parameters or the built-in scene name. If they name none, loads
 * the landscape, provided that the background is the sky and the model has no surroundings. */
static enum status load_surroundings(struct scene *scene, const struct scene_params *params)
{
    const struct scene_builtin *builtin = scene_find_builtin(params->name);
    if (params->surroundings)
        return add_surroundings(scene, params);
    if (builtin && builtin->surround)
        return add_builtin_surroundings(scene, builtin);
    const bool is_bare = !scene->model.surroundings.index_count && !stage_has_floor(&params->stage);
    return is_bare && scene->background.kind == SCENE_SKY ? add_landscape(scene, params)
                                                          : STATUS_OK;
}

/* Adds the floor of the stage. It stays below the first pose of an animated model. */
static enum status add_stage(struct scene *scene, const struct scene_params *params)
{
    if (!stage_has_floor(&params->stage))
        return STATUS_OK;
    scene->stage_box =
        params->previous_pose ? params->previous_pose->stage_box : stage_subject_box(&scene->model);
    return stage_add(&scene->model, &params->stage, scene->stage_box,
                     &scene->background.environment);
}

/* Sorts the surroundings by distance from the object's centre, because this point is near all
 * cameras and is the centre of the environment cube. */
static enum status sort_surroundings(struct scene *scene)
{
    struct mesh_order *sorted = scene->is_animated ? &scene->sorted : NULL;
    return mesh_sort_by_distance(&scene->model.surroundings, box_center(scene->box), sorted)
               ? STATUS_OK
               : log_out_of_memory("surroundings");
}

/* Tests whether the objects are convex and measures their depth complexity, if there are few:
 * scenes of many objects are drawn without this. */
static void measure_shape(struct scene *scene)
{
    const struct model *model = &scene->model;
    scene->is_convex = mesh_is_convex(&model->object);
    scene->depth_complexity = 0.0f;
    for (uint32_t i = 0; i < model->object_count && model->object_count < ICE_NESTED_MEDIA_MAX;
         i++) {
        const struct mesh part = object_mesh(&model->objects[i], &model->object);
        scene->depth_complexity = fmaxf(scene->depth_complexity, mesh_depth_complexity(&part));
    }
}

static enum status melt_ice(struct scene *scene, const struct scene_params *params)
{
    struct model *model = &scene->model;
    const enum status status =
        melt_model(model, &params->melting, params->pose.time, &scene->melted);
    if (status != STATUS_OK || !(scene->melted.lost_fraction > 0.0f))
        return status;
    if (scene->has_pool)
        scene->floating_ice = mesh_box(&model->object);
    else
        scene->box = mesh_box(&model->object);
    measure_shape(scene);
    return status;
}

static enum status find_contacts(struct scene *scene)
{
    const struct model *model = &scene->model;
    return coincident_shells_find(&scene->contacts, model->objects, model->object_count,
                                  &model->object)
               ? STATUS_OK
               : log_out_of_memory("objects");
}

/* Gives resources that two poses share to the new pose, or to the old one if loading has failed. */
static void transfer_ownership(struct scene *before, struct scene *scene, bool shares_environment,
                               enum status status)
{
    struct scene *other = status == STATUS_OK ? before : scene;
    if (status == STATUS_OK)
        move_rest_pose(scene, before);
    if (shares_environment)
        release_environment(other, before);
    other->files = (struct scene_files){ 0 };
}

/* Adds what is computed from the geometry: movers, melted ice, contacts, surfaces, occluders and
 * inclusions. */
static enum status add_derived(struct scene *scene, const struct scene_params *params)
{
    const bool has_object = scene->model.object.index_count > 0;
    enum status status = STATUS_OK;
    if (params->orbiting_ball_count)
        status = add_movers(scene, params->orbiting_ball_count);
    if (status == STATUS_OK)
        status = melt_ice(scene, params);
    if (status == STATUS_OK)
        status = find_contacts(scene);
    if (status == STATUS_OK && !scene->has_pool)
        status = add_surfaces(scene, params);
    if (status == STATUS_OK && scene->tables.materials && has_object)
        status = ao_find(&scene->ao, &scene->model.object, scene->model.objects,
                         scene->model.object_count);
    if (status == STATUS_OK && has_object && !scene->has_pool)
        status = scene_fill_object(scene, params);
    return status;
}

/* Limits the number of objects, because some algorithms compare them pairwise. */
static enum status check_object_count(const struct scene_params *params, const struct model *model)
{
    if (model->object_count <= BVH_OBJECTS_MAX)
        return STATUS_OK;
    log_error("%s: the scene has %u refractive objects, but at most %d can be drawn: join some, or "
              "make some opaque",
              params->name, model->object_count, BVH_OBJECTS_MAX);
    return STATUS_DATA;
}

enum status scene_load(struct scene *scene, const struct scene_params *given)
{
    struct scene_params copy = *given;
    const struct scene_params *params = &copy;
    *scene = (struct scene){ 0 };
    enum status status = load_object(scene, params);
    if (status == STATUS_OK && copy.on_object_loaded)
        copy.on_object_loaded(copy.user, scene, &copy);
    if (status == STATUS_OK)
        status = load_background(scene, params);
    if (status == STATUS_OK)
        status = check_object_count(params, &scene->model);
    if (status == STATUS_OK)
        status = object_assign_ranks(scene->model.objects, scene->model.object_count,
                                     &scene->model.object, scene->model.materials);
    const bool has_object = scene->model.object.index_count > 0;
    if (!scene->has_pool)
        scene->box = mesh_box(has_object ? &scene->model.object : &scene->model.surroundings);
    scene->framing_box = scene->box;
    if (status == STATUS_OK && !scene_is_known(params->name))
        framing_init(&scene->framing, &scene->model.object, &scene->model.surroundings);
    scene->time = params->pose.time;
    scene->is_animated = scene->model.animation || params->melting.speed > 0.0f;
    if (status == STATUS_OK)
        measure_shape(scene);
    if (status == STATUS_OK)
        status = load_surroundings(scene, params);
    if (!scene->model.has_box)
        scene->model.box = mesh_box(&scene->model.surroundings);
    if (status == STATUS_OK)
        status = add_stage(scene, params);
    if (status == STATUS_OK)
        status = sort_surroundings(scene);
    if (status == STATUS_OK)
        status = add_derived(scene, params);
    if (status == STATUS_OK)
        status = allocate_bvh(scene, params->previous_pose);
    if (params->previous_pose)
        transfer_ownership(params->previous_pose, scene, params->environment != NULL, status);
    if (status != STATUS_OK)
        scene_finish(scene);
    return status;
}

enum status scene_build_bvh(const struct scene *scene, bool is_cached)
{
    const struct bvh_params params = {
        .model = &scene->model,
        .sorted = scene->sorted,
        .cracks = &scene->inclusions.cracks,
        .bubbles = &scene->inclusions.bubbles,
        .contacts = &scene->contacts,
        .rest = scene->rest,
        .is_cached = is_cached && (scene->rest || !scene->is_animated),
    };
    return scene->bvh->nodes.all ? STATUS_OK : bvh_init(scene->bvh, &params);
}

static void free_tables(struct scene_tables *tables)
{
    free(tables->materials);
    free(tables->vertex_extras);
    free(tables->punctual_lights);
    free(tables->brdf);
    *tables = (struct scene_tables){ 0 };
}

enum status scene_update_materials(struct scene *scene, const struct scene_params *params)
{
    const struct scattering_media filled = scene->inclusions.media;
    if (scene->has_pool) /* has no tables */
        return STATUS_OK;
    free_tables(&scene->tables);
    const enum status status = add_surfaces(scene, params);
    scattering_media_finish(&scene->inclusions.media); /* found again, but not filled */
    scene->inclusions.media = filled;
    return status;
}

void scene_finish(struct scene *scene)
{
    if (scene->bvh)
        bvh_finish(scene->bvh);
    free(scene->bvh);
    bvh_rest_pose_destroy(scene->rest);
    free(scene->sorted.all);
    model_finish(&scene->model);
    coincident_shells_finish(&scene->contacts);
    melted_finish(&scene->melted);
    environment_finish(&scene->background.environment);
    environment_finish(&scene->background.cube);
    free_tables(&scene->tables);
    free(scene->previous_positions);
    free(scene->background.prefiltered);
    bump_maps_finish(&scene->bump);
    scattering_media_finish(&scene->inclusions.media);
    mesh_finish(&scene->inclusions.air);
    free(scene->inclusions.air_layers.texels);
    free(scene->inclusions.bubbles.all);
    mesh_finish(&scene->inclusions.cracks);
    mesh_finish(&scene->files.crack_sheet);
    free(scene->files.heights);
    free(scene->files.smoothness);
    free(scene->files.air_opacity);
    *scene = (struct scene){ 0 };
}

float scene_near_plane(const struct scene *scene)
{
    float diagonal = box_diagonal(scene->box);
    return diagonal > 0.0f ? diagonal * 1e-3f : 1e-3f;
}
