/* polygon_triangulate.c: triangulation by ear clipping (Meisters 1975, Polygons have ears). The
 * work per polygon is limited, because ear clipping takes O(n^2) time or more. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/import/obj_ply.h"

enum {
    /* maximum number of point-in-ear tests per polygon; any remaining corners form a fan */
    TESTS_MAX = 1 << 26,
};

/* Remaining corners of a polygon and their projections to a plane, counter-clockwise. */
struct outline {
    uint32_t *corners;
    double (*points)[2];
    uint32_t count, tests;
};

static vec3s position_of(const struct polygon *polygon, uint32_t corner)
{
    const size_t vertex =
        polygon->vertex_of ? polygon->vertex_of[(size_t)corner * polygon->vertex_stride] : corner;
    const float *p = &polygon->positions[3 * vertex];
    return (vec3s){ { p[0], p[1], p[2] } };
}

static uint32_t corner_at(const uint32_t *fan, uint32_t i)
{
    return i < 2 ? fan[i] : fan[3 * (i - 2) + 2];
}

/* Projects the corners onto the axis plane most nearly parallel to the polygon (Newell's normal).
 */
static void project(const struct polygon *polygon, struct outline *outline)
{
    double normal[3] = { 0 };
    for (uint32_t i = 0; i < outline->count; i++) {
        const vec3s a = position_of(polygon, outline->corners[i]);
        const vec3s b = position_of(polygon, outline->corners[(i + 1) % outline->count]);
        for (int k = 0; k < 3; k++) {
            const int y = (k + 1) % 3, z = (k + 2) % 3;
            normal[k] +=
                ((double)a.raw[y] - (double)b.raw[y]) * ((double)a.raw[z] + (double)b.raw[z]);
        }
    }
    int dropped_axis = 0;
    for (int k = 1; k < 3; k++)
        dropped_axis = fabs(normal[k]) > fabs(normal[dropped_axis]) ? k : dropped_axis;
    const double sign = normal[dropped_axis] < 0 ? -1 : 1;
    for (uint32_t i = 0; i < outline->count; i++) {
        const vec3s p = position_of(polygon, outline->corners[i]);
        outline->points[i][0] = sign * (double)p.raw[(dropped_axis + 1) % 3];
        outline->points[i][1] = (double)p.raw[(dropped_axis + 2) % 3];
    }
}

/* Returns twice the signed area of a triangle; negative if it is clockwise. */
static double signed_area(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double corner_area(const struct outline *o, uint32_t i)
{
    return signed_area(o->points[(i + o->count - 1) % o->count], o->points[i],
                       o->points[(i + 1) % o->count]);
}

static bool is_convex(const struct outline *o)
{
    for (uint32_t i = 0; i < o->count; i++) {
        if (corner_area(o, i) < 0)
            return false;
    }
    return true;
}

static bool is_ear(struct outline *o, uint32_t i)
{
    const uint32_t previous = (i + o->count - 1) % o->count, next = (i + 1) % o->count;
    const double *a = o->points[previous], *b = o->points[i], *c = o->points[next];
    o->tests += o->count;
    if (!(signed_area(a, b, c) > 0))
        return false;
    for (uint32_t k = 0; k < o->count; k++) {
        const double *p = o->points[k];
        if (k == i || k == previous || k == next || (p[0] == a[0] && p[1] == a[1]) ||
            (p[0] == b[0] && p[1] == b[1]) || (p[0] == c[0] && p[1] == c[1]))
            continue;
        if (signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 && signed_area(c, a, p) >= 0)
            return false;
    }
    return true;
}

static void cut_ear(struct outline *o, uint32_t i, uint32_t *triangle)
{
    triangle[0] = o->corners[(i + o->count - 1) % o->count];
    triangle[1] = o->corners[i];
    triangle[2] = o->corners[(i + 1) % o->count];
    o->count--;
    for (uint32_t k = i; k < o->count; k++) {
        o->corners[k] = o->corners[k + 1];
        o->points[k][0] = o->points[k + 1][0];
        o->points[k][1] = o->points[k + 1][1];
    }
}

static void cut_ears(struct outline *o, uint32_t *indices)
{
    uint32_t start = 0;
    while (o->count > 3 && o->tests < TESTS_MAX) {
        uint32_t ear = start;
        for (uint32_t tried = 0; tried < o->count && !is_ear(o, ear); tried++)
            ear = ear + 1 < o->count ? ear + 1 : 0;
        /* A non-planar or self-intersecting polygon may have no ear; then any corner is cut. */
        cut_ear(o, ear, indices);
        indices += 3;
        start = ear < o->count ? ear : 0;
    }
    for (uint32_t i = 1; i + 1 < o->count; i++, indices += 3) {
        indices[0] = o->corners[0];
        indices[1] = o->corners[i];
        indices[2] = o->corners[i + 1];
    }
}

/* Triangulates a polygon of outline->count corners, whose triangle fan is in `indices`. */
static void triangulate(const struct polygon *polygon, struct outline *outline, uint32_t *indices)
{
    outline->tests = 0;
    for (uint32_t i = 0; i < outline->count; i++)
        outline->corners[i] = corner_at(indices, i);
    project(polygon, outline);
    if (!is_convex(outline))
        cut_ears(outline, indices);
}

bool polygon_triangulate_all(const struct polygon *polygon, const struct polygon_range *polygons,
                             size_t count, uint32_t *indices)
{
    uint32_t longest = 0;
    for (size_t i = 0; i < count; i++)
        longest = polygons[i].count > longest ? polygons[i].count : longest;
    struct outline outline = {
        .corners = malloc((longest + (size_t)1) * sizeof(*outline.corners)),
        .points = malloc((longest + (size_t)1) * sizeof(*outline.points)),
    };
    const bool is_done = outline.corners && outline.points;
    for (size_t i = 0; i < count && is_done; i++) {
        outline.count = polygons[i].count;
        triangulate(polygon, &outline, &indices[polygons[i].first_index]);
    }
    free(outline.corners);
    free(outline.points);
    return is_done;
}
