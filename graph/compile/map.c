/* map.c: a hash map in an arena. */
#include "graph/compile/map.h"
#include <string.h>

enum {
    FIRST_MASK = 63
};

/* Texts: FNV-1a. Addresses: neighbours in the tables are neighbours in the map; higher bits are
 * added for tables whose rows are a power of two apart. */
static uint32_t hash(const struct map *map, const void *key)
{
    uintptr_t address = (uintptr_t)key;
    uint32_t hash = UINT32_C(2166136261);
    if (!map->of_texts)
        return (uint32_t)((address + (address >> 9)) >> 4);
    for (const unsigned char *text = key; *text; text++)
        hash = (hash ^ *text) * UINT32_C(16777619);
    return hash;
}

/* The slot of a key, or the empty one where it would be. */
static struct map_slot *find(const struct map *map, const void *key)
{
    uint32_t i = hash(map, key) & map->mask;
    for (;; i = (i + 1) & map->mask) {
        struct map_slot *slot = &map->slots[i];
        if (!slot->key || slot->key == key || (map->of_texts && !strcmp(slot->key, key)))
            return slot;
    }
}

void rg_map_expect(struct arena *arena, struct map *map, uint32_t count)
{
    struct map grown = { .mask = FIRST_MASK, .count = map->count, .of_texts = map->of_texts };
    while (grown.mask / 2 < count)
        grown.mask = grown.mask * 2 + 1;
    grown.slots = ARENA_ZEROED(arena, struct map_slot, (size_t)grown.mask + 1);
    if (!grown.slots)
        return;
    for (uint32_t i = 0; map->slots && i <= map->mask; i++) {
        if (map->slots[i].key)
            *find(&grown, map->slots[i].key) = map->slots[i];
    }
    *map = grown;
}

void **rg_map_value(struct arena *arena, struct map *map, const void *key)
{
    if (map->count >= map->mask / 2)
        rg_map_expect(arena, map, map->mask);
    if (arena->failed)
        return NULL;
    struct map_slot *slot = find(map, key);
    map->count += !slot->key;
    slot->key = key;
    return &slot->value;
}
