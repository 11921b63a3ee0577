/* rg_arena.c: memory that is freed all at once. */
#include <stdlib.h>
#include "graph/rg_internal.h"

enum {
    CHUNK_SIZE = 16384
};

struct arena_chunk {
    struct arena_chunk *next;
    size_t used, size; /* bytes of data */
    max_align_t data[];
};

static struct arena_chunk *add_chunk(struct arena *arena, size_t size)
{
    if (size < CHUNK_SIZE)
        size = CHUNK_SIZE;
    struct arena_chunk *chunk = calloc(1, sizeof(*chunk) + size);
    if (!chunk)
        return NULL;
    chunk->next = arena->chunks;
    chunk->size = size;
    arena->chunks = chunk;
    arena->size += sizeof(*chunk) + size;
    return chunk;
}

void *arena_alloc(struct arena *arena, size_t count, size_t element_size)
{
    const size_t align = _Alignof(max_align_t);
    size_t size;
    if (arena->failed || __builtin_mul_overflow(count, element_size, &size) ||
        size > SIZE_MAX / 2) {
        arena->failed = true;
        return NULL;
    }
    size = (size + align - 1) / align * align;

    struct arena_chunk *chunk = arena->chunks;
    if (!chunk || chunk->size - chunk->used < size)
        chunk = add_chunk(arena, size);
    if (!chunk) {
        arena->failed = true;
        return NULL;
    }
    void *data = (char *)chunk->data + chunk->used;
    chunk->used += size;
    return data;
}

void arena_finish(struct arena *arena)
{
    while (arena->chunks) {
        struct arena_chunk *next = arena->chunks->next;
        free(arena->chunks);
        arena->chunks = next;
    }
}
