/* cull_passes.c: removes passes and trailing colour targets whose results no output needs, by
 * backward liveness analysis. */
#include "graph/compile/compiler.h"

enum {
    MAX_ROUNDS = 16 /* maximum number of iterations */
};

/* Starts an iteration: marks outputs and persistent content of the next frame as needed. In
 * the first iteration, no other content is needed yet. */
static void begin_round(struct compiler *c, uint32_t round)
{
    const uint32_t count = c->persistent_count ? c->resource_count : c->boundary_count;
    for (uint32_t i = 0; i < count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count; k++) {
            struct cell *cell = &r->cells[k];
            cell->is_needed_next_frame =
                r->persistent && (cell->is_needed_next_frame || round == MAX_ROUNDS);
            cell->is_needed = r->output != RG_NONE || cell->is_needed_next_frame;
        }
    }
}

/* Marks the accesses of a pass whose results are needed later. Returns true if any is marked. */
static bool find_needed(struct access *first, const struct access *end)
{
    bool any = false;
    for (struct access *a = first; a < end; a++) {
        bool needed = false;
        a->flags &= (uint8_t) ~(ACCESS_NEEDED | ACCESS_DROPPED);
        if (!(a->flags & ACCESS_WRITES))
            continue;
        for (struct cell_walk w = rg_cells(a); w.cell && !needed; rg_next_cell(&w))
            needed = w.cell->is_needed;
        a->flags |= needed ? ACCESS_NEEDED : 0;
        any = any || needed;
    }
    return any;
}

/* Marks the content that a live pass reads as needed, and content that it replaces as unneeded. */
static void mark_needed_content(const struct access *first, const struct access *end)
{
    for (const struct access *a = first; a < end; a++) {
        if (!(a->flags & (ACCESS_OVERWRITES | ACCESS_READS)) || a->flags & ACCESS_DROPPED)
            continue;
        for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w))
            w.cell->is_needed = a->flags & ACCESS_READS;
    }
}

/* Finds a pass's trailing colour targets, and their resolve targets, that nothing needs. The first
 * target is kept, so that the pass keeps its number of samples, and earlier targets are kept, so
 * that the locations of the others do not change. Rows without a fragment shader keep all, because
 * the application may bind its own pipelines, created for the declared targets. Returns true if any
 * is found. */
static bool find_dropped(struct access *first, const struct access *end, const struct rg_pass *row)
{
    struct access *a = first + 1;
    while (a < end && (a->kind == RG_COLOR || a->kind == RG_RESOLVE))
        a++;
    for (; a - 1 > first && !(a[-1].flags & ACCESS_NEEDED) && row->frag; a--)
        a[-1].flags |= ACCESS_DROPPED;
    if (a < end && a->kind == RG_RESOLVE) /* of a target that is kept */
        a++->flags &= (uint8_t)~ACCESS_DROPPED;
    return a < end && a->flags & ACCESS_DROPPED;
}

static void cull_round(struct compiler *c)
{
    for (uint32_t p = c->pass_count; p-- > 0;) {
        struct pass *pass = &c->passes[p];
        struct access *first = &c->accesses[pass->first_access];
        const struct access *end = first + pass->access_count;
        pass->alive = find_needed(first, end);
        if (!pass->alive)
            continue;
        pass->drops = first->kind == RG_COLOR && find_dropped(first, end, c->plan_passes[p].pass);
        mark_needed_content(first, end);
    }
}

/* Returns true if the next frame needs more persistent content than the last iteration assumed. */
static bool needs_another_round(const struct compiler *c)
{
    bool more = false;
    for (uint32_t i = 0; i < c->resource_count && c->persistent_count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++) {
            const struct cell *cell = &r->cells[k];
            struct cell *end = rg_is_history(r) ? &r->partner->cells[k] : &r->cells[k];
            more = more || (cell->is_needed && !end->is_needed_next_frame);
            end->is_needed_next_frame = end->is_needed_next_frame || cell->is_needed;
        }
    }
    return more;
}

/* Removes the accesses of the dropped targets. */
static void remove_dropped(struct pass *pass, struct access *first)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < pass->access_count; i++) {
        if (!(first[i].flags & ACCESS_DROPPED))
            first[count++] = first[i];
    }
    pass->access_count = count;
}

/* Removes the culled passes, and lists them in the plan. */
static void remove_culled(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    struct rg_culled *culled = ARENA_ARRAY(c->arena, struct rg_culled, c->pass_count);
    for (uint32_t p = 0; p < c->pass_count && culled; p++) {
        const struct rg_plan_pass *pass = &c->plan_passes[p];
        if (!c->passes[p].alive) {
            culled[plan->culled_count++] = (struct rg_culled){ pass->pass, pass->repetition };
        } else {
            if (c->passes[p].drops)
                remove_dropped(&c->passes[p], &c->accesses[c->passes[p].first_access]);
            c->passes[plan->pass_count] = c->passes[p];
            c->plan_passes[plan->pass_count++] = *pass;
        }
    }
    plan->culled = culled;
    c->pass_count = plan->pass_count;
}

void rg_cull(struct compiler *c)
{
    uint32_t round = 0;
    do {
        begin_round(c, round++);
        cull_round(c);
    } while (round <= MAX_ROUNDS && needs_another_round(c));
    remove_culled(c);
}
