/*
 * rg_pack.c: where resources lie in a block, those that live at the same time apart.
 *
 * An instance of dynamic storage allocation, which is NP-hard; several greedy rules are tried and
 * the smallest block wins. Each puts resources one after another, in some order, into a gap that
 * is free for their whole life: the lowest that fits, or the tightest.
 */
#include <stdlib.h>
#include <string.h>
#include "graph/rg_internal.h"

/* Beyond this many resources only time order is tried: the others look at every pair. */
enum {
    MANY = 512
};

typedef int compare_fn(const void *a, const void *b);

static int by_time(const struct pack_item *a, const struct pack_item *b)
{
    if (a->first != b->first)
        return a->first < b->first ? -1 : 1;
    return a < b ? -1 : a > b; /* as listed */
}

static int compare_size(const void *a, const void *b)
{
    const struct pack_item *x = *(const struct pack_item *const *)a;
    const struct pack_item *y = *(const struct pack_item *const *)b;
    if (x->size != y->size)
        return x->size > y->size ? -1 : 1;
    return by_time(x, y);
}

static int compare_life(const void *a, const void *b)
{
    const struct pack_item *x = *(const struct pack_item *const *)a;
    const struct pack_item *y = *(const struct pack_item *const *)b;
    if (x->last - x->first != y->last - y->first)
        return x->last - x->first > y->last - y->first ? -1 : 1;
    return compare_size(a, b);
}

static int compare_area(const void *a, const void *b)
{
    const struct pack_item *x = *(const struct pack_item *const *)a;
    const struct pack_item *y = *(const struct pack_item *const *)b;
    double p = (double)x->size * (double)(x->last - x->first + 1);
    double q = (double)y->size * (double)(y->last - y->first + 1);
    if (p != q)
        return p > q ? -1 : 1;
    return by_time(x, y);
}

static const struct rule {
    compare_fn *order;
    bool tightest; /* gap; else the lowest */
} rules[] = {
    { compare_size, true },
    { compare_area, false },
    { compare_life, false },
    { compare_size, false },
};

static VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment)
{
    return alignment ? (value + alignment - 1) / alignment * alignment : value;
}

static bool live_together(const struct pack_item *a, const struct pack_item *b)
{
    return a->first <= b->last && b->first <= a->last;
}

/* A free offset for an item among those placed, which are sorted by offset. */
static VkDeviceSize find_gap(const struct pack_item *item, struct pack_item *const *placed,
                             uint32_t count, bool tightest)
{
    VkDeviceSize end = 0; /* of everything so far that lives with the item */
    VkDeviceSize best = 0;
    VkDeviceSize best_room = UINT64_MAX;
    for (size_t i = 0; i < count; i++) {
        if (!live_together(item, placed[i]))
            continue;
        VkDeviceSize start = align_up(end, item->alignment);
        if (placed[i]->offset >= start && placed[i]->offset - start >= item->size &&
            placed[i]->offset - end < best_room) {
            best = start;
            best_room = placed[i]->offset - end;
            if (!tightest)
                return best;
        }
        if (end < placed[i]->offset + placed[i]->size)
            end = placed[i]->offset + placed[i]->size;
    }
    return best_room < UINT64_MAX ? best : align_up(end, item->alignment);
}

/* Places all items by a rule; returns the size of the block. */
static VkDeviceSize apply_rule(const struct rule *rule, struct pack_item **order,
                               struct pack_item **placed, uint32_t count)
{
    VkDeviceSize size = 0;
    qsort(order, count, sizeof(struct pack_item *), rule->order);
    for (uint32_t i = 0; i < count; i++) {
        struct pack_item *item = order[i];
        item->offset = find_gap(item, placed, i, rule->tightest);
        uint32_t k = i;
        for (; k > 0 && placed[k - 1]->offset > item->offset; k--)
            placed[k] = placed[k - 1];
        placed[k] = item;
        if (size < item->offset + item->size)
            size = item->offset + item->size;
    }
    return size;
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
static VkDeviceSize take(struct holes *holes, const struct pack_item *item)
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
        item->offset = take(&holes, item);
        next[i] = dying[item->last];
        dying[item->last] = i + 1;
        if (size < item->offset + item->size)
            size = item->offset + item->size;
    }
    return size;
}

/* ---- the best of all ---- */

static VkDeviceSize pack_apart(struct pack_item *items, uint32_t count)
{
    VkDeviceSize size = 0;
    for (size_t i = 0; i < count; i++) {
        items[i].offset = align_up(size, items[i].alignment);
        size = items[i].offset + items[i].size;
    }
    return size;
}

VkDeviceSize rg_pack_bound(struct arena *arena, const struct pack_item *items, uint32_t count)
{
    uint32_t end = 0;
    for (uint32_t i = 0; i < count; i++)
        end = end < items[i].last ? items[i].last : end;
    VkDeviceSize *more = ARENA_ZEROED(arena, VkDeviceSize, (size_t)end + 2); /* less may wrap */
    VkDeviceSize live = 0;
    VkDeviceSize bound = 0;
    if (!more)
        return 0;
    for (uint32_t i = 0; i < count; i++) {
        more[items[i].first] += items[i].size;
        more[items[i].last + 1] -= items[i].size;
    }
    for (uint32_t p = 0; p <= end; p++) {
        live += more[p];
        bound = bound < live ? live : bound;
    }
    return bound;
}

struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count, bool apart)
{
    struct pack_item **order = ARENA_ARRAY(arena, struct pack_item *, count);
    struct pack_item **placed = ARENA_ARRAY(arena, struct pack_item *, count);
    VkDeviceSize *best = ARENA_ARRAY(arena, VkDeviceSize, count);
    struct pack_result result = {
        .apart = pack_apart(items, count),
        .bound = rg_pack_bound(arena, items, count),
    };
    result.size = result.apart;
    if (arena->failed || apart)
        return result;
    for (size_t i = 0; i < count; i++) {
        order[i] = &items[i];
        best[i] = items[i].offset;
    }
    size_t rule_count = count > MANY ? 0 : sizeof(rules) / sizeof(rules[0]);
    for (size_t r = 0; r <= rule_count && result.size > result.bound; r++) {
        VkDeviceSize size = r ? apply_rule(&rules[r - 1], order, placed, count)
                              : apply_time_order(arena, items, count);
        if (size >= result.size)
            continue;
        result.size = size;
        for (size_t i = 0; i < count; i++)
            best[i] = items[i].offset;
    }
    for (size_t i = 0; i < count; i++)
        items[i].offset = best[i];
    return result;
}
