/* tree_nodes.c: lays out the nodes of trees, with bounds of boxes in steps and cones of normals. */
#include "src/scene/tree_nodes.h"
#include <math.h>
#include <string.h>

/* In steps, by how much boxes are larger than their bounds: places are computed with rounding. */
static const double rounding = 0.02;

/* Of the largest coordinate: rounding of the planes of triangles. */
static const float rounding_of_planes = 4e-7f;

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

/* Writes the bits of a cone. A ray that meets the near side of a triangle is at most a right angle
 * and the cone's from its axis; rounding turns the axis. */
static void put_cone(uint32_t to[static 4], const struct cone *cone)
{
    double axis[3], square = 0.0;
    uint32_t sine = TREE_CONE_OPEN;
    for (int k = 0; k < 3; k++) {
        axis[k] = rint(cone->axis[k] * TREE_CONE_AXIS);
        square += axis[k] * axis[k];
    }
    const double length = sqrt(square);
    if (cone->angle >= 0.0 && cone->angle < 1.4 && length > 0.0) {
        const double turn = acos(fmin(dot(axis, cone->axis) / length, 1.0));
        const double angle = fmin(cone->angle + turn + 1e-3, 1.57);
        for (int k = 0; k < 3; k++)
            to[k] |= (uint32_t)(int)axis[k] << (2 * TREE_STEP_BITS);
        sine = (uint32_t)fmin(ceil(length * sin(angle) / TREE_CONE_STEP), TREE_CONE_OPEN);
    }
    to[3] |= sine << TREE_CONE_SHIFT;
}

/* ---- nodes ---- */

/* A tree while it is laid out. */
struct layout {
    struct tree *tree;
    const struct tree_shape *shape;
    uint32_t first;        /* triangle of the tree for the part's first one */
    uint32_t step_bits;    /* of a bound */
    float room;            /* by which boxes are enlarged */
    float low[3], step[3]; /* the place of the bound 0, and the size of a step */
    bool has_cones;
};

static uint32_t lay_node(struct layout *layout, uint32_t at, uint32_t depth, struct cone *cone);

static uint32_t bounds_of(const struct layout *layout, const struct tree_box *box, int k)
{
    const double scale = 1.0 / (double)layout->step[k], most = ldexp(1.0, (int)layout->step_bits);
    const double low = (double)box->low[k] - (double)layout->room - (double)layout->low[k];
    const double high = (double)box->high[k] + (double)layout->room - (double)layout->low[k];
    return (uint32_t)fmax(floor(low * scale - rounding), 0.0) |
           (uint32_t)fmin(ceil(high * scale + rounding), most - 1.0) << layout->step_bits;
}

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
    uint32_t *to = tree->nodes.all[word];
    for (int k = 0; k < 3; k++)
        to[k] = bounds_of(layout, &node->box, k);
    to[3] = child;
    if (layout->has_cones)
        put_cone(to, &own);
    else
        to[3] |= TREE_CONE_OPEN << TREE_CONE_SHIFT;
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

/* Writes the two words before a root. The outermost steps hold no box, whatever is rounded. */
static void lay_steps(struct layout *layout)
{
    const struct tree_box *box = &layout->shape->draft.nodes[layout->shape->root].box;
    uint32_t(*to)[4] = &layout->tree->nodes.all[layout->tree->nodes.count];
    float most = 0.0f;
    for (int k = 0; k < 3; k++)
        most = fmaxf(most, fmaxf(fabsf(box->low[k]), fabsf(box->high[k])));
    layout->room = rounding_of_planes * most;
    layout->step_bits = layout->has_cones ? TREE_STEP_BITS : TREE_STEP_BITS_MOST;
    for (int k = 0; k < 3; k++) {
        const float extent = fmaxf(box->high[k] - box->low[k], 1e-30f) + 4.0f * layout->room;
        layout->step[k] = extent / (ldexpf(1.0f, (int)layout->step_bits) - 8.0f);
        layout->low[k] = box->low[k] - 2.0f * layout->room - 2.0f * layout->step[k];
        memcpy(&to[0][k], &layout->low[k], sizeof(to[0][k]));
        memcpy(&to[1][k], &layout->step[k], sizeof(to[1][k]));
    }
    to[0][3] = layout->step_bits;
    layout->tree->nodes.count += TREE_NODE_WORDS;
}

/* A single leaf gets a node of which it is both children. */
uint32_t tree_nodes_lay(struct tree *tree, const struct tree_shape *shape, uint32_t first,
                        bool has_cones)
{
    struct layout layout = { .tree = tree, .shape = shape, .first = first, .has_cones = has_cones };
    struct cone cone = { .angle = -1.0 };
    lay_steps(&layout);
    if (shape->draft.nodes[shape->root].children[0])
        return lay_node(&layout, shape->root, 1, &cone);
    const uint32_t word = tree->nodes.count;
    tree->nodes.count += TREE_NODE_WORDS;
    for (uint32_t i = 0; i < TREE_NODE_WORDS; i++)
        lay_child(&layout, word + i, shape->root, 1, &cone);
    return word / TREE_NODE_WORDS;
}

static uint32_t count_inner(const struct tree_draft *draft, uint32_t at)
{
    const uint32_t *children = draft->nodes[at].children;
    return children[0] ? 1 + count_inner(draft, children[0]) + count_inner(draft, children[1]) : 0;
}

uint32_t tree_nodes_count(const struct tree_shape *shape)
{
    const uint32_t inner = count_inner(&shape->draft, shape->root);
    return ((inner > 0 ? inner : 1) + 1) * TREE_NODE_WORDS;
}
