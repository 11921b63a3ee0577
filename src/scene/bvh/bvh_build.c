/*
 * bvh_build.c: multithreaded BVH build with the binned surface area heuristic.
 *
 * Each node is split between two of BVH_BIN_COUNT bins along an axis, where the sum of area times
 * triangle count is lowest; it stays a leaf if no split is cheaper. The subtree of n triangles has
 * 2 n - 1 reserved node slots, so that threads need no lock and do not affect the result.
 */
#include "src/scene/bvh/bvh_build.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include "src/base/parallel.h"

enum {
    PARALLEL_MIN = 1 << 13, /* minimum triangle count of a subtree built by its own thread */
};

static struct bvh_box empty_box(void)
{
    return (struct bvh_box){ { FLT_MAX, FLT_MAX, FLT_MAX }, { -FLT_MAX, -FLT_MAX, -FLT_MAX } };
}

static void extend_box(struct bvh_box *a, const struct bvh_box *b)
{
    for (int k = 0; k < 3; k++) {
        a->low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
        a->high[k] = a->high[k] > b->high[k] ? a->high[k] : b->high[k];
    }
}

/* Returns half the surface area of a box; 0 for an empty box. */
static float half_area(const struct bvh_box *b)
{
    const float x = b->high[0] - b->low[0], y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
    return x < 0.0f ? 0.0f : x * y + y * z + z * x;
}

static float centroid(const struct bvh_box *b, int axis)
{
    return 0.5f * b->low[axis] + 0.5f * b->high[axis];
}

struct bin {
    struct bvh_box box;
    uint32_t count;
};

/* Triangles binned by centroid along each axis. */
struct bins {
    float low[3], scale[3]; /* lowest centroid, and number of bins per metre, for each axis */
    struct bin all[3][BVH_BIN_COUNT];
};

struct split {
    float cost;
    int axis; /* split axis; negative if there is no split */
    uint32_t bin;
};

static uint32_t bin_of(const struct bins *bins, const struct bvh_box *box, int axis)
{
    const uint32_t bin = (uint32_t)((centroid(box, axis) - bins->low[axis]) * bins->scale[axis]);
    return bin < BVH_BIN_COUNT ? bin : BVH_BIN_COUNT - 1;
}

static void fill_bins(struct bins *bins, const struct bvh_builder *builder,
                      const struct bvh_node *node)
{
    struct bvh_box middles = empty_box();
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const struct bvh_box *box = &builder->boxes[builder->order[i]];
        const struct bvh_box at = { { centroid(box, 0), centroid(box, 1), centroid(box, 2) },
                                    { centroid(box, 0), centroid(box, 1), centroid(box, 2) } };
        extend_box(&middles, &at);
    }
    for (int axis = 0; axis < 3; axis++) {
        const float extent = middles.high[axis] - middles.low[axis];
        bins->low[axis] = middles.low[axis];
        bins->scale[axis] = extent > FLT_MIN * BVH_BIN_COUNT ? (float)BVH_BIN_COUNT / extent : 0.0f;
        for (int i = 0; i < BVH_BIN_COUNT; i++)
            bins->all[axis][i] = (struct bin){ empty_box(), 0 };
    }
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const struct bvh_box *box = &builder->boxes[builder->order[i]];
        for (int axis = 0; axis < 3; axis++) {
            struct bin *bin = &bins->all[axis][bin_of(bins, box, axis)];
            extend_box(&bin->box, box);
            bin->count++;
        }
    }
}

/* Replaces *best with the cheapest split along an axis if that split is cheaper. */
static void find_split(struct split *best, const struct bins *bins, int axis)
{
    const struct bin *bin = bins->all[axis];
    float right[BVH_BIN_COUNT];
    struct bvh_box box = empty_box();
    uint32_t count = 0;
    for (uint32_t i = BVH_BIN_COUNT - 1; i > 0; i--) {
        extend_box(&box, &bin[i].box);
        count += bin[i].count;
        right[i] = count ? half_area(&box) * (float)count : FLT_MAX;
    }
    box = empty_box();
    count = 0;
    for (uint32_t i = 1; i < BVH_BIN_COUNT; i++) {
        extend_box(&box, &bin[i - 1].box);
        count += bin[i - 1].count;
        const float cost = half_area(&box) * (float)count + right[i];
        if (count && cost < best->cost)
            *best = (struct split){ cost, axis, i };
    }
}

/* Partitions a node's triangles at a split. Returns the number on the left side. */
static uint32_t partition(struct bvh_builder *builder, const struct bvh_node *node,
                          const struct bins *bins, const struct split *split)
{
    uint32_t i = node->first, end = node->first + node->count;
    while (i < end) {
        const uint32_t triangle = builder->order[i];
        if (bin_of(bins, &builder->boxes[triangle], split->axis) < split->bin) {
            i++;
        } else {
            builder->order[i] = builder->order[--end];
            builder->order[end] = triangle;
        }
    }
    return i - node->first;
}

uint32_t bvh_balanced_depth(uint32_t count, uint32_t leaf_max)
{
    uint32_t needed = 0;
    while (count > leaf_max) {
        count = (count + 1) / 2;
        needed++;
    }
    return needed;
}

/* Returns true if even the most unbalanced split of `count` triangles fits the remaining depth. */
static bool fits_depth(const struct bvh_builder *builder, uint32_t count, uint32_t depth_left)
{
    return bvh_balanced_depth(count, builder->leaf_max) + 1 < depth_left;
}

/* Splits a node's triangles. Returns the triangle count of the first child, or 0 for a leaf. */
static uint32_t split_node(struct bvh_builder *builder, const struct bvh_node *node,
                           uint32_t depth_left)
{
    struct bins bins;
    const bool may_end = node->count <= builder->leaf_max;
    const float area = half_area(&node->box);
    struct split split = { may_end ? ((float)node->count - BVH_NODE_COST) * area : FLT_MAX, -1, 0 };
    if (node->count < 2)
        return 0;
    if (fits_depth(builder, node->count, depth_left)) {
        fill_bins(&bins, builder, node);
        for (int axis = 0; axis < 3; axis++) {
            if (bins.scale[axis] > 0.0f)
                find_split(&split, &bins, axis);
        }
    }
    if (split.axis < 0)
        return may_end ? 0 : node->count / 2;
    return partition(builder, node, &bins, &split);
}

struct subtree {
    struct bvh_builder *builder;
    uint32_t at, first, count;
    uint32_t depth_left; /* remaining depth, nodes */
    uint32_t forks;      /* remaining levels that may fork threads */
};

/* Builds subtree `i` of an array. */
static void build_subtree(void *user, uint32_t i)
{
    const struct subtree *subtree = (const struct subtree *)user + i;
    struct bvh_builder *builder = subtree->builder;
    struct bvh_node *node = &builder->nodes[subtree->at];
    *node = (struct bvh_node){ empty_box(), subtree->first, subtree->count, { 0, 0 } };
    for (uint32_t k = node->first; k < node->first + node->count; k++)
        extend_box(&node->box, &builder->boxes[builder->order[k]]);
    const uint32_t count = split_node(builder, node, subtree->depth_left);
    if (!count)
        return;
    const uint32_t rest = node->count - count;
    const uint32_t forks = subtree->forks ? subtree->forks - 1 : 0;
    node->children[0] = subtree->at + 1;
    node->children[1] = subtree->at + 2 * count;
    struct subtree halves[2] = {
        { builder, node->children[0], node->first, count, subtree->depth_left - 1, forks },
        { builder, node->children[1], node->first + count, rest, subtree->depth_left - 1, forks },
    };
    const bool is_parallel = subtree->forks && count >= PARALLEL_MIN && rest >= PARALLEL_MIN;
    (void)parallel_for(2, is_parallel ? 2 : 1, build_subtree, halves, NULL, NULL);
}

void bvh_build(struct bvh_builder *builder, const struct bvh_range *range, uint32_t depth_left,
               uint32_t threads)
{
    /* number of tree levels at which new threads may start, large enough to balance the load */
    const uint32_t forks = threads < 2 ? 0 : threads < 4 ? 3 : 5;
    struct subtree all = { builder, range->root, range->first, range->count, depth_left, forks };
    build_subtree(&all, 0);
}

void bvh_refit(struct bvh_builder *builder, uint32_t at)
{
    struct bvh_node *node = &builder->nodes[at];
    node->box = empty_box();
    for (uint32_t i = 0; !node->children[0] && i < node->count; i++)
        extend_box(&node->box, &builder->boxes[builder->order[node->first + i]]);
    for (uint32_t i = 0; node->children[0] && i < 2; i++) {
        bvh_refit(builder, node->children[i]);
        extend_box(&node->box, &builder->nodes[node->children[i]].box);
    }
}

static double sum_cost(const struct bvh_builder *builder, uint32_t at)
{
    const struct bvh_node *node = &builder->nodes[at];
    const double area = (double)half_area(&node->box);
    if (!node->children[0])
        return area * (double)node->count;
    return area * (double)BVH_NODE_COST + sum_cost(builder, node->children[0]) +
           sum_cost(builder, node->children[1]);
}

double bvh_sah_cost(const struct bvh_builder *builder, uint32_t at)
{
    const double area = (double)half_area(&builder->nodes[at].box);
    return area > 0.0 ? sum_cost(builder, at) / area : 0.0;
}
