/*
 * rg_former.c: who used a resource's memory before it.
 *
 * A list of the block's bytes says who has them at some time of the frame, and who had them last.
 * Everybody there came before in the frame before, the resource itself among them. That somebody
 * in between has waited for them does not count: a barrier is about the memory of its image.
 */
#include <string.h>
#include "graph/rg_internal.h"

enum {
    /* With more, some resources count as lying on whole segments that they only touch: their
     * barriers wait for more than they must. So the cost stays linear. */
    SEGMENTS = 256
};

/* Bytes from `begin` up to where the next segment begins. */
struct segment {
    VkDeviceSize begin;
    struct former left; /* by all who have them */
    uint32_t end;       /* the first pass after whoever had them last */
};

struct owners {
    struct segment segments[SEGMENTS]; /* rising; the first one begins at 0 */
    uint32_t count;
};

/* The last segment that begins at or before an offset. */
static uint32_t segment_at(const struct owners *o, VkDeviceSize offset)
{
    uint32_t low = 0;
    uint32_t high = o->count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (o->segments[middle].begin <= offset)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Index of the segment that begins at an offset; if there is no room for it, of the one that holds
 * it. */
static uint32_t split(struct owners *o, VkDeviceSize offset)
{
    uint32_t i = segment_at(o, offset);
    if (o->segments[i].begin == offset || o->count == SEGMENTS)
        return i;
    memmove(&o->segments[i + 1], &o->segments[i], (o->count - i) * sizeof(*o->segments));
    o->count++;
    o->segments[i + 1].begin = offset;
    return i + 1;
}

static bool is_part(const struct owners *o, uint32_t segment, const struct pack_item *item)
{
    return segment < o->count && o->segments[segment].begin < item->offset + item->size;
}

/* Puts an item on its bytes; notes which pass of this frame they were used in before. */
static void put(struct owners *o, struct pack_item *item, const struct former *left)
{
    uint32_t first = split(o, item->offset);
    split(o, item->offset + item->size);
    uint32_t end = 0;
    for (uint32_t i = first; is_part(o, i, item); i++) {
        struct segment *s = &o->segments[i];
        end = end < s->end ? s->end : end;
        s->left.stages |= left->stages;
        s->left.writes |= left->writes;
        s->end = s->end < item->last + 1 ? item->last + 1 : s->end;
    }
    item->former_end = end < item->first ? end : item->first; /* a neighbour may live longer */
}

static void get(const struct owners *o, struct pack_item *item)
{
    item->former_stages = item->former_writes = 0;
    for (uint32_t i = segment_at(o, item->offset); is_part(o, i, item); i++) {
        item->former_stages |= o->segments[i].left.stages;
        item->former_writes |= o->segments[i].left.writes;
    }
}

void rg_former(struct arena *arena, struct pack_item *items, const struct former *left,
               uint32_t count)
{
    struct owners *owners = ARENA_ARRAY(arena, struct owners, 1);
    if (!owners)
        return;
    owners->segments[0] = (struct segment){ 0 };
    owners->count = 1;
    for (uint32_t i = 0; i < count; i++)
        put(owners, &items[i], &left[i]);
    for (uint32_t i = 0; i < count; i++)
        get(owners, &items[i]);
}
