/* tree_nodes.c: lays out the nodes of trees, whose boxes are rounded to a grid. */
#include "src/scene/tree_nodes.h"
#include <math.h>
#include <string.h>

/* Steps of a grid by which boxes are enlarged: rays are computed with rounding. */
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

/* ---- cones ---- */

/* The directions of normals: a unit mean, and the widest angle to it, radians. */
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

/* Returns a cone around both. */
static struct cone joined(const struct cone *a, const struct cone *b)
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

/* Returns the cone of a leaf's triangles, from their maps; one without an area has none. */
static struct cone cone_of(const struct tree *tree, uint32_t first, uint32_t count)
{
    struct cone cone = { .angle = -1.0 };
    for (uint32_t i = first; i < first + count; i++) {
        const uint32_t *row = tree->triangles.all[(size_t)i * TREE_TRIANGLE_WORDS + 2];
        struct cone one = { .angle = 0.0 };
        for (int k = 0; k < 3; k++)
            one.axis[k] = (double)number(row[k]);
        if (!(dot(one.axis, one.axis) > 0.5))
            continue;
        cone = joined(&cone, &one);
    }
    return cone;
}

/* The numbers of a cone in a child's words. */
struct packed_cone {
    int axis[3];
    uint32_t sine;
};

/* Light that meets only the far side of all triangles has a cosine with the axis of more than the
 * sine of the angle. That is enlarged by what is rounded of the axis. */
static struct packed_cone pack(const struct cone *cone)
{
    struct packed_cone packed = { .sine = TREE_CONE_OPEN };
    double off = 0.0;
    if (!(cone->angle >= 0.0 && cone->angle < 1.4))
        return packed;
    for (int k = 0; k < 3; k++) {
        const double axis = TREE_CONE_AXIS * cone->axis[k];
        packed.axis[k] = (int)rint(axis);
        off += (axis - rint(axis)) * (axis - rint(axis));
    }
    const double sine = ceil(2.0 * (TREE_CONE_AXIS * (sin(cone->angle) + 0.01) + sqrt(off)));
    if (sine < TREE_CONE_OPEN)
        packed.sine = (uint32_t)sine;
    else
        packed = (struct packed_cone){ .sine = TREE_CONE_OPEN };
    return packed;
}

/* ---- grids ---- */

static float room_of(const struct tree_box *box)
{
    float most = 0.0f;
    for (int k = 0; k < 3; k++)
        most = fmaxf(most, fmaxf(fabsf(box->low[k]), fabsf(box->high[k])));
    return 4e-7f * most;
}

/* Where the planes of boxes are numbers. */
struct grid {
    float low[3], scale[3]; /* where 0 is; steps a metre */
    uint32_t plane_bits;
};

/* Makes a grid around a box, with a step to spare on each side. */
static struct grid grid_around(const struct tree_box *box, uint32_t plane_bits)
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
    const double most = (double)((1u << grid->plane_bits) - 1);
    const double plane = is_high ? ceil(steps + margin) : floor(steps - margin);
    return (uint32_t)fmin(fmax(plane, 0.0), most);
}

struct tree_box tree_nodes_box(const uint32_t grid[static TREE_NODE_WORDS][4],
                               const uint32_t child[static 4])
{
    const uint32_t plane_bits = grid[0][3], mask = (1u << plane_bits) - 1;
    struct tree_box box;
    for (int k = 0; k < 3; k++) {
        const float low = number(grid[0][k]), step = 1.0f / number(grid[1][k]);
        box.low[k] = low + (float)(child[k] & mask) * step;
        box.high[k] = low + (float)(child[k] >> plane_bits & mask) * step;
    }
    return box;
}

struct tree_box tree_nodes_extent(const struct tree *tree, uint32_t part)
{
    const size_t word = (size_t)(tree->roots[part] - 1) * TREE_NODE_WORDS;
    const uint32_t(*grid)[4] = (const uint32_t(*)[4]) & tree->nodes.all[word];
    const uint32_t all = ((1u << grid[0][3]) - 1) << grid[0][3];
    return tree_nodes_box(grid, (const uint32_t[4]){ all, all, all });
}

/* ---- nodes ---- */

/* A tree while it is laid out. */
struct layout {
    struct tree *tree;
    const struct tree_shape *shape;
    struct grid grid;
    uint32_t first; /* triangle of the tree for the part's first one */
    float room;     /* by which boxes are enlarged: their planes are computed with rounding */
    bool has_cones;
};

static uint32_t lay_node(struct layout *layout, uint32_t at, uint32_t depth, struct cone *cone);

/* Writes a child's word, and widens the cone of its parent. */
static void lay_child(struct layout *layout, uint32_t word, uint32_t at, uint32_t depth,
                      struct cone *cone)
{
    struct tree *tree = layout->tree;
    const struct tree_node *node = &layout->shape->draft.nodes[at];
    const uint32_t first = layout->first + node->first;
    struct cone own;
    uint32_t child;
    if (node->children[0]) {
        child = lay_node(layout, at, depth, &own);
    } else {
        child = TREE_LEAF | first << 3 | node->count;
        own = cone_of(tree, first, node->count);
    }
    const struct packed_cone packed =
        layout->has_cones ? pack(&own) : (struct packed_cone){ .sine = TREE_CONE_OPEN };
    uint32_t *to = tree->nodes.all[word];
    for (int k = 0; k < 3; k++) {
        to[k] = plane_of(&layout->grid, k, node->box.low[k] - layout->room, false);
        to[k] |= plane_of(&layout->grid, k, node->box.high[k] + layout->room, true)
                 << layout->grid.plane_bits;
        if (layout->has_cones)
            to[k] |= (uint32_t)packed.axis[k] << TREE_CONE_SHIFT;
    }
    to[3] = child | packed.sine << TREE_SINE_SHIFT;
    *cone = joined(cone, &own);
}

/* Lays out a node that is no leaf, and what is below; returns its index. */
static uint32_t lay_node(struct layout *layout, uint32_t at, uint32_t depth, struct cone *cone)
{
    struct tree *tree = layout->tree;
    const uint32_t word = tree->nodes.count;
    const struct tree_node *node = &layout->shape->draft.nodes[at];
    tree->nodes.count += TREE_NODE_WORDS;
    tree->depth = depth > tree->depth ? depth : tree->depth;
    *cone = (struct cone){ .angle = -1.0 };
    lay_child(layout, word, node->children[0], depth + 1, cone);
    lay_child(layout, word + 1, node->children[1], depth + 1, cone);
    return word / TREE_NODE_WORDS;
}

static void lay_grid(struct layout *layout)
{
    uint32_t(*to)[4] = &layout->tree->nodes.all[layout->tree->nodes.count];
    for (int k = 0; k < 3; k++) {
        to[0][k] = bits(layout->grid.low[k]);
        to[1][k] = bits(layout->grid.scale[k]);
    }
    to[0][3] = layout->grid.plane_bits;
    layout->tree->nodes.count += TREE_NODE_WORDS;
}

static uint32_t count_inner(const struct tree_draft *draft, uint32_t at)
{
    const uint32_t *children = draft->nodes[at].children;
    return children[0] ? 1 + count_inner(draft, children[0]) + count_inner(draft, children[1]) : 0;
}

uint32_t tree_nodes_count(const struct tree_shape *shape)
{
    const uint32_t inner = count_inner(&shape->draft, shape->root);
    return (1 + (inner ? inner : 1)) * TREE_NODE_WORDS;
}

/* A single leaf gets a node that has it twice. */
uint32_t tree_nodes_lay(struct tree *tree, const struct tree_shape *shape, uint32_t first,
                        bool has_cones)
{
    const struct tree_node *root = &shape->draft.nodes[shape->root];
    struct layout layout = { .tree = tree,
                             .shape = shape,
                             .first = first,
                             .room = room_of(&root->box),
                             .has_cones = has_cones };
    struct tree_box box = root->box;
    struct cone cone = { .angle = -1.0 };
    for (int k = 0; k < 3; k++) {
        box.low[k] -= layout.room;
        box.high[k] += layout.room;
    }
    layout.grid = grid_around(&box, has_cones ? TREE_CONE_SHIFT / 2 : TREE_PLANE_BITS);
    lay_grid(&layout);
    if (root->children[0])
        return lay_node(&layout, shape->root, 1, &cone);
    const uint32_t word = tree->nodes.count;
    tree->nodes.count += TREE_NODE_WORDS;
    lay_child(&layout, word, shape->root, 1, &cone);
    lay_child(&layout, word + 1, shape->root, 1, &cone);
    return word / TREE_NODE_WORDS;
}
