/* hash_map.c: arena-allocated hash map keyed by address, and a string set. */
#include "graph/compile/hash_map.h"
#include <string.h>

enum {
    FIRST_MASK = 31
};

static uint32_t capacity_of(uint32_t mask)
{
    return mask / 4 * 3;
}

static uint32_t mask_for(uint32_t count)
{
    uint32_t mask = FIRST_MASK;
    while (capacity_of(mask) < count)
        mask = mask * 2 + 1;
    return mask;
}

/* ---- hash map of addresses ---- */

void rg_map_reserve(struct arena *arena, struct map *map, uint32_t count)
{
    struct map grown = { .mask = mask_for(count), .count = map->count };
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

/* ---- string set ---- */

/* FNV-1a hash */
static uint32_t hash_text(const char *text)
{
    uint32_t hash = UINT32_C(2166136261);
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * UINT32_C(16777619);
    return hash;
}

/* Returns the slot of a string, or the empty slot where it would be inserted. */
static struct string_slot *find_text(const struct string_set *set, const char *text, uint32_t hash)
{
    for (uint32_t i = hash;; i++) {
        struct string_slot *slot = &set->slots[i & set->mask];
        if (!slot->number || (slot->hash == hash && !strcmp(set->texts[slot->number - 1], text)))
            return slot;
    }
}

void rg_string_set_reserve(struct arena *arena, struct string_set *set, uint32_t count)
{
    struct string_set grown = { .mask = mask_for(count), .count = set->count };
    grown.slots = ARENA_ZEROED(arena, struct string_slot, (size_t)grown.mask + 1);
    grown.texts = ARENA_ARRAY(arena, const char *, capacity_of(grown.mask));
    if (!grown.texts)
        return;
    if (set->count)
        memcpy(grown.texts, set->texts, set->count * sizeof(*set->texts));
    for (uint32_t i = 0; set->slots && i <= set->mask; i++) {
        const struct string_slot *slot = &set->slots[i];
        if (slot->number)
            *find_text(&grown, set->texts[slot->number - 1], slot->hash) = *slot;
    }
    *set = grown;
}

bool rg_string_set_add(struct arena *arena, struct string_set *set, const char *text)
{
    const uint32_t hash = hash_text(text);
    if (set->count >= capacity_of(set->mask))
        rg_string_set_reserve(arena, set, set->mask);
    struct string_slot *slot = find_text(set, text, hash);
    if (slot->number || arena->failed)
        return slot->number;
    set->texts[set->count++] = text;
    *slot = (struct string_slot){ hash, set->count };
    return false;
}
