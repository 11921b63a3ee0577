/* choose_refraction.c: chooses the refraction model and warns of features that it cannot draw. */
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/trace/bvh_layout.h"
#include "src/base/log.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/scene/gpu_material_table.h"
#include "src/settings/scene_settings.h"
#include "src/setup/setup.h"
#include "src/tech/frame_media.h"
#include "src/tech/ice/ice_nested.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/lighting/bump.h"
#include "src/tech/lighting/highlight.h"
#include "src/tech/refract/refract.h"
#include "src/tech/refract/refract_bounce.h"
#include "src/tech/trace/refract_trace.h"

/* Scale factor that shrinks an object's box, to exclude surroundings that only touch the object. */
#define INNER_FRACTION 0.9f

static bool is_rough(const struct material *material)
{
    return material->roughness > 0.0f;
}

static bool is_partial(const struct material *material)
{
    return material->flags & MATERIAL_IS_PARTIAL;
}

static bool is_thin(const struct material *material)
{
    return !(material->thickness > 0.0f);
}

/* Returns true if the base colour, transmission or normal texture uses the second UV set. */
static bool has_second_set(const struct material *material)
{
    static const uint32_t uses[] = { MATERIAL_BASE_COLOR, MATERIAL_TRANSMISSION, MATERIAL_NORMAL };

    for (size_t i = 0; i < sizeof(uses) / sizeof(uses[0]); i++) {
        const struct material_texture *texture = &material->textures[uses[i]];
        if (texture->layer > 0 && texture->uv_set > 0)
            return true;
    }
    return false;
}

/* Counts the nested objects that the refraction model `bounce` wrongly draws as not enclosed. Such
 * objects are nested too deeply, or share their enclosing object with other objects. */
static uint32_t count_hidden(const struct model *model)
{
    uint32_t count = 0;
    uint32_t *inner_counts = calloc(model->object_count + (size_t)1, sizeof(*inner_counts));
    for (uint32_t i = 0; inner_counts && i < model->object_count; i++)
        inner_counts[model->objects[i].enclosing_object]++;
    for (uint32_t i = 0; inner_counts && i < model->object_count; i++) {
        const uint32_t around = model->objects[i].enclosing_object;
        uint32_t depth = 0;
        for (uint32_t k = i; model->objects[k].enclosing_object && depth < ICE_NESTED_LEVELS;
             k = model->objects[k].enclosing_object - 1)
            depth++;
        count += (around && inner_counts[around] > 1) || depth >= ICE_NESTED_LEVELS;
    }
    free(inner_counts);
    return count;
}

/* Test whether another box contains the box of an object. */
struct inside_test {
    const struct object *objects;
    uint32_t index;
    uint32_t left; /* number of further tests in all, which limits the time for dense objects */
    bool is_inside;
};

static bool visit_box(void *user, uint32_t i)
{
    struct inside_test *test = user;
    test->is_inside =
        i != test->index && box_contains(&test->objects[i].box, &test->objects[test->index].box);
    test->left -= test->left > 0;
    return !test->is_inside && test->left > 0;
}

/* Counts the objects that rasterisation leaves out because another object's box contains them. */
static uint32_t count_inside(const struct model *model)
{
    struct inside_test test = { .objects = model->objects, .left = 1u << 24 };
    struct box_tree tree;
    uint32_t count = 0;
    if (!object_boxes_init(&tree, model->objects, model->object_count))
        return 0;
    for (uint32_t i = 0; i < model->object_count && test.left > 0; i++) {
        test.index = tree.bvh.order[i];
        test.is_inside = false;
        box_tree_visit(&tree, &model->objects[test.index].box, &test, visit_box);
        count += test.is_inside;
    }
    box_tree_finish(&tree);
    return count;
}

static void add_count(char *text, size_t size, uint32_t count, const char *name)
{
    const size_t used = strlen(text);
    if (count)
        snprintf(&text[used], size - used, "%s%u %s", used ? ", " : "", count, name);
}

/* Writes how many objects need the refraction model `trace`, and why, such as "1 rough". */
static void name_undrawn(const struct scene *scene, const struct settings *settings, bool is_nested,
                         char *text, size_t size)
{
    static const struct {
        const char *name;
        bool (*is_present)(const struct material *material);
    } kinds[] = { { "rough", is_rough },
                  { "thin-walled", is_thin },
                  { "with several materials", is_partial },
                  { "with a second set of texture coordinates", has_second_set } };
    const struct model *model = &scene->model;
    const struct refract_params *refract = settings_of(settings, &refract_settings);
    const bool is_all_rough = refract->roughness > 0.0f;
    text[0] = '\0';
    if (is_all_rough)
        add_count(text, size, model->object_count, "rough");
    if (frame_media_are_from_settings(scene))
        return;
    for (size_t k = is_all_rough; k < sizeof(kinds) / sizeof(kinds[0]); k++) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < model->object_count; i++)
            count += kinds[k].is_present(&model->materials[model->objects[i].material]);
        add_count(text, size, count, kinds[k].name);
    }
    if (is_nested)
        add_count(text, size, count_hidden(model), "inside others that may hide each other");
    else
        add_count(text, size, count_inside(model), "inside others");
}

static void warn_of_materials(const struct setup_image *image, const struct scene *scene)
{
    char text[160];
    if (!image->refraction->refraction.shaders || image->refraction->refraction.traces_bvh)
        return;
    const bool is_nested = image->refraction == &refract_bounce &&
                           refract_bounce_is_nested(&image->scene.settings, scene);
    name_undrawn(scene, &image->scene.settings, is_nested, text, sizeof(text));
    if (text[0])
        log_warning("%s: its %u objects (of which %s) are approximated as separate smooth solids; "
                    "use --refraction trace to draw them exactly",
                    image->scene.name, scene->model.object_count, text);
}

/* Returns true if a vertex of the surroundings is well inside the box of the first object. */
static bool holds_surroundings(const struct model *model)
{
    const struct box *box = &model->objects[0].box;
    const vec3s center = box_center(*box);
    const vec3s half = glms_vec3_scale(glms_vec3_sub(box->max, box->min), 0.5f * INNER_FRACTION);
    for (uint32_t i = 0; i < model->surroundings.vertex_count; i++) {
        const vec3s at = glms_vec3_sub(model->surroundings.vertices[i].position, center);
        if (fabsf(at.x) < half.x && fabsf(at.y) < half.y && fabsf(at.z) < half.z)
            return true;
    }
    return false;
}

/* Returns true if the camera is inside an object at the time motion.time. */
static bool is_camera_inside(const struct scene *scene, const struct settings *settings,
                             const struct camera *camera)
{
    const struct motion_params *motion = settings_of(settings, &motion_settings);
    const struct model *model = &scene->model;
    mat4s world_from_object, world_from_movers;
    if (!camera || scene->has_pool || camera->height > 0.0f)
        return false;
    frame_rotations(&(struct frame_view){ .settings = settings }, box_center(scene->box),
                    motion->time, &world_from_object, &world_from_movers);
    const vec3s eye = glms_mat4_mulv3(glms_mat4_inv(world_from_object), camera->eye, 1.0f);
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (object_contains(&model->objects[i], &model->object, eye))
            return true;
    }
    return false;
}

/* Writes why refraction model `bounce` cannot draw the scene exactly, or "" if it can. */
static void name_reason(const struct scene *scene, const struct settings *settings, bool is_inside,
                        char *text, size_t size)
{
    const struct model *model = &scene->model;
    char undrawn[160] = "";
    text[0] = '\0';
    if (!model->object_count || scene->has_pool)
        return;
    if (model->object_count > 1)
        snprintf(text, size, "it has %u refractive objects", model->object_count);
    else if (model->objects[0].open_edge_count)
        snprintf(text, size, "its object is not closed");
    else if (is_inside)
        snprintf(text, size, "the camera is inside its object");
    else if (holds_surroundings(model))
        snprintf(text, size, "something is inside its object");
    else
        name_undrawn(scene, settings, false, undrawn, sizeof(undrawn));
    if (undrawn[0])
        snprintf(text, size, "bounce would only approximate its object: %s", undrawn);
}

static bool can_trace(const struct model *model)
{
    const uint64_t indices = (uint64_t)model->object.index_count + model->surroundings.index_count;
    const bool is_few =
        model->object_count <= BVH_MASK_OBJECTS_MAX || model->material_count <= BVH_MEDIA_MAX;
    return is_few && model->object_count <= BVH_OBJECTS_MAX && indices / 3 <= BVH_TRIANGLES_MAX;
}

/* Returns true if a refraction model draws bump maps. The path tracer, which has no shaders, draws
 * bump maps. Models that trace rays on the GPU draw none. */
static bool draws_bumps(const struct refraction_model *refraction)
{
    return !refraction->shaders || (!refraction->traces_bvh && (refraction->shades_fullscreen ||
                                                                refraction->shaders->bump_frag));
}

/* Returns true if the user has set a setting. */
static bool is_set(const struct setup_scene *options, const char *name)
{
    return settings_source(&options->settings, settings_find(name)) == SETTING_USER;
}

/* Warns if bump.strength or a crack setting is given with --set, but has no effect with the
 * refraction model. */
static void warn_of_settings(const struct setup_image *image)
{
    static const struct {
        const char *name;
        const struct technique *of;
    } unknown[] = {
        { "bump.strength", &bump }, { "cracks.strength", &cracks }, { "cracks.refract", &cracks },
        { "cracks.clip", &cracks }, { "cracks.debug", &cracks },
    };
    const struct setup_scene *options = &image->scene;
    char text[120] = "";
    for (size_t i = 0; i < sizeof(unknown) / sizeof(unknown[0]); i++) {
        const size_t used = strlen(text);
        const bool is_left_out = unknown[i].of == &bump
                                     ? !draws_bumps(&image->refraction->refraction)
                                     : image->refraction->refraction.traces_bvh;
        if (is_set(options, unknown[i].name) && unknown[i].of->is_on(&options->settings) &&
            is_left_out)
            snprintf(&text[used], sizeof(text) - used, "%s%s", used ? ", " : "", unknown[i].name);
    }
    if (text[0] && !options->quiet)
        log_warning("%s: no effect with --refraction %s", text, image->refraction->refraction.name);
}

/* Warns if input files or inclusions.scale have no effect on this image. */
static void warn_of_files(const struct setup_image *image, const struct scene *scene)
{
    const struct setup_scene *options = &image->scene;
    const bool traces_bvh = image->refraction->refraction.traces_bvh;
    const bool has_bumps =
        bump.is_on(&options->settings) && draws_bumps(&image->refraction->refraction);
    const bool has_more =
        (scene->inclusions.bubbles.count || scene->inclusions.cracks.index_count) && !traces_bvh;
    const bool is_scaled = is_set(options, "inclusions.scale");

    const struct {
        const char *option, *file;
        bool has_effect;
    } files[] = {
        { "--cracks", options->cracks, scene->inclusions.cracks.index_count > 0 },
        { "--air", options->air, scene->inclusions.air.index_count > 0 },
        { "inclusions.scale", is_scaled ? options->name : NULL,
          image->refraction->refraction.shaders &&
              (scene->inclusions.air.index_count || has_more) },
        { "--bump", options->bump, has_bumps && !scene->has_pool },
        { "--bump-mask", options->bump_mask, has_bumps && !scene->has_pool },
    };

    for (size_t i = 0; i < sizeof(files) / sizeof(files[0]) && !options->quiet; i++) {
        if (files[i].file && !files[i].has_effect)
            log_warning("%s: no effect, because the scene or its settings do not use it",
                        files[i].option);
    }
}

static void warn_of_outside(const struct setup_scene *options, const struct scene *scene)
{
    if (scene->has_pool && is_set(options, "refract.ior_outside") && !options->quiet)
        log_warning(
            "refract.ior_outside: no effect in a pool, where water and air surround the ice");
}

/* Logs a note if ground.light=traced is not supported, or if tiles prevent ground.denoise. */
static void warn_of_ground(const struct setup_image *image, const struct scene *scene)
{
    const struct ground_params *ground = settings_of(&image->scene.settings, &ground_settings);
    const struct refraction_model *refraction = &image->refraction->refraction;
    if (ground->light == GROUND_TRACED && is_set(&image->scene, "ground.light") &&
        refraction->shaders && !refraction->traces_bvh && scene->tables.materials &&
        material_table_has_lit(&scene->model.surroundings) && !image->scene.quiet)
        log_note("ground.light=traced: not supported by this refraction model, which lights "
                 "surroundings without occlusion; use --refraction trace");
    if (ground->light == GROUND_TRACED && ground->denoise && image->columns &&
        refraction->traces_bvh && scene->tables.materials &&
        material_table_has_lit(&scene->model.surroundings) && !image->scene.quiet)
        log_note("ground.denoise: no effect with tiles, since the filter needs the whole image");
}

/* Warns if the refraction model omits scattering in media, or draws air bubbles only as planes. */
static void warn_of_media(const struct setup_image *image, const struct scene *scene)
{
    const struct settings *settings = &image->scene.settings;
    const struct refraction_model *refraction = &image->refraction->refraction;
    const struct technique_config config = { .scene = scene,
                                             .settings = settings,
                                             .refraction = image->refraction };
    const bool is_drawn = refraction->traces_bvh ? trace_hits_surroundings(scene, settings)
                                                 : refract_has_medium(&config);
    if (!scene->inclusions.media.count)
        return;
    if (!is_drawn && air_is_medium(settings) && !refraction->traces_bvh && refraction->shaders)
        log_warning("air.model=medium: drawn as planes by this refraction model; use --refraction "
                    "bounce, one-sided, trace or reference to draw a medium");
    else if (!is_drawn && refraction->shaders && !image->scene.quiet)
        log_note("%s: its scattering medium is drawn clear; --refraction trace and bounce draw "
                 "scattering%s",
                 image->scene.name,
                 refraction->traces_bvh ? ", but not with trace.surroundings=cube" : "");
    if (scene->inclusions.media.left_out)
        log_warning("%s: more than %d objects contain scattering media; %u of them are drawn clear",
                    image->scene.name, MEDIUM_MAX, scene->inclusions.media.left_out);
}

void setup_choose_refraction(struct setup_image *image, const struct scene *scene,
                             const struct camera *camera)
{
    const bool is_inside = is_camera_inside(scene, &image->scene.settings, camera);
    char reason[220] = "";
    if (!image->is_refraction_named)
        name_reason(scene, &image->scene.settings, is_inside, reason, sizeof(reason));
    if (!image->is_refraction_named)
        image->refraction =
            reason[0] && can_trace(&scene->model) ? &refract_trace : &refract_bounce;
    if (reason[0] && image->refraction == &refract_trace && !image->scene.quiet)
        log_note("%s: drawn with --refraction trace, because %s", image->scene.name, reason);
    warn_of_materials(image, scene);
    if (is_inside && image->refraction->refraction.shaders &&
        !image->refraction->refraction.traces_bvh)
        log_warning("%s: the camera is inside an object, which is missing, because %s draws only "
                    "the outside of objects; use --refraction trace",
                    image->scene.name, image->refraction->refraction.name);
    warn_of_ground(image, scene);
    warn_of_media(image, scene);
    warn_of_settings(image);
    warn_of_files(image, scene);
    warn_of_outside(&image->scene, scene);
}

void setup_check_rays(const struct settings *settings, const struct gpu *gpu)
{
    const struct trace_params *trace = settings_of(settings, &trace_settings);
    if (trace->rays == TRACE_BY_QUERY && !gpu->has_rays)
        log_warning(
            "trace.traversal=query: %s has no ray queries, so rays are traced in firn's BVH",
            gpu->properties.deviceName);
}
