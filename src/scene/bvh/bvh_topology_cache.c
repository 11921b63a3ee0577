/* bvh_topology_cache.c: encodes BVH topologies as 32-bit words, and decodes untrusted ones. */
#include "src/scene/bvh/bvh_topology_cache.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/disk_cache.h"

#define FORMAT 1 /* format version; must change with the encoding or the build algorithm */

enum {
    KEY_WORDS = sizeof(uint64_t) / sizeof(uint32_t), /* the key precedes the data */
    NAME_SIZE = 32,
};

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

uint64_t bvh_cache_key(const struct bvh_part *part)
{
    uint64_t key = 0x9e3779b97f4a7c15u;
    add(&key, FORMAT);
    add(&key, BVH_LEAF_MAX);
    add(&key, BVH_BIN_COUNT);
    add_number(&key, BVH_NODE_COST);
    add(&key, BVH_DEPTH_MAX);
    add(&key, part->count);
    for (uint32_t i = 0; i <= part->group_count; i++)
        add(&key, part->firsts[i]);
    for (uint32_t i = 0; i < part->count; i++) {
        for (uint32_t k = 0; k < 9; k++)
            add_number(&key, bvh_corner(part, part->triangles[i], k / 3)->position.raw[k % 3]);
    }
    return key * 0xc4ceb9fe1a85ec53u ^ key >> 32;
}

static void write_name(char name[static NAME_SIZE], uint64_t key)
{
    snprintf(name, NAME_SIZE, "tree-%016llx", (unsigned long long)key);
}

/* Returns the maximum size of an encoded topology: n triangles need at most 2 n - 1 nodes. */
static size_t words_max(const struct bvh_two_level *hierarchy)
{
    return 3 * (size_t)hierarchy->count;
}

/* Writes a subtree depth first, as the triangle count of each node's first child (0 for a leaf). */
static void encode_node(uint32_t *words, size_t *next, const struct bvh_node *nodes, uint32_t at)
{
    const uint32_t *children = nodes[at].children;
    words[(*next)++] = children[0] ? nodes[children[0]].count : 0;
    for (int i = 0; i < 2 && children[0]; i++)
        encode_node(words, next, nodes, children[i]);
}

/* Encodes a topology. Returns the number of words written. */
static size_t encode(uint32_t *words, const struct bvh_two_level *hierarchy)
{
    size_t next = hierarchy->count;
    memcpy(words, hierarchy->builder.order, hierarchy->count * sizeof(*words));
    for (uint32_t i = 0; i < hierarchy->group_count; i++)
        encode_node(words, &next, hierarchy->builder.nodes, hierarchy->groups[i].root);
    return next;
}

struct decoder {
    struct bvh_node *nodes;
    const uint32_t *words;
    size_t next, count;
};

/* Decodes the subtree that contains the triangles of `range`. Returns false if the data are
 * invalid: too few words, more than `left` levels, or a wrong size of a leaf or child. */
static bool decode_node(struct decoder *decoder, const struct bvh_range *range, uint32_t left)
{
    if (!left || decoder->next == decoder->count)
        return false;
    const uint32_t cut = decoder->words[decoder->next++];
    struct bvh_node *node = &decoder->nodes[range->root];
    *node = (struct bvh_node){ .first = range->first, .count = range->count };
    if (!cut)
        return range->count <= BVH_LEAF_MAX;
    if (cut >= range->count)
        return false;
    const struct bvh_range a = { range->first, cut, range->root + 1 };
    const struct bvh_range b = { range->first + cut, range->count - cut, range->root + 2 * cut };
    node->children[0] = a.root;
    node->children[1] = b.root;
    return decode_node(decoder, &a, left - 1) && decode_node(decoder, &b, left - 1);
}

/* Returns true if `order` is a permutation of the triangles within each group. */
static bool is_order(const struct bvh_two_level *hierarchy, const uint32_t *order)
{
    bool *is_used = calloc(hierarchy->count + (size_t)1, sizeof(*is_used));
    bool is_sound = is_used;
    for (uint32_t i = 0; i < hierarchy->group_count && is_sound; i++) {
        const struct bvh_range *group = &hierarchy->groups[i];
        for (uint32_t k = group->first; k < group->first + group->count && is_sound; k++) {
            is_sound = order[k] >= group->first && order[k] - group->first < group->count &&
                       !is_used[order[k]];
            if (is_sound)
                is_used[order[k]] = true;
        }
    }
    free(is_used);
    return is_sound;
}

bool bvh_cache_decode(struct bvh_two_level *hierarchy, const uint32_t *words, size_t count)
{
    if (count < hierarchy->count || !is_order(hierarchy, words))
        return false;
    struct decoder decoder = { hierarchy->builder.nodes, words, hierarchy->count, count };
    for (uint32_t i = 0; i < hierarchy->group_count; i++) {
        if (!decode_node(&decoder, &hierarchy->groups[i], hierarchy->depth))
            return false;
    }
    if (decoder.next != count)
        return false;
    memcpy(hierarchy->builder.order, words, hierarchy->count * sizeof(*words));
    for (uint32_t i = 0; i < hierarchy->group_count; i++)
        bvh_refit(&hierarchy->builder, hierarchy->groups[i].root);
    return true;
}

static bool is_sound(const void *key, const void *data, size_t size)
{
    return size >= sizeof(uint64_t) + DISK_CACHE_HASH_SIZE && size % sizeof(uint32_t) == 0 &&
           memcmp(data, key, sizeof(uint64_t)) == 0 && disk_cache_is_intact(data, size);
}

bool bvh_cache_load(struct bvh_two_level *hierarchy, uint64_t key)
{
    char name[NAME_SIZE];
    size_t size = 0;
    write_name(name, key);
    const struct disk_cache_file file = {
        .name = name,
        .size_max = (KEY_WORDS + words_max(hierarchy)) * sizeof(uint32_t) + DISK_CACHE_HASH_SIZE,
        .is_quiet = true,
        .is_sound = is_sound,
        .user = &key,
    };
    uint32_t *words = disk_cache_read(&file, &size);
    const size_t count = size / sizeof(*words);
    const bool done =
        words && bvh_cache_decode(hierarchy, words + KEY_WORDS, count - 2 * (size_t)KEY_WORDS);
    free(words);
    return done;
}

void bvh_cache_save(const struct bvh_two_level *hierarchy, uint64_t key)
{
    char name[NAME_SIZE];
    uint32_t *words =
        malloc((KEY_WORDS + words_max(hierarchy)) * sizeof(*words) + (size_t)DISK_CACHE_HASH_SIZE);
    if (!words)
        return;
    memcpy(words, &key, sizeof(key));
    const size_t count = KEY_WORDS + encode(words + KEY_WORDS, hierarchy);
    write_name(name, key);
    disk_cache_write(name, words, count * sizeof(*words));
    disk_cache_evict("tree-", BVH_CACHE_SIZE_MAX);
    free(words);
}
