/*
 * arena.h: memory that is given back all at once: the caller's first, then from malloc. Private to
 * graph/compile/.
 */
#ifndef RG_COMPILE_ARENA_H
#define RG_COMPILE_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* After a failed allocation `failed` stays true, and no further allocation succeeds. */
struct arena {
    char *next, *end;           /* room left in the newest chunk */
    struct arena_chunk *chunks; /* from malloc */
    size_t used;                /* bytes handed out, those for alignment included */
    bool failed;
};

/* `memory` may be NULL. */
void rg_arena_init(struct arena *arena, void *memory, size_t size);
void rg_arena_finish(struct arena *arena);

/* Returns room for count elements, aligned for any type; NULL when memory is short. */
void *rg_arena_alloc(struct arena *arena, size_t count, size_t element_size);
void *rg_arena_zeroed(struct arena *arena, size_t count, size_t element_size);

#define ARENA_ARRAY(arena, type, count)  ((type *)rg_arena_alloc((arena), (count), sizeof(type)))
#define ARENA_ZEROED(arena, type, count) ((type *)rg_arena_zeroed((arena), (count), sizeof(type)))

/* Returns a larger copy of a full array of *room elements: doubled, at least `least`. Returns the
 * array itself when memory is short. */
void *rg_arena_grow(struct arena *arena, void *array, uint32_t *room, uint32_t least,
                    size_t element_size);

/* Makes room for one more element at array[count]; false when memory is short. */
#define ARENA_ROOM(arena, array, count, room, least) \
    ((count) < (room) || \
     ((array) = rg_arena_grow((arena), (array), &(room), (least), sizeof(*(array))), \
      !(arena)->failed))

#endif
