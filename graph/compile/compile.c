/* compile.c: the compiler's steps, in their order. */
#include "graph/compile/name.h"

/* The plan and what it lives in. */
struct owned_plan {
    struct rg_plan plan; /* first: what the caller sees */
    struct arena arena;
};

/* Lists what the plan needs memory for, and places it. */
static void place(struct compiler *c)
{
    rg_list(c);
    if (!c->arena->failed && !c->fault_count)
        rg_place(c);
}

/* Barriers need memory's places, or places the barriers, as enum rg_sharing has it. What the device
 * cannot do is found on the way. */
static void place_and_sync(struct compiler *c)
{
    struct sync sync = { .c = c };
    bool place_first = c->params->sharing == RG_SHARE_LEAST_MEMORY;
    rg_check_formats(c);
    if (place_first) {
        rg_follow_passes(c);
        rg_follow_outputs(c);
        place(c);
        if (!c->arena->failed && !c->fault_count)
            rg_place_ends(c);
    }
    if (!c->arena->failed)
        rg_emit(c, &sync);
    if (!place_first && !c->arena->failed)
        place(c);
    if (c->arena->failed || c->fault_count)
        return;
    rg_place_left(c);
    if (!c->arena->failed)
        rg_sync_takeovers(&sync);
}

/* Room for what the tables are likely to hold, so that nothing has to be copied as it grows. */
static void expect(struct compiler *c)
{
    size_t rows = 0;
    for (size_t t = 0; t < c->params->technique_count; t++)
        rows += c->params->techniques[t]->pass_count;
    uint32_t count = rows < UINT32_MAX / 64 ? (uint32_t)rows + 8 : UINT32_MAX / 64;
    c->pass_room = count;
    c->passes = ARENA_ARRAY(c->arena, struct pass, count);
    c->access_room = count * 4 + 64;
    c->accesses = ARENA_ARRAY(c->arena, struct access, c->access_room);
    c->meanings = rg_arena_alloc(c->arena, RG_TRANSFER + 1, sizeof(*c->meanings));
    rg_resource_expect(c, count * 2);
    rg_name_expect(c, NAME_RESOURCE, count * 2);
    rg_name_expect(c, NAME_PASS, count);
}

static void run(struct compiler *c)
{
    expect(c);
    if (c->arena->failed)
        return;
    rg_check_params(c);
    rg_add_ends(c);
    if (!c->arena->failed)
        rg_expand(c);
    if (c->arena->failed || c->fault_count)
        return;
    rg_cull(c);
    place_and_sync(c);
}

struct rg_plan *rg_compile(const struct rg_compile_params *params)
{
    struct arena arena;
    rg_arena_init(&arena, params->memory, params->memory_size);
    struct owned_plan *owned = rg_arena_zeroed(&arena, 1, sizeof(*owned));
    if (!owned)
        return NULL;
    const struct rg_device *device = params->device;
    struct compiler c = {
        .params = params,
        .plan = &owned->plan,
        .arena = &arena,
        .max_image_size = device && device->max_image_size ? device->max_image_size : 1u << 16,
        .max_layers = device && device->max_layers ? device->max_layers : 1u << 11,
    };
    owned->plan.view = params->view;
    owned->plan.max_region = params->max_region.width ? params->max_region : params->view;
    run(&c);
    owned->arena = arena;
    if (arena.failed) {
        rg_plan_destroy(&owned->plan);
        return NULL;
    }
    if (c.fault_count) /* nothing half-made is to be seen */
        owned->plan =
            (struct rg_plan){ .view = params->view, .max_region = owned->plan.max_region };
    owned->plan.faults = c.faults;
    owned->plan.fault_count = c.fault_count;
    owned->plan.arena_size = arena.used + _Alignof(max_align_t);
    return &owned->plan;
}

void rg_plan_destroy(struct rg_plan *plan)
{
    if (!plan)
        return;
    struct arena arena = ((struct owned_plan *)plan)->arena;
    rg_arena_finish(&arena); /* the plan lives in it */
}
