/*
 * rg_name.h: names that come twice, among resources and among passes. What nearly every name needs
 * is here, so that it is inlined.
 */
#ifndef RG_NAME_H
#define RG_NAME_H

#include "graph/rg_internal.h"

enum name_kind {
    NAME_RESOURCE,
    NAME_PASS,
};

/* Room for about so many. */
void rg_name_expect(struct compiler *c, uint32_t count);

/* False if there was one of this name; else adds it. */
bool rg_name_is_new(struct compiler *c, enum name_kind kind, const char *name);

#define RG_HINT_NAME "give each a name of its own"

/* FNV-1a. */
static inline uint32_t rg_name_hash(enum name_kind kind, const char *text)
{
    uint32_t hash = UINT32_C(2166136261) ^ (uint32_t)kind;
    for (unsigned char c = (unsigned char)*text; c; c = (unsigned char)*++text)
        hash = (hash ^ c) * UINT32_C(16777619);
    return hash;
}

/* Adds a name if that is quick: there is none of this hash, and room. Else does nothing. */
static inline bool rg_name_add_quickly(struct compiler *c, enum name_kind kind, const char *name)
{
    struct name_map *map = &c->names;
    uint32_t hash = rg_name_hash(kind, name);
    uint32_t i = hash & map->mask;
    while (map->slots[i] && map->names[map->slots[i] - 1].hash != hash)
        i = (i + 1) & map->mask;
    if (map->slots[i] || map->count == map->room)
        return false;
    map->names[map->count] = (struct name){ name, hash };
    map->slots[i] = ++map->count;
    return true;
}

#endif
