/* memory_blocks.c: assigns transient resources to memory blocks and offsets (pack_memory.c). Images
 * and buffers have separate blocks, so bufferImageGranularity never applies. Each memory type has
 * its own blocks. */
#include <string.h>
#include "graph/compile/compiler.h"

static bool fits_block(const struct pack_item *item, const struct rg_block *block)
{
    return !item->resource->image == block->buffers && item->type_bits == block->type_bits;
}

/* Moves the resources that may be in `block` to the front, in order. Returns their number. */
static uint32_t gather(struct compiler *c, struct pack_item *items, uint32_t count,
                       const struct rg_block *block)
{
    uint32_t same = 0;
    uint32_t other_count = 0;
    while (same < count && fits_block(&items[same], block))
        same++;
    const uint32_t first_other = same;
    struct pack_item *others = ARENA_ARRAY(c->arena, struct pack_item, count - first_other);
    for (uint32_t i = first_other; i < count && others; i++) {
        if (fits_block(&items[i], block))
            items[same++] = items[i];
        else
            others[other_count++] = items[i];
    }
    if (other_count)
        memcpy(&items[same], others, other_count * sizeof(*items));
    return same;
}

static void place_block(struct compiler *c, uint32_t first, uint32_t count, struct rg_block *block)
{
    struct rg_plan *plan = c->plan;
    bool unaliased = c->params->sharing == RG_SHARE_NOTHING;
    struct pack_item *items = &c->items[first];
    struct pack_result packed = rg_pack(c->arena, items, count, plan->pass_count, unaliased);
    block->size = packed.size;
    block->alignment = packed.alignment;
    plan->memory_used += packed.size;
    plan->memory_without_aliasing += packed.unaliased;
    plan->memory_bound += packed.bound;
    plan->memory_least += packed.min_bound;
    for (uint32_t i = 0; i < count; i++) {
        const struct resource *r = items[i].resource;
        items[i].block = plan->block_count;
        if (r->image) {
            c->images[r->plan_image].block = plan->block_count;
            c->images[r->plan_image].offset = items[i].offset;
        } else {
            c->buffers[r->plan_buffer].block = plan->block_count;
            c->buffers[r->plan_buffer].offset = items[i].offset;
        }
    }
    plan->block_count++;
}

void rg_pack_blocks(struct compiler *c)
{
    struct rg_block *blocks = NULL;
    uint32_t room = 0;
    bool unaliased = c->params->sharing == RG_SHARE_NOTHING; /* then no memory is reused */
    for (uint32_t i = 0; i < c->item_count; i++) {
        const struct resource *r = c->items[i].resource;
        c->items[i].first = unaliased ? r->first : r->acquired_before;
    }
    for (uint32_t done = 0; done < c->item_count;) {
        const struct pack_item *item = &c->items[done];
        if (!ARENA_ROOM(c->arena, blocks, c->plan->block_count, room, 4))
            return;
        struct rg_block *block = &blocks[c->plan->block_count];
        *block = (struct rg_block){
            .type_bits = item->type_bits,
            .buffers = !item->resource->image,
        };
        uint32_t count = gather(c, &c->items[done], c->item_count - done, block);
        if (c->arena->failed)
            return;
        place_block(c, done, count, block);
        done += count;
    }
    c->plan->blocks = blocks;
}
