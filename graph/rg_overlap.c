/*
 * rg_overlap.c: who used a resource's memory before it.
 *
 * A segment tree over the offsets of a block where something begins or ends. What was put on a
 * range of offsets is found again by every range that overlaps it, in O(log R) a range.
 */
#include <stdlib.h>
#include "graph/rg_internal.h"

/* `all` lies on every byte of the node's range, `any` on some. */
struct node {
    struct former all, any;
};

struct tree {
    VkDeviceSize *offsets; /* rising; leaf i is offsets[i] .. offsets[i + 1] */
    uint32_t leaf_count;
    struct node *nodes; /* node n has the children 2n + 1 and 2n + 2 */
};

static void merge(struct former *into, const struct former *from)
{
    into->stages |= from->stages;
    into->writes |= from->writes;
    if (into->end < from->end)
        into->end = from->end;
}

struct range {
    uint32_t begin, end; /* leaves */
};

static void put(struct tree *tree, uint32_t n, struct range node, struct range range,
                const struct former *value)
{
    if (range.end <= node.begin || node.end <= range.begin)
        return;
    merge(&tree->nodes[n].any, value);
    if (range.begin <= node.begin && node.end <= range.end) {
        merge(&tree->nodes[n].all, value);
        return;
    }
    uint32_t middle = node.begin + (node.end - node.begin) / 2;
    put(tree, 2 * n + 1, (struct range){ node.begin, middle }, range, value);
    put(tree, 2 * n + 2, (struct range){ middle, node.end }, range, value);
}

static void get(const struct tree *tree, uint32_t n, struct range node, struct range range,
                struct former *found)
{
    if (range.end <= node.begin || node.end <= range.begin)
        return;
    if (range.begin <= node.begin && node.end <= range.end) {
        merge(found, &tree->nodes[n].any);
        return;
    }
    merge(found, &tree->nodes[n].all);
    uint32_t middle = node.begin + (node.end - node.begin) / 2;
    get(tree, 2 * n + 1, (struct range){ node.begin, middle }, range, found);
    get(tree, 2 * n + 2, (struct range){ middle, node.end }, range, found);
}

static int compare_offsets(const void *a, const void *b)
{
    const VkDeviceSize *x = a;
    const VkDeviceSize *y = b;
    return *x < *y ? -1 : *x > *y;
}

static uint32_t leaf_at(const struct tree *tree, VkDeviceSize offset)
{
    const VkDeviceSize *found =
        bsearch(&offset, tree->offsets, tree->leaf_count + 1, sizeof(offset), compare_offsets);
    return (uint32_t)(found - tree->offsets);
}

static struct range range_of(const struct tree *tree, const struct pack_item *item)
{
    return (struct range){ leaf_at(tree, item->offset), leaf_at(tree, item->offset + item->size) };
}

static bool make_tree(struct tree *tree, struct arena *scratch, const struct pack_item *items,
                      uint32_t count)
{
    tree->offsets = ARENA_ARRAY(scratch, VkDeviceSize, (size_t)count * 2);
    tree->nodes = ARENA_ARRAY(scratch, struct node, (size_t)count * 8 + 4);
    if (!tree->offsets || !tree->nodes)
        return false;
    for (size_t i = 0; i < count; i++) {
        tree->offsets[2 * i] = items[i].offset;
        tree->offsets[2 * i + 1] = items[i].offset + items[i].size;
    }
    qsort(tree->offsets, (size_t)count * 2, sizeof(VkDeviceSize), compare_offsets);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count * 2; i++) {
        if (i == 0 || tree->offsets[i] != tree->offsets[kept - 1])
            tree->offsets[kept++] = tree->offsets[i];
    }
    tree->leaf_count = kept - 1;
    return true;
}

void rg_overlap(struct arena *scratch, const struct pack_item *items, uint32_t count)
{
    struct tree tree;
    if (!make_tree(&tree, scratch, items, count))
        return;
    const struct range all = { 0, tree.leaf_count };
    for (uint32_t i = 0; i < count; i++) { /* in the order of first use */
        struct resource *r = items[i].resource;
        const struct former now = { r->tail_stages, r->tail_writes, r->last + 1 };
        const struct range range = range_of(&tree, &items[i]);
        struct former found = { 0 };
        get(&tree, 0, all, range, &found);
        r->former.end = found.end;
        put(&tree, 0, all, range, &now);
    }
    for (uint32_t i = 0; i < count; i++) { /* in the frame before, everybody came before */
        struct former found = { 0 };
        get(&tree, 0, all, range_of(&tree, &items[i]), &found);
        items[i].resource->former.stages = found.stages;
        items[i].resource->former.writes = found.writes;
    }
}
