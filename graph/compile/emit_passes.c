/* emit_passes.c: writes the plan's passes with their targets and uses, and adds their barriers. */
#include "graph/compile/compiler.h"

static const VkAttachmentLoadOp load_ops[] = {
    [RG_LOAD_KEEP] = VK_ATTACHMENT_LOAD_OP_LOAD,
    [RG_LOAD_CLEAR] = VK_ATTACHMENT_LOAD_OP_CLEAR,
    [RG_LOAD_DISCARD] = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
};

/* Writes an attachment field by field: copying a whole struct takes several times as long. */
static void write_target(struct rg_plan_target *target, const struct access *a)
{
    const struct rg_target *declared = a->declared;
    bool writes = a->flags & ACCESS_WRITES;
    target->image = a->resource->plan_image;
    target->mip = a->range.baseMipLevel;
    target->layer = a->range.baseArrayLayer;
    target->load = writes ? load_ops[declared->load] : VK_ATTACHMENT_LOAD_OP_LOAD;
    target->store = !writes                    ? VK_ATTACHMENT_STORE_OP_NONE
                    : a->flags & ACCESS_NEEDED ? VK_ATTACHMENT_STORE_OP_STORE
                                               : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    target->layout = a->layout;
    target->resolve = RG_NONE;
    target->resolve_mip = target->resolve_layer = 0;
}

static void write_access(struct compiler *c, const struct access *a, struct rg_plan_pass *pass)
{
    struct rg_plan *plan = c->plan;
    struct rg_plan_target *newest = &c->colors[plan->color_count];
    if (a->kind == RG_COLOR) {
        write_target(newest, a);
        plan->color_count++;
        pass->color_count++;
    } else if (a->kind == RG_RESOLVE) {
        newest[-1].resolve = a->resource->plan_image;
        newest[-1].resolve_mip = a->range.baseMipLevel;
        newest[-1].resolve_layer = a->range.baseArrayLayer;
    } else if (a->kind == RG_DEPTH || a->kind == RG_DEPTH_READ) {
        write_target(&pass->depth, a);
    } else {
        struct rg_plan_use *use = &c->uses[plan->use_count++];
        use->use = a->declared;
        use->image = a->resource->plan_image;
        use->buffer = a->resource->plan_buffer;
        use->range = a->resource->image ? a->range : (VkImageSubresourceRange){ 0 };
        use->layout = a->layout;
        pass->use_count++;
    }
}

/* Writes a pass of the plan. Barriers for the first use of memory come last, because they may then
 * join a batch that the pass needs anyway, and acquire the memory as late as possible. */
static void write_pass(struct compiler *c, const struct pass *pass, uint32_t index)
{
    const struct access *first = &c->accesses[pass->first_access];
    const struct access *end = first + pass->access_count;
    struct rg_plan_pass *out = &c->plan_passes[index];
    out->first_barrier = out->barrier_count = 0;
    out->first_use = c->plan->use_count;
    out->use_count = 0;
    out->color = &c->colors[c->plan->color_count];
    out->color_count = 0;
    out->depth = (struct rg_plan_target){ .image = RG_NONE };
    bool any_first = false;
    for (const struct access *a = first; a < end; a++) {
        write_access(c, a, out);
        if (a->resource->first != index)
            rg_add_barriers(c, a, index, false);
        else
            any_first = true;
    }
    for (const struct access *a = first; a < end && any_first; a++) {
        if (a->resource->first == index)
            rg_add_barriers(c, a, index, false);
    }
}

void rg_write_plan_passes(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    uint32_t index = 0;
    struct rg_culled *culled =
        ARENA_ARRAY(c->arena, struct rg_culled, c->pass_count - plan->pass_count);
    c->uses = ARENA_ARRAY(c->arena, struct rg_plan_use, c->access_count);
    c->colors = ARENA_ARRAY(c->arena, struct rg_plan_target, c->color_count);
    rg_begin_cells(c);
    for (uint32_t p = 0; p < c->pass_count && !c->arena->failed; p++) {
        const struct rg_plan_pass *pass = &c->plan_passes[p];
        if (!c->passes[p].alive) {
            culled[plan->culled_count++] = (struct rg_culled){ pass->pass, pass->repetition };
            continue;
        }
        if (index < p)
            c->plan_passes[index] = *pass;
        write_pass(c, &c->passes[p], index++);
    }
    plan->passes = c->plan_passes;
    plan->uses = c->uses;
    plan->colors = c->colors;
    plan->culled = culled;
    plan->fallbacks = c->fallbacks;
    plan->fallback_count = c->fallback_count;
    if (!c->arena->failed)
        rg_end_barriers(c);
}
