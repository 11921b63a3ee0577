/* scene_objects.c: list of a scene's objects, and picking of the object at a point of the image. */
#include "src/view/scene_objects.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/tech/frame_resources.h"

void scene_objects_finish(struct scene_objects *list)
{
    free(list->all);
    *list = (struct scene_objects){ 0 };
}

static void name_object(struct scene_object *one, const char *name, const char *kind, uint32_t id)
{
    snprintf(one->name, sizeof(one->name), "%s", name);
    if (*name || !id)
        snprintf(one->label, sizeof(one->label), "%s", *name ? name : kind);
    else
        snprintf(one->label, sizeof(one->label), "%s %u", kind, id);
    log_sanitize(one->label);
}

static void add_refractive(struct scene_objects *list, const struct scene *scene)
{
    const struct model *model = &scene->model;
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        const struct material *material = &model->materials[object->material];
        struct scene_object *one = &list->all[list->count++];
        name_object(one, object->name, "object", i + 1);
        if (!(material->flags & MATERIAL_FROM_SETTINGS))
            memcpy(one->material, material->name, sizeof(one->material));
        one->is_refractive = one->is_of_file = true;
        one->triangle_count = object->index_count / 3;
        one->open_edge_count = object->open_edge_count;
        one->box = object->box;
        list->open_count += object->open_edge_count > 0;
    }
}

static void add_opaque(struct scene_objects *list, const struct scene *scene)
{
    const struct model *model = &scene->model;
    const struct mesh *mesh = &model->surroundings;
    struct scene_object *first = &list->all[list->count];
    for (uint32_t i = 0; i <= model->surroundings_object_count; i++) {
        const char *name = i ? model->surroundings_names[i - 1] : "";
        name_object(&first[i], name, i ? "opaque object" : "surroundings", i);
        first[i].is_of_file = *name && strcmp(name, "stage") != 0;
        first[i].box.min = (vec3s){ { INFINITY, INFINITY, INFINITY } };
        first[i].box.max = (vec3s){ { -INFINITY, -INFINITY, -INFINITY } };
    }
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        struct scene_object *one = &first[model_surroundings_find_object(model, mesh->indices[i])];
        if (!one->triangle_count++) {
            const uint32_t material =
                mesh->vertices[mesh->indices[i]].material >> MESH_SURFACE_SHIFT;
            if (material && material <= model->material_count)
                memcpy(one->material, model->materials[material - 1].name, sizeof(one->material));
        }
        for (uint32_t k = 0; k < 3; k++) {
            const vec3s p = mesh->vertices[mesh->indices[i + k]].position;
            one->box.min = glms_vec3_minv(one->box.min, p);
            one->box.max = glms_vec3_maxv(one->box.max, p);
        }
    }
    list->count += model->surroundings_object_count + 1;
}

static void add_hidden(struct scene_objects *list, const struct setup_scene *setup)
{
    for (uint32_t i = 0; i < setup->object_transform_count; i++) {
        const struct object_transform *t = &setup->object_transforms[i];
        const uint32_t found = t->is_hidden ? scene_objects_find(list, t->name) : 0;
        if (!t->is_hidden)
            continue;
        struct scene_object *one =
            found == SCENE_OBJECT_NONE ? &list->all[list->count++] : &list->all[found];
        name_object(one, t->name, "object", 0);
        one->is_hidden = one->is_of_file = true;
    }
}

void scene_objects_update(struct scene_objects *list, const struct viewport *p)
{
    const struct model *model = &p->scene.model;
    if (list->all && list->of == p && list->version == p->version)
        return;
    scene_objects_finish(list);
    list->all = calloc((size_t)model->object_count + model->surroundings_object_count + 1 +
                           p->state.scene.object_transform_count,
                       sizeof(*list->all));
    list->of = p;
    list->version = p->version;
    if (!list->all)
        return;
    add_refractive(list, &p->scene);
    add_opaque(list, &p->scene);
    add_hidden(list, &p->state.scene);
}

uint32_t scene_objects_find(const struct scene_objects *list, const char *name)
{
    for (uint32_t i = 0; i < list->count && *name; i++) {
        if (!strcmp(list->all[i].name, name))
            return i;
    }
    return SCENE_OBJECT_NONE;
}

mat4s scene_objects_matrix(const struct viewport *p, float time)
{
    const struct scene *scene = &p->scene;
    const struct frame_view view = { .settings = &p->state.scene.settings };
    const bool floats = scene->has_pool && scene->model.object.index_count;
    mat4s world_from_object;
    mat4s world_from_movers;
    frame_rotations(&view, box_center(floats ? scene->floating_ice : scene->box), time,
                    &world_from_object, &world_from_movers);
    return world_from_object;
}

/* ---- picking ---- */

struct ray {
    vec3s origin, direction;
    float nearest;  /* parameter of the nearest hit */
    uint32_t index; /* first index of the triangle that is hit; UINT32_MAX for none */
};

/* Shortens the ray to the nearest triangle of a mesh (Moller and Trumbore 1997). */
static void intersect(struct ray *ray, const struct mesh *mesh)
{
    ray->index = UINT32_MAX;
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const vec3s a = mesh->vertices[mesh->indices[i]].position;
        const vec3s ab = glms_vec3_sub(mesh->vertices[mesh->indices[i + 1]].position, a);
        const vec3s ac = glms_vec3_sub(mesh->vertices[mesh->indices[i + 2]].position, a);
        const vec3s p = glms_vec3_cross(ray->direction, ac);
        const float determinant = glms_vec3_dot(ab, p);
        const vec3s from = glms_vec3_sub(ray->origin, a);
        const float u = glms_vec3_dot(from, p) / determinant;
        if (!(u >= 0.0f && u <= 1.0f))
            continue;
        const vec3s q = glms_vec3_cross(from, ab);
        const float v = glms_vec3_dot(ray->direction, q) / determinant;
        const float t = glms_vec3_dot(ac, q) / determinant;
        if (v >= 0.0f && u + v <= 1.0f && t > 0.0f && t < ray->nearest) {
            ray->nearest = t;
            ray->index = i;
        }
    }
}

static struct ray camera_ray(const struct camera *camera, float aspect, float x, float y)
{
    const struct camera_basis basis = camera_basis(camera);
    const float half = camera_half_height(camera);
    const vec3s across =
        glms_vec3_add(glms_vec3_scale(basis.right, (2.0f * x - 1.0f) * half * aspect),
                      glms_vec3_scale(basis.up, (1.0f - 2.0f * y) * half));
    struct ray ray = { camera->eye, basis.forward, INFINITY, UINT32_MAX };
    if (camera->height > 0.0f)
        ray.origin = glms_vec3_add(ray.origin, across);
    else
        ray.direction = glms_vec3_normalize(glms_vec3_add(basis.forward, across));
    return ray;
}

uint32_t scene_objects_pick(const struct viewport *p, float time, float x, float y, vec3s *at)
{
    const struct model *model = &p->scene.model;
    const float aspect = (float)p->state.width / (float)p->state.height;
    const mat4s object_from_world = glms_mat4_inv(scene_objects_matrix(p, time));
    struct ray world = camera_ray(&p->camera, aspect, x, y);
    struct ray ray = world;
    uint32_t found = SCENE_OBJECT_NONE;
    ray.origin = glms_mat4_mulv3(object_from_world, world.origin, 1.0f);
    ray.direction = glms_mat4_mulv3(object_from_world, world.direction, 0.0f);
    intersect(&ray, &model->object);
    for (uint32_t i = 0; i < model->object_count && ray.index != UINT32_MAX; i++) {
        const struct object *object = &model->objects[i];
        if (ray.index >= object->first_index &&
            ray.index - object->first_index < object->index_count)
            found = i;
    }
    world.nearest = ray.nearest;
    intersect(&world, &model->surroundings);
    if (world.index != UINT32_MAX)
        found = model->object_count +
                model_surroundings_find_object(model, model->surroundings.indices[world.index]);
    *at = glms_vec3_add(world.origin, glms_vec3_scale(world.direction, world.nearest));
    return found;
}
