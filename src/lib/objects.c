/* objects.c: lists the objects of a scene, and reads and changes their materials. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lib/lib.h"
#include "src/scene/material_presets.h"
#include "src/scene/world_position.h"
#include "src/tech/frame_media.h"

/* ---- list ---- */

static uint32_t count_of(const struct model *model)
{
    return model->object_count + model->surroundings_object_count;
}

/* Logs an error and returns STATUS_USAGE if no object has the index. */
static enum status check_index(const struct model *model, uint32_t index)
{
    if (index < count_of(model))
        return STATUS_OK;
    log_error("object %u: the scene has %u objects", index, count_of(model));
    return STATUS_USAGE;
}

static void extend(struct box *box, vec3s position, bool is_first)
{
    box->min = is_first ? position : glms_vec3_minv(box->min, position);
    box->max = is_first ? position : glms_vec3_maxv(box->max, position);
}

/* Vertex range of an object of the surroundings, and properties of its triangles. */
struct surroundings_part {
    uint32_t first, end;
    struct box box;
    uint32_t triangle_count, material; /* material index + 1 */
};

static struct surroundings_part measure_part(const struct model *model, uint32_t index)
{
    const struct mesh *mesh = &model->surroundings;
    struct surroundings_part part = {
        .first = model->surroundings_starts[index],
        .end = index + 1 < model->surroundings_object_count ? model->surroundings_starts[index + 1]
                                                            : mesh->vertex_count,
    };
    for (uint32_t i = part.first; i < part.end; i++)
        extend(&part.box, mesh->vertices[i].position, i == part.first);
    if (part.first < part.end)
        part.material = mesh->vertices[part.first].material >> MESH_SURFACE_SHIFT;
    for (uint32_t i = 0; i < mesh->index_count; i += 3)
        part.triangle_count += mesh->indices[i] >= part.first && mesh->indices[i] < part.end;
    return part;
}

static void set_box(struct firn_object *object, const struct model *model, struct box box)
{
    for (int i = 0; i < 3; i++) {
        object->box_min[i] = (float)world_position_axis(model, box.min, i);
        object->box_max[i] = (float)world_position_axis(model, box.max, i);
    }
}

static struct firn_object describe(const struct model *model, uint32_t index)
{
    struct firn_object found = { .size = sizeof(found) };
    if (index < model->object_count) {
        const struct object *object = &model->objects[index];
        found.name = object->name;
        found.id = index + 1;
        found.refracts = 1;
        found.triangle_count = object->index_count / 3;
        found.material = model->materials[object->material].name;
        set_box(&found, model, object_box(object, &model->object));
        return found;
    }
    const uint32_t number = index - model->object_count;
    const struct surroundings_part part = measure_part(model, number);
    found.name = model->surroundings_names[number];
    found.id = index + 2; /* surroundings without an object also have a number */
    found.triangle_count = part.triangle_count;
    found.material = part.material ? model->materials[part.material - 1].name : "";
    set_box(&found, model, part.box);
    return found;
}

firn_status firn_scene_object_count(firn_scene *scene, uint32_t *count)
{
    struct lib_call call;
    if (!lib_enter(&call, scene ? scene->device : NULL, true))
        return scene ? FIRN_FAILED : FIRN_USAGE;
    enum status status = lib_require(count, "count");
    if (status == STATUS_OK)
        status = lib_scene_update(scene);
    if (status == STATUS_OK)
        *count = count_of(&scene->session.scene.model);
    return lib_leave(&call, status);
}

firn_status firn_scene_object(firn_scene *scene, uint32_t index, struct firn_object *object)
{
    struct lib_call call;
    if (!lib_enter(&call, scene ? scene->device : NULL, true))
        return scene ? FIRN_FAILED : FIRN_USAGE;
    const struct model *model = &scene->session.scene.model;
    enum status status = lib_scene_update(scene);
    if (status == STATUS_OK)
        status = check_index(model, index);
    if (status == STATUS_OK) {
        const struct firn_object found = describe(model, index);
        status = lib_write(object, &found, sizeof(found), "object");
    }
    return lib_leave(&call, status);
}

/* ---- materials ---- */

/* Sets the medium's members that the settings define. */
static void use_settings(struct material *material, const struct firn_scene *scene, uint32_t index)
{
    const struct frame_medium medium =
        frame_medium_at(&scene->session.scene, &scene->image.scene.settings, index);
    const double dispersion =
        settings_get(&scene->image.scene.settings, settings_find("refract.dispersion"));
    material->ior = medium.ior[1];
    material->dispersion = (float)dispersion;
    material->roughness = medium.roughness;
    material->thickness = 1.0f;
    material->attenuation_distance = MATERIAL_COLOR_LENGTH;
    for (int i = 0; i < 3; i++)
        material->attenuation_color.raw[i] =
            expf(-medium.absorption.raw[i] * MATERIAL_COLOR_LENGTH);
}

firn_status firn_scene_material(firn_scene *scene, uint32_t index, struct firn_material *material)
{
    struct lib_call call;
    if (!lib_enter(&call, scene ? scene->device : NULL, true))
        return scene ? FIRN_FAILED : FIRN_USAGE;
    const struct model *model = &scene->session.scene.model;
    enum status status = lib_scene_update(scene);
    if (status == STATUS_OK)
        status = check_index(model, index);
    if (status != STATUS_OK)
        return lib_leave(&call, status);
    static const struct material none;
    const struct material *found = &none;
    struct material copy;
    struct firn_material written;
    if (index < model->object_count) {
        found = &model->materials[model->objects[index].material];
    } else {
        const uint32_t number = measure_part(model, index - model->object_count).material;
        found = number ? &model->materials[number - 1] : found;
    }
    copy = found == &none ? material_make("") : *found;
    if (copy.flags & MATERIAL_FROM_SETTINGS)
        use_settings(&copy, scene, index);
    lib_material_write(&written, &copy);
    written.name = found->name;
    return lib_leave(&call, lib_write(material, &written, sizeof(written), "material"));
}

/* Logs an error and returns STATUS_USAGE if an object's material cannot be replaced. */
static enum status check_change(const firn_scene *scene, uint32_t index,
                                const struct firn_material *material)
{
    const struct model *model = &scene->session.scene.model;
    struct material made = material_make("");
    enum status status = check_index(model, index);
    if (status == STATUS_OK)
        status = lib_material_read(&made, material);
    if (status != STATUS_OK)
        return status;
    if (scene_find_builtin(scene->given.scene.name) ||
        (index < model->object_count) != (made.transmission > 0.0f)) {
        log_error("object %u: a refractive object needs a material with transmission above 0, an "
                  "opaque object one with transmission 0, and objects of built-in scenes the "
                  "option `material`",
                  index);
        return STATUS_USAGE;
    }
    return STATUS_OK;
}

/* Returns the recorded change of an object's material, or NULL. */
static struct lib_material_change *find_change(const firn_scene *scene, uint32_t index)
{
    for (uint32_t i = 0; i < scene->change_count; i++) {
        if (scene->changes[i].object == index)
            return &scene->changes[i];
    }
    return NULL;
}

static enum status put_change(firn_scene *scene, uint32_t index,
                              const struct firn_material *material)
{
    struct lib_material_change *change = find_change(scene, index);
    if (!change) {
        struct lib_material_change *grown =
            realloc(scene->changes, (scene->change_count + (size_t)1) * sizeof(*grown));
        if (!grown)
            return log_out_of_memory(NULL);
        scene->changes = grown;
        change = &grown[scene->change_count++];
    }
    change->object = index;
    const enum status status =
        lib_read(&change->material, sizeof(change->material), material, "material");
    change->material.size = sizeof(change->material);
    change->material.name = NULL;
    return status;
}

static bool is_equal(float a, float b)
{
    return !(a < b || a > b);
}

/* Returns true if materials differ only in values that affect neither meshes nor the BVH. */
static bool differ_in_numbers(const struct material *a, const struct material *b)
{
    return a->flags == b->flags && a->priority == b->priority &&
           is_equal(a->transmission, b->transmission) && is_equal(a->alpha, b->alpha) &&
           (a->thickness > 0.0f) == (b->thickness > 0.0f) &&
           is_equal(a->scattering_optical_depth, b->scattering_optical_depth) &&
           glms_vec3_eqv(a->base_color, b->base_color);
}

/* Changes an object's material in place if an earlier change gave the object a material of its own.
 * Sets *is_done to false if the scene must be reloaded instead. */
static enum status change_in_place(firn_scene *scene, uint32_t index,
                                   const struct firn_material *material, bool *is_done)
{
    struct model *model = &scene->session.scene.model;
    *is_done = false;
    if (index >= model->object_count || !find_change(scene, index))
        return STATUS_OK;
    struct material *own = &model->materials[model->objects[index].material];
    struct material made = *own;
    enum status status = lib_material_read(&made, material);
    if (status != STATUS_OK || !differ_in_numbers(own, &made))
        return status;
    *is_done = true;
    memcpy(made.name, own->name, sizeof(made.name));
    lib_scene_close_sessions(scene);
    *own = made;
    if (index == 0)
        model->ior = made.ior;
    if (scene->session.scene.model_ior > 0.0f)
        scene->session.scene.model_ior = model->ior;
    scene->needs_settings = true;
    return setup_update_materials(&scene->session.scene, &scene->image.scene);
}

/* Copies a material of the caller without its name, which is not set: it may point to the scene
 * before its last change, from which firn_scene_material() has read it. */
static enum status read_unnamed(struct firn_material *to, const struct firn_material *from)
{
    const enum status status = lib_read(to, sizeof(*to), from, "material");
    to->size = sizeof(*to);
    to->name = NULL;
    return status;
}

firn_status firn_scene_set_material(firn_scene *scene, uint32_t index,
                                    const struct firn_material *material)
{
    struct lib_call call;
    struct firn_material unnamed;
    if (!lib_enter(&call, scene ? scene->device : NULL, true))
        return scene ? FIRN_FAILED : FIRN_USAGE;
    bool is_done = false;
    enum status status = lib_scene_update(scene);
    if (status == STATUS_OK)
        status = read_unnamed(&unnamed, material);
    if (status == STATUS_OK)
        status = check_change(scene, index, &unnamed);
    if (status == STATUS_OK)
        status = change_in_place(scene, index, &unnamed, &is_done);
    if (status == STATUS_OK)
        status = put_change(scene, index, &unnamed);
    if ((status == STATUS_OK) != is_done) /* not possible in place, or failed midway */
        lib_scene_reload(scene);
    return lib_leave(&call, status);
}
