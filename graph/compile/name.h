/*
 * name.h: names that come twice, among resources and among passes. What nearly every name needs
 * is here, so that it is inlined.
 */
#ifndef RG_COMPILE_NAME_H
#define RG_COMPILE_NAME_H

#include "graph/compile/compiler.h"

/* Room for about so many. */
void rg_name_expect(struct compiler *c, enum name_kind kind, uint32_t count);

/* False if there was one of this name; else adds it. */
bool rg_name_is_new(struct compiler *c, enum name_kind kind, const char *name);

#define RG_HINT_NAME "give each a name of its own"

/* FNV-1a. */
static inline uint32_t rg_name_hash(const char *text)
{
    uint32_t hash = UINT32_C(2166136261);
    for (unsigned char c = (unsigned char)*text; c; c = (unsigned char)*++text)
        hash = (hash ^ c) * UINT32_C(16777619);
    return hash;
}

/* As strcmp(), but inlined: most texts differ at once. */
static inline bool rg_name_is_same(const char *a, const char *b)
{
    while (*a && *a == *b)
        a++, b++;
    return *a == *b;
}

/* Where a name is, or would be. */
static inline const char **rg_name_slot(const struct name_map *map, const char *name)
{
    uint32_t i = rg_name_hash(name) & map->mask;
    while (map->slots[i] && !rg_name_is_same(map->slots[i], name))
        i = (i + 1) & map->mask;
    return &map->slots[i];
}

/* Adds a name if it is new and there is room. Else does nothing. */
static inline bool rg_name_add_quickly(struct compiler *c, enum name_kind kind, const char *name)
{
    struct name_map *map = &c->names[kind];
    const char **slot = rg_name_slot(map, name);
    if (*slot || !map->room)
        return false;
    *slot = name;
    map->room--;
    return true;
}

#endif
