/*
 * pack.c: the places of items in a block; items that live at the same time are apart.
 *
 * An instance of dynamic storage allocation, which is NP-hard; several orders are tried and the
 * smallest block wins. Each puts items one after another into the lowest gap that is free for their
 * whole life, until it has met the bound or lost. The first orders are by greedy rules; then, again
 * and again, the item that reached highest comes earlier (squeaky wheel optimization, Joslin and
 * Clements, JAIR 10, 1999).
 */
#include <string.h>
#include "graph/compile/compiler.h"

enum {
    PROMOTIONS = 8,    /* orders beside those of the rules */
    MANY = 512,        /* items beyond which only the first rules are tried, */
    RULES_OF_MANY = 2, /* so many, */
    FEW = 256,         /* items that are sorted faster without counting bytes */
    LONG_LIFE = 32,    /* and only time order if on average more than so many begin in a life */
};

/* In falling order of size and life, each to a power, multiplied. */
static const struct rule {
    unsigned size_power; /* 0, 1 or 4 */
    unsigned life_power; /* 0 or 1 */
} rules[] = {
    { 4, 1 },
    { 1, 0 },
    { 1, 1 },
    { 0, 1 },
};

enum {
    RULE_COUNT = sizeof(rules) / sizeof(rules[0])
};

/* Bytes that are taken. In a list they rise, none touches the next, the first one begins at 0 and
 * may be empty, and one more begins at UINT64_MAX. */
struct span {
    VkDeviceSize begin, end;
};

/*
 * Items that live together do so at the pass where the last of them begins, so no other passes
 * count. Of several such passes between which nothing ends, only the last one counts: a moment.
 */
struct moment {
    struct span *spans;
    struct span *next; /* the span above the gap in which the item at work fits */
    uint32_t alive;    /* items */
};

/* What changes from the pass before; unsigned, so decreases wrap. */
struct change {
    VkDeviceSize taken;    /* bytes */
    VkDeviceSize used;     /* bytes if items took their memory at their first use */
    struct moment *newest; /* of the moments so far */
    uint32_t begun, ended; /* items that begin at this pass, that end at the pass before */
};

struct packing {
    struct pack_item *items; /* with the offsets of the order at work */
    uint32_t count;
    struct change *changes; /* of each pass */
    struct moment *moments; /* in the order of time */
    struct moment *moments_end;
    struct span *spans;    /* room for those of all moments */
    VkDeviceSize *offsets; /* of each item, the best so far */
    uint64_t *order;       /* items in the lower half, keys in the upper */
    uint64_t *sorted;      /* room for the next order */
    uint32_t placed;       /* items that the order at work has placed before it lost or ended */
};

static VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) & ~(alignment - 1);
}

static VkDeviceSize end_of(const struct pack_item *item)
{
    return item->offset + item->size;
}

/* ---- moments ---- */

/* Fills `changes`, and `offsets` with the places of items if nothing is shared. */
static void find_changes(const struct packing *p, struct pack_result *result)
{
    struct change *changes = p->changes;
    for (uint32_t i = 0; i < p->count; i++) {
        const struct pack_item *item = &p->items[i];
        struct change *after = &changes[item->last + 1];
        p->offsets[i] = align_up(result->apart, item->alignment);
        result->apart = p->offsets[i] + item->size;
        if (result->alignment < item->alignment)
            result->alignment = item->alignment;
        changes[item->first].taken += item->size;
        changes[item->first].begun++;
        changes[item->first_use].used += item->size;
        after->taken -= item->size;
        after->used -= item->size;
        after->ended++;
    }
}

/* Fills `moments` and the bounds. Returns the number of items alive, summed over all passes at
 * which some begin: no fewer than at the moments. */
static uint64_t find_moments(struct packing *p, uint32_t end, struct pack_result *result)
{
    VkDeviceSize taken = 0;
    VkDeviceSize used = 0;
    struct moment *newest = p->moments;
    struct moment *next = newest;
    uint32_t alive = 0;
    uint32_t ended = 1; /* since the newest moment; the first one is always new */
    uint64_t lived = 0;
    for (struct change *pass = p->changes; pass <= &p->changes[end]; pass++) {
        taken += pass->taken;
        used += pass->used;
        alive += pass->begun - pass->ended;
        ended += pass->ended;
        result->bound = result->bound < taken ? taken : result->bound;
        result->least = result->least < used ? used : result->least;
        if (pass->begun) {
            newest = ended ? next++ : newest;
            newest->alive = alive;
            ended = 0;
            lived += alive;
        }
        pass->newest = newest;
    }
    p->moments_end = next;
    return lived;
}

/* ---- lists of spans ---- */

static void begin_spans(struct span *spans)
{
    spans[0] = (struct span){ 0 };
    spans[1].begin = UINT64_MAX;
}

/* Before `next`. No memmove(): there are few behind it. */
static void insert_span(struct span *next, struct span span)
{
    while (span.begin != UINT64_MAX) {
        struct span moved = *next;
        *next++ = span;
        span = moved;
    }
    *next = span;
}

static void remove_span(struct span *span)
{
    do
        *span = span[1];
    while ((span++)->begin != UINT64_MAX);
}

/* Takes bytes in the gap below `next`. */
static void take(struct span *next, struct span span)
{
    bool joins_next = next->begin == span.end;
    if (next[-1].end != span.begin) {
        if (joins_next)
            next->begin = span.begin;
        else
            insert_span(next, span);
    } else if (joins_next) {
        next[-1].end = next->end;
        remove_span(next);
    } else {
        next[-1].end = span.end;
    }
}

/* Gives back the bytes of an item. */
static void give_back(struct span *spans, const struct pack_item *item)
{
    struct span *span = spans;
    while (span->end < end_of(item))
        span++;
    struct span above = { end_of(item), span->end };
    span->end = item->offset;
    if (above.begin < above.end)
        insert_span(span + 1, above);
    if (span != spans && span->begin == span->end)
        remove_span(span);
}

/* Returns the lowest offset from `begin` on that is free at a moment, in the gap below m->next. */
static VkDeviceSize rise(struct moment *m, const struct pack_item *item, VkDeviceSize begin)
{
    struct span *next = m->spans + 1;
    VkDeviceSize lowest = align_up(m->spans->end, item->alignment);
    begin = begin < lowest ? lowest : begin;
    for (; next->begin < begin + item->size; next++) {
        VkDeviceSize above = align_up(next->end, item->alignment);
        begin = begin < above ? above : begin;
    }
    m->next = next;
    return begin;
}

/* ---- orders ---- */

/* The product as a double, whose bits rise with it. */
static uint64_t product_of(const struct rule *rule, const struct pack_item *item)
{
    double product = rule->life_power ? (double)(int32_t)(item->last - item->first + 1) : 1;
    double size = (double)(int64_t)item->size;
    uint64_t bits;
    if (rule->size_power)
        product *= size;
    if (rule->size_power == 4)
        product = product * size * size * size;
    memcpy(&bits, &product, sizeof(bits));
    return bits;
}

/* Sorts p->order by the byte from bit `shift` on; what has the same byte stays in order. */
static void sort_by_byte(struct packing *p, unsigned shift)
{
    uint32_t places[256] = { 0 };
    uint32_t sum = 0;
    uint64_t *from = p->order;
    for (uint32_t i = 0; i < p->count; i++)
        places[from[i] >> shift & 255]++;
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t count = places[i];
        places[i] = sum;
        sum += count;
    }
    for (uint32_t i = 0; i < p->count; i++)
        p->sorted[places[from[i] >> shift & 255]++] = from[i];
    p->order = p->sorted;
    p->sorted = from;
}

/* Shell sort. */
static void sort_few(uint64_t *order, uint32_t count)
{
    uint32_t gap = 1;
    while (gap < count / 3)
        gap = gap * 3 + 1;
    for (; gap; gap /= 3) {
        for (uint32_t i = gap; i < count; i++) {
            const uint64_t moved = order[i];
            uint32_t k = i;
            for (; k >= gap && order[k - gap] > moved; k -= gap)
                order[k] = order[k - gap];
            order[k] = moved;
        }
    }
}

/* Fills p->order: items by falling upper halves of their products. No qsort(), which may allocate.
 */
static void sort(struct packing *p, const struct rule *rule)
{
    for (uint32_t i = 0; i < p->count; i++)
        p->order[i] = (~product_of(rule, &p->items[i]) & UINT64_MAX << 32) | i;
    if (p->count <= FEW) {
        sort_few(p->order, p->count);
        return;
    }
    for (unsigned shift = 32; shift < 64; shift += 8)
        sort_by_byte(p, shift);
}

/* Lets the item that reaches highest choose earlier: half as many come before it. */
static void promote_highest(struct packing *p)
{
    uint64_t *order = p->order;
    uint32_t highest = 0;
    for (uint32_t i = 1; i < p->placed; i++) {
        if (end_of(&p->items[(uint32_t)order[i]]) > end_of(&p->items[(uint32_t)order[highest]]))
            highest = i;
    }
    const uint64_t key = order[highest];
    memmove(&order[highest / 2 + 1], &order[highest / 2], (highest - highest / 2) * sizeof(*order));
    order[highest / 2] = key;
}

/* Gives an item the lowest offset that is free in its whole life: at all its moments, in circles,
 * until no other one raises it. */
static void place_item(const struct packing *p, struct pack_item *item)
{
    struct moment *first = p->changes[item->first].newest;
    struct moment *last = p->changes[item->last].newest;
    const struct moment *end = last; /* the one before the last one that raised it */
    VkDeviceSize begin = 0;
    for (struct moment *m = first;; m = m == last ? first : m + 1) {
        VkDeviceSize before = begin;
        begin = rise(m, item, begin);
        if (begin != before)
            end = m == first ? last : m - 1;
        if (m == end)
            break;
    }
    item->offset = begin;
    for (const struct moment *m = first; m <= last; m++)
        take(m->next, (struct span){ begin, begin + item->size });
}

/* Places one item after another. Returns the size of the block, or UINT64_MAX if it is not below
 * `limit`. */
static VkDeviceSize apply_order(struct packing *p, VkDeviceSize limit)
{
    VkDeviceSize size = 0;
    struct span *spans = p->spans;
    for (struct moment *m = p->moments; m < p->moments_end; m++) {
        m->spans = spans;
        begin_spans(spans);
        spans += m->alive + 2; /* as many as there may be */
    }
    for (p->placed = 0; p->placed < p->count && size < limit; p->placed++) {
        struct pack_item *item = &p->items[(uint32_t)p->order[p->placed]];
        place_item(p, item);
        size = size < end_of(item) ? end_of(item) : size;
    }
    return size < limit ? size : UINT64_MAX;
}

/* Tries the orders. Returns the size of the smallest block, below `size` if there is one, whose
 * offsets the items then have. */
static VkDeviceSize apply_orders(struct packing *p, VkDeviceSize size, VkDeviceSize bound)
{
    uint32_t rule_count = p->count > MANY ? RULES_OF_MANY : RULE_COUNT;
    uint32_t order_count = p->count > MANY ? RULES_OF_MANY : RULE_COUNT + PROMOTIONS;
    for (uint32_t i = 0; i < order_count && size > bound; i++) {
        if (i < rule_count)
            sort(p, &rules[i]);
        else
            promote_highest(p);
        VkDeviceSize found = apply_order(p, size);
        if (found >= size)
            continue;
        size = found;
        for (uint32_t k = 0; k < p->count; k++)
            p->offsets[k] = p->items[k].offset;
    }
    return size;
}

/* Places items in the order of first use, into the bytes that are free at that time: the cost does
 * not grow with lives. Returns the size of the block. */
static VkDeviceSize apply_time_order(const struct packing *p, struct arena *arena, uint32_t end)
{
    struct moment m = { .spans = ARENA_ARRAY(arena, struct span, (size_t)p->count + 2) };
    uint32_t *ending = ARENA_ZEROED(arena, uint32_t, (size_t)end + 1); /* first of a pass, plus 1 */
    uint32_t *next = ARENA_ARRAY(arena, uint32_t, p->count);
    uint32_t now = 0;
    VkDeviceSize size = 0;
    if (arena->failed)
        return 0;
    begin_spans(m.spans);
    for (uint32_t i = 0; i < p->count; i++) {
        struct pack_item *item = &p->items[i];
        for (; now < item->first; now++) {
            for (uint32_t dead = ending[now]; dead; dead = next[dead - 1])
                give_back(m.spans, &p->items[dead - 1]);
        }
        item->offset = rise(&m, item, 0);
        take(m.next, (struct span){ item->offset, end_of(item) });
        next[i] = ending[item->last];
        ending[item->last] = i + 1;
        size = size < end_of(item) ? end_of(item) : size;
        p->offsets[i] = item->offset;
    }
    return size;
}

struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count,
                           uint32_t end, bool apart)
{
    struct pack_result result = { .alignment = 1 };
    struct packing p = {
        .items = items,
        .count = count,
        .changes = ARENA_ZEROED(arena, struct change, (size_t)end + 2),
        .moments = ARENA_ARRAY(arena, struct moment, count),
        .offsets = ARENA_ARRAY(arena, VkDeviceSize, count),
        .order = ARENA_ARRAY(arena, uint64_t, count),
        .sorted = ARENA_ARRAY(arena, uint64_t, count),
    };
    if (arena->failed)
        return result;
    find_changes(&p, &result);
    uint64_t lived = find_moments(&p, end, &result);
    size_t moment_count = (size_t)(p.moments_end - p.moments);
    result.size = result.apart;
    bool shared = !apart && result.apart > result.bound;
    if (shared && lived > MANY * MANY / 2 + (uint64_t)count * LONG_LIFE) {
        result.size = apply_time_order(&p, arena, end);
    } else if (shared) {
        p.spans = ARENA_ARRAY(arena, struct span, lived + 2 * moment_count);
        if (p.spans)
            result.size = apply_orders(&p, result.apart, result.bound);
    }
    for (uint32_t i = 0; i < count; i++)
        items[i].offset = p.offsets[i];
    return result;
}
