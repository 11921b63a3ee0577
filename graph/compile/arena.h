/* arena.h: arena allocator that uses the caller's memory first, then malloc(), and an
 * arena-allocated hash map. Private to graph/compile/. */
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

/* ---- hash map ---- */

/* Slot of a hash map with open addressing. Initialise the map with {0} and rg_map_reserve(). */

struct map_slot {
    const void *key; /* NULL: empty slot */
    void *value;
};

struct map {
    struct map_slot *slots;
    uint32_t mask; /* number of slots minus 1 */
    uint32_t room; /* entries that can be added before it grows */
};

/* Returns the slot of an address, or the empty slot where it would be inserted. */
static inline struct map_slot *rg_map_find(const struct map *map, const void *address)
{
    /* this hash puts adjacent addresses into adjacent slots, but spreads power-of-two strides */
    uintptr_t i = ((uintptr_t)address + ((uintptr_t)address >> 9)) >> 4;
    while (map->slots[i & map->mask].key && map->slots[i & map->mask].key != address)
        i++;
    return &map->slots[i & map->mask];
}

/* Grows the map to a capacity of at least `count` entries. Returns false if out of memory. */
bool rg_map_reserve(struct arena *arena, struct map *map, uint32_t count);

/* Returns a pointer to an address's value, initially NULL. Returns NULL if out of memory. */
static inline void **rg_map_value(struct arena *arena, struct map *map, const void *address)
{
    if (!map->room && !rg_map_reserve(arena, map, map->mask))
        return NULL;
    struct map_slot *slot = rg_map_find(map, address);
    if (!slot->key) {
        slot->key = address;
        map->room--;
    }
    return &slot->value;
}

/* Adds a string to a string set, a map keyed by hashes. Returns true if the set already contained
 * it. The string is borrowed. */
bool rg_map_add_text(struct arena *arena, struct map *set, const char *text);

#endif
