/* alias_dependencies.c: finds which accesses must finish before a transient resource may reuse
 * memory: those of all resources that use these bytes, in this frame or the previous one. */
#include <string.h>
#include "graph/compile/compiler.h"

enum {
    /* maximum number of segments per memory block; with fewer, barriers may wait too long */
    MAX_SEGMENTS = 256
};

/* Part of a memory block, up to the next segment's `begin`, and the last accesses to this part. */
struct segment {
    VkDeviceSize begin;
    struct previous_owner pending;
};

struct segments {
    struct segment items[MAX_SEGMENTS]; /* ascending; the first begins at 0 */
    uint32_t count;
};

static void split(struct segments *s, uint32_t i, VkDeviceSize offset)
{
    memmove(&s->items[i + 1], &s->items[i], (s->count++ - i) * sizeof(*s->items));
    s->items[i + 1].begin = offset;
}

/* Returns the index of the last segment that begins at or before an offset. */
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

static void add(struct previous_owner *to, const struct previous_owner *pending)
{
    to->stages |= pending->stages;
    to->writes |= pending->writes;
}

static bool covers(const struct previous_owner *a, const struct previous_owner *b)
{
    return !(b->stages & ~a->stages) && !(b->writes & ~a->writes);
}

/* Adds a resource's last accesses to the segments of its memory. Splits segments at its ends. */
static void record_accesses(struct segments *s, const struct pack_item *item,
                            const struct previous_owner *pending)
{
    VkDeviceSize stop = item->offset + item->size;
    uint32_t i = find(s, item->offset);
    if (s->items[i].begin != item->offset && !covers(&s->items[i].pending, pending) &&
        s->count < MAX_SEGMENTS)
        split(s, i++, item->offset);
    for (; i < s->count && s->items[i].begin < stop; i++) {
        if (covers(&s->items[i].pending, pending))
            continue;
        if ((i + 1 == s->count || s->items[i + 1].begin > stop) && s->count < MAX_SEGMENTS)
            split(s, i, stop);
        add(&s->items[i].pending, pending);
    }
}

/* Collects the accesses to a resource that may still be running at the end of the frame. */
static void find_pending(const struct resource *r, struct previous_owner *pending)
{
    *pending = (struct previous_owner){ 0 };
    for (uint32_t k = 0; k < r->cell_count; k++) {
        const struct cell *cell = &r->cells[k];
        bool awaited = cell->flags & CELL_AWAITED;
        pending->stages |= cell->read_stages | (awaited ? 0 : cell->write_stages);
        pending->writes |= awaited ? 0 : cell->write_access;
    }
}

/* Collects the accesses to each resource's memory that may still run at the end of a frame. */
static void find_owners(struct compiler *c, struct segments *s, const struct pack_item *items,
                        uint32_t count)
{
    const struct pack_item *end = items + count;
    struct previous_owner common = { UINT64_MAX, UINT64_MAX };
    for (const struct pack_item *item = items; item < end; item++) {
        struct previous_owner *owner = &c->owners[item->resource->item];
        find_pending(item->resource, owner);
        common.stages &= owner->stages;
        common.writes &= owner->writes;
    }
    /* without aliasing, a resource is itself the previous owner of its memory */
    if (c->params->sharing == RG_SHARE_NOTHING)
        return;
    s->items[0].pending = common;
    for (const struct pack_item *item = items; item < end; item++) {
        const struct previous_owner *owner = &c->owners[item->resource->item];
        if (!covers(&common, owner))
            record_accesses(s, item, owner);
    }
    for (const struct pack_item *item = items; item < end; item++) {
        struct previous_owner *owner = &c->owners[item->resource->item];
        for (uint32_t i = find(s, item->offset);
             i < s->count && s->items[i].begin < item->offset + item->size; i++)
            add(owner, &s->items[i].pending);
    }
}

void rg_complete_alias_barriers(struct compiler *c)
{
    struct segments *segments = ARENA_ARRAY(c->arena, struct segments, 1);
    c->owners = ARENA_ARRAY(c->arena, struct previous_owner, c->item_count);
    for (uint32_t done = 0, end; done < c->item_count && !c->arena->failed; done = end) {
        for (end = done + 1; end < c->item_count && c->items[end].block == c->items[done].block;)
            end++;
        segments->items[0] = (struct segment){ 0 };
        segments->count = 1;
        find_owners(c, segments, &c->items[done], end - done);
    }
    for (uint32_t i = 0; i < c->plan->barrier_count && !c->arena->failed; i++) {
        struct rg_barrier *b = &c->barriers[i];
        if (b->src_stages)
            continue;
        /* index stored by barriers.c */
        const struct previous_owner *owner = &c->owners[b->src_access];
        b->src_stages = owner->stages;
        b->src_access = owner->writes;
    }
}
