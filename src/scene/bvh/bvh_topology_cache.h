/*
 * bvh_topology_cache.h: caches the topology of large BVHs in files between runs
 * (src/base/disk_cache.h).
 *
 * A file holds the triangle order of a scene part, and the triangle count of each node's first
 * child. Boxes are recomputed from the scene, so a wrong file can make rays slower, but cannot
 * change what they hit. The file name is a hash of everything that determines the topology.
 */
#ifndef FIRN_SCENE_BVH_BVH_TOPOLOGY_CACHE_H
#define FIRN_SCENE_BVH_BVH_TOPOLOGY_CACHE_H

#include "src/scene/bvh/bvh_scene_parts.h"

enum {
    BVH_CACHE_MIN = 100000,         /* minimum triangle count of a cached BVH */
    BVH_CACHE_SIZE_MAX = 256 << 20, /* total size limit of cache files, bytes */
};

/* Returns a hash of positions, groups and build parameters of a scene part without bubbles. */
uint64_t bvh_cache_key(const struct bvh_part *part);

/* Loads the BVH topology that was saved with `key`. The group ranges must already be set. If there
 * is no valid file, returns false, leaves the nodes undefined, and keeps the triangle order. */
bool bvh_cache_load(struct bvh_two_level *hierarchy, uint64_t key);

/* Writes a BVH's topology to a cache file, evicting the least recently used files. */
void bvh_cache_save(const struct bvh_two_level *hierarchy, uint64_t key);

/* Decodes `count` untrusted words into a BVH. Returns false if they are not a valid topology. */
bool bvh_cache_decode(struct bvh_two_level *hierarchy, const uint32_t *words, size_t count);

#endif
