/*
 * tree_cache.h: keeps the shapes of large trees in files between runs (src/base/cache.h).
 *
 * A file has the order of a part's triangles, and how many of its triangles each node's first child
 * has. Boxes and all else come from the scene, so what a file says decides how fast rays are, and
 * not what they meet. Its name is a fingerprint of all that decides the shape.
 */
#ifndef FIRN_SCENE_TREE_CACHE_H
#define FIRN_SCENE_TREE_CACHE_H

#include "src/scene/tree_part.h"

enum {
    TREE_CACHE_MIN = 100000,         /* triangles of a part whose tree is kept */
    TREE_CACHE_SIZE_MAX = 256 << 20, /* bytes of all files of trees */
};

/* Returns a fingerprint of the places of a part's triangles, its groups, and what the building of
 * trees depends on. The part has no bubbles. */
uint64_t tree_cache_key(const struct tree_part *part);

/* Gives a shape, whose groups have ranges and whose order is that of the part, the trees of a file
 * of that key. Returns false if there is none that is sound; the shape's nodes are then undefined,
 * and its order is as it was. */
bool tree_cache_load(struct tree_shape *shape, uint64_t key);

/* Writes the trees of a shape's groups, and removes files that were not used for long. */
void tree_cache_save(const struct tree_shape *shape, uint64_t key);

/* Gives a shape the trees of `count` words: what tree_cache_load() does with a file's. They may be
 * any. */
bool tree_cache_decode(struct tree_shape *shape, const uint32_t *words, size_t count);

#endif
