/*
 * fuzz_bvh.c: decodes the input as the topology of a BVH of two groups, with a file's hash and
 * key. What is accepted has each triangle once, and ways and leaves that are no longer than
 * allowed.
 */
#include <stdbool.h>
#include "src/scene/bvh/bvh_topology_cache.h"
#include "tests/fuzz/fuzz.h"

enum {
    FIRST = 13,
    COUNT = 20,
    NODES = 2 * COUNT + 1,
    DEPTH = 7,
};

/* Returns how many triangles the leaves below have, from the node's first one on. */
static uint32_t walk(const struct bvh_two_level *shape, uint32_t at, bool *seen, uint32_t left)
{
    FUZZ_CHECK(left > 0 && at < NODES);
    const struct bvh_node *node = &shape->builder.nodes[at];
    uint32_t count = 0;
    for (int i = 0; i < 2 && node->children[0]; i++) {
        FUZZ_CHECK(shape->builder.nodes[node->children[i]].first == node->first + count);
        count += walk(shape, node->children[i], seen, left - 1);
    }
    FUZZ_CHECK(node->children[0] || node->count <= BVH_LEAF_MAX);
    for (uint32_t i = 0; i < node->count && !node->children[0]; i++, count++) {
        const uint32_t triangle = shape->builder.order[node->first + i];
        FUZZ_CHECK(triangle < COUNT && !seen[triangle]);
        seen[triangle] = true;
    }
    FUZZ_CHECK(count == node->count && count > 0);
    return count;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bvh_box boxes[COUNT] = { { { 0.0f }, { 0.0f } } };
    struct bvh_node nodes[NODES];
    uint32_t order[COUNT] = { 0 };
    struct bvh_range groups[] = { { 0, FIRST, 1 }, { FIRST, COUNT - FIRST, 2 * FIRST + 1 } };
    struct bvh_two_level shape = { .builder = { boxes, order, nodes, BVH_LEAF_MAX },
                                   .groups = groups,
                                   .count = COUNT,
                                   .group_count = 2,
                                   .node_count = NODES,
                                   .depth = DEPTH };
    bool seen[COUNT] = { false };
    uint32_t words[4 * COUNT] = { 0 };
    for (size_t i = 0; i < size && i < 4 * (size_t)COUNT; i++)
        words[i] = data[i] == UINT8_MAX ? UINT32_MAX : data[i];
    if (!bvh_cache_decode(&shape, words, size < 4 * (size_t)COUNT ? size : 4 * (size_t)COUNT))
        return 0;
    FUZZ_CHECK(walk(&shape, groups[0].root, seen, DEPTH) == FIRST);
    FUZZ_CHECK(walk(&shape, groups[1].root, seen, DEPTH) == COUNT - FIRST);
    return 0;
}
