/*
 * previous_owner.c: how the accesses end that had an item's memory before it.
 *
 * In a frame, the items that had some of its bytes before it; over the end of a frame, all items
 * that have some of its bytes, the item itself among them. That a barrier in between has waited for
 * an owner does not count: a barrier is about the memory of its own resource.
 */
#include <string.h>
#include "graph/compile/compiler.h"

enum {
    MAX_SEGMENTS = 256 /* beyond it items count as having whole segments, so that barriers wait for
                          more than they must; the cost stays linear */
};

/* The bytes of a block from `begin` to the next segment, and how the accesses to them end. */
struct segment {
    VkDeviceSize begin;
    struct previous_owner left;
};

struct segments {
    struct segment items[MAX_SEGMENTS]; /* rising; the first begins at 0 */
    uint32_t count;
};

static void split(struct segments *s, uint32_t i, VkDeviceSize offset)
{
    memmove(&s->items[i + 1], &s->items[i], (s->count++ - i) * sizeof(*s->items));
    s->items[i + 1].begin = offset;
}

/* The last segment that begins at or before an offset. */
static uint32_t find(const struct segments *s, VkDeviceSize offset)
{
    uint32_t first = 0;
    for (uint32_t count = s->count; count > 1;) {
        uint32_t half = count / 2;
        first += s->items[first + half].begin <= offset ? half : 0;
        count -= half;
    }
    return first;
}

static void add(struct previous_owner *to, const struct previous_owner *left)
{
    to->stages |= left->stages;
    to->writes |= left->writes;
    to->end = to->end < left->end ? left->end : to->end;
}

static bool has_all(const struct previous_owner *a, const struct previous_owner *b)
{
    return !(b->stages & ~a->stages) && !(b->writes & ~a->writes) && b->end <= a->end;
}

/* Adds how the accesses to an item end to its bytes. A segment is split where only a part of it is
 * the item's, unless that changes nothing or there is no room. */
static void leave(struct segments *s, const struct pack_item *item,
                  const struct previous_owner *left)
{
    VkDeviceSize stop = item->offset + item->size;
    uint32_t i = find(s, item->offset);
    if (s->items[i].begin != item->offset && !has_all(&s->items[i].left, left) &&
        s->count < MAX_SEGMENTS)
        split(s, i++, item->offset);
    for (; i < s->count && s->items[i].begin < stop; i++) {
        if (has_all(&s->items[i].left, left))
            continue;
        if ((i + 1 == s->count || s->items[i + 1].begin > stop) && s->count < MAX_SEGMENTS)
            split(s, i, stop);
        add(&s->items[i].left, left);
    }
}

/* Adds how all accesses to an item's bytes end. */
static void look_up(const struct segments *s, const struct pack_item *item,
                    struct previous_owner *all)
{
    for (uint32_t i = find(s, item->offset);
         i < s->count && s->items[i].begin < item->offset + item->size; i++)
        add(all, &s->items[i].left);
}

static struct previous_owner *owner_of(const struct compiler *c, const struct pack_item *item)
{
    return &c->owners[item->resource->item];
}

/* Finds when the accesses of one block's items end. */
static void find_ends(struct compiler *c, struct segments *s, const struct pack_item *items,
                      uint32_t count)
{
    for (const struct pack_item *item = items; item < items + count; item++) {
        const struct previous_owner left = { .end = item->last + 1 };
        struct previous_owner *owner = owner_of(c, item);
        look_up(s, item, owner);
        if (owner->end > item->first) /* a neighbour may live on */
            owner->end = item->first;
        leave(s, item, &left);
    }
}

/* Adds what the last accesses to a resource do, and which writes are not available after the frame.
 */
static void find_left(const struct resource *r, struct previous_owner *left)
{
    for (uint32_t k = 0; k < r->cell_count; k++) {
        const struct cell *cell = &r->cells[k];
        bool awaited = cell->flags & CELL_AWAITED;
        left->stages |= cell->read_stages | (awaited ? 0 : cell->write_stages);
        left->writes |= awaited ? 0 : cell->write_access;
    }
}

/* Finds the owners of one block's items. What is left of all items is left of all bytes, so that
 * only what is more splits segments. */
static void find_owners(struct compiler *c, struct segments *s, const struct pack_item *items,
                        uint32_t count)
{
    const struct pack_item *end = items + count;
    struct previous_owner common = { UINT64_MAX, UINT64_MAX, 0 };
    for (const struct pack_item *item = items; item < end; item++) {
        struct previous_owner *owner = owner_of(c, item);
        owner->end = 0;
        find_left(item->resource, owner);
        common.stages &= owner->stages;
        common.writes &= owner->writes;
    }
    if (c->params->sharing == RG_SHARE_NOTHING) /* each has been its own */
        return;
    s->items[0].left = common;
    for (const struct pack_item *item = items; item < end; item++) {
        if (!has_all(&common, owner_of(c, item)))
            leave(s, item, owner_of(c, item));
    }
    for (const struct pack_item *item = items; item < end; item++)
        look_up(s, item, owner_of(c, item));
}

typedef void find_fn(struct compiler *c, struct segments *s, const struct pack_item *items,
                     uint32_t count);

static void each_block(struct compiler *c, find_fn *find_in_block)
{
    struct segments *segments = ARENA_ARRAY(c->arena, struct segments, 1);
    if (!c->owners)
        c->owners = ARENA_ZEROED(c->arena, struct previous_owner, c->item_count);
    for (uint32_t done = 0, end; done < c->item_count && !c->arena->failed; done = end) {
        for (end = done + 1; end < c->item_count && c->items[end].block == c->items[done].block;)
            end++;
        segments->items[0] = (struct segment){ 0 };
        segments->count = 1;
        find_in_block(c, segments, &c->items[done], end - done);
    }
}

void rg_find_owner_ends(struct compiler *c)
{
    each_block(c, find_ends);
}

void rg_find_owners(struct compiler *c)
{
    each_block(c, find_owners);
    for (uint32_t i = 0; i < c->plan->barrier_count && !c->arena->failed; i++) {
        struct rg_barrier *b = &c->barriers[i];
        if (b->src_stages)
            continue;
        const struct previous_owner *owner = &c->owners[b->src_access]; /* as barriers.c left it */
        b->src_stages = owner->stages;
        b->src_access = owner->writes;
    }
}
