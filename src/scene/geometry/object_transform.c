/* object_transform.c: moves, rotates, scales and hides single objects of a loaded model. */
#include "src/scene/geometry/object_transform.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

static const float coordinate_max = 1e6f; /* maximum absolute coordinate, metres */

static float scale_of(const struct object_transform *t)
{
    return t->scale > 0.0f ? t->scale : 1.0f;
}

static bool moves(const struct object_transform *t)
{
    return glms_vec3_norm2(t->move) > 0.0f || glms_vec3_norm2(t->rotate_deg) > 0.0f ||
           scale_of(t) < 1.0f || scale_of(t) > 1.0f;
}

bool object_transform_is_identity(const struct object_transform *t)
{
    return !t->is_hidden && !moves(t);
}

static mat4s rotation_of(const struct object_transform *t)
{
    mat4s rotation = glms_mat4_identity();
    rotation = glms_rotate(rotation, glm_rad(t->rotate_deg.z), (vec3s){ { 0.0f, 0.0f, 1.0f } });
    rotation = glms_rotate(rotation, glm_rad(t->rotate_deg.y), (vec3s){ { 0.0f, 1.0f, 0.0f } });
    return glms_rotate(rotation, glm_rad(t->rotate_deg.x), (vec3s){ { 1.0f, 0.0f, 0.0f } });
}

/* Transforms vertices of a mesh about the centre of their bounding box. Returns false if a
 * coordinate is too large. */
static bool transform_vertices(struct mesh *mesh, const uint32_t *vertices, uint32_t count,
                               const struct object_transform *t)
{
    const mat4s rotation = rotation_of(t);
    const float scale = scale_of(t);
    vec3s low = { { INFINITY, INFINITY, INFINITY } };
    vec3s high = { { -INFINITY, -INFINITY, -INFINITY } };
    bool is_in_range = true;
    for (uint32_t i = 0; i < count; i++) {
        low = glms_vec3_minv(low, mesh->vertices[vertices[i]].position);
        high = glms_vec3_maxv(high, mesh->vertices[vertices[i]].position);
    }
    const vec3s center = glms_vec3_scale(glms_vec3_add(low, high), 0.5f);
    for (uint32_t i = 0; i < count; i++) {
        struct mesh_vertex *v = &mesh->vertices[vertices[i]];
        const vec3s p = glms_vec3_scale(glms_vec3_sub(v->position, center), scale);
        v->position =
            glms_vec3_add(glms_mat4_mulv3(rotation, p, 0.0f), glms_vec3_add(center, t->move));
        v->normal = glms_mat4_mulv3(rotation, v->normal, 0.0f);
        if (mesh->extras) {
            vec3s *tangent = &mesh->extras[vertices[i]].tangent;
            *tangent = glms_mat4_mulv3(rotation, *tangent, 0.0f);
        }
        is_in_range = is_in_range && glms_vec3_max(glms_vec3_abs(v->position)) <= coordinate_max;
    }
    return is_in_range;
}

static bool has_name(const struct object_transform *t, const char *name)
{
    return strcmp(t->name, name) == 0;
}

/* ---- transformed refractive objects ---- */

/* Vertex of the refractive objects' mesh. */
struct vertex_use {
    uint32_t user_count; /* number of objects that use it */
    uint32_t visit;      /* number of the last visit; counts objects, in two passes */
    uint32_t copy;       /* its index in the object that visited it last */
};

/* Returns how many objects use each vertex; NULL when out of memory. The caller frees it. */
static struct vertex_use *count_users(const struct model *model)
{
    struct vertex_use *uses = calloc(model->object.vertex_count + (size_t)1, sizeof(*uses));
    for (uint32_t k = 0; uses && k < model->object_count; k++) {
        const struct object *object = &model->objects[k];
        for (uint32_t i = 0; i < object->index_count; i++) {
            struct vertex_use *use = &uses[model->object.indices[object->first_index + i]];
            use->user_count += use->visit != k + 1;
            use->visit = k + 1;
        }
    }
    return uses;
}

/* Appends copies of vertices to a mesh. Returns false when out of memory. */
static bool append_copies(struct mesh *mesh, const uint32_t *vertices, uint32_t count)
{
    struct mesh copy;
    bool is_good = mesh_init(&copy, count, 0) && (!mesh->extras || mesh_add_extras(&copy));
    for (uint32_t i = 0; i < count && is_good; i++) {
        copy.vertices[i] = mesh->vertices[vertices[i]];
        if (mesh->extras)
            copy.extras[i] = mesh->extras[vertices[i]];
    }
    is_good = is_good && (!count || mesh_append(mesh, &copy));
    mesh_finish(&copy);
    return is_good;
}

/* Makes each object with the name of `t` use copies of the vertices that other objects use, too.
 * `list` has room for all indices of the mesh. Returns false when out of memory. */
static bool unshare(struct model *model, const struct object_transform *t, uint32_t *list)
{
    struct mesh *mesh = &model->object;
    struct vertex_use *uses = count_users(model);
    uint32_t count = 0;
    for (uint32_t k = 0; uses && k < model->object_count; k++) {
        const struct object *object = &model->objects[k];
        for (uint32_t i = 0; has_name(t, object->name) && i < object->index_count; i++) {
            uint32_t *index = &mesh->indices[object->first_index + i];
            struct vertex_use *use = &uses[*index];
            const uint32_t visit = model->object_count + k + 1;
            if (use->visit != visit && use->user_count > 1) {
                use->user_count--;
                use->copy = mesh->vertex_count + count;
                list[count++] = *index;
            } else if (use->visit != visit) {
                use->copy = *index;
            }
            use->visit = visit;
            *index = use->copy;
        }
    }
    const bool is_good = uses && append_copies(mesh, list, count);
    free(uses);
    return is_good;
}

/* Lists the vertices of an object whose bytes in `is_listed` are 0, and sets these bytes. Returns
 * their number. */
static uint32_t list_vertices(const struct model *model, uint32_t object, uint8_t *is_listed,
                              uint32_t *list)
{
    const uint32_t *indices = &model->object.indices[model->objects[object].first_index];
    uint32_t count = 0;
    for (uint32_t i = 0; i < model->objects[object].index_count; i++) {
        if (!is_listed[indices[i]])
            list[count++] = indices[i];
        is_listed[indices[i]] = 1;
    }
    return count;
}

/* Transforms the refractive objects with the name of `t`. */
static enum status transform_refractive(struct model *model, const struct object_transform *t)
{
    struct mesh *mesh = &model->object;
    uint32_t *list = malloc((mesh->index_count + (size_t)1) * sizeof(*list));
    uint8_t *is_listed = NULL;
    if (list && unshare(model, t, list))
        is_listed = calloc(mesh->vertex_count + (size_t)1, 1);
    enum status status = is_listed ? STATUS_OK : STATUS_TRY_AGAIN;
    for (uint32_t k = 0; k < model->object_count && status == STATUS_OK; k++) {
        if (!has_name(t, model->objects[k].name))
            continue;
        const uint32_t count = list_vertices(model, k, is_listed, list);
        status = transform_vertices(mesh, list, count, t) ? STATUS_OK : STATUS_DATA;
    }
    free(list);
    free(is_listed);
    return status;
}

/* ---- transformed surroundings ---- */

static uint32_t end_vertex(const struct model *model, uint32_t object)
{
    return object + 1 < model->surroundings_object_count ? model->surroundings_starts[object + 1]
                                                         : model->surroundings.vertex_count;
}

/* Transforms the surroundings objects with the name of `t`. */
static enum status transform_surroundings(struct model *model, const struct object_transform *t)
{
    struct mesh *mesh = &model->surroundings;
    uint8_t *is_used = calloc(mesh->vertex_count + (size_t)1, 1);
    uint32_t *list = malloc((mesh->vertex_count + (size_t)1) * sizeof(*list));
    enum status status = is_used && list ? STATUS_OK : STATUS_TRY_AGAIN;
    for (uint32_t i = 0; i < mesh->index_count && status == STATUS_OK; i++)
        is_used[mesh->indices[i]] = 1;
    for (uint32_t k = 0; k < model->surroundings_object_count && status == STATUS_OK; k++) {
        uint32_t count = 0;
        if (!has_name(t, model->surroundings_names[k]))
            continue;
        for (uint32_t v = model->surroundings_starts[k]; v < end_vertex(model, k); v++) {
            if (is_used[v])
                list[count++] = v;
        }
        status = transform_vertices(mesh, list, count, t) ? STATUS_OK : STATUS_DATA;
    }
    free(is_used);
    free(list);
    return status;
}

/* ---- hidden objects ---- */

/* Removes the triangles whose bytes in `is_hidden` are not 0. Their vertices stay, so that ranges
 * of vertices stay valid, but take the position of a remaining one, because bounding boxes count
 * them. Returns false when out of memory. */
static bool remove_triangles(struct mesh *mesh, const uint8_t *is_hidden)
{
    uint32_t kept = 0;
    uint8_t *is_used = calloc(mesh->vertex_count + (size_t)1, 1);
    if (!is_used)
        return false;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        if (is_hidden[i / 3])
            continue;
        is_used[mesh->indices[i]] = 1;
        mesh->indices[kept++] = mesh->indices[i];
    }
    mesh->index_count = kept;
    for (uint32_t v = 0; v < mesh->vertex_count && kept; v++) {
        if (!is_used[v])
            mesh->vertices[v].position = mesh->vertices[mesh->indices[0]].position;
    }
    free(is_used);
    return true;
}

/* Removes the refractive objects with the name of `t`, and their triangles. */
static enum status hide_refractive(struct model *model, const struct object_transform *t)
{
    uint8_t *is_hidden = calloc(model->object.index_count / 3 + (size_t)1, 1);
    uint32_t kept = 0, removed = 0;
    if (!is_hidden)
        return STATUS_TRY_AGAIN;
    for (uint32_t k = 0; k < model->object_count; k++) {
        const struct object object = model->objects[k];
        if (has_name(t, object.name)) {
            memset(&is_hidden[object.first_index / 3], 1, object.index_count / 3);
            removed += object.index_count;
            continue;
        }
        model->objects[kept] = object;
        model->objects[kept++].first_index -= removed;
    }
    const bool is_good = remove_triangles(&model->object, is_hidden);
    free(is_hidden);
    model->object_count = kept;
    if (!kept)
        model->object.vertex_count = 0;
    return is_good ? STATUS_OK : STATUS_TRY_AGAIN;
}

/* Removes the triangles of the surroundings objects with the name of `t`. */
static enum status hide_surroundings(struct model *model, const struct object_transform *t)
{
    struct mesh *mesh = &model->surroundings;
    uint8_t *is_inside = calloc(mesh->vertex_count + (size_t)1, 1); /* of each vertex */
    uint8_t *is_hidden = calloc(mesh->index_count / 3 + (size_t)1, 1);
    bool is_good = is_inside && is_hidden;
    for (uint32_t k = 0; k < model->surroundings_object_count && is_good; k++) {
        const uint32_t first = model->surroundings_starts[k];
        if (has_name(t, model->surroundings_names[k]))
            memset(&is_inside[first], 1, end_vertex(model, k) - first);
    }
    for (uint32_t i = 0; i < mesh->index_count && is_good; i += 3)
        is_hidden[i / 3] = is_inside[mesh->indices[i]];
    is_good = is_good && remove_triangles(mesh, is_hidden);
    free(is_inside);
    free(is_hidden);
    return is_good ? STATUS_OK : STATUS_TRY_AGAIN;
}

/* ---- all of a model ---- */

/* Returns true if a refractive object has the name of `t`. */
static bool is_refractive(const struct model *model, const struct object_transform *t)
{
    for (uint32_t k = 0; k < model->object_count; k++) {
        if (has_name(t, model->objects[k].name))
            return true;
    }
    return false;
}

static bool is_in_surroundings(const struct model *model, const struct object_transform *t)
{
    for (uint32_t k = 0; k < model->surroundings_object_count; k++) {
        if (has_name(t, model->surroundings_names[k]))
            return true;
    }
    return false;
}

static enum status apply(struct model *model, const struct object_transform *t, const char *path,
                         bool *is_found)
{
    const bool refractive = is_refractive(model, t), other = is_in_surroundings(model, t);
    enum status status = STATUS_OK;
    *is_found = refractive || other;
    if (refractive && t->is_hidden)
        status = hide_refractive(model, t);
    else if (refractive && moves(t))
        status = transform_refractive(model, t);
    if (other && status == STATUS_OK && t->is_hidden)
        status = hide_surroundings(model, t);
    else if (other && status == STATUS_OK && moves(t))
        status = transform_surroundings(model, t);
    if (status == STATUS_DATA)
        log_error("%s: --transform %s makes its coordinates larger than 1000000 metres", path,
                  t->name);
    return status == STATUS_TRY_AGAIN ? log_out_of_memory(t->is_hidden ? "--hide" : "--transform")
                                      : status;
}

enum status object_transform_apply(struct model *model, const struct object_transform *all,
                                   uint32_t count, const char *path, bool warns)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++) {
        bool is_found = false;
        status = apply(model, &all[i], path, &is_found);
        if (status == STATUS_OK && !is_found && warns)
            log_warning("%s: has no object '%s' to transform or hide (firn info lists its objects)",
                        path, all[i].name);
    }
    if (status == STATUS_OK && count && !model->object.index_count &&
        !model->surroundings.index_count) {
        log_error("%s: --hide leaves no triangle", path);
        return STATUS_DATA;
    }
    if (!model->surroundings.index_count)
        model->surroundings.vertex_count = 0;
    return status;
}
