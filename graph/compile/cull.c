/*
 * cull.c: which passes live.
 *
 * From the last pass back: a pass lives if a later living pass or an output needs what it leaves.
 * The next frame needs what a frame leaves in a persistent resource if the frame reads it before it
 * writes it; that is known when the first pass has been looked at, so the walk is repeated until
 * nothing is new.
 */
#include "graph/compile/compiler.h"

enum {
    MAX_ROUNDS = 4 /* then all of every persistent resource counts as needed */
};

/* Cells begin unwanted, so that the first round has only outputs to look at. */
static void begin_round(struct compiler *c, uint32_t round)
{
    uint32_t count = round ? c->resource_count : c->boundary_count;
    for (uint32_t i = 0; i < count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count; k++) {
            struct cell *cell = &r->cells[k];
            cell->wanted_next = r->persistent && (cell->wanted_next || round == MAX_ROUNDS);
            cell->wanted = r->output != RG_NONE || cell->wanted_next;
        }
    }
}

/* Whether later passes or outputs need any of what this access leaves, if it does. */
static bool is_wanted(const struct access *a)
{
    if (!(a->flags & ACCESS_WRITES))
        return false;
    for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w)) {
        if (w.cell->wanted)
            return true;
    }
    return false;
}

/* Notes for each access of a pass whether it is needed. Returns whether any is. */
static bool find_needed(struct access *first, const struct access *end)
{
    bool any = false;
    for (struct access *a = first; a < end; a++) {
        bool needed = is_wanted(a);
        a->flags = needed ? a->flags | ACCESS_NEEDED : a->flags & ~(uint32_t)ACCESS_NEEDED;
        any = any || needed;
    }
    return any;
}

/* Notes for earlier passes what a living one does. No access of a pass reads what another one of it
 * overwrites. */
static void mark_wanted(const struct access *first, const struct access *end)
{
    for (const struct access *a = first; a < end; a++) {
        if (!(a->flags & (ACCESS_OVERWRITES | ACCESS_READS)))
            continue;
        for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w))
            w.cell->wanted = a->flags & ACCESS_READS;
    }
}

static void cull_round(struct compiler *c)
{
    c->plan->pass_count = 0;
    for (uint32_t p = c->pass_count; p-- > 0;) {
        struct pass *pass = &c->passes[p];
        struct access *first = &c->accesses[pass->first_access];
        const struct access *end = first + pass->access_count;
        pass->alive = find_needed(first, end);
        if (!pass->alive)
            continue;
        mark_wanted(first, end);
        c->plan->pass_count++;
    }
}

/* Whether the next frame needs more than this round was told. */
static bool wants_more(const struct compiler *c)
{
    bool more = false;
    for (uint32_t i = 0; i < c->resource_count && c->persistent_count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++) {
            struct cell *cell = &r->cells[k];
            more = more || (cell->wanted && !cell->wanted_next);
            cell->wanted_next = cell->wanted_next || cell->wanted;
        }
    }
    return more;
}

void rg_cull(struct compiler *c)
{
    uint32_t round = 0;
    do {
        begin_round(c, round++);
        cull_round(c);
    } while (round <= MAX_ROUNDS && wants_more(c));
}
