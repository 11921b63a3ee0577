/* subresource_state.c: synchronisation state of subresources at the start of a frame. */
#include "graph/compile/subresource_state.h"

/* Returns the state in which an import's subresources begin a frame (struct rg_import). The first
 * write waits for all commands, because earlier readers are unknown. */
static struct cell import_state(const struct compiler *c, struct resource *r)
{
    enum rg_access access = c->params->imports[r->import].access;
    const struct access arrival = rg_boundary_access(r, access);
    struct cell s = {
        .layout = arrival.layout,
        .write_stages = arrival.stages ? arrival.stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .write_access = rg_access_table[access].writes,
    };
    if (access == RG_ACCESS_NONE)
        s.write_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
    if (arrival.flags & ACCESS_WRITES || access == RG_ACCESS_NONE)
        return s;
    s.read_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    s.flags = CELL_AWAITED;
    s.visible = arrival.visibility & RG_VISIBLE_TO_ALL;
    return s;
}

/* ---- persistent resources begin a frame in the state in which the previous frame ended ---- */

static void simulate_access(const struct access *a)
{
    for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w)) {
        struct rg_barrier unused;
        uint32_t release;
        bool needed = rg_needs_barrier(w.cell, a, &unused, &release);
        rg_apply_access(w.cell, a, 0, needed);
    }
}

static void simulate_frame(struct compiler *c)
{
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        const struct access *a = &c->accesses[pass->first_access];
        for (uint32_t i = 0; i < pass->access_count && pass->alive; i++) {
            if (a[i].resource->persistent)
                simulate_access(&a[i]);
        }
    }
    for (uint32_t i = 0; i < c->boundary_count; i++) {
        struct resource *r = c->resources[i];
        if (!r->persistent || r->output == RG_NONE)
            continue;
        const struct access a = rg_boundary_access(r, c->params->outputs[r->output].access);
        simulate_access(&a);
    }
}

void rg_each_history_read(struct compiler *c, rg_history_read_fn *visit)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++)
            r->cells[k].changed = false;
    }
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        const struct access *first = &c->accesses[pass->first_access];
        const struct access *end = first + (pass->alive ? pass->access_count : 0);
        for (const struct access *a = first; a < end; a++) {
            if (!a->resource->persistent)
                continue;
            for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w)) {
                if (a->flags & ACCESS_WRITES || w.cell->layout != a->layout)
                    w.cell->changed = true;
                if (!w.cell->changed)
                    visit(c, &w, a);
            }
        }
    }
}

/* Marks a read of the previous frame's content as synchronised if the previous frame has a barrier
 * for another such read. barriers.c then extends this barrier to cover both reads. */
static void expect_history_read(struct compiler *c, const struct cell_walk *w,
                                const struct access *a)
{
    (void)c;
    if (w->cell->visible)
        w->cell->visible |= a->visibility & RG_VISIBLE_TO_ALL;
}

static void begin_history(struct compiler *c)
{
    simulate_frame(c);
    rg_each_history_read(c, expect_history_read);
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++) {
            struct cell *s = &r->cells[k];
            s->written = s->touched = s->barrier_end = 0;
            s->flags &= ~(uint32_t)(CELL_CHANGED | CELL_CERTAIN);
        }
    }
}

void rg_begin_cells(struct compiler *c)
{
    for (uint32_t i = 0; i < c->item_count && c->owners; i++) {
        const struct resource *r = c->items[i].resource;
        for (uint32_t k = 0; k < r->cell_count; k++)
            r->cells[k].written = r->cells[k].touched = c->owners[r->item].end;
    }
    for (uint32_t i = 0; i < c->boundary_count; i++) {
        struct resource *r = c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->import != RG_NONE; k++)
            r->cells[k] = import_state(c, r);
    }
    if (c->persistent_count)
        begin_history(c);
}
