/* arena.h: allocates from the caller's memory, then by malloc(). Private to graph/compile/. */
#ifndef RG_COMPILE_ARENA_H
#define RG_COMPILE_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Arena allocator. Once an allocation has failed, `failed` is true and all later ones fail too. */
struct arena {
    char *next, *end;           /* free space in the newest chunk */
    struct arena_chunk *chunks; /* allocated by malloc */
    size_t used;                /* bytes handed out, including alignment padding */
    bool failed;
};

/* Initialises an arena whose first chunk is the caller's `memory`, which may be NULL. */
void rg_arena_init(struct arena *arena, void *memory, size_t size);
void rg_arena_finish(struct arena *arena);

/* Returns memory for `count` elements, aligned for any type; NULL if out of memory. */
void *rg_arena_alloc(struct arena *arena, size_t count, size_t element_size);
void *rg_arena_zeroed(struct arena *arena, size_t count, size_t element_size);

#define ARENA_ARRAY(arena, type, count)  ((type *)rg_arena_alloc((arena), (count), sizeof(type)))
#define ARENA_ZEROED(arena, type, count) ((type *)rg_arena_zeroed((arena), (count), sizeof(type)))

/* Copies an array to one of twice the size, at least `min_room`. Returns the old one on failure. */
void *rg_arena_grow(struct arena *arena, void *array, uint32_t *room, uint32_t min_room,
                    size_t element_size);

/* Ensures room for an element at array[count]. Evaluates to false if out of memory. */
#define ARENA_ROOM(arena, array, count, room, min_room) \
    ((count) < (room) || \
     ((array) = rg_arena_grow((arena), (array), &(room), (min_room), sizeof(*(array))), \
      !(arena)->failed))

#endif
