/* hash_map.h: arena-allocated pointer map, also as a set of strings. Private to graph/compile/. */
#ifndef RG_COMPILE_HASH_MAP_H
#define RG_COMPILE_HASH_MAP_H

#include "graph/compile/arena.h"

/* Slot of a hash map with open addressing. Initialise the map with {0} and rg_map_reserve(). */

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
    /* this hash puts adjacent addresses into adjacent slots, but spreads power-of-two strides */
    uintptr_t i = ((uintptr_t)address + ((uintptr_t)address >> 9)) >> 4;
    while (map->slots[i & map->mask].key && map->slots[i & map->mask].key != address)
        i++;
    return &map->slots[i & map->mask];
}

void rg_map_reserve(struct arena *arena, struct map *map, uint32_t count);

/* Inserts an address into an empty slot. Returns a pointer to its value; NULL if out of memory. */
void **rg_map_add(struct arena *arena, struct map *map, struct map_slot *slot, const void *address);

/* Returns a pointer to an address's value, initially NULL. Returns NULL if out of memory. */
static inline void **rg_map_value(struct arena *arena, struct map *map, const void *address)
{
    struct map_slot *slot = rg_map_find(map, address);
    return slot->key ? &slot->value : rg_map_add(arena, map, slot, address);
}

/* Adds a string to a set of strings, which is a map from hashes. Returns true if the set already
 * had it. The string is borrowed. */
bool rg_map_add_text(struct arena *arena, struct map *set, const char *text);

#endif
