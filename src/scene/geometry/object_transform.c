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

/* Transforms the vertices of a mesh whose bytes in `is_part` are not 0. Returns false if a
 * coordinate is too large. */
static bool transform_vertices(struct mesh *mesh, const uint8_t *is_part,
                               const struct object_transform *t)
{
    const mat4s rotation = rotation_of(t);
    const float scale = scale_of(t);
    vec3s low = { { INFINITY, INFINITY, INFINITY } };
    vec3s high = { { -INFINITY, -INFINITY, -INFINITY } };
    bool is_in_range = true;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (is_part[i]) {
            low = glms_vec3_minv(low, mesh->vertices[i].position);
            high = glms_vec3_maxv(high, mesh->vertices[i].position);
        }
    }
    const vec3s center = glms_vec3_scale(glms_vec3_add(low, high), 0.5f);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct mesh_vertex *v = &mesh->vertices[i];
        if (!is_part[i])
            continue;
        const vec3s p = glms_vec3_scale(glms_vec3_sub(v->position, center), scale);
        v->position =
            glms_vec3_add(glms_mat4_mulv3(rotation, p, 0.0f), glms_vec3_add(center, t->move));
        v->normal = glms_mat4_mulv3(rotation, v->normal, 0.0f);
        if (mesh->extras)
            mesh->extras[i].tangent = glms_mat4_mulv3(rotation, mesh->extras[i].tangent, 0.0f);
        is_in_range = is_in_range && glms_vec3_max(glms_vec3_abs(v->position)) <= coordinate_max;
    }
    return is_in_range;
}

/* ---- triangles of an object ---- */

/* Part of a mesh: one object's triangles. */
struct part {
    struct mesh *mesh;
    uint32_t first_index, index_count;   /* range of refractive objects */
    uint32_t first_vertex, vertex_count; /* range of surroundings objects */
    bool is_refractive;
};

static struct part refractive_part(struct model *model, uint32_t i)
{
    return (struct part){ .mesh = &model->object,
                          .first_index = model->objects[i].first_index,
                          .index_count = model->objects[i].index_count,
                          .is_refractive = true };
}

static struct part surroundings_part(struct model *model, uint32_t i)
{
    const uint32_t first = model->surroundings_starts[i];
    const uint32_t end = i + 1 < model->surroundings_object_count
                             ? model->surroundings_starts[i + 1]
                             : model->surroundings.vertex_count;
    return (struct part){ .mesh = &model->surroundings,
                          .first_vertex = first,
                          .vertex_count = end - first };
}

/* Returns true if the triangle that begins at `index` belongs to the part. */
static bool has_triangle(const struct part *part, uint32_t index)
{
    return part->is_refractive
               ? index >= part->first_index && index - part->first_index < part->index_count
               : part->mesh->indices[index] >= part->first_vertex &&
                     part->mesh->indices[index] - part->first_vertex < part->vertex_count;
}

/* Appends a copy of each vertex v with to[v] > 0; to[v] is the index of the copy. Returns false
 * when out of memory. */
static bool append_copies(struct mesh *mesh, const uint32_t *to, uint32_t count)
{
    const uint32_t first = mesh->vertex_count;
    struct mesh copy;
    bool is_good = mesh_init(&copy, count, 0) && (!mesh->extras || mesh_add_extras(&copy));
    for (uint32_t v = 0; v < first && is_good; v++) {
        if (!to[v])
            continue;
        copy.vertices[to[v] - first] = mesh->vertices[v];
        if (mesh->extras)
            copy.extras[to[v] - first] = mesh->extras[v];
    }
    is_good = is_good && mesh_append(mesh, &copy);
    mesh_finish(&copy);
    return is_good;
}

/* Makes a part use copies of the vertices that other triangles use, too. `is_part` marks the part's
 * vertices. Returns false when out of memory. */
static bool unshare(const struct part *part, const uint8_t *is_part)
{
    struct mesh *mesh = part->mesh;
    uint32_t *to = calloc(mesh->vertex_count, sizeof(*to));
    uint32_t count = 0;
    for (uint32_t i = 0; to && i < mesh->index_count; i++) {
        const uint32_t v = mesh->indices[i];
        if (is_part[v] && !to[v] && !has_triangle(part, i - i % 3))
            to[v] = mesh->vertex_count + count++;
    }
    const bool is_good = to && (!count || append_copies(mesh, to, count));
    for (uint32_t i = 0; is_good && count && i < part->index_count; i++) {
        uint32_t *index = &mesh->indices[part->first_index + i];
        *index = to[*index] ? to[*index] : *index;
    }
    free(to);
    return is_good;
}

/* Returns a byte for each vertex of a part's mesh, 1 for those of the part; NULL when out of
 * memory. The caller frees it. */
static uint8_t *mark(const struct part *part)
{
    const struct mesh *mesh = part->mesh;
    uint8_t *is_part = calloc(mesh->vertex_count + (size_t)1, 1);
    for (uint32_t i = 0; is_part && i < mesh->index_count; i++)
        is_part[mesh->indices[i]] |= has_triangle(part, i - i % 3);
    return is_part;
}

static enum status transform_part(const struct part *part, const struct object_transform *t,
                                  const char *path)
{
    uint8_t *is_part = mark(part);
    const bool is_good = is_part && (!part->is_refractive || unshare(part, is_part));
    free(is_part);
    is_part = is_good ? mark(part) : NULL;
    enum status status = is_part ? STATUS_OK : log_out_of_memory("--transform");
    if (status == STATUS_OK && !transform_vertices(part->mesh, is_part, t)) {
        log_error("%s: --transform %s makes its coordinates larger than 1000000 metres", path,
                  t->name);
        status = STATUS_DATA;
    }
    free(is_part);
    return status;
}

/* ---- hidden objects ---- */

/* Removes the triangles of a part. Its vertices stay, so that ranges of vertices stay valid, but
 * take the position of a remaining one, because bounding boxes count them. Returns false when out
 * of memory. */
static bool remove_triangles(const struct part *part)
{
    struct mesh *mesh = part->mesh;
    uint32_t kept = 0;
    uint8_t *is_used = calloc(mesh->vertex_count + (size_t)1, 1);
    if (!is_used)
        return false;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        if (has_triangle(part, i))
            continue;
        for (uint32_t k = 0; k < 3; k++) {
            is_used[mesh->indices[i + k]] = 1;
            mesh->indices[kept++] = mesh->indices[i + k];
        }
    }
    mesh->index_count = kept;
    for (uint32_t v = 0; v < mesh->vertex_count && kept; v++) {
        if (!is_used[v])
            mesh->vertices[v].position = mesh->vertices[mesh->indices[0]].position;
    }
    free(is_used);
    return true;
}

/* Removes refractive object `i` and its triangles. */
static bool remove_object(struct model *model, uint32_t i)
{
    const struct part part = refractive_part(model, i);
    if (!remove_triangles(&part))
        return false;
    for (uint32_t k = i + 1; k < model->object_count; k++) {
        model->objects[k].first_index -= part.index_count;
        model->objects[k - 1] = model->objects[k];
    }
    model->object_count--;
    if (!model->object_count)
        model->object.vertex_count = 0;
    return true;
}

/* ---- all of a model ---- */

/* Applies a transform to a part. Sets *removes if a refractive object is to be removed instead. */
static enum status apply_to(const struct part *part, const struct object_transform *t,
                            const char *path, bool *removes)
{
    *removes = t->is_hidden && part->is_refractive;
    if (*removes)
        return STATUS_OK;
    if (t->is_hidden)
        return remove_triangles(part) ? STATUS_OK : log_out_of_memory("--hide");
    return moves(t) ? transform_part(part, t, path) : STATUS_OK;
}

static enum status apply(struct model *model, const struct object_transform *t, const char *path,
                         bool *is_found)
{
    enum status status = STATUS_OK;
    bool removes;
    for (uint32_t i = model->object_count; i-- && status == STATUS_OK;) {
        const struct part part = refractive_part(model, i);
        if (strcmp(model->objects[i].name, t->name) != 0)
            continue;
        *is_found = true;
        status = apply_to(&part, t, path, &removes);
        if (removes && !remove_object(model, i))
            status = log_out_of_memory("--hide");
    }
    for (uint32_t i = 0; i < model->surroundings_object_count && status == STATUS_OK; i++) {
        const struct part part = surroundings_part(model, i);
        if (strcmp(model->surroundings_names[i], t->name) != 0)
            continue;
        *is_found = true;
        status = apply_to(&part, t, path, &removes);
    }
    return status;
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
