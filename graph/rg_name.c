/* rg_name.c: names that come twice. A hash table of what was named so far. */
#include <string.h>
#include "graph/rg_internal.h"

struct name_slot {
    uint32_t hash;  /* of the text and its kind */
    uint32_t index; /* one more than that in names; 0: an empty slot */
};

/* FNV-1a. */
static uint32_t hash_of(enum name_kind kind, const char *text)
{
    uint32_t hash = UINT32_C(2166136261) ^ (uint32_t)kind;
    for (unsigned char c = (unsigned char)*text; c; c = (unsigned char)*++text)
        hash = (hash ^ c) * UINT32_C(16777619);
    return hash;
}

/* Where a name is, or would be. */
static inline struct name_slot *slot_of(const struct name_map *map, uint32_t hash, const char *text)
{
    uint32_t i = (hash ^ hash >> 15) & map->mask;
    while (map->slots[i].index &&
           (map->slots[i].hash != hash || strcmp(map->names[map->slots[i].index - 1], text) != 0))
        i = (i + 1) & map->mask;
    return &map->slots[i];
}

static bool grow(struct arena *arena, struct name_map *map, uint32_t count)
{
    const struct name_map old = *map;
    map->mask = 63;
    while (map->mask / 2 <= count)
        map->mask = map->mask * 2 + 1;
    map->slots = ARENA_ZEROED(arena, struct name_slot, (size_t)map->mask + 1);
    if (!map->slots)
        return false;
    for (uint32_t i = 0; old.slots && i <= old.mask; i++) {
        if (old.slots[i].index)
            *slot_of(map, old.slots[i].hash, map->names[old.slots[i].index - 1]) = old.slots[i];
    }
    return true;
}

void rg_name_expect(struct compiler *c, uint32_t count)
{
    c->names.room = count;
    c->names.names = ARENA_ARRAY(c->arena, const char *, count);
    grow(c->arena, &c->names, count);
}

bool rg_name_is_new(struct compiler *c, enum name_kind kind, const char *name)
{
    struct name_map *map = &c->names;
    if ((map->count >= map->mask / 2 && !grow(c->arena, map, map->count)) ||
        !ARENA_ROOM(c->arena, map->names, map->count, map->room, 64))
        return true;
    uint32_t hash = hash_of(kind, name);
    struct name_slot *slot = slot_of(map, hash, name);
    if (slot->index)
        return false;
    map->names[map->count++] = name;
    *slot = (struct name_slot){ hash, map->count };
    return true;
}
