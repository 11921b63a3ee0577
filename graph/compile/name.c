/* name.c: names that come twice. A hash table for each kind of what was named so far. */
#include "graph/compile/name.h"

/* Room for `count` names, which fill at most half of the slots. */
static bool grow(struct arena *arena, struct name_map *map, uint32_t count)
{
    struct name_map grown = { .mask = 63 };
    while (grown.mask / 2 < count)
        grown.mask = grown.mask * 2 + 1;
    grown.room = grown.mask / 2;
    grown.slots = ARENA_ZEROED(arena, const char *, (size_t)grown.mask + 1);
    if (arena->failed)
        return false;
    for (uint32_t i = 0; map->slots && i <= map->mask; i++) {
        if (!map->slots[i])
            continue;
        *rg_name_slot(&grown, map->slots[i]) = map->slots[i];
        grown.room--;
    }
    *map = grown;
    return true;
}

void rg_name_expect(struct compiler *c, enum name_kind kind, uint32_t count)
{
    grow(c->arena, &c->names[kind], count);
}

bool rg_name_is_new(struct compiler *c, enum name_kind kind, const char *name)
{
    struct name_map *map = &c->names[kind];
    if (!map->room && !grow(c->arena, map, map->mask))
        return true;
    return rg_name_add_quickly(c, kind, name);
}
