/*
 * arena.h: memory that is given back all at once: the caller's first, then from malloc. Private
 * to graph/.
 */
#ifndef RG_COMPILE_ARENA_H
#define RG_COMPILE_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Memory that is given back all at once. After a failed allocation `failed` stays true. */
struct arena {
    char *next, *end;           /* room left in the newest chunk */
    struct arena_chunk *chunks; /* from malloc */
    size_t used;                /* bytes handed out, with what alignment takes */
    bool failed;
};

static inline size_t rg_arena_align(size_t size)
{
    return (size + _Alignof(max_align_t) - 1) & ~(_Alignof(max_align_t) - 1);
}

/* `memory` may be NULL. */
void rg_arena_init(struct arena *arena, void *memory, size_t size);
void rg_arena_finish(struct arena *arena);

/* The same of what the newest chunk has no room for, or nothing has. */
void *rg_arena_alloc_more(struct arena *arena, size_t count, size_t element_size);

/* Room for count elements, aligned for any type; NULL when memory is short. */
static inline void *rg_arena_alloc(struct arena *arena, size_t count, size_t element_size)
{
    size_t room = (size_t)(arena->end - arena->next);
    if (arena->failed || count > UINT32_MAX || element_size > UINT16_MAX ||
        rg_arena_align(count * element_size) > room)
        return rg_arena_alloc_more(arena, count, element_size);
    void *data = arena->next;
    size_t size = rg_arena_align(count * element_size);
    arena->next += size;
    arena->used += size;
    return data;
}

void *rg_arena_zeroed(struct arena *arena, size_t count, size_t element_size);

#define ARENA_ARRAY(arena, type, count)  ((type *)rg_arena_alloc((arena), (count), sizeof(type)))
#define ARENA_ZEROED(arena, type, count) ((type *)rg_arena_zeroed((arena), (count), sizeof(type)))

/* A larger copy of a full array of *room elements: doubled, at least `least`. The array itself when
 * memory is short. */
void *rg_arena_grow(struct arena *arena, void *array, uint32_t *room, uint32_t least,
                    size_t element_size);

/* Room for one more element at array[count]; false when memory is short. */
#define ARENA_ROOM(arena, array, count, room, least) \
    ((count) < (room) || \
     ((array) = rg_arena_grow((arena), (array), &(room), (least), sizeof(*(array))), \
      !(arena)->failed))

#endif
