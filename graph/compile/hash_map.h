/* hash_map.h: arena-allocated hash map keyed by address, and a string set. Private to
 * graph/compile/. */
#ifndef RG_COMPILE_HASH_MAP_H
#define RG_COMPILE_HASH_MAP_H

#include "graph/compile/arena.h"

/* Both tables use open addressing with a power of two of slots, at most three quarters full. {0} is
 * empty; slots must be reserved before the first lookup. */

struct map_slot {
    const void *key; /* NULL: empty slot */
    void *value;
};

struct map {
    struct map_slot *slots;
    uint32_t mask; /* number of slots minus 1 */
    uint32_t count;
};

/* Returns the slot of an address, or the empty slot where it would be inserted. */
static inline struct map_slot *rg_map_find(const struct map *map, const void *address)
{
    /* Neighbours in tables stay neighbours in the map (cache locality); mixing in higher bits
     * spreads tables whose row size is a power of two. */
    uintptr_t i = ((uintptr_t)address + ((uintptr_t)address >> 9)) >> 4;
    while (map->slots[i & map->mask].key && map->slots[i & map->mask].key != address)
        i++;
    return &map->slots[i & map->mask];
}

void rg_map_reserve(struct arena *arena, struct map *map, uint32_t count);

/* Inserts an address that is not yet in the map into the empty slot found for it. Returns a pointer
 * to its value, or NULL if out of memory. */
void **rg_map_add(struct arena *arena, struct map *map, struct map_slot *slot, const void *address);

/* Returns a pointer to the value of an address, inserting NULL if new; NULL if out of memory. */
static inline void **rg_map_value(struct arena *arena, struct map *map, const void *address)
{
    struct map_slot *slot = rg_map_find(map, address);
    return slot->key ? &slot->value : rg_map_add(arena, map, slot, address);
}

/* A slot holds a hash and an index rather than the string, to keep probing in few cache lines. */
struct string_slot {
    uint32_t hash;
    uint32_t number; /* index in `texts` plus 1; 0: empty slot */
};

/* Set of strings, compared by content. */
struct string_set {
    struct string_slot *slots;
    const char **texts; /* in insertion order */
    uint32_t mask, count;
};

void rg_string_set_reserve(struct arena *arena, struct string_set *set, uint32_t count);

/* Adds a string. Returns true if the set already had it. */
bool rg_string_set_add(struct arena *arena, struct string_set *set, const char *text);

#endif
