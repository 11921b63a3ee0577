/*
 * tree_cache.h: caches the topology of large BVHs in files between runs (src/base/cache.h).
 *
 * A file holds the triangle order of a part, and the number of triangles in each node's first
 * child. Boxes are recomputed from the scene, so a wrong file can make rays slower, but cannot
 * change what they hit. The file name is a hash of everything that determines the topology.
 */
#ifndef FIRN_SCENE_TREE_CACHE_H
#define FIRN_SCENE_TREE_CACHE_H

#include "src/scene/tree_part.h"

enum {
    TREE_CACHE_MIN = 100000,         /* minimum triangle count of a part whose BVH is cached */
    TREE_CACHE_SIZE_MAX = 256 << 20, /* total size limit of the cached BVHs, bytes */
};

/* Returns a hash of positions, groups and build parameters. The part must have no bubbles. */
uint64_t tree_cache_key(const struct tree_part *part);

/* Reads the topology with this key into a shape whose groups have ranges. Returns false if there is
 * no valid file; the nodes are then undefined, and the triangle order is unchanged. */
bool tree_cache_load(struct tree_shape *shape, uint64_t key);

/* Writes the topology of a shape's groups, and evicts least recently used files. */
void tree_cache_save(const struct tree_shape *shape, uint64_t key);

/* Decodes `count` untrusted words into a shape. Returns false if they are not a valid topology. */
bool tree_cache_decode(struct tree_shape *shape, const uint32_t *words, size_t count);

#endif
