/* mesh.c: storage, bounding boxes, normals and sorting of indexed triangle meshes. */
#include "src/scene/geometry/mesh.h"

#include <assert.h>
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool mesh_init(struct mesh *mesh, uint32_t vertex_count, uint32_t index_count)
{
    *mesh = (struct mesh){ 0 };
    if (vertex_count > 0) {
        mesh->vertices = calloc(vertex_count, sizeof(*mesh->vertices));
        if (mesh->vertices == NULL)
            goto fail;
        mesh->vertex_count = vertex_count;
    }
    if (index_count > 0) {
        mesh->indices = calloc(index_count, sizeof(*mesh->indices));
        if (mesh->indices == NULL)
            goto fail;
        mesh->index_count = index_count;
    }
    return true;

fail:
    mesh_finish(mesh);
    return false;
}

bool mesh_add_extras(struct mesh *mesh)
{
    if (!mesh->extras && mesh->vertex_count > 0)
        mesh->extras = calloc(mesh->vertex_count, sizeof(*mesh->extras));
    return mesh->extras || mesh->vertex_count == 0;
}

void mesh_finish(struct mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->extras);
    free(mesh->indices);
    *mesh = (struct mesh){ 0 };
}

/* Returns `array` reallocated for `count` more elements; NULL on overflow or when out of memory. */
static void *grow_array(void *array, uint32_t count_before, uint32_t count, size_t size)
{
    if (count > UINT32_MAX - count_before || count_before + count > SIZE_MAX / size)
        return NULL;
    return realloc(array, (count_before + count) * size);
}

/* Appends the extras of `other` to those of `mesh`. Missing extras count as zeros. */
static bool grow_extras(struct mesh *mesh, const struct mesh *other)
{
    if (!mesh->extras && !other->extras)
        return true;
    void *extras =
        grow_array(mesh->extras, mesh->vertex_count, other->vertex_count, sizeof(*mesh->extras));
    if (extras == NULL)
        return false;
    if (!mesh->extras)
        memset(extras, 0, mesh->vertex_count * sizeof(*mesh->extras));
    mesh->extras = extras;
    for (uint32_t i = 0; i < other->vertex_count; i++)
        mesh->extras[mesh->vertex_count + i] =
            other->extras ? other->extras[i] : (struct mesh_extra){ 0 };
    return true;
}

bool mesh_append(struct mesh *mesh, const struct mesh *other)
{
    assert(mesh != other);
    if (other->vertex_count > 0 && !grow_extras(mesh, other))
        return false;
    if (other->vertex_count > 0) {
        void *vertices = grow_array(mesh->vertices, mesh->vertex_count, other->vertex_count,
                                    sizeof(*mesh->vertices));
        if (vertices == NULL)
            return false;
        mesh->vertices = vertices;
    }
    if (other->index_count > 0) {
        void *indices = grow_array(mesh->indices, mesh->index_count, other->index_count,
                                   sizeof(*mesh->indices));
        if (indices == NULL)
            return false;
        mesh->indices = indices;
    }
    for (uint32_t i = 0; i < other->vertex_count; i++)
        mesh->vertices[mesh->vertex_count + i] = other->vertices[i];
    for (uint32_t i = 0; i < other->index_count; i++)
        mesh->indices[mesh->index_count + i] = mesh->vertex_count + other->indices[i];
    mesh->vertex_count += other->vertex_count;
    mesh->index_count += other->index_count;
    return true;
}

struct box mesh_box(const struct mesh *mesh)
{
    if (mesh->vertex_count == 0)
        return (struct box){ 0 };
    struct box box = { mesh->vertices[0].position, mesh->vertices[0].position };
    for (uint32_t i = 1; i < mesh->vertex_count; i++) {
        box.min = glms_vec3_minv(box.min, mesh->vertices[i].position);
        box.max = glms_vec3_maxv(box.max, mesh->vertices[i].position);
    }
    return box;
}

bool box_contains(const struct box *outer, const struct box *inner)
{
    for (int k = 0; k < 3; k++) {
        if (inner->min.raw[k] < outer->min.raw[k] || inner->max.raw[k] > outer->max.raw[k])
            return false;
    }
    return true;
}

vec3s box_center(struct box box)
{
    /* halves first, because the sum could overflow */
    return glms_vec3_add(glms_vec3_scale(box.min, 0.5F), glms_vec3_scale(box.max, 0.5F));
}

float box_diagonal(struct box box)
{
    return glms_vec3_distance(box.min, box.max);
}

void mesh_fit(struct mesh *mesh, float width)
{
    struct box box = mesh_box(mesh);
    vec3s center = box_center(box);
    float scale = width / (box.max.x - box.min.x);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        vec3s *position = &mesh->vertices[i].position;
        *position = glms_vec3_scale(glms_vec3_sub(*position, center), scale);
    }
}

/* Returns the normalised vector, or a zero vector if it has no direction. */
static vec3s unit(vec3s v)
{
    /* squares of floats neither underflow nor overflow in double */
    double x = (double)v.x, y = (double)v.y, z = (double)v.z;
    double length = sqrt(x * x + y * y + z * z);
    if (!(length > 0) || !isfinite(length))
        return (vec3s){ 0 };
    return (vec3s){ { (float)(x / length), (float)(y / length), (float)(z / length) } };
}

static void add_triangle_normals(struct mesh_vertex *vertices, const uint32_t *corners)
{
    vec3s side_dir[3]; /* direction from each corner to the next */
    for (int k = 0; k < 3; k++)
        side_dir[k] = unit(
            glms_vec3_sub(vertices[corners[(k + 1) % 3]].position, vertices[corners[k]].position));
    for (int k = 0; k < 3; k++) {
        vec3s next_dir = side_dir[k];
        vec3s last_dir = glms_vec3_negate(side_dir[(k + 2) % 3]);
        vec3s normal = unit(glms_vec3_cross(next_dir, last_dir));
        float angle = acosf(glm_clamp(glms_vec3_dot(next_dir, last_dir), -1, 1));
        vec3s *sum = &vertices[corners[k]].normal;
        *sum = glms_vec3_muladds(normal, angle, *sum);
    }
}

void mesh_make_normals(struct mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].normal = (vec3s){ 0 };
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3)
        add_triangle_normals(mesh->vertices, mesh->indices + i);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        vec3s normal = unit(mesh->vertices[i].normal);
        bool is_undefined = glms_vec3_norm2(normal) == 0;
        mesh->vertices[i].normal = is_undefined ? (vec3s){ { 0, 1, 0 } } : normal;
    }
}

/* Returns a triangle's area vector: the outward normal times twice the area. */
static vec3s area_of(const struct mesh *mesh, const uint32_t *corners)
{
    const vec3s a = mesh->vertices[corners[0]].position;
    return glms_vec3_cross(glms_vec3_sub(mesh->vertices[corners[1]].position, a),
                           glms_vec3_sub(mesh->vertices[corners[2]].position, a));
}

/* Returns true if no vertex is over `tolerance` in front of a plane with a normal of any length. */
static bool is_behind(const struct mesh *mesh, vec3s point, vec3s normal, float tolerance)
{
    const float most = glms_vec3_dot(normal, point) + tolerance * glms_vec3_norm(normal);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (glms_vec3_dot(normal, mesh->vertices[i].position) > most)
            return false;
    }
    return true;
}

bool mesh_is_convex(const struct mesh *mesh)
{
    const float tolerance = 1e-5f * box_diagonal(mesh_box(mesh));
    vec3s sum = { 0 }; /* sum of the triangles' area vectors, which is 0 for a closed surface */
    float all = 0.0f;
    if ((uint64_t)mesh->index_count / 3 * mesh->vertex_count > MESH_CONVEX_MAX)
        return false;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const vec3s area = area_of(mesh, mesh->indices + i);
        if (!is_behind(mesh, mesh->vertices[mesh->indices[i]].position, area, tolerance))
            return false;
        sum = glms_vec3_add(sum, area);
        all += glms_vec3_norm(area);
    }
    return all > 0.0f && glms_vec3_norm(sum) < 1e-4f * all;
}

enum {
    SHELL_COUNT = 1 << 9
};

/* Returns the index of the spherical shell around `from` that contains a triangle's nearest corner.
 * The distance doubles every four shells. */
static uint32_t shell_of(const struct mesh *mesh, const uint32_t *corners, vec3s from)
{
    float nearest = INFINITY;
    uint32_t bits;
    for (int k = 0; k < 3; k++)
        nearest = fminf(nearest, glms_vec3_distance2(mesh->vertices[corners[k]].position, from));
    memcpy(&bits, &nearest, sizeof(bits));
    return bits >> 22 & (SHELL_COUNT - 1);
}

bool mesh_sort_by_distance(struct mesh *mesh, vec3s from, struct mesh_order *order)
{
    uint32_t next[SHELL_COUNT + 1] = { 0 }; /* index of the next triangle in each shell */
    if (order)
        *order = (struct mesh_order){ 0 };
    if (mesh->index_count == 0)
        return true;
    uint32_t *sorted = malloc(mesh->index_count * sizeof(*sorted));
    uint32_t *original = order && sorted ? malloc(mesh->index_count / 3 * sizeof(*original)) : NULL;
    if (!sorted || (order && !original)) {
        free(sorted);
        return false;
    }
    if (order)
        *order = (struct mesh_order){ original, mesh->index_count / 3 };
    for (uint32_t i = 0; i < mesh->index_count; i += 3)
        next[shell_of(mesh, mesh->indices + i, from) + 1] += 3;
    for (uint32_t shell = 0; shell < SHELL_COUNT; shell++)
        next[shell + 1] += next[shell];
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        uint32_t *to = &next[shell_of(mesh, mesh->indices + i, from)];
        memcpy(sorted + *to, mesh->indices + i, 3 * sizeof(*sorted));
        if (original)
            original[*to / 3] = i / 3;
        *to += 3;
    }
    free(mesh->indices);
    mesh->indices = sorted;
    return true;
}
