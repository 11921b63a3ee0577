/*
 * memory.c: the block of memory of every transient resource, its place there, and who had it.
 *
 * Resources that do not need their memory at the same time may share bytes (rg_pack.c). Images and
 * buffers, and resources of different memory types, live in blocks of their own, so
 * bufferImageGranularity never matters.
 */
#include <string.h>
#include "graph/compile/compiler.h"

static bool same_kind(const struct pack_item *a, const struct pack_item *b)
{
    return a->is_buffer == b->is_buffer && a->type_bits == b->type_bits;
}

/* Brings all items of the kind of the first one to the front, in their order. */
static uint32_t gather(struct compiler *c, struct pack_item *items, uint32_t count)
{
    uint32_t same = 1;
    while (same < count && same_kind(&items[same], items))
        same++;
    if (same == count)
        return same;
    struct pack_item *others = ARENA_ARRAY(c->arena, struct pack_item, count);
    uint32_t other_count = 0;
    for (uint32_t i = same; i < count && others; i++) {
        if (same_kind(&items[i], &items[0]))
            items[same++] = items[i];
        else
            others[other_count++] = items[i];
    }
    if (other_count)
        memcpy(&items[same], others, other_count * sizeof(*items));
    return same;
}

static void set_places(const struct pack_item *items, uint32_t count, uint32_t block)
{
    const struct pack_item *end = items + count;
    for (const struct pack_item *item = items; item < end && !items->is_buffer; item++) {
        item->image->block = block;
        item->image->offset = item->offset;
    }
    for (const struct pack_item *item = items; item < end && items->is_buffer; item++) {
        item->buffer->block = block;
        item->buffer->offset = item->offset;
    }
}

static void place_block(struct compiler *c, struct pack_item *items, uint32_t count,
                        struct rg_block *block)
{
    struct rg_plan *plan = c->plan;
    struct pack_result packed =
        rg_pack(c->arena, items, count, plan->pass_count, c->params->sharing == RG_SHARE_NOTHING);
    VkDeviceSize alignments = packed.alignments; /* the highest bit is the largest one */
    while (alignments & (alignments - 1))
        alignments &= alignments - 1;
    *block = (struct rg_block){
        .size = packed.size,
        .alignment = alignments,
        .type_bits = items->type_bits,
        .buffers = items->is_buffer,
    };
    plan->memory_used += packed.size;
    plan->memory_without_aliasing += packed.apart;
    plan->memory_bound += packed.bound;
    plan->memory_least += packed.least;
    set_places(items, count, plan->block_count++);
}

static void find_moved(struct compiler *c)
{
    c->item_places = ARENA_ARRAY(c->arena, uint32_t, c->item_count);
    for (uint32_t i = 0; i < c->item_count && c->item_places; i++) {
        uint32_t *item = &c->items[i].resource->item;
        c->item_places[*item] = i;
        *item = i;
    }
}

void rg_place(struct compiler *c)
{
    uint32_t block_room = 0;
    struct rg_block *blocks = NULL;
    bool moved = false;
    for (uint32_t done = 0; done < c->item_count && !c->arena->failed;) {
        struct pack_item *items = &c->items[done];
        uint32_t count = gather(c, items, c->item_count - done);
        if (!ARENA_ROOM(c->arena, blocks, c->plan->block_count, block_room, 4))
            return;
        place_block(c, items, count, &blocks[c->plan->block_count]);
        moved = moved || count < c->item_count;
        done += count;
    }
    c->plan->blocks = blocks;
    if (moved)
        find_moved(c);
}

typedef void former_fn(struct arena *arena, const struct pack_item *items, struct former *formers,
                       uint32_t count);

static void each_block(struct compiler *c, former_fn *find)
{
    uint32_t done = 0;
    while (done < c->item_count) {
        uint32_t count = c->plan->block_count == 1 ? c->item_count : 1;
        while (done + count < c->item_count && same_kind(&c->items[done], &c->items[done + count]))
            count++;
        find(c->arena, &c->items[done], &c->formers[done], count);
        done += count;
    }
}

void rg_place_ends(struct compiler *c)
{
    c->formers = ARENA_ARRAY(c->arena, struct former, c->item_count);
    if (!c->arena->failed)
        each_block(c, rg_former_ends);
}

void rg_place_left(struct compiler *c)
{
    if (!c->formers)
        c->formers = ARENA_ARRAY(c->arena, struct former, c->item_count);
    if (!c->arena->failed)
        each_block(c, c->params->sharing == RG_SHARE_NOTHING ? rg_former_itself : rg_former_left);
}
