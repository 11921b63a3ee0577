/* tree_cache.c: writes the shapes of trees as words, and reads what may be any words. */
#include "src/scene/tree_cache.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/cache.h"

/* Raised when other words are written, or trees are built in another way than by other numbers. */
#define FORMAT 1

enum {
    KEY_WORDS = sizeof(uint64_t) / sizeof(uint32_t), /* of a file, before the others */
    NAME_SIZE = 32,
};

/* ---- the key ---- */

static void add(uint64_t *key, uint32_t word)
{
    *key = (*key ^ word) * 0xff51afd7ed558ccdu;
    *key ^= *key >> 29;
}

static void add_number(uint64_t *key, float x)
{
    uint32_t word;
    memcpy(&word, &x, sizeof(word));
    add(key, word);
}

uint64_t tree_cache_key(const struct tree_part *part)
{
    uint64_t key = 0x9e3779b97f4a7c15u;
    add(&key, FORMAT);
    add(&key, TREE_LEAF_MAX);
    add(&key, TREE_BIN_COUNT);
    add_number(&key, TREE_NODE_COST);
    add(&key, TREE_DEPTH_MAX);
    add(&key, part->count);
    for (uint32_t i = 0; i <= part->group_count; i++)
        add(&key, part->firsts[i]);
    for (uint32_t i = 0; i < part->count; i++) {
        for (uint32_t k = 0; k < 9; k++)
            add_number(&key, tree_corner(part, part->triangles[i], k / 3)->position.raw[k % 3]);
    }
    return key * 0xc4ceb9fe1a85ec53u ^ key >> 32;
}

static void write_name(char name[static NAME_SIZE], uint64_t key)
{
    snprintf(name, NAME_SIZE, "tree-%016llx", (unsigned long long)key);
}

/* ---- words ---- */

/* Most words that the trees of a shape take: a tree of n triangles has at most 2 n - 1 nodes. */
static size_t words_max(const struct tree_shape *shape)
{
    return 3 * (size_t)shape->count;
}

/* Writes a word for a node and each below: the triangles of its first child, or 0 for a leaf. */
static void encode_node(uint32_t *words, size_t *next, const struct tree_node *nodes, uint32_t at)
{
    const uint32_t *children = nodes[at].children;
    words[(*next)++] = children[0] ? nodes[children[0]].count : 0;
    for (int i = 0; i < 2 && children[0]; i++)
        encode_node(words, next, nodes, children[i]);
}

/* Returns how many words have been written. */
static size_t encode(uint32_t *words, const struct tree_shape *shape)
{
    size_t next = shape->count;
    memcpy(words, shape->draft.order, shape->count * sizeof(*words));
    for (uint32_t i = 0; i < shape->group_count; i++)
        encode_node(words, &next, shape->draft.nodes, shape->groups[i].root);
    return next;
}

/* Words that are read one by one. */
struct reading {
    struct tree_node *nodes;
    const uint32_t *words;
    size_t next, count;
};

/* Reads a node and those below, for triangles that the node above has given it: so they are one
 * tree whose leaves have each triangle once. Ways have at most `left` nodes. */
static bool decode_node(struct reading *reading, const struct tree_range *range, uint32_t left)
{
    if (!left || reading->next == reading->count)
        return false;
    const uint32_t cut = reading->words[reading->next++];
    struct tree_node *node = &reading->nodes[range->root];
    *node = (struct tree_node){ .first = range->first, .count = range->count };
    if (!cut)
        return range->count <= TREE_LEAF_MAX;
    if (cut >= range->count)
        return false;
    const struct tree_range a = { range->first, cut, range->root + 1 };
    const struct tree_range b = { range->first + cut, range->count - cut, range->root + 2 * cut };
    node->children[0] = a.root;
    node->children[1] = b.root;
    return decode_node(reading, &a, left - 1) && decode_node(reading, &b, left - 1);
}

/* Whether an order has each triangle once, among those of its group. */
static bool is_order(const struct tree_shape *shape, const uint32_t *order)
{
    bool *seen = calloc(shape->count + (size_t)1, sizeof(*seen));
    bool is_sound = seen;
    for (uint32_t i = 0; i < shape->group_count && is_sound; i++) {
        const struct tree_range *group = &shape->groups[i];
        for (uint32_t k = group->first; k < group->first + group->count && is_sound; k++) {
            is_sound = order[k] >= group->first && order[k] - group->first < group->count &&
                       !seen[order[k]];
            if (is_sound)
                seen[order[k]] = true;
        }
    }
    free(seen);
    return is_sound;
}

bool tree_cache_decode(struct tree_shape *shape, const uint32_t *words, size_t count)
{
    if (count < shape->count || !is_order(shape, words))
        return false;
    struct reading reading = { shape->draft.nodes, words, shape->count, count };
    for (uint32_t i = 0; i < shape->group_count; i++) {
        if (!decode_node(&reading, &shape->groups[i], shape->depth))
            return false;
    }
    if (reading.next != count)
        return false;
    memcpy(shape->draft.order, words, shape->count * sizeof(*words));
    for (uint32_t i = 0; i < shape->group_count; i++)
        tree_refit(&shape->draft, shape->groups[i].root);
    return true;
}

/* ---- files ---- */

static bool is_sound(const void *key, const void *data, size_t size)
{
    return size >= sizeof(uint64_t) + CACHE_HASH_SIZE && size % sizeof(uint32_t) == 0 &&
           memcmp(data, key, sizeof(uint64_t)) == 0 && cache_is_whole(data, size);
}

bool tree_cache_load(struct tree_shape *shape, uint64_t key)
{
    char name[NAME_SIZE];
    size_t size = 0;
    write_name(name, key);
    const struct cache_file file = {
        .name = name,
        .size_max = (KEY_WORDS + words_max(shape)) * sizeof(uint32_t) + CACHE_HASH_SIZE,
        .is_quiet = true,
        .is_sound = is_sound,
        .user = &key,
    };
    uint32_t *words = cache_read(&file, &size);
    const size_t count = size / sizeof(*words);
    const bool done =
        words && tree_cache_decode(shape, words + KEY_WORDS, count - 2 * (size_t)KEY_WORDS);
    free(words);
    return done;
}

void tree_cache_save(const struct tree_shape *shape, uint64_t key)
{
    char name[NAME_SIZE];
    uint32_t *words =
        malloc((KEY_WORDS + words_max(shape)) * sizeof(*words) + (size_t)CACHE_HASH_SIZE);
    if (!words)
        return;
    memcpy(words, &key, sizeof(key));
    const size_t count = KEY_WORDS + encode(words + KEY_WORDS, shape);
    write_name(name, key);
    cache_write(name, words, count * sizeof(*words));
    cache_trim("tree-", TREE_CACHE_SIZE_MAX);
    free(words);
}
