/* point_in_mesh.c: point-in-mesh tests with a uniform grid of triangle columns. */
#include "src/scene/geometry/point_in_mesh.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

enum {
    SIDE_MAX = 256,
    ENTRIES_PER_TRIANGLE = 16, /* maximum mean number of columns that a triangle overlaps */
};

/* Range of columns along one axis. */
struct span {
    uint32_t from, to;
};

static uint32_t column_of(const struct closed_mesh *s, float at, int axis)
{
    float width = s->box.max.raw[axis] - s->box.min.raw[axis];
    float column = (at - s->box.min.raw[axis]) / width * (float)s->side;
    if (!(column > 0.0F))
        return 0;
    return column < (float)s->side ? (uint32_t)column : s->side - 1;
}

static struct span span_of(const struct closed_mesh *s, struct box box, int axis)
{
    return (struct span){ column_of(s, box.min.raw[axis], axis),
                          column_of(s, box.max.raw[axis], axis) };
}

static struct box triangle_box(const struct mesh *mesh, uint32_t index)
{
    const uint32_t *corners = &mesh->indices[index];
    struct box box = { mesh->vertices[corners[0]].position, mesh->vertices[corners[0]].position };
    for (int k = 1; k < 3; k++) {
        box.min = glms_vec3_minv(box.min, mesh->vertices[corners[k]].position);
        box.max = glms_vec3_maxv(box.max, mesh->vertices[corners[k]].position);
    }
    return box;
}

/* Returns the bounding box of a mesh's triangles. Other objects may use most of the vertices. */
static struct box triangles_box(const struct mesh *mesh)
{
    struct box box = { 0 };
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const vec3s p = mesh->vertices[mesh->indices[i]].position;
        box.min = i ? glms_vec3_minv(box.min, p) : p;
        box.max = i ? glms_vec3_maxv(box.max, p) : p;
    }
    return box;
}

/* Counts the triangles that overlap each grid column. If s->triangles is allocated, stores the
 * triangles' indices instead. Each column is filled from its end. */
static void enter_triangles(struct closed_mesh *s)
{
    for (uint32_t i = 0; i + 2 < s->mesh->index_count; i += 3) {
        struct box box = triangle_box(s->mesh, i);
        struct span x = span_of(s, box, 0);
        struct span z = span_of(s, box, 2);
        for (uint32_t row = z.from; row <= z.to; row++) {
            for (uint32_t column = x.from; column <= x.to; column++) {
                uint32_t *first = &s->first[row * s->side + column];
                if (s->triangles)
                    s->triangles[--*first] = i;
                else
                    ++*first;
            }
        }
    }
}

/* Returns the number of entries that enter_triangles() makes. */
static uint64_t count_entries(const struct closed_mesh *s)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i + 2 < s->mesh->index_count; i += 3) {
        const struct box box = triangle_box(s->mesh, i);
        const struct span x = span_of(s, box, 0), z = span_of(s, box, 2);
        count += (uint64_t)(x.to - x.from + 1) * (z.to - z.from + 1);
    }
    return count;
}

/* Chooses the number of columns per side: the square root of the number of triangles, or less if
 * large triangles overlap many columns, so that the grid's size is linear in that number. */
static void choose_side(struct closed_mesh *s)
{
    const uint32_t triangle_count = s->mesh->index_count / 3;
    const float side = sqrtf((float)triangle_count);
    s->side = side < 1.0F ? 1 : side < (float)SIDE_MAX ? (uint32_t)side : SIDE_MAX;
    while (s->side > 1 && count_entries(s) > (uint64_t)ENTRIES_PER_TRIANGLE * triangle_count)
        s->side /= 2;
}

bool closed_mesh_init(struct closed_mesh *closed_mesh, const struct mesh *mesh)
{
    *closed_mesh = (struct closed_mesh){ .mesh = mesh, .box = triangles_box(mesh) };
    choose_side(closed_mesh);
    size_t columns = (size_t)closed_mesh->side * closed_mesh->side;
    closed_mesh->first = calloc(columns + 1, sizeof(*closed_mesh->first));
    if (!closed_mesh->first)
        goto fail;
    enter_triangles(closed_mesh);
    for (size_t i = 1; i <= columns; i++)
        closed_mesh->first[i] += closed_mesh->first[i - 1];
    closed_mesh->triangles =
        calloc((size_t)closed_mesh->first[columns] + 1, sizeof(*closed_mesh->triangles));
    if (!closed_mesh->triangles)
        goto fail;
    enter_triangles(closed_mesh);
    return true;

fail:
    closed_mesh_finish(closed_mesh);
    return false;
}

void closed_mesh_finish(struct closed_mesh *closed_mesh)
{
    free(closed_mesh->first);
    free(closed_mesh->triangles);
    *closed_mesh = (struct closed_mesh){ 0 };
}

/* Returns twice the signed area of the triangle a, b, p in the xz plane, but never 0. Swapping a
 * and b exactly negates the area, because a vertical line through an edge must hit exactly one of
 * the two triangles at the edge. */
static double side_of(vec3s a, vec3s b, vec3s p)
{
    bool is_swapped = a.x > b.x || (a.x >= b.x && a.z > b.z);
    vec3s from = is_swapped ? b : a;
    vec3s to = is_swapped ? a : b;
    double area = ((double)to.x - (double)from.x) * ((double)p.z - (double)from.z) -
                  ((double)to.z - (double)from.z) * ((double)p.x - (double)from.x);
    area = area == 0.0 ? 0x1p-500 : area;
    return is_swapped ? -area : area;
}

/* Returns 1 if a triangle is above a point, -1 if it is below, 0 if it is neither. */
static int side_of_point(const struct mesh *mesh, uint32_t index, vec3s p)
{
    vec3s v[3];
    double w[3];
    double sum = 0.0;
    double y = 0.0;
    for (uint32_t k = 0; k < 3; k++)
        v[k] = mesh->vertices[mesh->indices[index + k]].position;
    for (int k = 0; k < 3; k++) {
        w[k] = side_of(v[(k + 1) % 3], v[(k + 2) % 3], p);
        if (w[k] * w[0] < 0.0)
            return 0;
        sum += w[k];
    }
    for (int k = 0; k < 3; k++)
        y += w[k] / sum * (double)v[k].y;
    return y > (double)p.y ? 1 : -1;
}

/* Counts the triangles below (counts[0]) and above (counts[1]) a point. */
static void count_sides(const struct closed_mesh *s, vec3s point, uint32_t counts[static 2])
{
    counts[0] = counts[1] = 0;
    for (int axis = 0; axis < 3; axis++) {
        if (!(point.raw[axis] >= s->box.min.raw[axis] && point.raw[axis] <= s->box.max.raw[axis]))
            return;
    }
    uint32_t at = column_of(s, point.z, 2) * s->side + column_of(s, point.x, 0);
    for (uint32_t i = s->first[at]; i < s->first[at + 1]; i++) {
        const int side = side_of_point(s->mesh, s->triangles[i], point);
        if (side)
            counts[side > 0]++;
    }
}

uint32_t closed_mesh_cost(const struct closed_mesh *s, vec3s point)
{
    const uint32_t at = column_of(s, point.z, 2) * s->side + column_of(s, point.x, 0);
    return 1 + s->first[at + 1] - s->first[at];
}

bool closed_mesh_contains(const struct closed_mesh *s, vec3s point)
{
    uint32_t counts[2];
    count_sides(s, point, counts);
    return counts[1] % 2;
}

bool closed_mesh_surrounds(const struct closed_mesh *s, vec3s point)
{
    uint32_t counts[2];
    count_sides(s, point, counts);
    return counts[0] && counts[1];
}
