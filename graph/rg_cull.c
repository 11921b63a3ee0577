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
    for (uint32_t i = 0; i < c->resource_count; i++) {
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
static bool is_wanted(const struct resource *r, const struct access *access)
{
    if (access->whole)
        return r->cells->wanted;
    bool any = false;
    for (struct cell_walk w = rg_walk(r, access); rg_walk_next(&w);)
        any = any || w.cell->wanted;
    return any;
}

static void mark(const struct resource *r, const struct access *access, bool value)
{
    if (access->whole) {
        r->cells->wanted = value;
        return;
    }
    for (struct cell_walk w = rg_walk(r, access); rg_walk_next(&w);)
        w.cell->wanted = value;
}

static bool is_alive(struct compiler *c, const struct pass *pass)
{
    bool alive = false;
    for (uint32_t i = 0; i < pass->access_count; i++) {
        struct access *a = &c->accesses[pass->first_access + i];
        if (!(a->flags & ACCESS_WRITES_CONTENT))
            continue;
        bool needed = is_wanted(&c->resources[a->resource], a);
        a->flags = (uint8_t)(needed ? a->flags | ACCESS_NEEDED : a->flags & ~ACCESS_NEEDED);
        alive = alive || needed;
    }
    return alive;
}

static void cull_pass(struct compiler *c, struct pass *pass)
{
    const struct access *accesses = &c->accesses[pass->first_access];
    pass->alive = is_alive(c, pass);
    if (!pass->alive)
        return;
    c->alive_access_count += pass->access_count;
    c->plan->pass_count++;
    for (uint32_t i = 0; i < pass->access_count; i++) {
        if (accesses[i].flags & ACCESS_OVERWRITES)
            mark(&c->resources[accesses[i].resource], &accesses[i], false);
    }
    for (uint32_t i = 0; i < pass->access_count; i++) {
        if (accesses[i].flags & ACCESS_READS_CONTENT)
            mark(&c->resources[accesses[i].resource], &accesses[i], true);
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
