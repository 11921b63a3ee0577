/* map.h: a hash map in an arena, from addresses or texts to pointers. Private to graph/compile/. */
#ifndef RG_COMPILE_MAP_H
#define RG_COMPILE_MAP_H

#include "graph/compile/arena.h"

struct map_slot {
    const void *key; /* NULL: the slot is empty */

    union {
        void *value;   /* of an address */
        uint32_t hash; /* of a text */
    };
};

/* Open addressing: the slots are a power of two, and at most three quarters have a key. {0} is an
 * empty map of addresses. */
struct map {
    struct map_slot *slots;
    uint32_t mask; /* one less than the number of slots */
    uint32_t count;
    bool of_texts; /* keys are strings, compared by their characters; else addresses */
};

/* Returns the slot of an address, or the empty one where it would be. The map has slots. */
static inline struct map_slot *rg_map_find(const struct map *map, const void *address)
{
    /* Neighbours in tables are neighbours in the map; higher bits are added for tables whose rows
     * are a power of two apart. */
    uintptr_t i = ((uintptr_t)address + ((uintptr_t)address >> 9)) >> 4;
    while (map->slots[i & map->mask].key && map->slots[i & map->mask].key != address)
        i++;
    return &map->slots[i & map->mask];
}

/* Makes room for `count` keys. */
void rg_map_expect(struct arena *arena, struct map *map, uint32_t count);

/* Puts an address, which the map does not have, into the empty slot where it would be. Returns as
 * rg_map_value(). */
void **rg_map_add(struct arena *arena, struct map *map, struct map_slot *slot, const void *address);

/* Returns where the value of an address is; a new one has the value NULL. NULL: memory is short.
 * The map has slots. */
static inline void **rg_map_value(struct arena *arena, struct map *map, const void *address)
{
    struct map_slot *slot = rg_map_find(map, address);
    return slot->key ? &slot->value : rg_map_add(arena, map, slot, address);
}

/* Adds a text to a map of texts. Returns whether it was there before. */
bool rg_map_has_text(struct arena *arena, struct map *map, const char *text);

#endif
