/*
 * cull.c: which passes anybody needs.
 *
 * From the last pass back: a pass lives if a later living one or an output wants what it leaves.
 * What a frame leaves in a persistent resource is wanted if the frame reads it before it writes it;
 * that is known when the walk has come to the first pass, so it is repeated until nothing is new.
 */
#include "graph/compile/compiler.h"

enum {
    MAX_ROUNDS = 4 /* then all of every persistent resource counts as wanted */
};

static void set_cell(struct resource *r, uint32_t cell, bool value)
{
    if (r->cell_count == 1)
        r->wanted = value ? WANT_ALL : WANT_NOTHING;
    else
        r->cells[cell].wanted = value;
}

static bool is_cell_wanted(const struct resource *r, uint32_t cell)
{
    return r->cell_count == 1 ? r->wanted == WANT_ALL : r->cells[cell].wanted;
}

static void begin_round(struct compiler *c, uint32_t round)
{
    uint32_t count = c->persistent_count ? c->resource_count : c->end_count;
    for (uint32_t i = 0; i < count; i++) {
        struct resource *r = &c->resources[i];
        bool output = r->output != RG_NONE;
        if (!output && !r->persistent)
            continue;
        for (uint32_t k = 0; k < r->cell_count; k++) {
            struct cell *cell = &r->cells[k];
            cell->wanted_next = r->persistent && (cell->wanted_next || round == MAX_ROUNDS);
            set_cell(r, k, output || cell->wanted_next);
        }
    }
}

__attribute__((noinline)) static bool is_any_cell_wanted(const struct compiler *c,
                                                         const struct access *access)
{
    const struct resource *r = access->resource;
    bool any = false;
    for (struct cell_walk w = rg_walk(r, rg_range_of(c, access)); rg_walk_next(&w);)
        any = any || w.cell->wanted;
    return any;
}

__attribute__((noinline)) static void mark_cells(const struct compiler *c,
                                                 const struct access *access, bool value)
{
    const struct resource *r = access->resource;
    for (struct cell_walk w = rg_walk(r, rg_range_of(c, access)); rg_walk_next(&w);)
        w.cell->wanted = value;
}

/* Whether later passes or outputs want any of what this access leaves, if it does. */
static inline bool is_wanted(const struct compiler *c, const struct access *access)
{
    enum wanted wanted = access->resource->wanted;
    return wanted & access->flags ||
           (wanted == WANT_CELLS && access->flags & ACCESS_WRITES_CONTENT &&
            is_any_cell_wanted(c, access));
}

static inline void mark(const struct compiler *c, const struct access *access)
{
    bool value = access->flags & ACCESS_READS_CONTENT;
    enum wanted *wanted = &access->resource->wanted;
    if (*wanted == WANT_CELLS)
        mark_cells(c, access, value);
    else
        *wanted = value ? WANT_ALL : WANT_NOTHING;
}

/* Whether anybody wants any of what a pass leaves. Most write last. */
static inline bool is_needed(const struct compiler *c, const struct access *first,
                             const struct access *end)
{
    for (const struct access *a = end; a-- > first;) {
        if (is_wanted(c, a))
            return true;
    }
    return false;
}

/* What one access of a pass overwrites no other one of it reads. Targets come first. */
static inline void live(const struct compiler *c, struct access *first, const struct access *end)
{
    for (struct access *a = first; a < end && a->effect->access <= RG_RESOLVE; a++) {
        a->flags &= ~(uint32_t)ACCESS_NEEDED;
        a->flags |= is_wanted(c, a) ? ACCESS_NEEDED : 0;
    }
    for (const struct access *a = first; a < end; a++) {
        if (a->flags & (ACCESS_OVERWRITES | ACCESS_READS_CONTENT))
            mark(c, a);
    }
}

/* Whether the next frame wants more than the walk was told. */
static bool want_more(const struct compiler *c)
{
    bool more = false;
    for (uint32_t i = 0; i < c->resource_count && c->persistent_count; i++) {
        const struct resource *r = &c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++) {
            struct cell *cell = &r->cells[k];
            bool wanted = is_cell_wanted(r, k);
            more = more || (wanted && !cell->wanted_next);
            cell->wanted_next = cell->wanted_next || wanted;
        }
    }
    return more;
}

static void reset(struct compiler *c)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        struct resource *r = &c->resources[i];
        r->wanted = r->cell_count == 1 ? WANT_NOTHING : WANT_CELLS;
        for (uint32_t k = 0; k < r->cell_count && r->cell_count > 1; k++)
            r->cells[k].wanted = false;
    }
}

static inline void cull(struct compiler *c)
{
    uint32_t pass_count = 0;
    uint32_t access_count = 0;
    struct pass *const passes = c->passes;
    struct access *const accesses = c->accesses;
    for (struct pass *pass = passes + c->pass_count; pass-- > passes;) {
        struct access *first = &accesses[pass->first_access];
        const struct access *end = first + pass->access_count;
        pass->alive = is_needed(c, first, end);
        if (!pass->alive)
            continue;
        live(c, first, end);
        access_count += pass->access_count;
        pass_count++;
    }
    c->alive_access_count = access_count;
    c->plan->pass_count = pass_count;
}

void rg_cull(struct compiler *c)
{
    uint32_t round = 0;
    do {
        if (round)
            reset(c);
        begin_round(c, round++);
        cull(c);
    } while (round <= MAX_ROUNDS && want_more(c));
}
