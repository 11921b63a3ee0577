/* bvh_intersect.c: ray-BVH traversal on the CPU. */
#include <float.h>
#include <math.h>
#include <string.h>
#include "src/scene/bvh/bvh_node_encoding.h"

static double number(uint32_t word)
{
    float x;
    memcpy(&x, &word, sizeof(x));
    return (double)x;
}

static double dot_row(const uint32_t row[static 4], const float *xyz)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++)
        sum += number(row[k]) * (double)xyz[k];
    return sum;
}

static void intersect_triangle(const struct bvh *bvh, uint32_t triangle, const struct bvh_ray *ray,
                               struct bvh_hit *hit)
{
    const uint32_t(*rows)[4] =
        (const uint32_t(*)[4]) & bvh->triangles.all[(size_t)triangle * BVH_TRIANGLE_WORDS];
    const double dz = dot_row(rows[2], ray->dir.raw);
    const double t = -(dot_row(rows[2], ray->origin.raw) + number(rows[2][3])) / dz;
    const double u =
        dot_row(rows[0], ray->origin.raw) + t * dot_row(rows[0], ray->dir.raw) + number(rows[0][3]);
    const double v =
        dot_row(rows[1], ray->origin.raw) + t * dot_row(rows[1], ray->dir.raw) + number(rows[1][3]);
    const double edge = -1e-6;
    const bool is_beyond = t > ray->near || (t >= ray->near && triangle > ray->from);
    const bool is_nearer = t < hit->t || (t <= hit->t && triangle < hit->triangle);
    if (!is_beyond || !is_nearer)
        return;
    if (!(u >= edge && v >= edge && 1.0 - u - v >= edge))
        return;
    *hit = (struct bvh_hit){ t, u, v, triangle, 0, dz > 0.0 };
}

static bool intersects_box(const struct bvh_box *box, const struct bvh_ray *ray, double far)
{
    double enter = 0.0;
    for (int k = 0; k < 3; k++) {
        const double inverse = 1.0 / (double)ray->dir.raw[k];
        const double a = ((double)box->low[k] - (double)ray->origin.raw[k]) * inverse;
        const double b = ((double)box->high[k] - (double)ray->origin.raw[k]) * inverse;
        enter = fmax(enter, fmin(a, b));
        far = fmin(far, fmax(a, b));
    }
    return enter <= far;
}

bool bvh_intersect(const struct bvh *bvh, uint32_t part, const struct bvh_ray *ray,
                   struct bvh_hit *hit)
{
    uint32_t stack[BVH_DEPTH_MAX + 2];
    uint32_t count = 0;
    const uint32_t(*nodes)[4] = (const uint32_t(*)[4])bvh->nodes.all, (*grid)[4] = NULL;
    *hit = (struct bvh_hit){ .t = DBL_MAX, .triangle = BVH_NONE };
    if (bvh->triangle_count && bvh->roots[part] != BVH_NONE) {
        stack[count++] = bvh->roots[part];
        grid = &nodes[(size_t)(bvh->roots[part] - 1) * BVH_NODE_WORDS];
    }
    while (count) {
        const size_t word = (size_t)stack[--count] * BVH_NODE_WORDS;
        for (size_t w = word; w < word + BVH_NODE_WORDS; w++) {
            const struct bvh_box box = bvh_nodes_child_box(grid, nodes[w]);
            const uint32_t child = nodes[w][3] & BVH_CHILD_MASK;
            if (!intersects_box(&box, ray, hit->t))
                continue;
            if (!(child & BVH_LEAF)) {
                stack[count++] = child;
                continue;
            }
            const uint32_t first = (child & ~BVH_LEAF) >> 3;
            for (uint32_t i = first; i < first + (child & 7); i++)
                intersect_triangle(bvh, i, ray, hit);
        }
    }
    if (hit->triangle == BVH_NONE)
        return false;
    hit->rank = bvh->corners.all[(size_t)hit->triangle * BVH_CORNER_WORDS][3] % BVH_OBJECT_NUMBER;
    return true;
}
