/* passes.c: the plan's passes, their targets and uses. */
#include "graph/compile/barriers.h"

static const VkAttachmentLoadOp load_ops[] = {
    [RG_LOAD_KEEP] = VK_ATTACHMENT_LOAD_OP_LOAD,
    [RG_LOAD_CLEAR] = VK_ATTACHMENT_LOAD_OP_CLEAR,
    [RG_LOAD_DISCARD] = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
};

static struct rg_plan_target plan_target(const struct compiler *c, const struct access *a)
{
    const struct rg_target *target = a->declared;
    bool writes = a->flags & ACCESS_WRITES_CONTENT;
    VkAttachmentStoreOp store =
        a->flags & ACCESS_NEEDED ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return (struct rg_plan_target){
        .image = a->resource->plan_image,
        .mip = rg_range_of(c, a)->baseMipLevel,
        .layer = rg_range_of(c, a)->baseArrayLayer,
        .load = writes ? load_ops[target->load] : VK_ATTACHMENT_LOAD_OP_LOAD,
        .store = writes ? store : VK_ATTACHMENT_STORE_OP_NONE,
        .layout = a->effect->layout,
        .resolve = RG_NONE,
    };
}

static void add_resolve(const struct compiler *c, const struct access *a,
                        struct rg_plan_target *target)
{
    target->resolve = a->resource->plan_image;
    target->resolve_mip = rg_range_of(c, a)->baseMipLevel;
    target->resolve_layer = rg_range_of(c, a)->baseArrayLayer;
}

/* Of targets only says that there are none so far (emit_target). */
static void begin_pass(const struct compiler *c, const struct pass *pass, struct rg_plan_pass *out)
{
    out->pass = pass->rg;
    out->technique = pass->technique;
    out->row = pass->row;
    out->repetition = pass->repetition;
    out->extent = pass->extent;
    out->first_barrier = out->barrier_count = 0;
    out->color = &c->colors[c->plan->color_count];
    out->color_count = 0;
    out->depth.image = RG_NONE;
    out->first_use = c->plan->use_count;
}

static void emit_target(struct compiler *c, const struct access *a, struct rg_plan_pass *out)
{
    if (a->effect->access == RG_COLOR) {
        c->colors[c->plan->color_count++] = plan_target(c, a);
        out->color_count++;
    } else if (a->effect->access == RG_RESOLVE) {
        add_resolve(c, a, &c->colors[c->plan->color_count - 1]);
    } else {
        out->depth = plan_target(c, a);
    }
}

/* Field by field: a copy of the whole takes twice as long. */
static inline void emit_use(const struct compiler *c, const struct resource *r,
                            const struct access *a, struct rg_plan_use *use)
{
    use->use = a->declared;
    use->image = r->plan_image;
    use->buffer = r->plan_buffer;
    use->range = a->range ? c->ranges[a->range - 1] : r->all;
    use->layout = a->effect->layout;
}

/*
 * Barriers of memory that is used for the first time come last: if the pass needs a new batch
 * anyway, they lie in it, and the memory changes hands as late as it can.
 */
static void emit_pass(struct sync *sync, const struct pass *pass, struct rg_plan_use *uses,
                      uint32_t index)
{
    struct compiler *c = sync->c;
    struct rg_plan_pass *out = &sync->passes[index];
    struct rg_plan_use *use = &uses[c->plan->use_count];
    const struct access *a = &c->accesses[pass->first_access];
    const struct access *late = NULL;
    begin_pass(c, pass, out);
    const struct access *end = a + pass->access_count;
    for (; a < end; a++) {
        struct resource *r = a->resource;
        rg_follow(c, r, a->effect->usage, index);
        if (a->effect->access > RG_RESOLVE)
            emit_use(c, r, a, use++);
        else
            emit_target(c, a, out);
        if (r->first != index)
            rg_sync_access(sync, r, a, index);
        else if (!late)
            late = a;
    }
    out->use_count = (uint32_t)(use - uses) - out->first_use;
    c->plan->use_count += out->use_count;
    for (; late && late < end; late++) {
        struct resource *r = late->resource;
        if (r->first != index)
            continue;
        if (r->cell_count == 1 && r->cell.flags & CELL_FRESH)
            rg_sync_move(sync, r, late, index, true);
        else
            rg_sync_access(sync, r, late, index);
    }
}

void rg_emit(struct compiler *c, struct sync *sync)
{
    struct rg_plan *plan = c->plan;
    struct rg_plan_pass *passes = ARENA_ARRAY(c->arena, struct rg_plan_pass, plan->pass_count);
    struct rg_plan_use *uses = ARENA_ARRAY(c->arena, struct rg_plan_use, c->alive_access_count);
    struct rg_culled *culled =
        ARENA_ARRAY(c->arena, struct rg_culled, c->pass_count - plan->pass_count);
    c->colors = ARENA_ARRAY(c->arena, struct rg_plan_target, c->color_access_count);
    rg_sync_begin(sync, passes);
    if (c->arena->failed)
        return;
    plan->passes = passes;
    plan->uses = uses;
    plan->colors = c->colors;
    plan->culled = culled;
    uint32_t index = 0;
    for (const struct pass *pass = c->passes, *end = pass + c->pass_count; pass < end; pass++) {
        if (pass->alive)
            emit_pass(sync, pass, uses, index++);
        else
            *culled++ = (struct rg_culled){ pass->rg, pass->repetition };
    }
    plan->culled_count = c->pass_count - plan->pass_count;
    rg_follow_outputs(c);
    rg_sync_end(sync);
}
