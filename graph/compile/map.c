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

/* The slot of a text, or the empty one where it would be. */
static struct map_slot *find_text(const struct map *map, const char *text, uint32_t hash)
{
    uint32_t i = hash;
    for (;; i++) {
        struct map_slot *slot = &map->slots[i & map->mask];
        if (!slot->key || (slot->hash == hash && !strcmp(slot->key, text)))
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
        const struct map_slot *slot = &map->slots[i];
        if (slot->key)
            *(map->of_texts ? find_text(&grown, slot->key, slot->hash)
                            : rg_map_find(&grown, slot->key)) = *slot;
    }
    *map = grown;
}

static bool is_full(const struct map *map)
{
    return map->count >= map->mask / 4 * 3;
}

void **rg_map_add(struct arena *arena, struct map *map, struct map_slot *slot, const void *address)
{
    if (is_full(map)) {
        rg_map_expect(arena, map, map->mask);
        slot = rg_map_find(map, address);
    }
    if (arena->failed)
        return NULL;
    map->count++;
    slot->key = address;
    return &slot->value;
}

bool rg_map_has_text(struct arena *arena, struct map *map, const char *text)
{
    const uint32_t hash = hash_text(text);
    if (is_full(map))
        rg_map_expect(arena, map, map->mask);
    struct map_slot *slot = find_text(map, text, hash);
    if (slot->key || arena->failed)
        return slot->key != NULL;
    map->count++;
    slot->key = text;
    slot->hash = hash;
    return false;
}
