/*
 * cell_state.c: what a cell needs before an access, and what the access leaves.
 *
 * Every cell (rg_internal.h) remembers its layout, its last write, the stages that have read it
 * since, and to which stages and accesses the write was made visible. From these follow (Vulkan
 * 1.3, chapter 7): a read needs a barrier unless it is covered by an earlier one; a write always
 * needs one; a change of layout is a write between the barrier's two halves, and later barriers
 * chain on to the stages it was made visible to.
 *
 * A frame follows itself on one queue without a pause, so the first use of any memory waits for
 * whoever used it last in the frame before, and for those it is shared with.
 */
#include "graph/compile/cell_state.h"

/* As struct rg_import says; nobody knows who else reads it, so a write waits for everything. */
static struct cell import_state(const struct compiler *c, const struct resource *r)
{
    enum rg_access access = c->params->imports[r->import].access;
    const struct rg_access_info *info = &rg_access_table[access];
    bool shader = !info->stages && (info->reads || info->writes);
    struct cell s = {
        .layout = r->image ? info->layout : VK_IMAGE_LAYOUT_UNDEFINED,
        .write_stages = shader ? RG_ANY_SHADER : info->stages,
        .write_access = info->writes,
    };
    if (!s.write_stages)
        s.write_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    if (access == RG_ACCESS_NONE)
        s.write_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
    if (info->writes_content || access == RG_ACCESS_NONE)
        return s;
    s.read_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    s.flags = CELL_AWAITED;
    s.visible = rg_visibility(access, RG_ANY_SHADER);
    return s;
}

static void rehearse_access(const struct resource *r, const struct access *a,
                            const VkImageSubresourceRange *range)
{
    for (struct cell_walk w = rg_walk(r, range); rg_walk_next(&w);) {
        struct rg_barrier unused;
        uint32_t release;
        bool needed = rg_state_decide(w.cell, a, &unused, &release);
        rg_state_apply(w.cell, a, 0, needed);
    }
}

/* What a frame finds in persistent resources is what a frame leaves: the frame is rehearsed. */
static void rehearse(struct compiler *c)
{
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        for (uint32_t i = 0; i < pass->access_count && pass->alive; i++) {
            const struct access *a = &c->accesses[pass->first_access + i];
            if (a->resource->persistent)
                rehearse_access(a->resource, a, rg_range_of(c, a));
        }
    }
    for (uint32_t i = 0; i < c->resource_count; i++) {
        struct resource *r = &c->resources[i];
        if (!r->persistent || r->output == RG_NONE)
            continue;
        struct effect effect;
        const struct access a = rg_end_access(r, c->params->outputs[r->output].access, &effect);
        rehearse_access(r, &a, &r->all);
    }
}

void rg_state_each_early(struct compiler *c, rg_early_fn *see, void *user)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        for (uint32_t k = 0; k < c->resources[i].cell_count && c->resources[i].persistent; k++)
            c->resources[i].cells[k].changed = false;
    }
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        for (uint32_t i = 0; i < pass->access_count && pass->alive; i++) {
            const struct access *a = &c->accesses[pass->first_access + i];
            if (!a->resource->persistent)
                continue;
            bool writes = a->flags & ACCESS_WRITES_CONTENT;
            for (struct cell_walk w = rg_walk(a->resource, rg_range_of(c, a)); rg_walk_next(&w);) {
                if (writes || w.cell->layout != a->effect->layout)
                    w.cell->changed = true;
                if (!w.cell->changed)
                    see(user, a->resource, &w, a);
            }
        }
    }
}

/* Where a barrier of the frame before has made a write visible to some who read it, it will do so
 * for this one, too (rg_sync_end). */
static void expect_early(void *user, struct resource *r, const struct cell_walk *w,
                         const struct access *a)
{
    (void)user, (void)r;
    if (w->cell->visible)
        w->cell->visible |= a->effect->visibility & RG_VISIBLE_TO_ALL;
}

static void keep_state(struct cell *s)
{
    s->written = s->touched = 0;
    s->barrier_end = 0;
    s->flags &= ~(uint32_t)(CELL_CHANGED | CELL_CERTAIN);
}

/* Of shared memory, when those who had it before are known. */
static void wait_for_formers(struct compiler *c)
{
    for (uint32_t i = 0; i < c->item_count; i++) {
        const struct resource *r = c->items[i].resource;
        for (uint32_t k = 0; k < r->cell_count; k++)
            r->cells[k].written = r->cells[k].touched = c->formers[i].end;
    }
}

void rg_state_begin(struct compiler *c)
{
    if (c->formers)
        wait_for_formers(c);
    for (uint32_t i = 0; i < c->end_count; i++) {
        const struct resource *r = &c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->import != RG_NONE; k++)
            r->cells[k] = import_state(c, r);
    }
    if (!c->persistent_count)
        return;
    rehearse(c);
    rg_state_each_early(c, expect_early, NULL);
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        for (uint32_t k = 0; k < r->cell_count && r->persistent; k++)
            keep_state(&r->cells[k]);
    }
}
