/* map.c: a hash map in an arena. */
#include "graph/compile/map.h"
#include <string.h>

enum {
    FIRST_MASK = 63
};

/* FNV-1a. */
static uint32_t hash_text(const char *text)
{
    uint32_t hash = UINT32_C(2166136261);
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * UINT32_C(16777619);
    return hash;
}

/* Neighbours in the tables are neighbours in the map; higher bits are added for tables whose rows
 * are a power of two apart. */
static uint32_t hash_address(const void *key)
{
    uintptr_t address = (uintptr_t)key;
    return (uint32_t)((address + (address >> 9)) >> 4);
}

/* The slot of a key, or the empty one where it would be. */
static inline struct map_slot *find(const struct map *map, const void *key)
{
    uint32_t i = map->of_texts ? hash_text(key) : hash_address(key);
    for (;; i++) {
        struct map_slot *slot = &map->slots[i & map->mask];
        if (!slot->key || slot->key == key || (map->of_texts && !strcmp(slot->key, key)))
            return slot;
    }
}

void rg_map_expect(struct arena *arena, struct map *map, uint32_t count)
{
    struct map grown = { .mask = FIRST_MASK, .count = map->count, .of_texts = map->of_texts };
    while (grown.mask / 4 * 3 < count)
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
    if (map->count >= map->mask / 4 * 3)
        rg_map_expect(arena, map, map->mask);
    if (arena->failed)
        return NULL;
    struct map_slot *slot = find(map, key);
    map->count += !slot->key;
    slot->key = key;
    return &slot->value;
}

bool rg_map_has(struct arena *arena, struct map *map, const void *key)
{
    void **value = rg_map_value(arena, map, key);
    bool known = value && *value;
    if (value)
        *value = map;
    return known;
}
