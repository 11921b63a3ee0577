/*
 * rg_sync.c: which barrier goes before which pass.
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
#include <string.h>
#include "graph/rg_internal.h"

/* The stages for which visibility is tracked one by one; any other counts as never covered. */
static const VkPipelineStageFlags2 tracked_stages[] = {
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
    VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,
    VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT,
    VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
    VK_PIPELINE_STAGE_2_HOST_BIT,
};

enum {
    STAGE_COUNT = sizeof(tracked_stages) / sizeof(tracked_stages[0])
};

struct state {
    VkImageLayout layout;
    VkPipelineStageFlags2 write_stages; /* of the last write, or that it was chained on to */
    VkAccessFlags2 write_access;        /* of it, while not yet available */
    VkPipelineStageFlags2 read_stages;  /* since then */
    VkAccessFlags2 visible[STAGE_COUNT];
    uint32_t written, touched; /* the first pass after the last write, and after the last access */
    uint32_t first_transition, transition_end; /* of the access that made the write visible first */
    bool changed;                              /* content or layout, by this frame */
};

struct sync {
    struct compiler *c;
    struct state *states; /* one a cell */
    struct transitions transitions;
};

static bool is_visible(const struct state *s, VkPipelineStageFlags2 stages, VkAccessFlags2 access)
{
    for (uint32_t i = 0; i < STAGE_COUNT; i++) {
        if ((stages & tracked_stages[i]) && (access & ~s->visible[i]))
            return false;
        stages &= ~tracked_stages[i];
    }
    return !stages;
}

static void make_visible(struct state *s, VkPipelineStageFlags2 stages, VkAccessFlags2 access)
{
    for (uint32_t i = 0; i < STAGE_COUNT; i++) {
        if (stages & tracked_stages[i])
            s->visible[i] |= access;
    }
}

/* What a cell needs before an access at pass `deadline`; false if nothing. */
static bool decide(const struct state *s, const struct access *a, struct transition *t)
{
    bool moves = s->layout != a->layout;
    if (!a->writes_content && !moves && is_visible(s, a->stages, a->reads))
        return false;
    t->release = s->written;
    t->barrier = (struct rg_barrier){
        .src_stages = s->write_stages,
        .src_access = s->write_access,
        .dst_stages = a->stages,
        .dst_access = a->reads | a->writes,
        .old_layout = a->overwrites ? VK_IMAGE_LAYOUT_UNDEFINED : s->layout,
        .new_layout = a->layout,
    };
    if (a->writes_content || moves)
        t->release = s->touched;
    /* who read it since has waited for the write, and a barrier made the write available then */
    if ((a->writes_content || moves) && s->read_stages) {
        t->barrier.src_stages = s->read_stages;
        t->barrier.src_access = VK_ACCESS_2_NONE;
    }
    return moves || t->barrier.src_stages;
}

/*
 * Another stage reads what an earlier transition of this frame has made visible to some: that
 * transition makes it visible to this one too, instead of a barrier more.
 */
static bool widen(struct sync *sync, const struct state *s, const struct access *a, uint32_t image,
                  const struct cell_walk *w, VkImageAspectFlags aspect)
{
    if (a->writes_content || s->layout != a->layout)
        return false;
    for (uint32_t i = s->first_transition; i < s->transition_end; i++) {
        struct rg_barrier *b = &sync->transitions.items[i].barrier;
        const VkImageSubresourceRange *range = &b->range;
        bool holds = image == RG_NONE || ((range->aspectMask & aspect) &&
                                          w->mip - range->baseMipLevel < range->levelCount &&
                                          w->layer - range->baseArrayLayer < range->layerCount);
        if (!holds)
            continue;
        b->dst_stages |= a->stages;
        b->dst_access |= a->reads;
        return true;
    }
    return false;
}

static void apply(struct state *s, const struct access *a, uint32_t pass, bool made_visible)
{
    bool moves = s->layout != a->layout;
    s->touched = pass + 1;
    if (a->writes_content || moves) {
        s->write_stages = a->stages;
        s->write_access = a->writes;
        s->read_stages = VK_PIPELINE_STAGE_2_NONE;
        s->changed = true;
        s->written = pass + 1;
        s->first_transition = s->transition_end = 0;
        memset(s->visible, 0, sizeof(s->visible));
    }
    s->layout = a->layout;
    if (a->writes_content)
        return;
    s->read_stages |= a->stages;
    if (made_visible)
        make_visible(s, a->stages, a->reads);
}

static VkImageAspectFlags aspect_bit(VkImageAspectFlags aspects, uint32_t index)
{
    while (index--)
        aspects &= aspects - 1;
    return aspects & (~aspects + 1);
}

/* Whether a frame has left an import in another state than it came in. */
static bool has_to_go_back(const struct state *s, const struct access *arrival)
{
    return s->changed || (arrival->writes_content && s->read_stages);
}

/* The transitions that one access of the plan's pass `pass` needs, and what it leaves. */
static void synchronise_cells(struct sync *sync, const struct access *access, uint32_t pass,
                              bool hand_back)
{
    const struct resource *r = &sync->c->resources[access->resource];
    struct transitions *list = &sync->transitions;
    uint32_t start = list->count;
    uint32_t row_start = start; /* of the mip being walked */
    struct transition t = {
        .deadline = pass,
        .barrier.image = r->image ? r->plan_index : RG_NONE,
        .barrier.buffer = r->image ? RG_NONE : r->plan_index,
    };
    const struct rg_barrier names = t.barrier;
    for (struct cell_walk w = rg_walk(sync->c, access); rg_walk_next(&w);) {
        struct state *s = &sync->states[w.cell];
        VkImageAspectFlags aspect = aspect_bit(r->aspects, w.aspect);
        if (hand_back && !has_to_go_back(s, access))
            continue;
        if (r->image && w.layer == access->range.baseArrayLayer) {
            rg_transition_join(list, start); /* the mip before with those before it */
            row_start = list->count;
        }
        bool needed = decide(s, access, &t);
        if (needed && !widen(sync, s, access, names.image, &w, aspect)) {
            t.barrier.image = names.image;
            t.barrier.buffer = names.buffer;
            if (r->image)
                t.barrier.range = (VkImageSubresourceRange){ aspect, w.mip, 1, w.layer, 1 };
            rg_transition_add(&sync->c->scratch, list, &t);
            rg_transition_join(list, row_start);
        }
        apply(s, access, pass, needed);
    }
    rg_transition_join(list, start);
}

/*
 * `hand_back`: the access is an import's arrival, and cells that are still so are left alone. Later
 * readers can widen what the transitions of this access made visible.
 */
static void synchronise(struct sync *sync, const struct access *access, uint32_t pass,
                        bool hand_back)
{
    uint32_t start = sync->transitions.count;
    synchronise_cells(sync, access, pass, hand_back);
    if (access->writes_content || sync->transitions.count == start)
        return;
    for (struct cell_walk w = rg_walk(sync->c, access); rg_walk_next(&w);) {
        struct state *s = &sync->states[w.cell];
        if (s->transition_end)
            continue;
        s->first_transition = start;
        s->transition_end = sync->transitions.count;
    }
}

/* ---- where a frame begins and ends ---- */

/* As struct rg_import says; nobody knows who else reads it, so a write waits for everything. */
static struct state import_state(const struct resource *r, enum rg_access access)
{
    const struct rg_access_info *info = rg_access_info(access);
    bool shader = !info->stages && (info->reads || info->writes);
    struct state s = {
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
    make_visible(&s, s.write_stages, info->reads);
    return s;
}

static struct state initial_state(const struct compiler *c, const struct resource *r)
{
    struct state s = {
        .layout = VK_IMAGE_LAYOUT_UNDEFINED,
        .write_stages = r->former.stages,
        .write_access = r->former.writes,
        .written = r->former.end,
        .touched = r->former.end,
    };
    if (r->import != RG_NONE)
        return import_state(r, c->params->imports[r->import].access);
    if (r->buffer && r->buffer->memory == RG_MEMORY_UPLOAD) /* a submit shows all of it to all */
        memset(s.visible, 0xff, sizeof(s.visible));
    return s;
}

static void begin_frame(struct sync *sync)
{
    struct compiler *c = sync->c;
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        if (r->first == RG_NONE)
            continue;
        struct state s = initial_state(c, r);
        for (uint32_t k = 0; k < r->cell_count; k++)
            sync->states[r->first_cell + k] = s;
    }
}

static void end_frame(struct sync *sync)
{
    struct compiler *c = sync->c;
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        if (r->first == RG_NONE)
            continue;
        bool hand_back = r->output == RG_NONE && r->import != RG_NONE;
        enum rg_access access =
            hand_back ? c->params->imports[r->import].access : rg_output_access(c, r);
        if (access == RG_ACCESS_NONE)
            continue;
        const struct access a = rg_end_access(c, i, access);
        synchronise(sync, &a, c->plan->pass_count, hand_back);
    }
}

/* ---- the plan's passes ---- */

static const VkAttachmentLoadOp load_ops[] = {
    [RG_LOAD_KEEP] = VK_ATTACHMENT_LOAD_OP_LOAD,
    [RG_LOAD_CLEAR] = VK_ATTACHMENT_LOAD_OP_CLEAR,
    [RG_LOAD_DISCARD] = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
};

static struct rg_plan_target plan_target(const struct compiler *c, const struct access *a)
{
    VkAttachmentStoreOp store =
        a->needed ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (!a->writes_content)
        store = VK_ATTACHMENT_STORE_OP_NONE;
    return (struct rg_plan_target){
        .image = c->resources[a->resource].plan_index,
        .mip = a->range.baseMipLevel,
        .layer = a->range.baseArrayLayer,
        .load = a->writes_content ? load_ops[a->target->load] : VK_ATTACHMENT_LOAD_OP_LOAD,
        .store = store,
        .layout = a->layout,
        .resolve = RG_NONE,
    };
}

static struct rg_plan_use plan_use(const struct compiler *c, const struct access *a)
{
    const struct resource *r = &c->resources[a->resource];
    return (struct rg_plan_use){
        .use = a->use,
        .image = r->image ? r->plan_index : RG_NONE,
        .buffer = r->image ? RG_NONE : r->plan_index,
        .range = a->range,
        .layout = a->layout,
    };
}

static void plan_pass(struct sync *sync, const struct pass *pass, struct rg_plan_pass *out,
                      struct rg_plan_use *uses, uint32_t index)
{
    struct compiler *c = sync->c;
    *out = (struct rg_plan_pass){
        .pass = pass->rg,
        .technique = rg_technique_of(c, pass),
        .row = pass->row,
        .repetition = pass->repetition,
        .extent = pass->extent,
        .depth.image = RG_NONE,
        .first_use = c->plan->use_count,
    };
    for (uint32_t i = 0; i < pass->access_count; i++) {
        const struct access *a = &c->accesses[pass->first_access + i];
        synchronise(sync, a, index, false);
        if (a->use)
            uses[c->plan->use_count++] = plan_use(c, a);
        else if (a->access == RG_COLOR)
            out->color[out->color_count++] = plan_target(c, a);
        else
            out->depth = plan_target(c, a);
    }
    out->use_count = c->plan->use_count - out->first_use;
}

static void list_culled(struct compiler *c)
{
    struct rg_culled *culled =
        ARENA_ARRAY(c->arena, struct rg_culled, c->pass_count - c->plan->pass_count);
    for (uint32_t p = 0; p < c->pass_count && culled; p++) {
        if (!c->passes[p].alive)
            culled[c->plan->culled_count++] =
                (struct rg_culled){ c->passes[p].rg, c->passes[p].repetition };
    }
    c->plan->culled = culled;
}

void rg_sync(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    struct sync sync = { .c = c, .states = ARENA_ARRAY(&c->scratch, struct state, c->cell_count) };
    struct rg_plan_pass *passes = ARENA_ARRAY(c->arena, struct rg_plan_pass, plan->pass_count);
    struct rg_plan_use *uses = ARENA_ARRAY(c->arena, struct rg_plan_use, c->access_count);
    if (c->scratch.failed || c->arena->failed)
        return;
    begin_frame(&sync);
    uint32_t n = 0;
    for (uint32_t p = 0; p < c->pass_count; p++) {
        if (!c->passes[p].alive)
            continue;
        plan_pass(&sync, &c->passes[p], &passes[n], uses, n);
        n++;
    }
    end_frame(&sync);
    rg_batch(c, &sync.transitions, passes);
    plan->passes = passes;
    plan->uses = uses;
    list_culled(c);
}
