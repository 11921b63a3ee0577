/*
 * previous_owner.c: who used a resource's memory before it.
 *
 * Whoever has some of an item's bytes in a frame came before it in the frame before, the item
 * itself among them. That somebody in between has waited for them does not count: a barrier is
 * about the memory of its image.
 */
#include <string.h>
#include "graph/compile/compiler.h"

/* With more of any, barriers wait for more than they must, or as early as they may not need to; the
 * cost stays linear. */
enum {
    SEGMENTS = 256, /* items count as lying on whole segments that they only touch */
    CLASSES = 16,   /* all further classes are one */
    SPANS = 64,     /* of a class: it counts as having what lies between two of them */
};

/* ---- what they leave ---- */

/* Items that leave the same behind. */
struct class
{
    struct former left;
    uint32_t count;
    struct span spans[SPANS + 1]; /* of bytes that they have, and the one after the last */
};

struct owners {
    struct class classes[CLASSES];
    uint32_t count;
};

static bool is_same(const struct former *a, const struct former *b)
{
    return a->stages == b->stages && a->writes == b->writes;
}

/* Whether `b` adds nothing to `a`. */
static inline bool has_all(const struct former *a, const struct former *b)
{
    return !((b->stages & ~a->stages) | (b->writes & ~a->writes));
}

static struct class *find_class(struct owners *o, const struct former *left)
{
    for (uint32_t i = 0; i < o->count; i++) {
        if (is_same(&o->classes[i].left, left))
            return &o->classes[i];
    }
    if (o->count == CLASSES) {
        struct class *last = &o->classes[CLASSES - 1];
        last->left.stages |= left->stages;
        last->left.writes |= left->writes;
        return last;
    }
    struct class *new = &o->classes[o->count++];
    new->left = *left;
    new->count = 0;
    new->spans[0] = (struct span){ UINT64_MAX, UINT64_MAX };
    return new;
}

/* The first span that does not end before an offset. */
static inline const struct span *find_span(const struct class *c, VkDeviceSize offset)
{
    const struct span *span = c->spans;
    while (span->end < offset)
        span++;
    return span;
}

static void add_span(struct class *c, struct span span)
{
    uint32_t first = (uint32_t)(find_span(c, span.begin) - c->spans);
    uint32_t end = first;
    while (c->spans[end].begin <= span.end)
        end++;
    if (first == end && c->count == SPANS) {
        first -= first == SPANS;
        end = first + 1;
    }
    if (first == end) {
        rg_span_insert(&c->spans[first], span);
        c->count++;
        return;
    }
    struct span *joined = &c->spans[first];
    joined->end = c->spans[end - 1].end < span.end ? span.end : c->spans[end - 1].end;
    joined->begin = span.begin < joined->begin ? span.begin : joined->begin;
    if (first + 1 < end)
        memmove(joined + 1, &c->spans[end], (c->count + 1 - end) * sizeof(span));
    c->count -= end - first - 1;
}

static inline bool has_any(const struct class *c, struct span span)
{
    return find_span(c, span.begin + 1)->begin < span.end;
}

static struct span span_of(const struct pack_item *item)
{
    return (struct span){ item->offset, item->offset + item->size };
}

/* What its last users do, and what of it is not yet available when the frame is over. */
static inline void add_left(struct former *left, const struct cell *s)
{
    uint64_t unless_awaited = s->flags & CELL_AWAITED ? 0 : UINT64_MAX;
    left->stages |= s->read_stages | (s->write_stages & unless_awaited);
    left->writes |= s->write_access & unless_awaited;
}

static inline struct former find_left(const struct resource *r)
{
    struct former left = { 0 };
    add_left(&left, r->cells);
    for (uint32_t k = 1; k < r->cell_count; k++)
        add_left(&left, &r->cells[k]);
    return left;
}

static inline void set_left(struct former *former, const struct former *left)
{
    former->stages = left->stages;
    former->writes = left->writes;
}

void rg_former_itself(struct arena *arena, const struct pack_item *items, struct former *formers,
                      uint32_t count)
{
    (void)arena;
    for (uint32_t i = 0; i < count; i++) {
        struct former left = find_left(items[i].resource);
        set_left(&formers[i], &left);
    }
}

/* Adds what a class leaves to all that find it. */
static void add_class(const struct class *c, const struct pack_item *items, struct former *formers,
                      uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uint64_t if_any = has_any(c, span_of(&items[i])) ? UINT64_MAX : 0;
        formers[i].stages |= c->left.stages & if_any;
        formers[i].writes |= c->left.writes & if_any;
    }
}

/* What everybody leaves is left everywhere; only who leaves more is looked for. */
void rg_former_left(struct arena *arena, const struct pack_item *items, struct former *formers,
                    uint32_t count)
{
    struct former everybody = { UINT64_MAX, UINT64_MAX, 0 };
    struct former anybody = { 0 };
    for (uint32_t i = 0; i < count; i++) {
        const struct former left = find_left(items[i].resource);
        everybody.stages &= left.stages;
        everybody.writes &= left.writes;
        anybody.stages |= left.stages;
        anybody.writes |= left.writes;
        set_left(&formers[i], &left);
    }
    if (has_all(&everybody, &anybody))
        return;
    struct owners *owners = ARENA_ARRAY(arena, struct owners, 1);
    if (!owners)
        return;
    owners->count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!has_all(&everybody, &formers[i]))
            add_span(find_class(owners, &formers[i]), span_of(&items[i]));
    }
    for (uint32_t k = 0; k < owners->count; k++)
        add_class(&owners->classes[k], items, formers, count);
}

/* ---- when they are over ---- */

/* Bytes from `begin` up to where the next segment begins. */
struct segment {
    VkDeviceSize begin;
    uint32_t end;  /* the first pass after whoever had them last */
    uint32_t next; /* 0: none */
};

struct segments {
    struct segment items[SEGMENTS];
    uint8_t rising[SEGMENTS]; /* of their indices; the first one begins at 0 */
    uint32_t count;
};

/* Where in `rising` the last segment is that begins at or before an offset. */
static uint32_t find(const struct segments *s, VkDeviceSize offset)
{
    const uint8_t *base = s->rising;
    for (uint32_t count = s->count; count > 1;) {
        uint32_t half = count / 2;
        base = s->items[base[half]].begin <= offset ? base + half : base;
        count -= half;
    }
    return (uint32_t)(base - s->rising);
}

/* Makes another segment of what lies behind an offset in that of `rising[i]`. */
static void split(struct segments *s, uint32_t i, VkDeviceSize offset)
{
    struct segment *split = &s->items[s->rising[i]];
    memmove(&s->rising[i + 2], &s->rising[i + 1], s->count - i - 1);
    s->items[s->count] = *split;
    s->items[s->count].begin = offset;
    split->next = s->count;
    s->rising[i + 1] = (uint8_t)s->count++;
}

/* Puts an item on its bytes; returns from when on nobody has had them. */
static uint32_t put(struct segments *s, const struct pack_item *item)
{
    uint32_t i = find(s, item->offset);
    if (s->items[s->rising[i]].begin != item->offset && s->count < SEGMENTS)
        split(s, i++, item->offset);
    uint32_t last = item->last + 1;
    uint32_t end = 0;
    VkDeviceSize stop = item->offset + item->size;
    for (uint32_t next = s->rising[i];; i++) {
        struct segment *at = &s->items[next];
        if ((!at->next || s->items[at->next].begin > stop) && s->count < SEGMENTS)
            split(s, i, stop);
        end = end < at->end ? at->end : end;
        at->end = at->end < last ? last : at->end;
        next = at->next;
        if (!next || s->items[next].begin >= stop)
            break;
    }
    return end < item->first ? end : item->first; /* a neighbour may live longer */
}

void rg_former_ends(struct arena *arena, const struct pack_item *items, struct former *formers,
                    uint32_t count)
{
    struct segments *segments = ARENA_ARRAY(arena, struct segments, 1);
    if (!segments)
        return;
    segments->items[0] = (struct segment){ 0 };
    segments->rising[0] = 0;
    segments->count = 1;
    for (uint32_t i = 0; i < count; i++)
        formers[i].end = put(segments, &items[i]);
}
