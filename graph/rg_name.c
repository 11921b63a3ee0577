/* rg_name.c: names that come twice. A hash table of what was named so far. */
#include <string.h>
#include "graph/rg_internal.h"

struct name {
    const char *text; /* NULL: an empty slot */
    uint32_t hash;    /* of the text and its kind */
};

/* FNV-1a. */
static uint32_t hash_of(enum name_kind kind, const char *text)
{
    uint32_t hash = UINT32_C(2166136261) ^ (uint32_t)kind;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * UINT32_C(16777619);
    return hash;
}

/* Where a name is, or would be. */
static struct name *slot_of(const struct name_map *map, uint32_t hash, const char *text)
{
    uint32_t i = (hash * UINT32_C(2654435769)) >> 3 & map->mask;
    while (map->slots[i].text && (map->slots[i].hash != hash || strcmp(map->slots[i].text, text)))
        i = (i + 1) & map->mask;
    return &map->slots[i];
}

static bool grow(struct arena *arena, struct name_map *map)
{
    struct name_map old = *map;
    map->mask = old.slots ? old.mask * 2 + 1 : 127;
    map->slots = ARENA_ZEROED(arena, struct name, (size_t)map->mask + 1);
    if (!map->slots)
        return false;
    for (uint32_t i = 0; old.slots && i <= old.mask; i++) {
        if (old.slots[i].text)
            *slot_of(map, old.slots[i].hash, old.slots[i].text) = old.slots[i];
    }
    return true;
}

void rg_name_add(struct compiler *c, enum name_kind kind, const char *name, struct place place)
{
    struct name_map *map = &c->names;
    if (map->count >= map->mask / 2 && !grow(c->arena, map))
        return;
    uint32_t hash = hash_of(kind, name);
    struct name *slot = slot_of(map, hash, name);
    if (slot->text) {
        rg_fault_add(c, RG_ERROR_DUPLICATE_NAME, place, "give each a name of its own");
        return;
    }
    *slot = (struct name){ name, hash };
    map->count++;
}
