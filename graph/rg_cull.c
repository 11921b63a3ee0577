/*
 * rg_cull.c: which passes anybody needs.
 *
 * From the last pass back: a pass lives if a later living one or an output wants what it leaves.
 * What a frame leaves in a persistent resource is wanted if the frame reads it before it writes it;
 * that is known when the walk has come to the first pass, so it is repeated until nothing is new.
 */
#include "graph/rg_internal.h"

enum {
    MAX_ROUNDS = 4 /* then all of every persistent resource counts as wanted */
};

static void begin_round(struct compiler *c, uint32_t round)
{
    uint32_t count = c->persistent_count ? c->resource_count : c->end_count;
    for (uint32_t i = 0; i < count; i++) {
        const struct resource *r = &c->resources[i];
        bool output = r->output != RG_NONE;
        if (!output && !r->persistent)
            continue;
        for (uint32_t k = 0; k < r->cell_count; k++) {
            struct cell *cell = &r->cells[k];
            cell->wanted_next = r->persistent && (cell->wanted_next || round == MAX_ROUNDS);
            cell->wanted = output || cell->wanted_next;
        }
    }
}

/* Whether later passes or outputs want any of what this access leaves. */
static inline bool is_wanted(const struct compiler *c, const struct access *access)
{
    const struct resource *r = &c->resources[access->resource];
    bool any = false;
    if (r->cell_count == 1)
        return r->cell.wanted;
    for (struct cell_walk w = rg_walk(r, rg_range_of(c, access)); rg_walk_next(&w);)
        any = any || w.cell->wanted;
    return any;
}

static inline void mark(const struct compiler *c, const struct access *access, bool value)
{
    struct resource *r = &c->resources[access->resource];
    if (r->cell_count == 1) {
        r->cell.wanted = value;
        return;
    }
    for (struct cell_walk w = rg_walk(r, rg_range_of(c, access)); rg_walk_next(&w);)
        w.cell->wanted = value;
}

static bool is_alive(struct compiler *c, const struct pass *pass)
{
    bool alive = false;
    struct access *end = &c->accesses[pass->first_access + pass->access_count];
    for (struct access *a = &c->accesses[pass->first_access]; a < end; a++) {
        if (!(a->flags & ACCESS_WRITES_CONTENT))
            continue;
        bool needed = is_wanted(c, a);
        a->flags = needed ? a->flags | ACCESS_NEEDED : a->flags & ~(uint32_t)ACCESS_NEEDED;
        alive = alive || needed;
    }
    return alive;
}

/* What one access of a pass overwrites no other one of it reads. */
static void cull_pass(struct compiler *c, struct pass *pass)
{
    pass->alive = is_alive(c, pass);
    if (!pass->alive)
        return;
    c->alive_access_count += pass->access_count;
    c->plan->pass_count++;
    const struct access *end = &c->accesses[pass->first_access + pass->access_count];
    for (const struct access *a = &c->accesses[pass->first_access]; a < end; a++) {
        if (a->flags & (ACCESS_OVERWRITES | ACCESS_READS_CONTENT))
            mark(c, a, a->flags & ACCESS_READS_CONTENT);
    }
}

/* Whether the next frame wants more than the walk was told. */
static bool want_more(struct compiler *c)
{
    bool more = false;
    for (uint32_t i = 0; i < c->resource_count && c->persistent_count; i++) {
        const struct resource *r = &c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++) {
            struct cell *cell = &r->cells[k];
            more = more || (cell->wanted && !cell->wanted_next);
            cell->wanted_next = cell->wanted_next || cell->wanted;
        }
    }
    return more;
}

static void reset(struct compiler *c)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        for (uint32_t k = 0; k < r->cell_count; k++)
            r->cells[k].wanted = false;
    }
}

void rg_cull(struct compiler *c)
{
    uint32_t round = 0;
    do {
        if (round)
            reset(c);
        begin_round(c, round++);
        c->plan->pass_count = c->alive_access_count = 0;
        for (uint32_t p = c->pass_count; p-- > 0;)
            cull_pass(c, &c->passes[p]);
    } while (round <= MAX_ROUNDS && want_more(c));
}
