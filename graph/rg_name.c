/* rg_name.c: names that come twice. A hash table of what was named so far. */
#include "graph/rg_name.h"
#include <string.h>

/* Where a name is, or would be. */
static uint32_t *slot_of(const struct name_map *map, const struct name *name)
{
    uint32_t i = name->hash & map->mask;
    for (; map->slots[i]; i = (i + 1) & map->mask) {
        const struct name *other = &map->names[map->slots[i] - 1];
        if (other->hash == name->hash && strcmp(other->text, name->text) == 0)
            break;
    }
    return &map->slots[i];
}

/* Room for `count` names, which fill at most half of the slots. */
static bool grow(struct arena *arena, struct name_map *map, uint32_t count)
{
    uint32_t mask = 63;
    while (mask / 2 < count)
        mask = mask * 2 + 1;
    uint32_t *slots = ARENA_ZEROED(arena, uint32_t, (size_t)mask + 1);
    struct name *names = ARENA_ARRAY(arena, struct name, mask / 2);
    if (arena->failed)
        return false;
    for (uint32_t i = 0; i < map->count; i++)
        names[i] = map->names[i];
    map->slots = slots;
    map->mask = mask;
    map->room = mask / 2;
    map->names = names;
    for (uint32_t i = 0; i < map->count; i++)
        *slot_of(map, &names[i]) = i + 1;
    return true;
}

void rg_name_expect(struct compiler *c, uint32_t count)
{
    grow(c->arena, &c->names, count);
}

bool rg_name_is_new(struct compiler *c, enum name_kind kind, const char *name)
{
    struct name_map *map = &c->names;
    const struct name new = { name, rg_name_hash(kind, name) };
    if (map->count == map->room && !grow(c->arena, map, map->count + 1))
        return true;
    uint32_t *slot = slot_of(map, &new);
    if (*slot)
        return false;
    map->names[map->count] = new;
    *slot = ++map->count;
    return true;
}
