/*
 * pack.c: where resources lie in a block, those that live at the same time apart.
 *
 * An instance of dynamic storage allocation, which is NP-hard; several orders are tried and the
 * smallest block wins. Each puts resources one after another into the lowest gap that is free for
 * their whole life, until it has met the bound or lost. The first orders are by greedy rules; then,
 * again and again, whoever reached highest comes earlier (squeaky wheel optimization, Joslin and
 * Clements, JAIR 10, 1999).
 */
#include <string.h>
#include "graph/compile/compiler.h"

enum {
    PROMOTIONS = 8,    /* orders beside those of the rules */
    MANY = 512,        /* resources beyond which only the first rules are tried, */
    RULES_OF_MANY = 2, /* so many, */
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

/*
 * What lives together does so at the pass where the last of it begins, so no other passes count. Of
 * several such passes between which nothing ends, only the last one does: it is a moment.
 */
struct moment {
    struct span *spans; /* taken bytes; the first begins at 0 and may be empty */
    struct span *next;  /* the one above the gap in which the item at work fits */
    uint32_t alive;     /* items */
};

/* What is more at a pass than at the one before; less wraps. */
struct growth {
    VkDeviceSize taken, used; /* bytes, now and if items took them at their first use */
    struct moment *newest;    /* of the moments so far */
    uint32_t begun, ended;    /* items that begin here, and that end at the pass before */
};

struct packing {
    struct pack_item *items; /* in the order of first use; with the places of the order at work */
    uint32_t count;
    struct growth *growth;  /* of each pass */
    struct moment *moments; /* in the order of time */
    struct moment *moments_end;
    struct span *spans;       /* room for those of all moments */
    VkDeviceSize *offsets;    /* of each item, the best so far */
    uint64_t *order, *sorted; /* scratch */
    uint32_t placed;          /* so many of the order, which then had lost or come to its end */
};

static VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) & ~(alignment - 1);
}

/* ---- moments ---- */

/* Finds what each pass has more than the one before, and where items lie if nothing is shared. */
static void find_growth(const struct packing *p, struct pack_result *result)
{
    struct growth *growth = p->growth;
    VkDeviceSize *offset = p->offsets;
    for (const struct pack_item *item = p->items, *end = item + p->count; item < end; item++) {
        struct growth *first = &growth[item->first];
        struct growth *last = &growth[item->last];
        VkDeviceSize begin = align_up(result->apart, item->alignment);
        *offset++ = begin;
        result->apart = begin + item->size;
        result->alignments |= item->alignment;
        first->taken += item->size;
        first->begun++;
        growth[item->first_use].used += item->size;
        last[1].taken -= item->size;
        last[1].used -= item->size;
        last[1].ended++;
    }
}

/* Finds the moments, and the most bytes that are taken at once. Returns how many items are alive at
 * passes where some begin, all together: no fewer than at the moments. */
static uint64_t find_moments(struct packing *p, uint32_t end, struct pack_result *result)
{
    VkDeviceSize taken = 0, used = 0;
    struct moment *newest = p->moments;
    struct moment *next = newest;
    uint32_t alive = 0;
    uint32_t ended = 1; /* since the newest moment; the first one is always new */
    uint64_t lived = 0;
    for (struct growth *pass = p->growth, *last = pass + end; pass <= last; pass++) {
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

/* False: memory is short. */
static bool begin_rules(struct arena *arena, struct packing *p, uint64_t lived)
{
    size_t moment_count = (size_t)(p->moments_end - p->moments);
    p->spans = ARENA_ARRAY(arena, struct span, lived + 2 * moment_count);
    p->order = ARENA_ARRAY(arena, uint64_t, p->count);
    p->sorted = ARENA_ARRAY(arena, uint64_t, p->count);
    return !arena->failed;
}

/* ---- the order of a rule: sorted by digits, since nobody could foresee comparisons ---- */

enum {
    KEY_BITS = 32,
    MAX_DIGIT_BITS = 11,
    A_HANDFUL = 24, /* items, which are only compared */
    VERY_FEW = 64,  /* the same, */
    FEW = 256,      /* of which one digit is sorted, and the rest by comparing */
};

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

/* Sorts by the digit from bit `shift` on; what is equal keeps its order. */
static void sort_digit(struct packing *p, uint32_t shift, uint32_t digit_bits)
{
    uint32_t starts[1 << MAX_DIGIT_BITS];
    uint32_t mask = (UINT32_C(1) << digit_bits) - 1;
    uint32_t start = 0;
    uint64_t *order = p->order, *end = order + p->count;
    uint64_t *sorted = p->sorted;
    memset(starts, 0, (mask + 1) * sizeof(*starts));
    for (const uint64_t *at = order; at < end; at++)
        starts[*at >> shift & mask]++;
    for (uint32_t digit = 0; digit <= mask; digit++) {
        uint32_t count = starts[digit];
        starts[digit] = start;
        start += count;
    }
    for (const uint64_t *at = order; at < end; at++)
        sorted[starts[*at >> shift & mask]++] = *at;
    p->sorted = order;
    p->order = sorted;
}

/* Quick where little is out of order. */
static void insert_each(uint64_t *order, uint32_t count)
{
    uint64_t last = 0; /* the greatest so far */
    for (uint64_t *next = order, *end = order + count; next < end; next++) {
        uint64_t key = *next;
        if (key >= last) {
            last = key;
            continue;
        }
        uint64_t *at = next;
        for (; at > order && at[-1] > key; at--)
            *at = at[-1];
        *at = key;
    }
}

/* Fills p->order: items in the lower half, by falling upper halves of their products. */
static void sort(struct packing *p, const struct rule *rule)
{
    uint64_t *order = p->order;
    uint32_t count = p->count;
    bool few = count < FEW;
    uint32_t digit_bits = count < VERY_FEW ? 6 : count < 2048 ? 8 : MAX_DIGIT_BITS;
    uint64_t common = UINT64_MAX;
    uint64_t any = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint64_t product = product_of(rule, &p->items[i]);
        order[i] = (~product & UINT64_MAX << KEY_BITS) | i;
        common &= product;
        any |= product;
    }
    uint32_t differing = (uint32_t)((any & ~common) >> KEY_BITS);
    uint32_t shift = 0;
    if (count < A_HANDFUL)
        shift = KEY_BITS;
    else if (few && differing >> digit_bits) /* to the highest digit */
        shift = KEY_BITS - digit_bits - (uint32_t)__builtin_clz(differing);
    for (; shift < KEY_BITS && differing >> shift; shift += digit_bits)
        sort_digit(p, KEY_BITS + shift, digit_bits);
    if (few)
        insert_each(p->order, count);
}

/* ---- rules ---- */

static inline void remove_span(struct span *span)
{
    do
        *span = span[1];
    while ((span++)->begin != UINT64_MAX);
}

/* Below `next`. */
static inline void take(struct span *next, struct span span)
{
    bool joins_next = next->begin == span.end;
    if (next[-1].end != span.begin) {
        if (joins_next)
            next->begin = span.begin;
        else
            rg_span_insert(next, span);
    } else if (joins_next) {
        next[-1].end = next->end;
        remove_span(next);
    } else {
        next[-1].end = span.end;
    }
}

/* The lowest offset from `begin` on that is free at a moment, in the gap below m->next. */
static inline VkDeviceSize rise(struct moment *m, const struct pack_item *item, VkDeviceSize begin)
{
    struct span *next = m->spans + 1;
    for (; next->begin < begin + item->size; next++) {
        VkDeviceSize above = align_up(next->end, item->alignment);
        begin = begin < above ? above : begin;
    }
    m->next = next;
    return begin;
}

/* At all moments of a life: in circles, until no other one raises it. */
static VkDeviceSize rise_all(struct moment *first, struct moment *last,
                             const struct pack_item *item, VkDeviceSize begin)
{
    const struct moment *end = last; /* the one before the last one that did */
    for (struct moment *m = first;; m = m == last ? first : m + 1) {
        VkDeviceSize before = begin;
        begin = rise(m, item, begin);
        if (begin != before)
            end = m == first ? last : m - 1;
        if (m == end)
            return begin;
    }
}

/* Returns the lowest offset that is free in the life of an item, which it takes. */
static VkDeviceSize place(const struct growth *growth, const struct pack_item *item)
{
    struct moment *first = growth[item->first].newest;
    struct moment *last = growth[item->last].newest;
    struct span span = { 0 };
    VkDeviceSize ceiling = UINT64_MAX;
    for (const struct moment *m = first; m <= last; m++) {
        const struct span *spans = m->spans;
        span.begin = span.begin < spans[0].end ? spans[0].end : span.begin;
        ceiling = ceiling > spans[1].begin ? spans[1].begin : ceiling;
    }
    span.begin = align_up(span.begin, item->alignment);
    span.end = span.begin + item->size;
    if (span.end <= ceiling) {
        for (const struct moment *m = first; m <= last; m++)
            take(m->spans + 1, span);
        return span.begin;
    }
    span.begin = rise_all(first, last, item, span.begin);
    span.end = span.begin + item->size;
    for (const struct moment *m = first; m <= last; m++)
        take(m->next, span);
    return span.begin;
}

static VkDeviceSize end_of(const struct pack_item *item)
{
    return item->offset + item->size;
}

/* Puts one item after another. Returns the size of the block, or UINT64_MAX if it is not below
 * `limit`. */
static VkDeviceSize apply_order(struct packing *p, VkDeviceSize limit)
{
    VkDeviceSize size = 0;
    struct span *spans = p->spans;
    for (struct moment *m = p->moments; m < p->moments_end; m++) {
        m->spans = spans;
        spans[0] = (struct span){ 0 };
        spans[1].begin = UINT64_MAX;
        spans += m->alive + 2; /* as many as there may be */
    }
    const struct growth *growth = p->growth;
    struct pack_item *items = p->items;
    const uint64_t *next = p->order, *end = next + p->count;
    for (; next < end && size < limit; next++) {
        struct pack_item *item = &items[(uint32_t)*next];
        item->offset = place(growth, item);
        size = size < end_of(item) ? end_of(item) : size;
    }
    p->placed = (uint32_t)(next - p->order);
    return size < limit ? size : UINT64_MAX;
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
    uint32_t place = highest / 2;
    const uint64_t key = order[highest];
    memmove(&order[place + 1], &order[place], (highest - place) * sizeof(key));
    order[place] = key;
}

/* ---- time order, with the holes that are free at the moment ---- */

struct hole {
    VkDeviceSize offset, size;
};

struct holes {
    struct hole *items; /* by offset; none touches the next; the last one has no end */
    uint32_t count;
};

static void remove_hole(struct holes *holes, size_t i)
{
    memmove(&holes->items[i], &holes->items[i + 1], (holes->count - i - 1) * sizeof(*holes->items));
    holes->count--;
}

static void insert_hole(struct holes *holes, size_t i, struct hole hole)
{
    memmove(&holes->items[i + 1], &holes->items[i], (holes->count - i) * sizeof(*holes->items));
    holes->items[i] = hole;
    holes->count++;
}

/* The lowest fit. Splits the hole in what lies before and what lies after. */
static VkDeviceSize take_hole(struct holes *holes, const struct pack_item *item)
{
    size_t i = 0;
    VkDeviceSize start;
    for (;; i++) {
        const struct hole *hole = &holes->items[i];
        start = align_up(hole->offset, item->alignment);
        if (start - hole->offset <= hole->size && hole->size - (start - hole->offset) >= item->size)
            break;
    }
    struct hole before = { holes->items[i].offset, start - holes->items[i].offset };
    holes->items[i].size -= before.size + item->size;
    holes->items[i].offset = start + item->size;
    if (!holes->items[i].size)
        remove_hole(holes, i);
    if (before.size)
        insert_hole(holes, i, before);
    return start;
}

static void give_back(struct holes *holes, const struct pack_item *item)
{
    size_t i = 0;
    while (i < holes->count && holes->items[i].offset < item->offset)
        i++;
    insert_hole(holes, i, (struct hole){ item->offset, item->size });
    if (i + 1 < holes->count &&
        holes->items[i].offset + holes->items[i].size == holes->items[i + 1].offset) {
        holes->items[i].size += holes->items[i + 1].size;
        remove_hole(holes, i + 1);
    }
    if (i > 0 && holes->items[i - 1].offset + holes->items[i - 1].size == holes->items[i].offset) {
        holes->items[i - 1].size += holes->items[i].size;
        remove_hole(holes, i);
    }
}

/* Items come in the order of first use. Costs items times holes, and there are few holes. */
static VkDeviceSize apply_time_order(struct arena *arena, struct pack_item *items, uint32_t count)
{
    uint32_t end = 0;
    VkDeviceSize size = 0;
    for (size_t i = 0; i < count; i++)
        end = end < items[i].last ? items[i].last : end;
    struct holes holes = { ARENA_ARRAY(arena, struct hole, count * 2 + 1), 1 };
    uint32_t *dying = ARENA_ZEROED(arena, uint32_t, (size_t)end + 1); /* first of a pass, plus 1 */
    uint32_t *next = ARENA_ARRAY(arena, uint32_t, count);
    if (arena->failed)
        return UINT64_MAX;
    holes.items[0] = (struct hole){ 0, UINT64_MAX / 2 };
    uint32_t now = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct pack_item *item = &items[i];
        for (; now < item->first; now++) {
            for (uint32_t dead = dying[now]; dead; dead = next[dead - 1])
                give_back(&holes, &items[dead - 1]);
        }
        item->offset = take_hole(&holes, item);
        next[i] = dying[item->last];
        dying[item->last] = i + 1;
        if (size < item->offset + item->size)
            size = item->offset + item->size;
    }
    return size;
}

/* ---- the best of all ---- */

static void keep_places(struct packing *p)
{
    for (uint32_t i = 0; i < p->count; i++)
        p->offsets[i] = p->items[i].offset;
}

static void choose_places(struct packing *p)
{
    for (uint32_t i = 0; i < p->count; i++)
        p->items[i].offset = p->offsets[i];
}

/* Returns the size of the smallest block, below `size` if there is one, and chooses its places. */
static VkDeviceSize apply_rules(struct packing *p, VkDeviceSize size, VkDeviceSize bound)
{
    bool many = p->count > MANY;
    uint32_t rule_count = many ? RULES_OF_MANY : RULE_COUNT;
    uint32_t order_count = many ? RULES_OF_MANY : RULE_COUNT + PROMOTIONS;
    for (uint32_t i = 0; i < order_count; i++) {
        if (i < rule_count)
            sort(p, &rules[i]);
        else
            promote_highest(p);
        VkDeviceSize found = apply_order(p, size);
        if (found == bound)
            return found;
        if (found < size) {
            keep_places(p);
            size = found;
        }
    }
    choose_places(p);
    return size;
}

struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count,
                           uint32_t end, bool apart)
{
    struct packing p = { .items = items, .count = count };
    struct pack_result result = { 0 };
    p.growth = ARENA_ZEROED(arena, struct growth, (size_t)end + 2);
    p.moments = ARENA_ARRAY(arena, struct moment, count);
    p.offsets = ARENA_ARRAY(arena, VkDeviceSize, count);
    if (arena->failed)
        return result;
    find_growth(&p, &result);
    uint64_t lived = find_moments(&p, end, &result);
    result.size = result.apart;
    if (apart || result.apart == result.bound)
        choose_places(&p);
    else if (lived > MANY * MANY / 2 + (uint64_t)count * LONG_LIFE)
        result.size = apply_time_order(arena, items, count);
    else if (begin_rules(arena, &p, lived))
        result.size = apply_rules(&p, result.apart, result.bound);
    return result;
}
