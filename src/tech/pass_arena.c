/* pass_arena.c: arena allocator for pass tables, in blocks that are freed together. */
#include "src/tech/pass_arena.h"
#include <stdalign.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK_SIZE = 1 << 14 /* bytes; larger objects get own blocks */
};

struct pass_block {
    struct pass_block *next;
    size_t used, size;
    alignas(max_align_t) unsigned char bytes[];
};

static struct pass_block *add_block(struct pass_arena *builder, size_t size)
{
    struct pass_block *block = calloc(1, sizeof(*block) + size);
    if (!block)
        return NULL;
    block->size = size;
    block->next = builder->blocks;
    builder->blocks = block;
    return block;
}

void *pass_arena_alloc(struct pass_arena *builder, size_t size)
{
    const size_t room =
        (size + alignof(max_align_t) - 1) / alignof(max_align_t) * alignof(max_align_t);
    struct pass_block *block = builder->blocks;
    if (!block || block->size - block->used < room)
        block = add_block(builder, room > BLOCK_SIZE ? room : BLOCK_SIZE);
    if (!block) {
        builder->failed = true;
        return NULL;
    }
    void *memory = &block->bytes[block->used];
    block->used += room;
    return memory;
}

static void *copy(struct pass_arena *builder, const void *object, size_t size)
{
    void *memory = pass_arena_alloc(builder, size);
    if (memory)
        memcpy(memory, object, size);
    return memory;
}

struct rg_pass *pass_arena_copy_passes(struct pass_arena *builder, const struct rg_pass *table,
                                       size_t count)
{
    return copy(builder, table, count * sizeof(*table));
}

const char *pass_arena_name(struct pass_arena *builder, const char *prefix, const char *name)
{
    const size_t size = strlen(prefix) + strlen(name) + 2;
    char *full = pass_arena_alloc(builder, size);
    if (full)
        snprintf(full, size, "%s.%s", prefix, name);
    return full;
}

const struct rg_target *pass_arena_target(struct pass_arena *builder, struct rg_target target)
{
    return copy(builder, &target, sizeof(target));
}

static size_t count_uses(const struct rg_use *uses)
{
    size_t count = 0;
    while (uses && uses[count].access)
        count++;
    return count;
}

const struct rg_use *pass_arena_join_uses(struct pass_arena *builder,
                                          const struct rg_use *const *lists, size_t count)
{
    size_t all = 0;
    for (size_t i = 0; i < count; i++)
        all += count_uses(lists[i]);
    struct rg_use *uses = pass_arena_alloc(builder, (all + 1) * sizeof(*uses));
    size_t used = 0;
    for (size_t i = 0; i < count && uses; i++) {
        const size_t more = count_uses(lists[i]);
        if (more)
            memcpy(&uses[used], lists[i], more * sizeof(*uses));
        used += more;
    }
    return uses;
}

struct rg_target *pass_arena_copy_targets(struct pass_arena *builder,
                                          const struct rg_target *targets, uint32_t count)
{
    return count ? copy(builder, targets, count * sizeof(*targets)) : NULL;
}

struct rg_use *pass_arena_copy_uses(struct pass_arena *builder, const struct rg_use *uses)
{
    return uses ? copy(builder, uses, (count_uses(uses) + 1) * sizeof(*uses)) : NULL;
}

void pass_arena_finish(struct pass_arena *builder)
{
    while (builder->blocks) {
        struct pass_block *next = builder->blocks->next;
        free(builder->blocks);
        builder->blocks = next;
    }
    *builder = (struct pass_arena){ 0 };
}
