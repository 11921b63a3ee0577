/* passes.c: the plan's passes, their targets and uses, with the barriers before each pass. */
#include "graph/compile/compiler.h"

static const VkAttachmentLoadOp load_ops[] = {
    [RG_LOAD_KEEP] = VK_ATTACHMENT_LOAD_OP_LOAD,
    [RG_LOAD_CLEAR] = VK_ATTACHMENT_LOAD_OP_CLEAR,
    [RG_LOAD_DISCARD] = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
};

/* The plan's arrays, while they are written. */
struct writer {
    struct compiler *c;
    struct rg_plan_pass *passes;
    struct rg_plan_use *uses;
    struct rg_plan_target *colors;
    struct rg_culled *culled;
    struct barrier_list barriers;
};

/* Field by field, as all that is written often: the copy of a whole struct takes several times as
 * long. */
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

static void write_access(struct writer *w, const struct access *a, struct rg_plan_pass *pass)
{
    struct rg_plan *plan = w->c->plan;
    struct rg_plan_target *newest = &w->colors[plan->color_count];
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
        struct rg_plan_use *use = &w->uses[plan->use_count++];
        use->use = a->declared;
        use->image = a->resource->plan_image;
        use->buffer = a->resource->plan_buffer;
        use->range = a->resource->image ? a->range : (VkImageSubresourceRange){ 0 };
        use->layout = a->layout;
        pass->use_count++;
    }
}

/*
 * Barriers of memory that is used for the first time come last: if the pass needs a new batch
 * anyway, they are part of it, and the memory changes hands as late as it can.
 */
static void write_pass(struct writer *w, const struct pass *pass, uint32_t index)
{
    const struct access *first = &w->c->accesses[pass->first_access];
    const struct access *end = first + pass->access_count;
    struct rg_plan_pass *out = &w->passes[index];
    out->pass = pass->rg;
    out->technique = pass->technique;
    out->row = pass->row;
    out->repetition = pass->repetition;
    out->extent = pass->extent;
    out->first_barrier = out->barrier_count = 0;
    out->first_use = w->c->plan->use_count;
    out->use_count = 0;
    out->first_fallback = pass->first_fallback;
    out->fallback_count = pass->fallback_count;
    out->color = &w->colors[w->c->plan->color_count];
    out->color_count = 0;
    out->depth = (struct rg_plan_target){ .image = RG_NONE };
    bool any_first = false;
    for (const struct access *a = first; a < end; a++) {
        write_access(w, a, out);
        if (a->resource->first != index)
            rg_add_barriers(&w->barriers, a, index);
        else
            any_first = true;
    }
    for (const struct access *a = first; a < end && any_first; a++) {
        if (a->resource->first == index)
            rg_add_barriers(&w->barriers, a, index);
    }
}

void rg_write_passes(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    uint32_t culled_count = c->pass_count - plan->pass_count;
    uint32_t index = 0;
    struct writer w = {
        .c = c,
        .passes = ARENA_ARRAY(c->arena, struct rg_plan_pass, plan->pass_count),
        .uses = ARENA_ARRAY(c->arena, struct rg_plan_use, c->access_count),
        .colors = ARENA_ARRAY(c->arena, struct rg_plan_target, c->color_count),
        .culled = ARENA_ARRAY(c->arena, struct rg_culled, culled_count),
    };
    rg_begin_barriers(&w.barriers, c, w.passes);
    for (uint32_t p = 0; p < c->pass_count && !c->arena->failed; p++) {
        const struct pass *pass = &c->passes[p];
        if (pass->alive)
            write_pass(&w, pass, index++);
        else
            w.culled[plan->culled_count++] = (struct rg_culled){ pass->rg, pass->repetition };
    }
    plan->passes = w.passes;
    plan->uses = w.uses;
    plan->colors = w.colors;
    plan->culled = w.culled;
    plan->fallbacks = c->fallbacks;
    plan->fallback_count = c->fallback_count;
    if (!c->arena->failed)
        rg_end_barriers(&w.barriers);
}
