/*
 * bvh_node_encoding.c: encodes BVH nodes for the GPU, with quantised child boxes and normal cones.
 * Child boxes are rounded outwards to a fixed-point grid of the scene part, which halves their size
 * in memory. Normal cones let rays from outside an object skip subtrees of back faces. Rays from
 * inside skip subtrees of front faces.
 */
#include "src/scene/bvh/bvh_node_encoding.h"
#include <math.h>
#include <string.h>

/* Margin on each side of a box, in grid steps. It covers rounding errors of the shader. */
static const double margin = 0.125;

static uint32_t bits(float x)
{
    uint32_t word;
    memcpy(&word, &x, sizeof(word));
    return word;
}

static float number(uint32_t word)
{
    float x;
    memcpy(&x, &word, sizeof(x));
    return x;
}

/* Cone of normals: a unit axis, and a half-angle in radians. An empty cone has a negative angle. */
struct cone {
    double axis[3], angle;
};

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double angle_of(const double *a, const double *b)
{
    return acos(fmax(-1.0, fmin(1.0, dot(a, b))));
}

/* Returns a cone that contains two cones. */
static struct cone merge_cones(const struct cone *a, const struct cone *b)
{
    struct cone cone = { .angle = 4.0 };
    if (a->angle < 0.0 || b->angle < 0.0)
        return a->angle < 0.0 ? *b : *a;
    for (int k = 0; k < 3; k++)
        cone.axis[k] = a->axis[k] + b->axis[k];
    const double length = sqrt(dot(cone.axis, cone.axis));
    if (!(length > 1e-3))
        return cone;
    for (int k = 0; k < 3; k++)
        cone.axis[k] /= length;
    cone.angle =
        fmax(a->angle + angle_of(cone.axis, a->axis), b->angle + angle_of(cone.axis, b->axis));
    return cone;
}

/* Returns a leaf's normal cone, from the barycentric maps of its non-degenerate triangles. */
static struct cone leaf_cone(const struct bvh *bvh, uint32_t first, uint32_t count)
{
    struct cone cone = { .angle = -1.0 };
    for (uint32_t i = first; i < first + count; i++) {
        const uint32_t *row = bvh->triangles.all[(size_t)i * BVH_TRIANGLE_WORDS + 2];
        struct cone one = { .angle = 0.0 };
        for (int k = 0; k < 3; k++)
            one.axis[k] = (double)number(row[k]);
        if (!(dot(one.axis, one.axis) > 0.5))
            continue;
        cone = merge_cones(&cone, &one);
    }
    return cone;
}

/* Quantised cone, as stored in the 32-bit word of a child. */
struct packed_cone {
    int axis[3];
    uint32_t sine;
};

/* Quantises a normal cone. The half-angle is enlarged by the rounding error of the axis. If
 * cos(angle of ray and axis) > sin(half-angle), the subtree is back-facing. */
static struct packed_cone pack(const struct cone *cone)
{
    struct packed_cone packed = { .sine = BVH_CONE_OPEN };
    double off = 0.0;
    if (!(cone->angle >= 0.0 && cone->angle < 1.4))
        return packed;
    for (int k = 0; k < 3; k++) {
        const double axis = BVH_CONE_AXIS * cone->axis[k];
        packed.axis[k] = (int)rint(axis);
        off += (axis - rint(axis)) * (axis - rint(axis));
    }
    const double sine = ceil(2.0 * (BVH_CONE_AXIS * (sin(cone->angle) + 0.01) + sqrt(off)));
    if (sine < BVH_CONE_OPEN)
        packed.sine = (uint32_t)sine;
    else
        packed = (struct packed_cone){ .sine = BVH_CONE_OPEN };
    return packed;
}

static float rounding_of(const struct bvh_box *box)
{
    float max = 0.0f;
    for (int k = 0; k < 3; k++)
        max = fmaxf(max, fmaxf(fabsf(box->low[k]), fabsf(box->high[k])));
    return 4e-7f * max;
}

/* Fixed-point grid of box planes. */
struct grid {
    float low[3], scale[3]; /* position of the lowest plane, and grid steps per metre */
    uint32_t plane_bits;
};

/* Returns a grid around a box, with one spare step on each side. */
static struct grid grid_around(const struct bvh_box *box, uint32_t plane_bits)
{
    const double steps = (double)((1u << plane_bits) - 1) - 2.0;
    struct grid grid = { .plane_bits = plane_bits };
    double largest = 1e-6;
    for (int k = 0; k < 3; k++)
        largest = fmax(largest, (double)box->high[k] - (double)box->low[k]);
    for (int k = 0; k < 3; k++) {
        const double size = fmax((double)box->high[k] - (double)box->low[k], 1e-6 * largest);
        grid.scale[k] = (float)(steps / size);
        grid.low[k] = (float)((double)box->low[k] - size / steps);
    }
    return grid;
}

static uint32_t plane_of(const struct grid *grid, int axis, float at, bool is_high)
{
    const double steps = ((double)at - (double)grid->low[axis]) * (double)grid->scale[axis];
    const double max = (double)((1u << grid->plane_bits) - 1);
    const double plane = is_high ? ceil(steps + margin) : floor(steps - margin);
    return (uint32_t)fmin(fmax(plane, 0.0), max);
}

struct bvh_box bvh_nodes_child_box(const uint32_t grid[static BVH_NODE_WORDS][4],
                                   const uint32_t child[static 4])
{
    const uint32_t plane_bits = grid[0][3], mask = (1u << plane_bits) - 1;
    struct bvh_box box;
    for (int k = 0; k < 3; k++) {
        const float low = number(grid[0][k]), step = 1.0f / number(grid[1][k]);
        box.low[k] = low + (float)(child[k] & mask) * step;
        box.high[k] = low + (float)(child[k] >> plane_bits & mask) * step;
    }
    return box;
}

struct bvh_box bvh_nodes_extent(const struct bvh *bvh, uint32_t part)
{
    const size_t word = (size_t)(bvh->roots[part] - 1) * BVH_NODE_WORDS;
    const uint32_t(*grid)[4] = (const uint32_t(*)[4]) & bvh->nodes.all[word];
    const uint32_t all = ((1u << grid[0][3]) - 1) << grid[0][3];
    return bvh_nodes_child_box(grid, (const uint32_t[4]){ all, all, all });
}

struct encoder {
    struct bvh *bvh;
    const struct bvh_two_level *hierarchy;
    struct grid grid;
    uint32_t first; /* BVH index of the part's first triangle */
    float rounding; /* enlargement of boxes for rounding errors */
    bool has_cones;
};

static uint32_t write_node(struct encoder *encoder, uint32_t at, uint32_t depth, struct cone *cone);

/* Encodes a child node, and extends the parent's normal cone `cone` to contain the child's cone. */
static void write_child(struct encoder *encoder, uint32_t word, uint32_t at, uint32_t depth,
                        struct cone *cone)
{
    struct bvh *bvh = encoder->bvh;
    const struct bvh_node *node = &encoder->hierarchy->builder.nodes[at];
    const uint32_t first = encoder->first + node->first;
    struct cone child_cone;
    uint32_t child;
    if (node->children[0]) {
        child = write_node(encoder, at, depth, &child_cone);
    } else {
        child = BVH_LEAF | first << 3 | node->count;
        child_cone = leaf_cone(bvh, first, node->count);
    }
    const struct packed_cone packed =
        encoder->has_cones ? pack(&child_cone) : (struct packed_cone){ .sine = BVH_CONE_OPEN };
    uint32_t *to = bvh->nodes.all[word];
    for (int k = 0; k < 3; k++) {
        to[k] = plane_of(&encoder->grid, k, node->box.low[k] - encoder->rounding, false);
        to[k] |= plane_of(&encoder->grid, k, node->box.high[k] + encoder->rounding, true)
                 << encoder->grid.plane_bits;
        if (encoder->has_cones)
            to[k] |= (uint32_t)packed.axis[k] << BVH_CONE_SHIFT;
    }
    to[3] = child | packed.sine << BVH_CONE_SINE_SHIFT;
    *cone = merge_cones(cone, &child_cone);
}

/* Encodes an inner node and its subtree, and returns the node's index and normal cone. */
static uint32_t write_node(struct encoder *encoder, uint32_t at, uint32_t depth, struct cone *cone)
{
    struct bvh *bvh = encoder->bvh;
    const uint32_t word = bvh->nodes.count;
    const struct bvh_node *node = &encoder->hierarchy->builder.nodes[at];
    bvh->nodes.count += BVH_NODE_WORDS;
    bvh->depth = depth > bvh->depth ? depth : bvh->depth;
    *cone = (struct cone){ .angle = -1.0 };
    write_child(encoder, word, node->children[0], depth + 1, cone);
    write_child(encoder, word + 1, node->children[1], depth + 1, cone);
    return word / BVH_NODE_WORDS;
}

static void write_grid(struct encoder *encoder)
{
    uint32_t(*to)[4] = &encoder->bvh->nodes.all[encoder->bvh->nodes.count];
    for (int k = 0; k < 3; k++) {
        to[0][k] = bits(encoder->grid.low[k]);
        to[1][k] = bits(encoder->grid.scale[k]);
    }
    to[0][3] = encoder->grid.plane_bits;
    encoder->bvh->nodes.count += BVH_NODE_WORDS;
}

static uint32_t count_inner(const struct bvh_builder *builder, uint32_t at)
{
    const uint32_t *children = builder->nodes[at].children;
    return children[0] ? 1 + count_inner(builder, children[0]) + count_inner(builder, children[1])
                       : 0;
}

uint32_t bvh_nodes_word_count(const struct bvh_two_level *hierarchy)
{
    const uint32_t inner = count_inner(&hierarchy->builder, hierarchy->root);
    return (1 + (inner ? inner : 1)) * BVH_NODE_WORDS;
}

/* A BVH that is a single leaf becomes an inner node with this leaf as both children. */
uint32_t bvh_nodes_write(struct bvh *bvh, const struct bvh_two_level *hierarchy, uint32_t first,
                         bool has_cones)
{
    const struct bvh_node *root = &hierarchy->builder.nodes[hierarchy->root];
    struct encoder encoder = { .bvh = bvh,
                               .hierarchy = hierarchy,
                               .first = first,
                               .rounding = rounding_of(&root->box),
                               .has_cones = has_cones };
    struct bvh_box box = root->box;
    struct cone cone = { .angle = -1.0 };
    for (int k = 0; k < 3; k++) {
        box.low[k] -= encoder.rounding;
        box.high[k] += encoder.rounding;
    }
    encoder.grid = grid_around(&box, has_cones ? BVH_CONE_SHIFT / 2 : BVH_PLANE_BITS);
    write_grid(&encoder);
    if (root->children[0])
        return write_node(&encoder, hierarchy->root, 1, &cone);
    const uint32_t word = bvh->nodes.count;
    bvh->nodes.count += BVH_NODE_WORDS;
    write_child(&encoder, word, hierarchy->root, 1, &cone);
    write_child(&encoder, word + 1, hierarchy->root, 1, &cone);
    return word / BVH_NODE_WORDS;
}
