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

static inline uint32_t first_slot(const struct name_map *map, uint32_t hash)
{
    return (hash ^ hash >> 15) & map->mask;
}

static inline void add(struct name_map *map, struct name_slot *slot, uint32_t hash,
                       const char *name)
{
    map->names[map->count++] = name;
    *slot = (struct name_slot){ hash, map->count };
}

/* Where a name is, or would be. */
static struct name_slot *slot_of(const struct name_map *map, uint32_t hash, const char *text)
{
    uint32_t i = first_slot(map, hash);
    while (map->slots[i].index &&
           (map->slots[i].hash != hash || strcmp(map->names[map->slots[i].index - 1], text) != 0))
        i = (i + 1) & map->mask;
    return &map->slots[i];
}

/* Room for `count` names, which fill at most half of the slots. */
static bool grow(struct arena *arena, struct name_map *map, uint32_t count)
{
    struct name_map new = { .mask = 63, .count = map->count };
    while (new.mask / 2 < count)
        new.mask = new.mask * 2 + 1;
    new.room = new.mask / 2;
    new.slots = ARENA_ZEROED(arena, struct name_slot, (size_t) new.mask + 1);
    new.names = ARENA_ARRAY(arena, const char *, new.room);
    if (arena->failed)
        return false;
    for (uint32_t i = 0; i < map->count; i++)
        new.names[i] = map->names[i];
    for (uint32_t i = 0; map->slots && i <= map->mask; i++) {
        if (map->slots[i].index)
            *slot_of(&new, map->slots[i].hash, map->names[map->slots[i].index - 1]) = map->slots[i];
    }
    *map = new;
    return true;
}

void rg_name_expect(struct compiler *c, uint32_t count)
{
    grow(c->arena, &c->names, count);
}

/* Of a name that the map has, or one of its hash, or that the map has no room for. */
__attribute__((noinline)) static bool look_closer(struct compiler *c, uint32_t hash,
                                                  const char *name)
{
    struct name_map *map = &c->names;
    if (map->count == map->room && !grow(c->arena, map, map->count + 1))
        return true;
    struct name_slot *slot = slot_of(map, hash, name);
    if (slot->index)
        return false;
    add(map, slot, hash, name);
    return true;
}

bool rg_name_is_new(struct compiler *c, enum name_kind kind, const char *name)
{
    struct name_map *map = &c->names;
    uint32_t hash = hash_of(kind, name);
    uint32_t i = first_slot(map, hash);
    while (map->slots[i].index && map->slots[i].hash != hash)
        i = (i + 1) & map->mask;
    if (map->slots[i].index || map->count == map->room)
        return look_closer(c, hash, name);
    add(map, &map->slots[i], hash, name);
    return true;
}
