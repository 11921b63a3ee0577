/*
 * compile_plan.c: rg_compile(), which runs the stages of the compiler in order.
 *
 * ARCHITECTURE. Each stage is a function of one file, works on struct compiler (compiler.h), and
 * allocates from one arena, which the plan keeps. All stages are linear in the number of passes,
 * except sorting by size. The design is that of frame graphs with declared resources (O'Donnell,
 * "FrameGraph: Extensible Rendering Architecture in Frostbite", GDC 2017), as a compiler.
 *
 * 1. Check: create_resource_records.c, check_pass.c, and check_shaders.c against the interfaces
 *    that spirv_reflection.c reads from the modules. Faults are collected (fault.c); the compiler
 *    stops after a stage that has found any.
 * 2. Expand (expand_passes.c, create_resource_records.c): makes a pass of each repetition of a row,
 *    and an access of each target and use. A resource is divided into cells, one per aspect, mip
 *    level and layer.
 * 3. Cull (cull_passes.c): backward liveness analysis over cells, as in data-flow analysis of
 *    compilers (Kildall, "A Unified Approach to Global Program Optimization", POPL 1973), to a
 *    fixed point, because persistent content is live in the next frame.
 * 4. Lifetimes and memory requirements (memory_requirements.c).
 * 5. Barriers (barriers.c): a state machine per cell, and greedy interval stabbing for the fewest
 *    batches. If passes run on several queues, a cell has a home queue; crossing to another one
 *    waits for a timeline semaphore instead, which divides submissions.
 * 6. Memory (pack_memory.c): dynamic storage allocation.
 * 7. Aliases (alias_dependencies.c): the first access to memory waits for its previous owners.
 *    Stage 6 only aliases where stage 5 has made a batch that can carry this barrier.
 */
#include "graph/compile/compiler.h"

/* A plan together with the arena that holds it. */
struct owned_plan {
    struct rg_plan plan; /* first member: its address is public */
    struct arena arena;
};

static bool failed(const struct compiler *c)
{
    return c->arena->failed || c->fault_count;
}

/* Runs all stages; stops at the first that finds a fault or runs out of memory. */
static void run(struct compiler *c)
{
    if (!rg_check_params(c))
        return;
    /* so that the tables are not copied as they grow */
    if (!rg_map_reserve(c->arena, &c->by_address, c->row_count + c->row_count / 2) ||
        !rg_map_reserve(c->arena, &c->resource_names, c->row_count + c->row_count / 2) ||
        !rg_map_reserve(c->arena, &c->pass_names, c->row_count))
        return;
    rg_add_boundary(c);
    rg_expand(c);
    if (failed(c))
        return;
    rg_cull(c);
    rg_find_lifetimes(c);
    rg_list_resources(c);
    if (failed(c))
        return;
    rg_write_plan_passes(c);
    if (!failed(c)) /* alias only where existing barriers permit */
        rg_pack_blocks(c);
    if (!failed(c))
        rg_complete_alias_barriers(c);
}

static uint32_t limit(uint32_t device_limit, uint32_t max)
{
    return device_limit && device_limit < max ? device_limit : max;
}

struct rg_plan *rg_compile(const struct rg_compile_params *params)
{
    static const struct rg_compile_params none = { 0 };
    struct arena arena;
    bool given = params != NULL;
    params = given ? params : &none;
    rg_arena_init(&arena, params->memory, params->memory_size);
    struct owned_plan *owned = ARENA_ZEROED(&arena, struct owned_plan, 1);
    if (!owned)
        return NULL;
    const struct rg_device *device = params->device;
    struct compiler c = {
        .params = params,
        .plan = &owned->plan,
        .arena = &arena,
        .row = RG_NONE,
        .max_image_size = limit(device ? device->max_image_size : 0, 1u << 16),
        .max_layers = limit(device ? device->max_layers : 0, 1u << 14),
        .max_volume_size = limit(device ? device->max_volume_size : 0, 1u << 14),
    };
    c.max_view = params->max_view.width ? params->max_view : params->view;
    owned->plan.view = params->view;
    rg_fault_if(&c, !given, RG_ERROR_TABLE, NULL, "rg_compile(): expected params, got NULL");
    if (given)
        run(&c);
    owned->arena = arena;
    if (arena.failed) {
        rg_plan_destroy(&owned->plan);
        return NULL;
    }
    if (c.fault_count) /* do not expose a half-built plan */
        owned->plan = (struct rg_plan){ .view = params->view };
    owned->plan.faults = c.faults;
    owned->plan.fault_count = c.fault_count;
    owned->plan.arena_size = arena.used + _Alignof(max_align_t);
    return &owned->plan;
}

void rg_plan_destroy(struct rg_plan *plan)
{
    if (!plan || __atomic_fetch_or(&plan->users, RG_PLAN_DESTROYED, __ATOMIC_ACQ_REL))
        return;
    struct arena arena = ((struct owned_plan *)plan)->arena;
    rg_arena_finish(&arena); /* also frees the plan itself */
}
