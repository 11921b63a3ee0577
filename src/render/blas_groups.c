/* blas_groups.c: extracts per-object triangle lists from the BVH for acceleration structures. */
#include "src/render/blas_groups.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/bvh/bvh_node_encoding.h"
#include "src/scene/geometry/fit_similarity.h"

enum {
    GROUPS_MAX = 1 << 17,           /* per BVH root; else one group */
    INCLUSIONS_AT = BVH_INCLUSIONS, /* BVH root without a BLAS */
};

static const double barycentric_epsilon = 1e-6; /* tolerance of the test in trace_bvh.glsl */
static const double scene_fraction = 1e-5;

static double float_from_bits(uint32_t word)
{
    float x;
    memcpy(&x, &word, sizeof(x));
    return (double)x;
}

/* Affine map from world space to a triangle's barycentric coordinates and plane distance. */
struct affine_map {
    double rows[3][3], translation[3];
};

static struct affine_map read_map(const struct bvh *bvh, uint32_t triangle)
{
    struct affine_map map;
    for (int i = 0; i < 3; i++) {
        const uint32_t *row = bvh->triangles.all[(size_t)triangle * BVH_TRIANGLE_WORDS + (size_t)i];
        for (int k = 0; k < 3; k++)
            map.rows[i][k] = float_from_bits(row[k]);
        map.translation[i] = float_from_bits(row[3]);
    }
    return map;
}

static double sum_length(const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++)
        sum += (a[k] + b[k]) * (a[k] + b[k]);
    return sqrt(sum);
}

/* Computes a point in a triangle's plane. Vertices 2 and 3 have the barycentric weights u and v. */
static void compute_point(const struct affine_map *map, double u, double v, float to[static 3])
{
    const double offsets[3] = { u - map->translation[0], v - map->translation[1],
                                -map->translation[2] };
    double cofactors[3][3], volume = 0.0;
    for (int i = 0; i < 3; i++) {
        const double *a = map->rows[(i + 1) % 3], *b = map->rows[(i + 2) % 3];
        for (int k = 0; k < 3; k++)
            cofactors[i][k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    for (int k = 0; k < 3; k++)
        volume += map->rows[0][k] * cofactors[0][k];
    for (int k = 0; k < 3; k++) {
        double x = 0.0;
        for (int i = 0; i < 3; i++)
            x += offsets[i] * cofactors[i][k] / volume;
        to[k] = (float)x;
    }
}

/* Computes a triangle's vertices, with sides moved out by `margin`. Returns false for area 0. */
static bool compute_vertices(const struct affine_map *map, double margin, float to[static 3][3])
{
    static const double none[3] = { 0 };
    if (!(sum_length(map->rows[2], none) > 0.5))
        return false;
    const double a = barycentric_epsilon + margin * sum_length(map->rows[0], none);
    const double b = barycentric_epsilon + margin * sum_length(map->rows[1], none);
    const double c = barycentric_epsilon + margin * sum_length(map->rows[0], map->rows[1]);
    compute_point(map, -a, -b, to[0]);
    compute_point(map, 1.0 + b + c, -b, to[1]);
    compute_point(map, -a, 1.0 + a + c, to[2]);
    return true;
}

/* Writes the vertices of a group. If a triangle has no area, no ray can hit it. All its vertices
 * are then set to one vertex of another triangle. */
static void write_group(struct gpu_blas_groups *groups, const struct bvh *bvh,
                        const struct gpu_blas_group *group, double margin)
{
    float last[3] = { 0 };
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = group->first; i < group->first + group->count; i++) {
            const struct affine_map map = read_map(bvh, i);
            float(*to)[3] = groups->corners[i];
            const bool has_area = compute_vertices(&map, margin, to);
            for (int k = 0; k < 3 && !has_area; k++)
                memcpy(to[k], last, sizeof(last));
            memcpy(last, to[0], sizeof(last));
        }
    }
}

static const uint32_t *vertex_data(const struct bvh *bvh, uint32_t triangle, uint32_t k)
{
    return bvh->corners.all[(size_t)triangle * BVH_CORNER_WORDS + k];
}

/* Returns the object ID of a triangle, like trace_object_number() of trace_bvh.glsl. */
static uint32_t object_id_of(const struct bvh *bvh, uint32_t triangle)
{
    const uint32_t id = vertex_data(bvh, triangle, 0)[3] / BVH_OBJECT_NUMBER;
    const uint32_t surface = vertex_data(bvh, triangle, 2)[3];
    return id ? id : bvh->corners.all[(size_t)surface + 3][3] / 2;
}

/* Visits a child node: adds a leaf's triangles to `range`, or pushes an inner node on the stack. */
static void visit(uint32_t child, uint32_t range[static 2], uint32_t *stack, uint32_t *top)
{
    const uint32_t first = (child & ~BVH_LEAF) >> 3, count = child & 7;
    if (!(child & BVH_LEAF)) {
        stack[(*top)++] = child;
    } else if (count) {
        range[0] = first < range[0] ? first : range[0];
        range[1] = first + count > range[1] ? first + count : range[1];
    }
}

/* Finds the triangle indices below a BVH root, from range[0] to range[1] (exclusive). */
static void find_triangle_range(const struct bvh *bvh, uint32_t root, uint32_t range[static 2])
{
    uint32_t stack[BVH_DEPTH_MAX + 2], top = 0;
    range[0] = UINT32_MAX;
    range[1] = 0;
    if (bvh->roots[root] != BVH_NONE)
        stack[top++] = bvh->roots[root];
    while (top) {
        const uint32_t(*words)[4] =
            (const uint32_t(*)[4]) & bvh->nodes.all[(size_t)stack[--top] * BVH_NODE_WORDS];
        for (int i = 0; i < BVH_NODE_WORDS; i++)
            visit(words[i][3] & BVH_CHILD_MASK, range, stack, &top);
    }
}

/* Adds the groups of a BVH root. If `groups->all` is not allocated yet, only counts the groups. */
static uint32_t add_root_groups(struct gpu_blas_groups *groups, const struct bvh *bvh,
                                uint32_t root, bool by_objects)
{
    static const VkTransformMatrixKHR in_world = { {
        { 1, 0, 0, 0 },
        { 0, 1, 0, 0 },
        { 0, 0, 1, 0 },
    } };
    uint32_t range[2], count = 0;
    find_triangle_range(bvh, root, range);
    for (uint32_t i = range[0]; i < range[1]; i++) {
        const bool is_first =
            i == range[0] || (by_objects && object_id_of(bvh, i) != object_id_of(bvh, i - 1));
        if (is_first && groups->all)
            groups->all[groups->count + count] = (struct gpu_blas_group){
                .first = i, .mask = (uint8_t)(1u << root), .transform = in_world
            };
        count += is_first;
        if (groups->all)
            groups->all[groups->count + count - 1].count++;
    }
    return count;
}

static bool add_parts(struct gpu_blas_groups *groups, const struct bvh *bvh, bool by_objects)
{
    bool too_many[BVH_COUNT] = { false };
    uint32_t count = 0;
    for (uint32_t root = 0; root < INCLUSIONS_AT; root++) {
        const uint32_t own = add_root_groups(groups, bvh, root, by_objects);
        too_many[root] = own > GROUPS_MAX;
        count += too_many[root] ? 1 : own;
    }
    groups->all = calloc(count + (size_t)1, sizeof(*groups->all));
    for (uint32_t root = 0; root < INCLUSIONS_AT && groups->all; root++)
        groups->count += add_root_groups(groups, bvh, root, by_objects && !too_many[root]);
    return groups->all;
}

/* Returns the largest absolute coordinate of the BVH's boxes, rounded up to a power of two. */
static double extent_of(const struct bvh *bvh)
{
    double largest = 0.0;
    for (uint32_t root = 0; root < INCLUSIONS_AT; root++) {
        if (bvh->roots[root] == BVH_NONE)
            continue;
        const struct bvh_box box = bvh_nodes_extent(bvh, root);
        for (int k = 0; k < 3; k++)
            largest = fmax(largest, fmax(fabs((double)box.low[k]), fabs((double)box.high[k])));
    }
    int power;
    (void)frexp(largest, &power);
    return ldexp(1.0, power);
}

enum status blas_groups_init(struct gpu_blas_groups *groups, const struct bvh *bvh, bool by_objects)
{
    *groups = (struct gpu_blas_groups){
        .corners = calloc(bvh->triangle_count + (size_t)1, sizeof(*groups->corners)),
        .margin = (float)(scene_fraction * extent_of(bvh)),
    };
    if (!groups->corners || !add_parts(groups, bvh, by_objects)) {
        gpu_blas_groups_finish(groups);
        return log_out_of_memory("acceleration structures");
    }
    for (uint32_t i = 0; i < groups->count; i++)
        write_group(groups, bvh, &groups->all[i], (double)groups->margin);
    return STATUS_OK;
}

static const float *vertex_at(const void *context, uint32_t corner)
{
    const float *corners = context;
    return &corners[(size_t)corner * 3];
}

static struct similarity_transform_corners vertices_of(const struct gpu_blas_groups *groups,
                                                       uint32_t index)
{
    const struct gpu_blas_group *group = &groups->all[index];
    return (struct similarity_transform_corners){ groups->corners[group->first][0], vertex_at,
                                                  3 * group->count };
}

/* Returns true if a group has only moved rigidly or scaled uniformly since `built`. Vertices may
 * deviate by groups->margin / 2, because the rest of the margin is for rounding errors. */
static bool has_moved(const struct gpu_blas_groups *groups, const struct gpu_blas_groups *built,
                      uint32_t index, struct similarity_transform *motion)
{
    const struct similarity_transform_corners old = vertices_of(built, index);
    const struct similarity_transform_corners moved = vertices_of(groups, index);
    const struct similarity_transform_anchor anchor = similarity_transform_anchor_find(&old);
    if (!similarity_transform_find(motion, &anchor, &old, &moved))
        return false;
    for (uint32_t i = 0; i < moved.count; i++) {
        const double error = similarity_transform_error(motion, vertex_at(old.context, i),
                                                        vertex_at(moved.context, i));
        if (!(error <= 0.5 * (double)groups->margin))
            return false;
    }
    return true;
}

static bool same_sizes(const struct gpu_blas_groups *a, const struct gpu_blas_groups *b)
{
    bool same = a->count == b->count;
    for (uint32_t i = 0; same && i < a->count; i++)
        same = a->all[i].first == b->all[i].first && a->all[i].count == b->all[i].count &&
               a->all[i].mask == b->all[i].mask;
    return same;
}

bool blas_groups_keep(struct gpu_blas_groups *groups, const struct gpu_blas_groups *built)
{
    const bool same = same_sizes(groups, built);
    for (uint32_t i = 0; same && i < groups->count; i++) {
        struct gpu_blas_group *group = &groups->all[i];
        struct similarity_transform motion;
        if (!has_moved(groups, built, i, &motion))
            continue;
        group->is_kept = true;
        for (int k = 0; k < 12; k++)
            group->transform.matrix[k / 4][k % 4] = (float)motion.rows[k / 4][k % 4];
        memcpy(groups->corners[group->first], built->corners[group->first],
               group->count * sizeof(*groups->corners));
    }
    return same;
}
