/* arena.c: arena allocator that uses the caller's memory first, then malloc(); arena-allocated hash
 * map keyed by address, and string set. */
#include "graph/compile/arena.h"
#include <stdlib.h>
#include <string.h>

enum {
    CHUNK_SIZE = 65536
};

struct arena_chunk {
    struct arena_chunk *next;
    max_align_t data[];
};

static size_t align(size_t size)
{
    return (size + _Alignof(max_align_t) - 1) & ~(_Alignof(max_align_t) - 1);
}

void rg_arena_init(struct arena *arena, void *memory, size_t size)
{
    size_t gap = memory ? align((uintptr_t)memory) - (uintptr_t)memory : 0;
    *arena = (struct arena){ 0 };
    if (memory && gap <= size) {
        arena->next = (char *)memory + gap;
        arena->end = (char *)memory + size;
    }
}

/* Adds a chunk for at least `size` bytes. Chunks grow geometrically, so few are needed. */
static bool add_chunk(struct arena *arena, size_t size)
{
    size_t room = arena->used < CHUNK_SIZE ? CHUNK_SIZE : arena->used;
    if (room < size)
        room = size;
    struct arena_chunk *chunk = malloc(sizeof(*chunk) + room);
    if (!chunk)
        return false;
    chunk->next = arena->chunks;
    arena->chunks = chunk;
    arena->next = (char *)chunk->data;
    arena->end = arena->next + room;
    return true;
}

void *rg_arena_alloc(struct arena *arena, size_t count, size_t element_size)
{
    size_t size;
    if (arena->failed || __builtin_mul_overflow(count, element_size, &size) ||
        size > SIZE_MAX / 4) {
        arena->failed = true;
        return NULL;
    }
    size = align(size);
    if (size > (size_t)(arena->end - arena->next) && !add_chunk(arena, size)) {
        arena->failed = true;
        return NULL;
    }
    void *data = arena->next;
    arena->next += size;
    arena->used += size;
    return data;
}

void *rg_arena_zeroed(struct arena *arena, size_t count, size_t element_size)
{
    void *data = rg_arena_alloc(arena, count, element_size);
    if (data)
        memset(data, 0, count * element_size);
    return data;
}

void *rg_arena_grow(struct arena *arena, void *array, uint32_t *room, uint32_t min_room,
                    size_t element_size)
{
    if (*room > UINT32_MAX / 2) {
        arena->failed = true;
        return array;
    }
    uint32_t grown = *room * 2 < min_room ? min_room : *room * 2;
    void *copy = rg_arena_alloc(arena, grown, element_size);
    if (!copy)
        return array;
    if (*room)
        memcpy(copy, array, *room * element_size);
    *room = grown;
    return copy;
}

void rg_arena_finish(struct arena *arena)
{
    while (arena->chunks) {
        struct arena_chunk *next = arena->chunks->next;
        free(arena->chunks);
        arena->chunks = next;
    }
}

/* ---- hash map ---- */

enum {
    FIRST_MASK = 31
};

bool rg_map_reserve(struct arena *arena, struct map *map, uint32_t count)
{
    struct map grown = { .mask = FIRST_MASK };
    while (grown.mask / 4 * 3 < count)
        grown.mask = grown.mask * 2 + 1;
    grown.room = grown.mask / 4 * 3;
    grown.slots = ARENA_ZEROED(arena, struct map_slot, (size_t)grown.mask + 1);
    for (uint32_t i = 0; grown.slots && map->slots && i <= map->mask; i++) {
        if (map->slots[i].key) {
            *rg_map_find(&grown, map->slots[i].key) = map->slots[i];
            grown.room--;
        }
    }
    if (grown.slots)
        *map = grown;
    return grown.slots;
}

bool rg_map_add_text(struct arena *arena, struct map *set, const char *text)
{
    uint64_t hash = UINT64_C(14695981039346656037); /* FNV-1a */
    for (const char *c = text; *c; c++)
        hash = (hash ^ (unsigned char)*c) * UINT64_C(1099511628211);
    void **value;
    while ((value = rg_map_value(arena, set, (const void *)(uintptr_t)(hash | 1))) && *value) {
        if (!strcmp(*value, text))
            return true;
        hash += 2; /* another string has this hash */
    }
    if (value)
        *value = (void *)(uintptr_t)text;
    return false;
}
