/* hash_map.c: arena-allocated hash map keyed by address, also as a set of strings. */
#include "graph/compile/hash_map.h"
#include <string.h>

enum {
    FIRST_MASK = 31
};

static uint32_t capacity_of(uint32_t mask)
{
    return mask / 4 * 3;
}

void rg_map_reserve(struct arena *arena, struct map *map, uint32_t count)
{
    struct map grown = { .mask = FIRST_MASK, .count = map->count };
    while (capacity_of(grown.mask) < count)
        grown.mask = grown.mask * 2 + 1;
    grown.slots = ARENA_ZEROED(arena, struct map_slot, (size_t)grown.mask + 1);
    if (!grown.slots)
        return;
    for (uint32_t i = 0; map->slots && i <= map->mask; i++) {
        if (map->slots[i].key)
            *rg_map_find(&grown, map->slots[i].key) = map->slots[i];
    }
    *map = grown;
}

void **rg_map_add(struct arena *arena, struct map *map, struct map_slot *slot, const void *address)
{
    if (map->count >= capacity_of(map->mask)) {
        rg_map_reserve(arena, map, map->mask);
        slot = rg_map_find(map, address);
    }
    if (arena->failed)
        return NULL;
    map->count++;
    slot->key = address;
    return &slot->value;
}

bool rg_map_add_text(struct arena *arena, struct map *set, const char *text)
{
    uint64_t hash = UINT64_C(14695981039346656037); /* FNV-1a */
    for (const char *c = text; *c; c++)
        hash = (hash ^ (unsigned char)*c) * UINT64_C(1099511628211);
    for (;; hash += 2) { /* the next one if another text has this hash */
        void **value = rg_map_value(arena, set, (const void *)(uintptr_t)(hash | 1));
        if (!value)
            return false;
        if (*value && !strcmp(*value, text))
            return true;
        if (*value)
            continue;
        *value = (void *)(uintptr_t)text;
        return false;
    }
}
