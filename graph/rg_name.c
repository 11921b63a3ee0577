/* rg_name.c: names that come twice. A hash table of what was named so far. */
#include "graph/rg_name.h"
#include <string.h>

/* Where a name is, or would be. */
static struct name_slot *slot_of(const struct name_map *map, uint32_t hash, const char *text)
{
    uint32_t i = rg_name_slot(map, hash);
    while (map->slots[i].hash &&
           (map->slots[i].hash != hash || strcmp(map->names[map->slots[i].index], text) != 0))
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
        if (map->slots[i].hash)
            *slot_of(&new, map->slots[i].hash, map->names[map->slots[i].index]) = map->slots[i];
    }
    *map = new;
    return true;
}

void rg_name_expect(struct compiler *c, uint32_t count)
{
    grow(c->arena, &c->names, count);
}

bool rg_name_is_new(struct compiler *c, enum name_kind kind, const char *name)
{
    struct name_map *map = &c->names;
    uint32_t hash = rg_name_hash(kind, name);
    if (map->count == map->room && !grow(c->arena, map, map->count + 1))
        return true;
    struct name_slot *slot = slot_of(map, hash, name);
    if (slot->hash)
        return false;
    rg_name_add(map, slot, hash, name);
    return true;
}
