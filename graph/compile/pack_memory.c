/* pack_memory.c: packs transient resources; those with disjoint lifetimes may alias. This dynamic
 * storage allocation is NP-hard: several orders are tried, each first-fit (at the lowest offset
 * free during the whole lifetime), until the block reaches its lower bound, the peak of live bytes.
 * The first orders are greedy; each later one moves the item that ends highest forward (squeaky
 * wheel optimization, Joslin and Clements, JAIR 10, 1999). */
#include <string.h>
#include "graph/compile/compiler.h"

enum {
    RULE_COUNT = 4,          /* greedy orders */
    PROMOTIONS = 8,          /* orders tried after them */
    FEW_ITEMS = 256,         /* above it, a radix sort is faster than Shell sort */
    MANY_ITEMS = 512,        /* above it, fewer rules are tried */
    RULES_OF_MANY_ITEMS = 2, /* rules tried for many items */
    /* above this mean number of live sets per item, large plans only use apply_time_order() */
    LONG_LIFE = 32,
};

/* Sort rules of the greedy orders: by descending size^size_power * lifetime^life_power. */
static const struct rule {
    unsigned size_power;
    unsigned life_power; /* 0 or 1 */
} rules[RULE_COUNT] = {
    { 4, 1 },
    { 1, 0 },
    { 1, 1 },
    { 0, 1 },
};

/* Range of allocated bytes. Spans in a list are ascending, with gaps between them. The first span
 * begins at 0 and may be empty. The last span is a sentinel at UINT64_MAX. */
struct span {
    VkDeviceSize begin, end;
};

/* Maximal set of items that are alive at the same pass. If an item of the newest set has ended, the
 * next item that begins starts a new set. */
struct live_set {
    struct span *spans;
    struct span *next; /* span above the current item's gap */
    uint32_t alive;    /* number of items */
};

/* Changes of the live items since the previous pass. Negative changes wrap around (unsigned). */
struct change {
    VkDeviceSize taken;      /* live bytes */
    struct live_set *newest; /* newest live set */
    uint32_t begun, ended;   /* items begun here; ended before */
};

struct packing {
    struct pack_item *items; /* with offsets of the current order */
    uint32_t count;
    struct change *changes;     /* one per pass */
    struct live_set *live_sets; /* in ascending order of time */
    struct live_set *live_sets_end;
    struct span *spans;    /* span storage of all live sets */
    VkDeviceSize *offsets; /* best offsets so far, per item */
    uint64_t *order;       /* upper half: key; lower half: item */
    uint64_t *sorted;      /* scratch of sort() */
    uint32_t placed;       /* items placed by the current order */
};

static VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) & ~(alignment - 1);
}

static VkDeviceSize end_of(const struct pack_item *item)
{
    return item->offset + item->size;
}

/* ---- live sets ---- */

/* Fills p->changes. Sets p->offsets to the offsets that items would have without aliasing. */
static void find_changes(const struct packing *p, struct pack_result *result)
{
    struct change *changes = p->changes;
    for (uint32_t i = 0; i < p->count; i++) {
        const struct pack_item *item = &p->items[i];
        struct change *after = &changes[item->last + 1];
        p->offsets[i] = align_up(result->unaliased, item->alignment);
        result->unaliased = p->offsets[i] + item->size;
        if (result->alignment < item->alignment)
            result->alignment = item->alignment;
        changes[item->first].taken += item->size;
        changes[item->first].begun++;
        after->taken -= item->size;
        after->ended++;
    }
}

/* Finds the live sets and size bounds. Returns an upper limit of the item count of all sets. */
static uint64_t find_live_sets(struct packing *p, uint32_t end, struct pack_result *result)
{
    VkDeviceSize taken = 0;
    struct live_set *newest = p->live_sets;
    struct live_set *next = newest;
    uint32_t alive = 0;
    uint32_t ended = 1; /* since the newest set; initially 1 */
    uint64_t live_sum = 0;
    for (struct change *pass = p->changes; pass <= &p->changes[end]; pass++) {
        taken += pass->taken;
        alive += pass->begun - pass->ended;
        ended += pass->ended;
        result->bound = result->bound < taken ? taken : result->bound;
        if (pass->begun) {
            newest = ended ? next++ : newest;
            newest->alive = alive;
            ended = 0;
            live_sum += alive;
        }
        pass->newest = newest;
    }
    p->live_sets_end = next;
    return live_sum;
}

/* ---- lists of spans ---- */

static void begin_spans(struct span *spans)
{
    spans[0] = (struct span){ 0 };
    spans[1].begin = UINT64_MAX;
}

/* Inserts a span before `next`. A loop beats memmove() because few spans follow. */
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

/* Allocates a span in the gap below `next`. */
static void take_span(struct span *next, struct span span)
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

/* Frees the bytes of an item. */
static void free_item(struct span *spans, const struct pack_item *item)
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

/* Returns the lowest free offset >= `begin` for an item. Sets set->next to the span above. */
static VkDeviceSize find_free(struct live_set *set, const struct pack_item *item,
                              VkDeviceSize begin)
{
    struct span *next = set->spans + 1;
    VkDeviceSize lowest = align_up(set->spans->end, item->alignment);
    begin = begin < lowest ? lowest : begin;
    for (; next->begin < begin + item->size; next++) {
        VkDeviceSize above = align_up(next->end, item->alignment);
        begin = begin < above ? above : begin;
    }
    set->next = next;
    return begin;
}

/* ---- orders of placement ---- */

/* Returns an item's sort key: the bits of a positive double, which sort like the double. */
static uint64_t product_of(const struct rule *rule, const struct pack_item *item)
{
    double product = rule->life_power ? (double)(int32_t)(item->last - item->first + 1) : 1;
    uint64_t bits;
    for (unsigned i = 0; i < rule->size_power; i++)
        product *= (double)(int64_t)item->size;
    memcpy(&bits, &product, sizeof(bits));
    return bits;
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

/* Sorts all items into p->order by descending key. qsort() is not used because it may allocate. */
static void sort(struct packing *p, const struct rule *rule)
{
    for (uint32_t i = 0; i < p->count; i++)
        p->order[i] = (~product_of(rule, &p->items[i]) & UINT64_MAX << 32) | i;
    if (p->count <= FEW_ITEMS)
        sort_few(p->order, p->count);
    for (unsigned shift = 32; shift < 64 && p->count > FEW_ITEMS; shift += 8) { /* radix sort */
        uint32_t begins[257] = { 0 };
        uint64_t *from = p->order;
        for (uint32_t i = 0; i < p->count; i++)
            begins[(from[i] >> shift & 255) + 1]++;
        for (uint32_t i = 1; i < 256; i++)
            begins[i] += begins[i - 1];
        for (uint32_t i = 0; i < p->count; i++)
            p->sorted[begins[from[i] >> shift & 255]++] = from[i];
        p->order = p->sorted;
        p->sorted = from;
    }
}

/* Moves the item that ends highest in memory to half its index in p->order. */
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

/* Assigns an item the lowest offset that is free in all its live sets, by fixed-point iteration. */
static void place_item(const struct packing *p, struct pack_item *item)
{
    struct live_set *first = p->changes[item->first].newest;
    struct live_set *last = p->changes[item->last].newest;
    /* the search ends here unless a set raises `begin`; then all sets have to be checked again */
    const struct live_set *end = last;
    VkDeviceSize begin = 0;
    for (struct live_set *set = first;; set = set == last ? first : set + 1) {
        VkDeviceSize before = begin;
        begin = find_free(set, item, begin);
        if (begin != before)
            end = set == first ? last : set - 1;
        if (set == end)
            break;
    }
    item->offset = begin;
    for (const struct live_set *set = first; set <= last; set++)
        take_span(set->next, (struct span){ begin, begin + item->size });
}

/* Places items in the current order. Returns the block size; UINT64_MAX if not below `limit`. */
static VkDeviceSize apply_order(struct packing *p, VkDeviceSize limit)
{
    VkDeviceSize size = 0;
    struct span *spans = p->spans;
    for (struct live_set *set = p->live_sets; set < p->live_sets_end; set++) {
        set->spans = spans;
        begin_spans(spans);
        spans += set->alive + 2; /* at most alive + 2 spans */
    }
    for (p->placed = 0; p->placed < p->count && size < limit; p->placed++) {
        struct pack_item *item = &p->items[(uint32_t)p->order[p->placed]];
        place_item(p, item);
        size = size < end_of(item) ? end_of(item) : size;
    }
    return size < limit ? size : UINT64_MAX;
}

/* Tries several orders. Stores the offsets of the smallest block below `size`. Returns its size. */
static VkDeviceSize apply_orders(struct packing *p, VkDeviceSize size, VkDeviceSize bound)
{
    uint32_t order_count = p->count > MANY_ITEMS ? RULES_OF_MANY_ITEMS : RULE_COUNT + PROMOTIONS;
    for (uint32_t i = 0; i < order_count && size > bound; i++) {
        if (i < RULE_COUNT)
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

/* Places each item at the lowest free offset, in order of first use. Returns the block size in
 * bytes. The running time does not depend on the lengths of lifetimes. */
static VkDeviceSize apply_time_order(const struct packing *p, struct arena *arena, uint32_t end)
{
    struct live_set set = { .spans = ARENA_ARRAY(arena, struct span, (size_t)p->count + 2) };
    /* heads of linked lists of the items that end at each pass: item index + 1, or 0 if empty */
    uint32_t *ending = ARENA_ZEROED(arena, uint32_t, (size_t)end + 1);
    uint32_t *next = ARENA_ARRAY(arena, uint32_t, p->count);
    uint32_t now = 0;
    VkDeviceSize size = 0;
    if (arena->failed)
        return 0;
    begin_spans(set.spans);
    for (uint32_t i = 0; i < p->count; i++) {
        struct pack_item *item = &p->items[i];
        for (; now < item->first; now++) {
            for (uint32_t dead = ending[now]; dead; dead = next[dead - 1])
                free_item(set.spans, &p->items[dead - 1]);
        }
        item->offset = find_free(&set, item, 0);
        take_span(set.next, (struct span){ item->offset, end_of(item) });
        next[i] = ending[item->last];
        ending[item->last] = i + 1;
        size = size < end_of(item) ? end_of(item) : size;
        p->offsets[i] = item->offset;
    }
    return size;
}

struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count,
                           uint32_t end, bool unaliased)
{
    struct pack_result result = { .alignment = 1 };
    struct packing p = {
        .items = items,
        .count = count,
        .changes = ARENA_ZEROED(arena, struct change, (size_t)end + 2),
        .live_sets = ARENA_ARRAY(arena, struct live_set, count),
        .offsets = ARENA_ARRAY(arena, VkDeviceSize, count),
        .order = ARENA_ARRAY(arena, uint64_t, count),
        .sorted = ARENA_ARRAY(arena, uint64_t, count),
    };
    if (arena->failed)
        return result;
    find_changes(&p, &result);
    uint64_t live_sum = find_live_sets(&p, end, &result);
    size_t live_set_count = (size_t)(p.live_sets_end - p.live_sets);
    result.size = result.unaliased;
    bool shared = !unaliased && result.unaliased > result.bound;
    if (shared && live_sum > MANY_ITEMS * MANY_ITEMS / 2 + (uint64_t)count * LONG_LIFE) {
        result.size = apply_time_order(&p, arena, end);
    } else if (shared) {
        p.spans = ARENA_ARRAY(arena, struct span, live_sum + 2 * live_set_count);
        if (p.spans)
            result.size = apply_orders(&p, result.unaliased, result.bound);
    }
    for (uint32_t i = 0; i < count; i++)
        items[i].offset = p.offsets[i];
    return result;
}

/* ---- blocks: each has either images or buffers, so that bufferImageGranularity never applies, and
 * one set of memory types ---- */

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
    bool unaliased = c->params->sharing == RG_SHARE_NOTHING; /* no memory is reused */
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
