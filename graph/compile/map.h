/* map.h: a hash map of addresses and a set of texts, in an arena. Private to graph/compile/. */
#ifndef RG_COMPILE_MAP_H
#define RG_COMPILE_MAP_H

#include "graph/compile/arena.h"

/* Both have open addressing: the slots are a power of two, and at most three quarters are in use.
 * {0} is empty. Before anything is looked for, rg_..._expect() makes room for some. */

struct map_slot {
    const void *key; /* NULL: the slot is empty */
    void *value;
};

struct map {
    struct map_slot *slots;
    uint32_t mask; /* one less than the number of slots */
    uint32_t count;
};

/* Returns the slot of an address, or the empty one where it would be. */
static inline struct map_slot *rg_map_find(const struct map *map, const void *address)
{
    /* Neighbours in tables are neighbours in the map; higher bits are added for tables whose rows
     * are a power of two apart. */
    uintptr_t i = ((uintptr_t)address + ((uintptr_t)address >> 9)) >> 4;
    while (map->slots[i & map->mask].key && map->slots[i & map->mask].key != address)
        i++;
    return &map->slots[i & map->mask];
}

void rg_map_expect(struct arena *arena, struct map *map, uint32_t count);

/* Puts an address, which the map does not have, into the empty slot where it would be. Returns as
 * rg_map_value(). */
void **rg_map_add(struct arena *arena, struct map *map, struct map_slot *slot, const void *address);

/* Returns where the value of an address is; a new one has the value NULL. NULL: memory is short. */
static inline void **rg_map_value(struct arena *arena, struct map *map, const void *address)
{
    struct map_slot *slot = rg_map_find(map, address);
    return slot->key ? &slot->value : rg_map_add(arena, map, slot, address);
}

/* Slots are small, since texts are all over them. */
struct text_slot {
    uint32_t hash;
    uint32_t number; /* one more than the index of the text; 0: the slot is empty */
};

/* Strings, compared by their characters. */
struct text_set {
    struct text_slot *slots;
    const char **texts; /* in the order in which they were added */
    uint32_t mask, count;
};

void rg_texts_expect(struct arena *arena, struct text_set *set, uint32_t count);

/* Adds a text. Returns whether it was there before. */
bool rg_texts_had(struct arena *arena, struct text_set *set, const char *text);

#endif
