/* box_tree.c: bounding volume hierarchy of boxes. */
#include "src/scene/geometry/box_tree.h"
#include <stdlib.h>
#include <string.h>

enum {
    STACK_MAX = BVH_DEPTH_MAX + 2, /* maximum number of pending nodes */
};

/* Moves the boxes to leaf order, so that visits read them one after another. Returns false when out
 * of memory. */
static bool sort_boxes(struct box_tree *tree)
{
    struct bvh_box *sorted = malloc((tree->count + (size_t)1) * sizeof(*sorted));
    if (!sorted)
        return false;
    for (uint32_t i = 0; i < tree->count; i++)
        sorted[i] = tree->bvh.boxes[tree->bvh.order[i]];
    free(tree->bvh.boxes);
    tree->bvh.boxes = sorted;
    return true;
}

bool box_tree_init(struct box_tree *tree, const struct box *boxes, uint32_t count)
{
    *tree = (struct box_tree){
        .count = count,
        .bvh = {
            .boxes = malloc((count + (size_t)1) * sizeof(*tree->bvh.boxes)),
            .order = malloc((count + (size_t)1) * sizeof(*tree->bvh.order)),
            .nodes = malloc((2 * (size_t)count + 1) * sizeof(*tree->bvh.nodes)),
            .leaf_max = BVH_LEAF_MAX,
        },
    };
    if (!tree->bvh.boxes || !tree->bvh.order || !tree->bvh.nodes) {
        box_tree_finish(tree);
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        memcpy(tree->bvh.boxes[i].low, boxes[i].min.raw, sizeof(tree->bvh.boxes[i].low));
        memcpy(tree->bvh.boxes[i].high, boxes[i].max.raw, sizeof(tree->bvh.boxes[i].high));
        tree->bvh.order[i] = i;
    }
    if (count > 0)
        bvh_build(&tree->bvh, &(struct bvh_range){ 0, count, 0 }, BVH_DEPTH_MAX, 1);
    if (sort_boxes(tree))
        return true;
    box_tree_finish(tree);
    return false;
}

void box_tree_finish(struct box_tree *tree)
{
    free(tree->bvh.boxes);
    free(tree->bvh.order);
    free(tree->bvh.nodes);
    *tree = (struct box_tree){ 0 };
}

static bool overlaps(const struct bvh_box *a, const struct box *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low[k] > b->max.raw[k] || a->high[k] < b->min.raw[k])
            return false;
    }
    return true;
}

void box_tree_visit(const struct box_tree *tree, const struct box *box, void *user,
                    bool (*visit)(void *user, uint32_t index))
{
    uint32_t stack[STACK_MAX], depth = 0;
    if (tree->count > 0)
        stack[depth++] = 0;
    while (depth > 0) {
        const struct bvh_node *node = &tree->bvh.nodes[stack[--depth]];
        if (!overlaps(&node->box, box))
            continue;
        if (node->children[0]) {
            stack[depth++] = node->children[1];
            stack[depth++] = node->children[0];
            continue;
        }
        for (uint32_t i = node->first; i < node->first + node->count; i++) {
            if (overlaps(&tree->bvh.boxes[i], box) && !visit(user, tree->bvh.order[i]))
                return;
        }
    }
}
