/*
 * rg_pack.c: where resources lie in a block, those that live at the same time apart.
 *
 * An instance of dynamic storage allocation, which is NP-hard; several greedy rules are tried and
 * the smallest block wins. Each puts resources one after another, in some order, into the lowest
 * gap that is free for their whole life, until it has met the bound or lost.
 */
#include <string.h>
#include "graph/rg_internal.h"

enum {
    MANY = 512,        /* resources beyond which only the first rules are tried, */
    RULES_OF_MANY = 2, /* so many, */
    LONG_LIFE = 32,    /* and only time order if they live longer, in moments and on average */
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

/* Bytes that are taken. */
struct span {
    VkDeviceSize begin, end;
};

/*
 * A moment is a pass at which some item begins. What lives together lives together at the moment
 * when the later one begins, so no other passes count.
 */
struct moment {
    VkDeviceSize floor;   /* all below is taken */
    VkDeviceSize ceiling; /* nothing is between the floor and this, where the first span begins */
    struct span *spans;   /* that are taken above, rising; none touches another or the floor */
    uint32_t count;
    uint32_t alive; /* items: no more spans than these */
    uint32_t gap;   /* index of the span above the gap in which the item at work fits */
};

/* What is more at a pass than at the one before; less wraps. */
struct growth {
    VkDeviceSize taken, used; /* bytes, now and if items took them at their first use */
    struct moment *end;       /* of the moments so far */
    uint32_t alive;           /* items */
    uint32_t begun;           /* items that begin here */
};

struct packing {
    const struct pack_item *items; /* in the order of first use */
    uint32_t count;
    struct growth *growth;  /* of each pass */
    struct moment *moments; /* in the order of time */
    struct moment *moments_end;
    VkDeviceSize *offsets;    /* of each item, by the rule at work */
    uint64_t *order, *sorted; /* scratch */
};

static VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) & ~(alignment - 1);
}

/* ---- moments ---- */

/* Finds what each pass has more than the one before, and where items lie if nothing is shared. */
static void find_growth(const struct packing *p, struct pack_item *items,
                        struct pack_result *result)
{
    for (uint32_t i = 0; i < p->count; i++) {
        struct pack_item *item = &items[i];
        struct growth *first = &p->growth[item->first];
        struct growth *end = &p->growth[item->last + 1];
        item->offset = align_up(result->apart, item->alignment);
        result->apart = item->offset + item->size;
        result->alignments |= item->alignment;
        first->taken += item->size;
        first->alive++;
        first->begun++;
        p->growth[item->first_use].used += item->size;
        end->taken -= item->size;
        end->used -= item->size;
        end->alive--;
    }
}

/* Finds the moments, and the most bytes that are taken at once. Returns how many moments the items
 * live, all together. */
static uint64_t find_moments(struct packing *p, uint32_t end, struct pack_result *result)
{
    struct growth now = { .end = p->moments };
    uint64_t lived = 0;
    for (struct growth *pass = p->growth, *last = pass + end; pass <= last; pass++) {
        now.taken += pass->taken;
        now.used += pass->used;
        now.alive += pass->alive;
        result->bound = result->bound < now.taken ? now.taken : result->bound;
        result->least = result->least < now.used ? now.used : result->least;
        if (pass->begun) {
            (now.end++)->alive = now.alive;
            lived += now.alive;
        }
        pass->end = now.end;
    }
    p->moments_end = now.end;
    return lived;
}

/* False: memory is short. */
static bool begin_rules(struct arena *arena, struct packing *p, uint64_t lived)
{
    struct span *spans = ARENA_ARRAY(arena, struct span, lived);
    p->offsets = ARENA_ARRAY(arena, VkDeviceSize, p->count);
    p->order = ARENA_ARRAY(arena, uint64_t, p->count);
    p->sorted = ARENA_ARRAY(arena, uint64_t, p->count);
    if (arena->failed)
        return false;
    for (struct moment *m = p->moments; m < p->moments_end; m++) {
        m->spans = spans; /* as many as there may be */
        spans += m->alive;
    }
    return true;
}

/* ---- the order of a rule: sorted by digits, since nobody could foresee comparisons ---- */

enum {
    KEY_BITS = 32,
    MAX_DIGIT_BITS = 11,
    A_HANDFUL = 24, /* items, which are only compared */
    VERY_FEW = 64,  /* the same, */
    FEW = 256,      /* of which one digit is sorted, and the rest by comparing */
};

/* The upper half of the product as a double, whose bits rise with it. */
static uint32_t product_of(const struct rule *rule, const struct pack_item *item)
{
    double product = rule->life_power ? (double)(int32_t)(item->last - item->first + 1) : 1;
    double size = (double)(int64_t)item->size;
    uint64_t bits;
    if (rule->size_power)
        product *= size;
    if (rule->size_power == 4)
        product = product * size * size * size;
    memcpy(&bits, &product, sizeof(bits));
    return (uint32_t)(bits >> 32);
}

/* Sorts by the digit from bit `shift` on; what is equal keeps its order. */
static void sort_digit(struct packing *p, uint32_t shift, uint32_t digit_bits)
{
    uint32_t starts[1 << MAX_DIGIT_BITS];
    uint32_t mask = (UINT32_C(1) << digit_bits) - 1;
    uint32_t start = 0;
    memset(starts, 0, (mask + 1) * sizeof(*starts));
    for (uint32_t i = 0; i < p->count; i++)
        starts[p->order[i] >> shift & mask]++;
    for (uint32_t digit = 0; digit <= mask; digit++) {
        uint32_t count = starts[digit];
        starts[digit] = start;
        start += count;
    }
    for (uint32_t i = 0; i < p->count; i++)
        p->sorted[starts[p->order[i] >> shift & mask]++] = p->order[i];
    uint64_t *sorted = p->sorted;
    p->sorted = p->order;
    p->order = sorted;
}

/* Quick where little is out of order. */
static void insert_each(uint64_t *order, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        uint64_t key = order[i];
        uint32_t at = i;
        for (; at && order[at - 1] > key; at--)
            order[at] = order[at - 1];
        order[at] = key;
    }
}

/* Fills p->order: items in the lower half, by falling products. */
static void sort(struct packing *p, const struct rule *rule)
{
    bool few = p->count < FEW;
    uint32_t digit_bits = p->count < VERY_FEW ? 5 : p->count < 2048 ? 8 : MAX_DIGIT_BITS;
    uint32_t common = UINT32_MAX;
    uint32_t any = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        uint32_t product = product_of(rule, &p->items[i]);
        p->order[i] = (uint64_t)~product << KEY_BITS | i;
        common &= product;
        any |= product;
    }
    uint32_t differing = any & ~common;
    uint32_t shift = 0;
    if (p->count < A_HANDFUL)
        shift = KEY_BITS;
    else if (few && differing >> digit_bits) /* to the highest digit */
        shift = KEY_BITS - digit_bits - (uint32_t)__builtin_clz(differing);
    for (; shift < KEY_BITS && differing >> shift; shift += digit_bits)
        sort_digit(p, KEY_BITS + shift, digit_bits);
    if (few)
        insert_each(p->order, p->count);
}

/* ---- rules ---- */

static void remove_span(struct moment *m, struct span *span)
{
    m->count--;
    for (const struct span *end = m->spans + m->count; span < end; span++)
        *span = span[1];
}

/* Where m->gap says. */
static void add_span(struct moment *m, struct span span)
{
    struct span *next = m->spans + m->gap;
    struct span *end = m->spans + m->count;
    bool joins_last = next > m->spans && next[-1].end == span.begin;
    bool joins_next = next < end && next->begin == span.end;
    if (joins_last && joins_next) {
        next[-1].end = next->end;
        remove_span(m, next);
    } else if (joins_last) {
        next[-1].end = span.end;
    } else if (joins_next) {
        next->begin = span.begin;
    } else {
        for (; end > next; end--)
            *end = end[-1];
        *next = span;
        m->count++;
    }
    m->ceiling = m->spans->begin;
}

static inline void take(struct moment *m, struct span span)
{
    if (span.begin != m->floor) {
        add_span(m, span);
        return;
    }
    m->floor = span.end;
    if (m->ceiling == span.end) {
        m->floor = m->spans->end;
        remove_span(m, m->spans);
        m->ceiling = m->count ? m->spans->begin : UINT64_MAX;
    }
}

/* The lowest offset from `begin` on that is free at a moment, in the gap before m->gap. */
static inline VkDeviceSize rise(struct moment *m, const struct pack_item *item, VkDeviceSize begin)
{
    uint32_t gap = 0;
    for (; gap < m->count && m->spans[gap].begin < begin + item->size; gap++) {
        if (m->spans[gap].end > begin)
            begin = align_up(m->spans[gap].end, item->alignment);
    }
    m->gap = gap;
    return begin;
}

/* At all moments of a life: in circles, until no other one raises it. */
static VkDeviceSize rise_all(struct moment *first, struct moment *last,
                             const struct pack_item *item, VkDeviceSize begin)
{
    const struct moment *raised = last; /* the last one that did */
    struct moment *m = first;
    for (;;) {
        VkDeviceSize before = begin;
        begin = rise(m, item, begin);
        if (begin != before)
            raised = m == first ? last : m - 1;
        else if (m == raised)
            return begin;
        m = m == last ? first : m + 1;
    }
}

/* Returns the lowest offset that is free in the life of an item, which it takes. */
static VkDeviceSize place(const struct packing *p, uint32_t index)
{
    const struct pack_item *item = &p->items[index];
    struct moment *first = p->growth[item->first].end - 1;
    struct moment *last = p->growth[item->last].end - 1;
    VkDeviceSize begin = 0;
    VkDeviceSize ceiling = UINT64_MAX;
    for (struct moment *m = first; m <= last; m++) {
        begin = begin < m->floor ? m->floor : begin;
        ceiling = ceiling > m->ceiling ? m->ceiling : ceiling;
        m->gap = 0;
    }
    begin = align_up(begin, item->alignment);
    if (ceiling < begin + item->size)
        begin = rise_all(first, last, item, begin);
    for (struct moment *taken = first; taken <= last; taken++)
        take(taken, (struct span){ begin, begin + item->size });
    return begin;
}

/* Returns the size of the block, or UINT64_MAX if it is not below `limit`. */
static VkDeviceSize apply_rule(struct packing *p, const struct rule *rule, VkDeviceSize limit)
{
    VkDeviceSize size = 0;
    sort(p, rule);
    for (struct moment *m = p->moments; m < p->moments_end; m++) {
        m->floor = m->count = 0;
        m->ceiling = UINT64_MAX;
    }
    for (uint32_t i = 0; i < p->count && size < limit; i++) {
        uint32_t index = (uint32_t)p->order[i];
        p->offsets[index] = place(p, index);
        if (size < p->offsets[index] + p->items[index].size)
            size = p->offsets[index] + p->items[index].size;
    }
    return size < limit ? size : UINT64_MAX;
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

/* Returns the size of the smallest block, below `size`, whose places it fills in; or `size`. */
static VkDeviceSize apply_rules(struct packing *p, struct pack_item *items, VkDeviceSize size,
                                VkDeviceSize bound)
{
    uint32_t rule_count = p->count > MANY ? RULES_OF_MANY : RULE_COUNT;
    for (uint32_t r = 0; r < rule_count && size > bound; r++) {
        VkDeviceSize found = apply_rule(p, &rules[r], size);
        if (found >= size)
            continue;
        size = found;
        for (uint32_t i = 0; i < p->count; i++)
            items[i].offset = p->offsets[i];
    }
    return size;
}

struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count,
                           uint32_t end, bool apart)
{
    struct packing p = { .items = items, .count = count };
    struct pack_result result = { 0 };
    p.growth = ARENA_ZEROED(arena, struct growth, (size_t)end + 2);
    p.moments = ARENA_ARRAY(arena, struct moment, count);
    if (arena->failed)
        return result;
    find_growth(&p, items, &result);
    uint64_t lived = find_moments(&p, end, &result);
    result.size = result.apart;
    if (apart || result.apart == result.bound)
        return result;
    if (lived > MANY * MANY / 2 + (uint64_t)count * LONG_LIFE)
        result.size = apply_time_order(arena, items, count);
    else if (begin_rules(arena, &p, lived))
        result.size = apply_rules(&p, items, result.apart, result.bound);
    return result;
}
