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

/* The slot of a key, or the empty one where it would be. */
static inline struct map_slot *find(const struct map *map, const void *key)
{
    if (!map->of_texts)
        return rg_map_find(map, key);
    uint32_t i = hash_text(key);
    while (map->slots[i & map->mask].key && strcmp(map->slots[i & map->mask].key, key) != 0)
        i++;
    return &map->slots[i & map->mask];
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

/* The slot of a key, which gets one if it has none. NULL: memory is short. */
static inline struct map_slot *find_or_add(struct arena *arena, struct map *map, const void *key)
{
    if (map->count >= map->mask / 4 * 3)
        rg_map_expect(arena, map, map->mask);
    if (arena->failed)
        return NULL;
    struct map_slot *slot = find(map, key);
    map->count += !slot->key;
    slot->key = key;
    return slot;
}

void **rg_map_value(struct arena *arena, struct map *map, const void *key)
{
    struct map_slot *slot = find_or_add(arena, map, key);
    return slot ? &slot->value : NULL;
}

bool rg_map_has(struct arena *arena, struct map *map, const void *key)
{
    struct map_slot *slot = find_or_add(arena, map, key);
    bool known = slot && slot->value;
    if (slot)
        slot->value = map;
    return known;
}
