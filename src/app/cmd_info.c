/* cmd_info.c: command firn info: prints the contents of a scene or model file. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/info_surroundings.h"
#include "src/base/log.h"
#include "src/file/json_text.h"
#include "src/scene/world_position.h"
#include "src/tech/techniques.h"

enum {
    TRIANGLES_MANY = 200000, /* of models whose BVH is not built for its statistics */
};

/* ---- facts ---- */

static const char *const support_names[MODEL_SUPPORT_COUNT] = {
    [MODEL_DRAWN] = "drawn",
    [MODEL_APPROXIMATED] = "approximated",
    [MODEL_IGNORED] = "ignored",
};

static const char *const texture_names[MATERIAL_TEXTURE_COUNT] = {
    [MATERIAL_BASE_COLOR] = "base colour",
    [MATERIAL_METALLIC_ROUGHNESS] = "metallic and roughness",
    [MATERIAL_NORMAL] = "normal",
    [MATERIAL_OCCLUSION] = "occlusion",
    [MATERIAL_EMISSION] = "emission",
    [MATERIAL_TRANSMISSION] = "transmission",
    [MATERIAL_THICKNESS] = "thickness",
    [MATERIAL_SPECULAR] = "specular",
    [MATERIAL_SPECULAR_COLOR] = "specular colour",
    [MATERIAL_COAT] = "clear coat",
    [MATERIAL_COAT_ROUGHNESS] = "clear coat roughness",
};

/* Returns how a material is drawn. */
static const char *kind_of(const struct material *material)
{
    if (material->flags & MATERIAL_FROM_SETTINGS)
        return "as set";
    if (!(material->transmission > 0.0f))
        return "opaque";
    return material->thickness > 0.0f ? "solid" : "thin wall";
}

static const char *camera_kind(const struct model_camera *camera)
{
    return camera->kind == MODEL_ORTHOGRAPHIC ? "orthographic" : "perspective";
}

static int by_rank(const void *a, const void *b)
{
    const struct object *x = a;
    const struct object *y = b;
    return x->rank < y->rank ? -1 : x->rank > y->rank;
}

/* ---- text ---- */

/* Prints a position in the coordinates of the file. */
static void print_position(const struct model *model, const char *before, vec3s relative)
{
    const int digits = world_position_digits(model, 6);
    printf("%s%.*g,%.*g,%.*g", before, digits, world_position_axis(model, relative, 0), digits,
           world_position_axis(model, relative, 1), digits,
           world_position_axis(model, relative, 2));
}

/* Replaces control characters in the model's names, because they could control the terminal. */
static void clean_names(struct model *model)
{
    for (uint32_t i = 0; i < model->object_count; i++)
        log_sanitize(model->objects[i].name);
    for (uint32_t i = 0; i < model->material_count; i++)
        log_sanitize(model->materials[i].name);
    for (uint32_t i = 0; i < model->surroundings_object_count; i++)
        log_sanitize(model->surroundings_names[i]);
    for (uint32_t i = 0; i < model->camera_count; i++)
        log_sanitize(model->cameras[i].name);
    for (uint32_t i = 0; i < model->animation_count; i++)
        log_sanitize(model->animations[i].name);
    for (uint32_t i = 0; i < model->light_count; i++)
        log_sanitize(model->lights[i].name);
    for (uint32_t i = 0; i < model->extension_count; i++)
        log_sanitize(model->extensions[i].name);
}

static void print_objects(const struct model *model)
{
    if (!model->object_count)
        return;
    printf("\nobjects; where they overlap, the medium of the later one applies:\n");
    printf("  %-24s %10s  %-8s %s\n", "name", "triangles", "shell",
           "material, and the object it is inside");
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        printf("  %-24s %10u  %-8s %s", object->name, object->index_count / 3,
               object->open_edge_count ? "open" : "closed",
               model->materials[object->material].name);
        if (object->container_rank) /* container_rank counts from 1; 0 means no container */
            printf(", inside %s", model->objects[object->container_rank - 1].name);
        printf("\n");
    }
}

/* Prints the parameters of an opaque surface. */
static void print_surface(const struct material *m)
{
    printf(" %-6g %-10s %-9g colour %.3g,%.3g,%.3g, metallic %g", (double)m->ior, "",
           (double)m->roughness, (double)m->base_color.x, (double)m->base_color.y,
           (double)m->base_color.z, (double)m->metallic);
    if (glms_vec3_max(m->emission) > 0.0f)
        printf(", emits %.3g,%.3g,%.3g", (double)m->emission.x, (double)m->emission.y,
               (double)m->emission.z);
    if (m->flags & MATERIAL_IS_UNLIT)
        printf(", unlit");
    if (m->specular < 1.0f || !glms_vec3_eqv(m->specular_color, glms_vec3_one()))
        printf(", specular %g of %.3g,%.3g,%.3g", (double)m->specular, (double)m->specular_color.x,
               (double)m->specular_color.y, (double)m->specular_color.z);
    if (m->coat > 0.0f)
        printf(", clear coat %g of roughness %g", (double)m->coat, (double)m->coat_roughness);
    if (m->flags & MATERIAL_IS_CUTOUT)
        printf(", holes where alpha is below %g", (double)m->alpha_cutoff);
    if (m->flags & MATERIAL_IS_BLENDED)
        printf(", blended by alpha %g", (double)m->alpha);
}

static void print_medium(const struct material *m)
{
    printf(" %-6g %-10g %-9g ", (double)m->ior, (double)m->dispersion, (double)m->roughness);
    if (m->attenuation_distance > 0.0f)
        printf("%.3g,%.3g,%.3g in %g m", (double)m->attenuation_color.x,
               (double)m->attenuation_color.y, (double)m->attenuation_color.z,
               (double)m->attenuation_distance);
    else
        printf("clear");
    if (m->transmission < 1.0f)
        printf(", transmission %g", (double)m->transmission);
    if (!glms_vec3_eqv(m->base_color, glms_vec3_one()))
        printf(", tint %.3g,%.3g,%.3g", (double)m->base_color.x, (double)m->base_color.y,
               (double)m->base_color.z);
    if (m->flags & MATERIAL_HAS_PRIORITY)
        printf(", priority %d", m->priority);
    if (m->scattering_optical_depth > 0.0f)
        printf(", cloud %g", (double)m->scattering_optical_depth);
}

static void print_material(const struct material *m)
{
    const char *separator = "; textures: ";
    const bool is_bare = m->flags & MATERIAL_FROM_SETTINGS;
    printf("  %-24s %-10s", m->name[0] ? m->name : "(no name)", kind_of(m));
    if (!is_bare && m->transmission > 0.0f)
        print_medium(m);
    else if (!is_bare)
        print_surface(m);
    for (int i = 0; i < MATERIAL_TEXTURE_COUNT; i++) {
        if (m->textures[i].layer > 0) {
            printf("%s%s", separator, texture_names[i]);
            separator = ", ";
        }
    }
    printf("\n");
}

static void print_materials(const struct model *model)
{
    if (model->material_count)
        printf("\nmaterials:\n  %-24s %-10s %-6s %-10s %-9s %s\n", "name", "kind", "index",
               "dispersion", "roughness", "attenuation, or surface");
    for (uint32_t i = 0; i < model->material_count; i++)
        print_material(&model->materials[i]);
}

static void print_cameras(const struct model *model)
{
    if (model->camera_count)
        printf("\ncameras; --camera takes a name or a number:\n  %-3s %-24s %-13s %s\n", "no.",
               "name", "kind", "field of view and position");
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const struct model_camera *m = &model->cameras[i];
        const bool is_flat = m->kind == MODEL_ORTHOGRAPHIC;
        printf("  %-3u %-24s %-13s %g %s high", i, m->name[0] ? m->name : "(no name)",
               camera_kind(m), is_flat ? (double)m->height : (double)m->camera.fov_deg,
               is_flat ? "metres" : "degrees");
        print_position(model, ", from ", m->camera.eye);
        printf("\n");
    }
}

static void print_lights(const struct model *model)
{
    if (model->light_count)
        printf("\nlights:\n  %-24s %-11s %s\n", "name", "kind", "intensity, colour and position");
    for (uint32_t i = 0; i < model->light_count; i++) {
        const struct light *m = &model->lights[i];
        const bool is_far = m->kind == LIGHT_DIRECTIONAL;
        printf("  %-24s %-11s %g %s, colour %.3g,%.3g,%.3g", m->name[0] ? m->name : "(no name)",
               punctual_light_kind_name(m), (double)m->intensity, is_far ? "lux" : "candela",
               (double)m->color.x, (double)m->color.y, (double)m->color.z);
        if (is_far)
            printf(", along %g,%g,%g", (double)m->direction.x, (double)m->direction.y,
                   (double)m->direction.z);
        else
            print_position(model, ", at ", m->position);
        if (m->range > 0.0f)
            printf(", within %g m", (double)m->range);
        if (m->kind == LIGHT_SPOT)
            printf(", cone of %g to %g degrees", (double)glm_deg(m->inner_cone),
                   (double)glm_deg(m->outer_cone));
        printf("\n");
    }
}

/* Prints the model's glTF extensions, one line per level of support. */
static void print_extensions(const struct model *model)
{
    if (model->extension_count)
        printf("\nextensions:\n");
    for (uint32_t support = 0; support < MODEL_SUPPORT_COUNT; support++) {
        bool is_begun = false;
        for (uint32_t i = 0; i < model->extension_count; i++) {
            if (model->extensions[i].support != support)
                continue;
            if (is_begun)
                printf(", %s", model->extensions[i].name);
            else
                printf("  %-13s %s", support_names[support], model->extensions[i].name);
            is_begun = true;
        }
        if (is_begun)
            printf("\n");
    }
}

static void print_animations(const struct model *model)
{
    if (model->animation_count)
        printf("\nanimations; --animation takes a name or a number:\n  %-3s %-24s %s\n", "no.",
               "name", "seconds");
    for (uint32_t i = 0; i < model->animation_count; i++)
        printf("  %-3u %-24s %g\n", i,
               model->animations[i].name[0] ? model->animations[i].name : "(no name)",
               (double)model->animations[i].seconds);
}

static void print_tree(const struct bvh *bvh)
{
    static const struct {
        uint32_t part;
        const char *of;
    } bvhs[] = { { BVH_OBJECTS, "the objects" }, { BVH_SURROUNDINGS, "the surroundings" } };

    const char *separator = ", in triangle tests: ";
    printf("\nBVH for ray tracing: %u nodes, %u triangles, %.1f MiB, %s in %.1f ms\n",
           bvh_node_count(bvh), bvh->triangle_count, (double)bvh_size(bvh) / (1 << 20),
           bvh->read ? "from the cache" : "built", bvh->ms);
    printf("cost of a ray");
    for (size_t i = 0; i < sizeof(bvhs) / sizeof(bvhs[0]); i++) {
        if (!(bvh->costs[bvhs[i].part] > 0.0))
            continue;
        printf("%s%.1f through the box of %s", separator, bvh->costs[bvhs[i].part], bvhs[i].of);
        separator = ", ";
    }
    printf("\ndevices with ray queries use their own acceleration structures: firn list devices\n");
}

/* Returns true if a model has too many triangles to build a BVH only for its statistics, which
 * takes 2 to 3 microseconds of CPU time for each triangle. */
static bool has_many_triangles(const struct model *model)
{
    return ((uint64_t)model->object.index_count + model->surroundings.index_count) / 3 >
           TRIANGLES_MANY;
}

static void print_text(struct scene *scene, const struct technique *refraction, const char *ground)
{
    const struct model *model = &scene->model;
    const struct box box = scene->box;
    clean_names(&scene->model);
    printf("%u triangles of %u objects, %u of surroundings, %u textures\n",
           model->object.index_count / 3, model->object_count, model->surroundings.index_count / 3,
           model->textures.count + model->numbers.count);
    print_position(model, "box of the objects: ", box.min);
    print_position(model, " to ", box.max);
    printf(" metres\n");
    if (world_position_is_far(model))
        printf("origin of layer P: %.15g,%.15g,%.15g metres, because the model is far from 0,0,0\n",
               model->origin[0], model->origin[1], model->origin[2]);
    if (model->has_camera && !model->camera_count) {
        print_position(model, "camera: eye ", model->camera.eye);
        print_position(model, ", target ", model->camera.target);
        printf(", field of view %g degrees\n", (double)model->camera.fov_deg);
    }
    printf("default refraction model: %s\n", refraction->refraction.name);
    printf("ground: %s\n", ground);
    print_cameras(model);
    print_materials(model);
    print_objects(model);
    info_surroundings_print(model);
    print_lights(model);
    print_animations(model);
    print_extensions(model);
    if (bvh_node_count(scene->bvh))
        print_tree(scene->bvh);
    else if (has_many_triangles(model))
        printf("\nBVH for ray tracing: not built for more than %d triangles; firn profile "
               "--refraction trace builds it\n",
               TRIANGLES_MANY);
}

/* ---- JSON ---- */

static json_t *vector(vec3s v)
{
    return json_pack("[f, f, f]", json_text_float(v.x), json_text_float(v.y), json_text_float(v.z));
}

/* Returns a position in the coordinates of the file. */
static json_t *position_of(const struct model *model, vec3s relative)
{
    if (!world_position_is_far(model))
        return vector(relative);
    return json_pack("[f, f, f]", world_position_axis(model, relative, 0),
                     world_position_axis(model, relative, 1),
                     world_position_axis(model, relative, 2));
}

/* Returns a text from a file as a JSON string, or "?" if the text is not UTF-8. */
static json_t *text_of(const char *text)
{
    json_t *string = json_string(text);
    return string ? string : json_string("?");
}

static json_t *object_of(const struct model *model, const struct object *object)
{
    return json_pack("{s:o, s:i, s:i, s:i, s:i, s:b, s:o, s:o}", "name", text_of(object->name),
                     "rank", (int)object->rank, "inside_rank", (int)object->container_rank,
                     "triangles", (int)(object->index_count / 3), "material", (int)object->material,
                     "closed", object->open_edge_count == 0, "min",
                     position_of(model, object->box.min), "max",
                     position_of(model, object->box.max));
}

static json_t *objects_of(const struct model *model)
{
    json_t *all = json_array();
    for (uint32_t i = 0; i < model->object_count && all; i++)
        all = json_text_append(all, object_of(model, &model->objects[i]));
    return all;
}

static json_t *textures_of(const struct material *m)
{
    json_t *all = json_array();
    for (int i = 0; i < MATERIAL_TEXTURE_COUNT && all; i++) {
        if (m->textures[i].layer > 0)
            all = json_text_append(all, json_string(texture_names[i]));
    }
    return all;
}

/* Moves the members of `more` into `json`. On failure frees both and returns NULL. */
static json_t *join(json_t *json, json_t *more)
{
    const bool is_done = json && more && json_object_update(json, more) == 0;
    json_decref(more);
    if (is_done)
        return json;
    json_decref(json);
    return NULL;
}

static json_t *medium_of(const struct material *m)
{
    return json_pack("{s:f, s:f, s:f, s:f, s:o, s:f}", "transmission",
                     json_text_float(m->transmission), "thickness", json_text_float(m->thickness),
                     "ior", json_text_float(m->ior), "dispersion", json_text_float(m->dispersion),
                     "attenuation_color", vector(m->attenuation_color), "attenuation_distance",
                     json_text_float(m->attenuation_distance));
}

static json_t *surface_of(const struct material *m)
{
    const char *mode = m->flags & MATERIAL_IS_CUTOUT    ? "mask"
                       : m->flags & MATERIAL_IS_BLENDED ? "blend"
                                                        : "opaque";
    return json_pack("{s:f, s:o, s:f, s:o, s:f, s:f, s:s, s:f, s:f, s:b}", "metallic",
                     json_text_float(m->metallic), "emission", vector(m->emission), "specular",
                     json_text_float(m->specular), "specular_color", vector(m->specular_color),
                     "clearcoat", json_text_float(m->coat), "clearcoat_roughness",
                     json_text_float(m->coat_roughness), "alpha_mode", mode, "alpha",
                     json_text_float(m->alpha), "alpha_cutoff", json_text_float(m->alpha_cutoff),
                     "unlit", (int)(m->flags & MATERIAL_IS_UNLIT) > 0);
}

static json_t *material_of(const struct material *m)
{
    json_t *json = json_pack("{s:o, s:s, s:o, s:f, s:o}", "name", text_of(m->name), "kind",
                             kind_of(m), "base_color", vector(m->base_color), "roughness",
                             json_text_float(m->roughness), "textures", textures_of(m));
    if (!(m->flags & MATERIAL_FROM_SETTINGS))
        json = join(json, m->transmission > 0.0f ? medium_of(m) : surface_of(m));
    if (json && m->flags & MATERIAL_HAS_PRIORITY)
        (void)json_object_set_new(json, "priority", json_integer(m->priority));
    if (json && m->scattering_optical_depth > 0.0f)
        (void)json_object_set_new(json, "cloud",
                                  json_real(json_text_float(m->scattering_optical_depth)));
    return json;
}

static json_t *materials_of(const struct model *model)
{
    json_t *all = json_array();
    for (uint32_t i = 0; i < model->material_count && all; i++)
        all = json_text_append(all, material_of(&model->materials[i]));
    return all;
}

static json_t *camera_of(const struct model *model, const struct model_camera *m)
{
    json_t *json = json_pack("{s:o, s:s, s:o, s:o}", "name", text_of(m->name), "kind",
                             camera_kind(m), "eye", position_of(model, m->camera.eye), "target",
                             position_of(model, m->camera.target));
    if (json && m->kind == MODEL_ORTHOGRAPHIC)
        (void)json_object_set_new(json, "height", json_real(json_text_float(m->height)));
    else if (json)
        (void)json_object_set_new(json, "fov", json_real(json_text_float(m->camera.fov_deg)));
    return json;
}

static json_t *cameras_of(const struct model *model)
{
    json_t *all = json_array();
    for (uint32_t i = 0; i < model->camera_count && all; i++)
        all = json_text_append(all, camera_of(model, &model->cameras[i]));
    return all;
}

static json_t *extensions_of(const struct model *model)
{
    json_t *all = json_array();
    for (uint32_t i = 0; i < model->extension_count && all; i++)
        all = json_text_append(all,
                               json_pack("{s:o, s:s}", "name", text_of(model->extensions[i].name),
                                         "support", support_names[model->extensions[i].support]));
    return all;
}

/* Returns the features that a model file uses but firn does not draw. */
static json_t *undrawn_of(const struct model *model)
{
    json_t *all = json_array();
    for (uint32_t i = 0; model_undrawn_name(i) && all; i++) {
        if (model->undrawn & 1u << i)
            all = json_text_append(all, json_string(model_undrawn_name(i)));
    }
    for (const char *line = model->undrawn_text; *line && all;) {
        const size_t length = strcspn(line, "\n");
        json_t *text = json_stringn(line, length);
        all = json_text_append(all, text ? text : json_string("?"));
        line += length + (line[length] == '\n');
    }
    return all;
}

static json_t *light_of(const struct model *model, const struct light *m)
{
    json_t *json = json_pack("{s:o, s:s, s:o, s:o, s:o, s:f, s:s}", "name", text_of(m->name),
                             "kind", punctual_light_kind_name(m), "position",
                             position_of(model, m->position), "direction", vector(m->direction),
                             "color", vector(m->color), "intensity", json_text_float(m->intensity),
                             "unit", m->kind == LIGHT_DIRECTIONAL ? "lux" : "candela");
    if (json && m->range > 0.0f)
        (void)json_object_set_new(json, "range", json_real(json_text_float(m->range)));
    if (json && m->kind == LIGHT_SPOT) {
        (void)json_object_set_new(json, "inner_cone", json_real(json_text_float(m->inner_cone)));
        (void)json_object_set_new(json, "outer_cone", json_real(json_text_float(m->outer_cone)));
    }
    return json;
}

static json_t *lights_of(const struct model *model)
{
    json_t *all = json_array();
    for (uint32_t i = 0; i < model->light_count && all; i++)
        all = json_text_append(all, light_of(model, &model->lights[i]));
    return all;
}

static json_t *animations_of(const struct model *model)
{
    json_t *all = json_array();
    for (uint32_t i = 0; i < model->animation_count && all; i++)
        all = json_text_append(all,
                               json_pack("{s:o, s:f}", "name", text_of(model->animations[i].name),
                                         "seconds", json_text_float(model->animations[i].seconds)));
    return all;
}

static json_t *bvh_of(const struct bvh *bvh)
{
    return json_pack("{s:i, s:i, s:I, s:f, s:b, s:f, s:f}", "nodes", (int)bvh_node_count(bvh),
                     "triangles", (int)bvh->triangle_count, "bytes", (json_int_t)bvh_size(bvh),
                     "ms", json_text_float((float)bvh->ms), "cached", bvh->read > 0, "cost",
                     json_text_float((float)bvh->costs[BVH_OBJECTS]), "surrounding_cost",
                     json_text_float((float)bvh->costs[BVH_SURROUNDINGS]));
}

static enum status print_json(const char *name, const struct scene *scene,
                              const struct technique *refraction, const char *ground)
{
    const struct model *model = &scene->model;

    const struct {
        const char *key;
        json_t *(*make)(const struct model *model);
    } lists[] = {
        { "objects", objects_of },       { "surroundings", info_surroundings_json },
        { "materials", materials_of },   { "cameras", cameras_of },
        { "lights", lights_of },         { "animations", animations_of },
        { "extensions", extensions_of }, { "not_drawn", undrawn_of },
    };

    json_t *root =
        json_pack("{s:o, s:s, s:s, s:i, s:i, s:o, s:o, s:[f, f, f]}", "scene", text_of(name),
                  "refraction", refraction->refraction.name, "ground", ground,
                  "surrounding_triangles", (int)(model->surroundings.index_count / 3), "textures",
                  (int)(model->textures.count + model->numbers.count), "min",
                  position_of(model, scene->box.min), "max", position_of(model, scene->box.max),
                  "origin", model->origin[0], model->origin[1], model->origin[2]);
    for (size_t i = 0; root && i < sizeof(lists) / sizeof(lists[0]); i++) {
        if (json_object_set_new(root, lists[i].key, lists[i].make(model)) != 0) {
            json_decref(root);
            root = NULL;
        }
    }
    if (root && bvh_node_count(scene->bvh))
        (void)json_object_set_new(root, "tree", bvh_of(scene->bvh));
    if (root && model->has_camera)
        (void)json_object_set_new(root, "camera",
                                  json_pack("{s:o, s:o, s:f}", "eye",
                                            position_of(model, model->camera.eye), "target",
                                            position_of(model, model->camera.target), "fov",
                                            json_text_float(model->camera.fov_deg)));
    return json_text_print(root);
}

enum status app_info(const struct app_options *o)
{
    struct setup_image image = o->image;
    struct setup_scene *options = &image.scene;
    struct scene scene;
    options->plain = true;               /* without added ice effects */
    options->background.is_given = true; /* loads no panorama */
    options->ground.ground = STAGE_NONE;
    options->quiet = true;
    enum status status = setup_load_scene(&scene, options);
    if (status != STATUS_OK)
        return status;
    setup_choose_refraction(&image, &scene, NULL);
    if (!has_many_triangles(&scene.model))
        status = scene_build_bvh(&scene, !o->run.gpu.no_cache);
    if (status == STATUS_TRY_AGAIN) {
        scene_finish(&scene);
        return status;
    }
    const struct stage_params stage = setup_stage(&o->image.scene, &scene.model);
    char text[SETUP_GROUND_NAME_SIZE];
    const char *ground = setup_ground_name(&stage, text);
    status = STATUS_OK; /* printing a scene does not require a BVH */
    setup_note_contacts(options, &scene);
    if (scene.model.object_count)
        qsort(scene.model.objects, scene.model.object_count, sizeof(*scene.model.objects), by_rank);
    if (o->run.format == APP_FORMAT_JSON)
        status = print_json(options->name, &scene, image.refraction, ground);
    else
        print_text(&scene, image.refraction, ground);
    scene_finish(&scene);
    return status;
}
