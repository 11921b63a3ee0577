/*
 * rg_former.c: who used a resource's memory before it.
 *
 * A list of the block's bytes says who has them at some time of the frame, and who had them last.
 * Everybody there came before in the frame before, the resource itself among them. That somebody
 * in between has waited for them does not count: a barrier is about the memory of its image.
 */
#include <string.h>
#include "graph/rg_internal.h"

/* With more of either, barriers wait for more than they must, and the cost stays linear. */
enum {
    SEGMENTS = 256, /* resources count as lying on whole segments that they only touch */
    CLASSES = 32,   /* all further classes are one */
};

/* Bytes from `begin` up to where the next segment begins. */
struct segment {
    VkDeviceSize begin;
    uint32_t classes; /* of all who have them, a bit each */
    uint32_t end;     /* the first pass after whoever had them last */
};

struct owners {
    struct segment segments[SEGMENTS]; /* rising; the first one begins at 0 */
    uint32_t count;
    struct former classes[CLASSES]; /* of items that leave the same behind */
    uint32_t class_count;
};

/* The last segment that begins at or before an offset. */
static uint32_t segment_at(const struct owners *o, VkDeviceSize offset)
{
    const struct segment *base = o->segments;
    for (uint32_t count = o->count; count > 1;) {
        uint32_t half = count / 2;
        base = base[half].begin <= offset ? base + half : base;
        count -= half;
    }
    return (uint32_t)(base - o->segments);
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

static uint32_t class_bit(struct owners *o, const struct former *left)
{
    uint32_t i = 0;
    while (i < o->class_count &&
           (o->classes[i].stages != left->stages || o->classes[i].writes != left->writes))
        i++;
    if (i == CLASSES) {
        o->classes[--i].stages |= left->stages;
        o->classes[i].writes |= left->writes;
    } else if (i == o->class_count) {
        o->classes[o->class_count++] = *left;
    }
    return UINT32_C(1) << i;
}

/* Puts an item on its bytes; notes which pass of this frame they were used in before. */
static void put(struct owners *o, struct pack_item *item, const struct former *left)
{
    uint32_t first = split(o, item->offset);
    uint32_t bit = class_bit(o, left);
    uint32_t last = item->last + 1;
    uint32_t end = 0;
    VkDeviceSize stop = item->offset + item->size;
    split(o, stop);
    for (struct segment *s = &o->segments[first]; s < &o->segments[o->count] && s->begin < stop;
         s++) {
        end = end < s->end ? s->end : end;
        s->end = s->end < last ? last : s->end;
        s->classes |= bit;
    }
    item->former_end = end < item->first ? end : item->first; /* a neighbour may live longer */
}

static void get(const struct owners *o, struct pack_item *item)
{
    uint32_t classes = 0;
    VkDeviceSize stop = item->offset + item->size;
    for (const struct segment *s = &o->segments[segment_at(o, item->offset)];
         s < &o->segments[o->count] && s->begin < stop; s++)
        classes |= s->classes;
    item->former_stages = item->former_writes = 0;
    for (uint32_t i = 0; classes; i++, classes >>= 1) {
        item->former_stages |= classes & 1 ? o->classes[i].stages : 0;
        item->former_writes |= classes & 1 ? o->classes[i].writes : 0;
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
    owners->class_count = 0;
    for (uint32_t i = 0; i < count; i++)
        put(owners, &items[i], &left[i]);
    for (uint32_t i = 0; i < count; i++)
        get(owners, &items[i]);
}
