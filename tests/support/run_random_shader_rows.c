/* run_random_shader_rows.c: generates draw and dispatch passes; tracks filled subresources. */
#include <string.h>
#include "tests/gpu/test_shaders.h"
#include "tests/support/run_random_private.h"

/* A shader and the resources that it binds. */
struct program {
    const struct rg_shader *shader;
    uint32_t sampled, targets;
    bool loaded, read, uniform;
    VkFormat stored; /* format of the written storage image; 0 if a buffer is written */
    bool array;      /* the sampled images form a descriptor array */
    bool texels;     /* buffers are bound as texel buffers */
    bool volume;     /* images are 3D */
    bool changes;    /* reads the resource that it writes */
    bool instances;  /* reads one vertex attribute per instance */
    bool own;        /* reads the application's descriptor set */
    bool sums;       /* blends into a float image of integers */
};

/* Format of the storage images that shaders read. */
static const VkFormat loaded_format = VK_FORMAT_R32_UINT;

static const struct program raster_programs[] = {
    { &random_flat_frag, .targets = 1, .uniform = true },
    { &random_fetch_frag, .targets = 1, .sampled = 1 },
    { &random_blend_frag, .targets = 1, .sampled = 2 },
    { &random_load_frag, .targets = 1, .loaded = true },
    { &random_read_two_frag, .targets = 2, .read = true },
    { &random_fetch_two_frag, .targets = 2, .sampled = 1, .uniform = true },
    { &random_flat_three_frag, .targets = 3 },
    { &random_fetch_three_frag, .targets = 3, .sampled = 1 },
    { &random_array_frag, .targets = 1, .sampled = 2, .array = true },
    { &random_instances_frag, .targets = 1, .uniform = true, .instances = true },
    { &random_instances_two_frag, .targets = 2, .sampled = 1, .instances = true },
    { &random_own_frag, .targets = 1, .sampled = 1, .own = true },
    { &random_sums_frag, .targets = 1, .uniform = true, .sums = true },
};

static const struct program compute_programs[] = {
    { &random_image_comp, .stored = VK_FORMAT_R32G32B32A32_UINT, .uniform = true },
    { &random_image_fetch_comp, .stored = VK_FORMAT_R32_UINT, .sampled = 2 },
    { &random_image_load_comp, .stored = VK_FORMAT_R32G32B32A32_UINT, .loaded = true,
      .read = true },
    { &random_image_change_comp, .stored = VK_FORMAT_R32_UINT, .sampled = 1, .changes = true },
    { &random_list_comp, .uniform = true },
    { &random_list_own_comp, .uniform = true, .own = true },
    { &random_list_fetch_comp, .sampled = 1 },
    { &random_list_change_comp, .read = true, .changes = true },
    { &random_list_load_comp, .loaded = true },
    { &random_image_array_comp, .stored = VK_FORMAT_R32_UINT, .sampled = 2, .array = true },
    { &random_texels_comp, .read = true, .uniform = true, .texels = true },
    { &random_texels_change_comp, .sampled = 1, .changes = true, .texels = true },
    { &random_volume_comp, .stored = VK_FORMAT_R32_UINT, .uniform = true, .volume = true },
    { &random_volume_change_comp, .stored = VK_FORMAT_R32_UINT, .sampled = 1, .changes = true,
      .volume = true },
    { &random_list_volume_comp, .sampled = 1, .volume = true },
};

const struct rg_set run_random_own = { "own" };

static bool is_even(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame->number % 2 == 0;
}

static bool is_later(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame->number > 0;
}

static rg_when_fn *const conditions[] = { is_even, is_later };

/* ---- ranges of resources ---- */

struct rg_range run_random_covered(const struct run_random_tables *t, uint32_t resource,
                                   struct rg_range range)
{
    const struct run_random_known *known = &t->known[resource];
    const enum rg_repeat repeat = t->passes[t->pass_count].repeat;
    if (!range.mip_count)
        range.mip_count = known->mips - range.mip;
    if (!range.layer_count)
        range.layer_count = known->layers - range.layer;
    if (range.each && repeat == RG_PER_LAYER)
        range.layer_count = t->repetitions;
    if (range.each && repeat == RG_PER_MIP)
        range.mip_count = t->repetitions;
    return range;
}

bool run_random_is_filled(const struct run_random_tables *t, uint32_t resource,
                          struct rg_range range)
{
    const struct run_random_known *known = &t->known[resource];
    for (uint32_t layer = range.layer; layer < range.layer + range.layer_count; layer++) {
        for (uint32_t mip = range.mip; mip < range.mip + range.mip_count; mip++) {
            const uint8_t filled = known->filled[layer * known->mips + mip];
            if (filled != FILLED_ALWAYS && (filled == FILLED_NEVER || filled != t->filled))
                return false;
        }
    }
    return true;
}

static void fill(struct run_random_tables *t, const struct run_random_claim *claim)
{
    struct run_random_known *known = &t->known[claim->resource];
    const struct rg_range *range = &claim->range;
    for (uint32_t layer = range->layer; layer < range->layer + range->layer_count; layer++) {
        for (uint32_t mip = range->mip; mip < range->mip + range->mip_count; mip++) {
            uint8_t *filled = &known->filled[layer * known->mips + mip];
            if (*filled != FILLED_ALWAYS)
                *filled = t->filled;
        }
    }
    t->last_written = claim->resource;
}

static bool overlaps(const struct rg_range *a, const struct rg_range *b)
{
    return a->mip < b->mip + b->mip_count && b->mip < a->mip + a->mip_count &&
           a->layer < b->layer + b->layer_count && b->layer < a->layer + a->layer_count;
}

bool run_random_claim(struct run_random_tables *t, uint32_t resource, struct rg_range range,
                      enum rg_access access)
{
    const struct run_random_known *known = &t->known[resource];
    const struct rg_access_info *info = rg_access_info(access);
    const struct run_random_claim claim = {
        .resource = resource,
        .range = run_random_covered(t, resource, range),
        .access = access,
        .writes = info->writes_content,
    };
    if (claim.range.layer + claim.range.layer_count > known->layers ||
        claim.range.mip + claim.range.mip_count > known->mips ||
        (info->reads_content && !run_random_is_filled(t, resource, claim.range)))
        return false;
    for (uint32_t i = 0; i < t->claim_count; i++) {
        const struct run_random_claim *other = &t->claims[i];
        const bool reads =
            !claim.writes && !other->writes && (resource >= IMAGES || other->access == access);
        if (other->resource == resource && overlaps(&other->range, &claim.range) && !reads)
            return false;
    }
    t->claims[t->claim_count++] = claim;
    return true;
}

struct rg_use *run_random_use(struct run_random_tables *t, uint32_t resource, enum rg_access access,
                              struct rg_range range)
{
    struct rg_use *use = &t->uses[t->pass_count][t->use_count++];
    *use = (struct rg_use){ .access = access, .range = range };
    if (resource < IMAGES)
        use->image = &t->images[resource];
    else
        use->buffer = &t->buffers[resource - IMAGES];
    return use;
}

struct rg_pass *run_random_begin(struct run_random_tables *t, enum rg_kind kind)
{
    struct rg_pass *pass = &t->passes[t->pass_count];
    *pass = (struct rg_pass){
        .kind = kind,
        .color = t->targets[t->pass_count],
        .color_count = RG_COLOR_COUNT,
        .uses = t->uses[t->pass_count],
        .record = run_random_record,
    };
    memset(t->targets[t->pass_count], 0, sizeof(t->targets[0]));
    t->rows[t->pass_count] = (struct interpret_row){
        .salt = run_random_below(t, UINT32_MAX),
        .shift = run_random_below(t, 16),
        .to = { UINT32_MAX, UINT32_MAX },
        .instance_count = 1,
    };
    t->claim_count = t->use_count = 0;
    t->repetitions = 1;
    t->filled = FILLED_ALWAYS;
    return pass;
}

void run_random_end(struct run_random_tables *t)
{
    t->uses[t->pass_count][t->use_count] = (struct rg_use){ 0 };
    run_random_name(t, 'p', RESOURCES + t->pass_count, &t->passes[t->pass_count].name);
    for (uint32_t i = 0; i < t->claim_count; i++) {
        if (t->claims[i].writes)
            fill(t, &t->claims[i]);
    }
    t->pass_count++;
}

void run_random_condition(struct run_random_tables *t, struct rg_pass *pass)
{
    if (!(t->features & RUN_RANDOM_CONDITIONS) || !run_random_chance(t, 20))
        return;
    const uint32_t condition = run_random_below(t, 2);
    pass->when = conditions[condition];
    t->filled = (uint8_t)(FILLED_SOMETIMES + condition);
}

/* ---- inputs ---- */

uint32_t run_random_image(struct run_random_tables *t)
{
    if (t->last_written < IMAGES && run_random_chance(t, 50))
        return t->last_written;
    if (!t->local || t->image_count < 4)
        return run_random_below(t, t->image_count);
    const uint32_t done = t->pass_count < t->wanted_count ? t->pass_count : t->wanted_count;
    return done * (t->image_count - 3) / t->wanted_count + run_random_below(t, 3);
}

uint32_t run_random_buffer(struct run_random_tables *t)
{
    uint32_t buffer;
    do {
        buffer = ARGUMENTS + run_random_below(t, t->buffer_count - ARGUMENTS);
    } while (t->buffers[buffer].size < RANDOM_UNIFORM_WORDS * sizeof(uint32_t));
    return IMAGES + buffer;
}

/* Returns a random range of an image: all of it, or some mips and layers. In a repeated pass, the
 * range may advance with each repetition. */
struct rg_range run_random_range(struct run_random_tables *t, uint32_t resource)
{
    const struct run_random_known *known = &t->known[resource];
    const enum rg_repeat repeat = t->passes[t->pass_count].repeat;
    struct rg_range range = { 0 };
    if (run_random_chance(t, 60)) {
        range.mip = run_random_below(t, known->mips);
        range.layer = run_random_below(t, known->layers);
    }
    if (run_random_chance(t, 60)) {
        range.mip_count = 1 + run_random_below(t, known->mips - range.mip);
        range.layer_count = 1 + run_random_below(t, known->layers - range.layer);
    }
    range.each = repeat != RG_ONCE && run_random_chance(t, 60);
    return range;
}

static bool draw_image_input(struct run_random_tables *t, enum rg_access access, uint16_t binding,
                             uint16_t element, bool volume)
{
    for (uint32_t tries = 0; tries < 8; tries++) {
        const uint32_t image = run_random_image(t);
        struct rg_range range = run_random_range(t, image);
        if (access == RG_STORAGE_READ)
            range.mip_count = 1;
        if (t->known[image].depth || t->known[image].sum || t->known[image].volume != volume ||
            (access == RG_STORAGE_READ && t->images[image].format != loaded_format) ||
            !run_random_claim(t, image, range, access))
            continue;
        struct rg_use *use = run_random_use(t, image, access, range);
        use->binding = binding;
        use->element = element;
        return true;
    }
    return false;
}

static bool draw_buffer_input(struct run_random_tables *t, enum rg_access access, uint16_t binding)
{
    for (uint32_t tries = 0; tries < 8; tries++) {
        const uint32_t buffer = run_random_buffer(t);
        if (!run_random_claim(t, buffer, (struct rg_range){ 0 }, access))
            continue;
        run_random_use(t, buffer, access, (struct rg_range){ 0 })->binding = binding;
        return true;
    }
    return false;
}

static bool draw_inputs(struct run_random_tables *t, const struct program *program)
{
    bool drawn = true;
    t->passes[t->pass_count].set = program->own ? &run_random_own : NULL;
    for (uint32_t i = 0; i < program->sampled && drawn; i++)
        drawn =
            draw_image_input(t, RG_SAMPLED, (uint16_t)(RANDOM_SAMPLED + (program->array ? 0 : i)),
                             (uint16_t)(program->array ? i : 0), program->volume);
    if (program->loaded)
        drawn = drawn && draw_image_input(t, RG_STORAGE_READ, RANDOM_LOADED, 0, false);
    if (program->read)
        drawn = drawn &&
                draw_buffer_input(t, program->texels ? RG_SAMPLED : RG_STORAGE_READ, RANDOM_READ);
    if (program->uniform)
        drawn = drawn && draw_buffer_input(t, RG_UNIFORM, RANDOM_UNIFORM);
    if (program->instances)
        drawn = drawn && draw_buffer_input(t, RG_VERTEX, 0);
    return drawn;
}

/* Chooses the region of a partial write, and whether its draw or dispatch is indirect. */
static void draw_region(struct run_random_tables *t)
{
    struct interpret_row *row = &t->rows[t->pass_count];
    for (uint32_t i = 0; i < 2; i++) {
        row->from[i] = run_random_below(t, 4);
        row->to[i] = row->from[i] + 1 + run_random_below(t, 8);
    }
    const uint32_t arguments = IMAGES + run_random_below(t, ARGUMENTS);
    if (run_random_chance(t, 40) &&
        run_random_claim(t, arguments, (struct rg_range){ 0 }, RG_INDIRECT))
        run_random_use(t, arguments, RG_INDIRECT, (struct rg_range){ 0 });
    row->is_counted = t->is_counted;
}

/* ---- compute ---- */

/* Chooses whether the pass is repeated. Returns the first mip or layer of `image` to write. */
static uint32_t draw_repeat(struct run_random_tables *t, uint32_t image)
{
    const struct run_random_known *known = &t->known[image];
    struct rg_pass *pass = &t->passes[t->pass_count];
    uint32_t count = 1;
    if (known->layers > 1 && run_random_chance(t, 35)) {
        pass->repeat = RG_PER_LAYER;
        count = known->layers;
    } else if (known->mips > 1 && run_random_chance(t, 40)) {
        pass->repeat = RG_PER_MIP;
        count = known->mips;
    }
    const uint32_t first = run_random_chance(t, 70) ? 0 : run_random_below(t, count);
    t->repetitions = count - first;
    return first;
}

struct rg_range run_random_written_range(struct run_random_tables *t, uint32_t image)
{
    const uint32_t first = draw_repeat(t, image);
    const enum rg_repeat repeat = t->passes[t->pass_count].repeat;
    struct rg_range range = run_random_range(t, image);
    range.mip_count = 1;
    range.each = repeat != RG_ONCE;
    if (repeat == RG_PER_LAYER)
        range.layer = first;
    if (repeat == RG_PER_MIP)
        range.mip = first;
    return range;
}

static bool draw_compute(struct run_random_tables *t)
{
    const struct program *program = &compute_programs[run_random_below(
        t, sizeof(compute_programs) / sizeof(compute_programs[0]))];
    struct rg_pass *pass = run_random_begin(t, RG_COMPUTE);
    struct rg_range range = { 0 };
    uint32_t to = run_random_buffer(t);
    run_random_condition(t, pass);
    pass->comp = program->shader;
    pass->push_size = sizeof(struct random_push);
    if (program->stored) {
        for (uint32_t tries = 0; tries < 8; tries++) {
            to = run_random_image(t);
            if (t->images[to].format == program->stored && t->known[to].volume == program->volume)
                break;
        }
        if (t->images[to].format != program->stored || t->known[to].volume != program->volume)
            return false;
        range = run_random_written_range(t, to);
    }
    const bool partial =
        run_random_is_filled(t, to, run_random_covered(t, to, range)) && run_random_chance(t, 40);
    const enum rg_access access = program->changes ? RG_STORAGE_READ_WRITE : RG_STORAGE_WRITE;
    if (!t->known[to].writable || !run_random_claim(t, to, range, access))
        return false;
    struct rg_use *use = run_random_use(t, to, access, range);
    use->binding = program->stored ? RANDOM_STORED : RANDOM_WRITTEN;
    use->partial = partial;
    use->texels = program->texels;
    if (partial)
        draw_region(t);
    return draw_inputs(t, program);
}

/* ---- raster ---- */

static float draw_depth(struct run_random_tables *t)
{
    return (float)run_random_below(t, 5) * 0.25F;
}

static VkClearValue draw_clear(struct run_random_tables *t, const struct run_random_known *known)
{
    VkClearValue clear = { .color.uint32 = { 0 } };
    if (known->depth)
        clear.depthStencil = (VkClearDepthStencilValue){ draw_depth(t), run_random_below(t, 4) };
    else if (known->sum)
        clear.color.float32[0] = (float)run_random_below(t, 256);
    for (uint32_t i = 0; i < 4 && !known->depth && !known->sum; i++)
        clear.color.uint32[i] = run_random_below(t, 256);
    return clear;
}

uint32_t run_random_mip_size(uint32_t size, uint32_t mip)
{
    return size >> mip ? size >> mip : 1;
}

/* Returns true if `target` fits the first target of the pass in extent and repetitions. */
static bool fits(const struct run_random_tables *t, uint32_t first_image,
                 const struct rg_target *first, uint32_t image, const struct rg_target *target)
{
    const struct run_random_known *a = &t->known[first_image];
    const struct run_random_known *b = &t->known[image];
    const enum rg_repeat repeat = t->passes[t->pass_count].repeat;
    if (run_random_mip_size(a->width, first->mip) != run_random_mip_size(b->width, target->mip) ||
        run_random_mip_size(a->height, first->mip) != run_random_mip_size(b->height, target->mip))
        return false;
    if (repeat == RG_PER_LAYER)
        return b->layers == 1 || b->layers - target->layer >= t->repetitions;
    if (repeat == RG_PER_MIP)
        return b->mips - target->mip >= t->repetitions;
    return true;
}

static bool add_target(struct run_random_tables *t, uint32_t image, struct rg_target *place,
                       struct rg_target target, bool whole)
{
    struct rg_pass *pass = &t->passes[t->pass_count];
    const struct run_random_known *known = &t->known[image];
    struct rg_range range = {
        .mip = target.mip,
        .mip_count = 1,
        .layer = target.layer,
        .layer_count = 1,
    };
    range.each = pass->repeat == RG_PER_LAYER ? known->layers > 1 : known->mips > 1;
    const bool keeps = run_random_is_filled(t, image, run_random_covered(t, image, range)) &&
                       run_random_chance(t, 60);
    const bool tests = place == &pass->depth && keeps && run_random_chance(t, 30);
    if (known->volume || !run_random_claim(t, image, range,
                                           tests          ? RG_DEPTH_READ
                                           : known->depth ? RG_DEPTH
                                                          : RG_COLOR))
        return false;
    *place = target;
    place->image = &t->images[image];
    place->clear = draw_clear(t, known);
    place->load = keeps                               ? RG_LOAD_KEEP
                  : whole && run_random_chance(t, 60) ? RG_LOAD_DISCARD
                                                      : RG_LOAD_CLEAR;
    pass->depth_read_only = pass->depth_read_only || tests;
    if (!known->depth && place->load != RG_LOAD_DISCARD)
        run_random_blend(t, place, known->sum);
    return true;
}

static const struct rg_vertex_layout word_of_instance = {
    .stride = sizeof(uint32_t),
    .attribute_count = 1,
    .attributes = &(const VkVertexInputAttributeDescription){ .format = VK_FORMAT_R32_UINT },
    .rate = VK_VERTEX_INPUT_RATE_INSTANCE,
};

/* Adds targets of the same extent as the first. Returns the number of colour targets. */
static uint32_t draw_other_targets(struct run_random_tables *t, uint32_t first_image, bool whole)
{
    struct rg_pass *pass = &t->passes[t->pass_count];
    const struct rg_target *first = pass->color[0].image ? &pass->color[0] : &pass->depth;
    const uint32_t wanted = first == &pass->depth       ? 0
                            : t->known[first_image].sum ? 1
                                                        : 1 + run_random_below(t, RANDOM_TARGETS);
    const bool depth = run_random_chance(t, 40);
    uint32_t colors = first == &pass->depth ? 0 : 1;
    for (uint32_t tries = 0; tries < 16; tries++) {
        const uint32_t image = run_random_below(t, t->image_count);
        const struct run_random_known *known = &t->known[image];
        const struct rg_target target = {
            .mip = pass->repeat == RG_PER_MIP ? first->mip : run_random_below(t, known->mips),
            .layer = run_random_below(t, known->layers),
        };
        struct rg_target *place = known->depth ? &pass->depth : &t->targets[t->pass_count][colors];
        if (known->sum || (known->depth ? !depth || place->image : colors >= wanted) ||
            target.mip >= known->mips || !fits(t, first_image, first, image, &target))
            continue;
        if (add_target(t, image, place, target, whole) && !known->depth)
            colors++;
    }
    return colors;
}

static const struct program *draw_raster_program(struct run_random_tables *t, uint32_t targets,
                                                 bool sums)
{
    const uint32_t count = sizeof(raster_programs) / sizeof(raster_programs[0]);
    const struct program *program = &raster_programs[run_random_below(t, count)];
    while (program->targets != targets || program->sums != sums)
        program = &raster_programs[run_random_below(t, count)];
    return program;
}

/* Generates a mip chain: each repetition reads the mip that the previous one wrote. */
static bool draw_mip_chain(struct run_random_tables *t)
{
    struct rg_pass *pass = run_random_begin(t, RG_RASTER);
    const uint32_t image = run_random_image(t);
    const struct run_random_known *known = &t->known[image];
    struct rg_range range = { .mip_count = 1, .layer_count = 1, .each = true };
    if (known->mips < 2 || known->depth || known->volume || known->sum)
        return false;
    range.layer = run_random_below(t, known->layers);
    run_random_condition(t, pass);
    pass->repeat = RG_PER_MIP;
    if (!run_random_claim(t, image, range, RG_SAMPLED)) /* mip 0 must be filled before */
        return false;
    t->claim_count = 0;
    t->repetitions = known->mips - 1;
    run_random_use(t, image, RG_SAMPLED, range)->binding = RANDOM_SAMPLED;
    range.mip = 1;
    if (!run_random_claim(t, image, range, RG_COLOR))
        return false;
    t->targets[t->pass_count][0] = (struct rg_target){
        .image = &t->images[image],
        .load = RG_LOAD_DISCARD,
        .mip = 1,
        .layer = range.layer,
    };
    pass->vert = &random_vert;
    pass->frag = &random_fetch_frag;
    pass->push_size = sizeof(struct random_push);
    return true;
}

static bool draw_raster(struct run_random_tables *t)
{
    struct rg_pass *pass = run_random_begin(t, RG_RASTER);
    const uint32_t image = run_random_image(t);
    const struct run_random_known *known = &t->known[image];
    const bool whole = run_random_chance(t, 50); /* every texel is overwritten */
    run_random_condition(t, pass);
    const uint32_t start = draw_repeat(t, image);
    const struct rg_target first = {
        .mip = pass->repeat == RG_PER_MIP ? start : run_random_below(t, known->mips),
        .layer = pass->repeat == RG_PER_LAYER ? start : run_random_below(t, known->layers),
    };
    if (!add_target(t, image, known->depth ? &pass->depth : t->targets[t->pass_count], first,
                    whole))
        return false;
    const uint32_t colors = draw_other_targets(t, image, whole);
    if (!colors && pass->depth_read_only)
        return false;
    t->rows[t->pass_count].depth = draw_depth(t);
    pass->depth_compare = whole ? VK_COMPARE_OP_ALWAYS : (VkCompareOp)run_random_below(t, 8);
    pass->vert = &random_vert;
    pass->push_size = sizeof(struct random_push);
    run_random_stencil(t, pass, whole);
    if (!whole)
        draw_region(t);
    if (colors) {
        const struct program *program = draw_raster_program(t, colors, known->sum);
        pass->frag = program->shader;
        pass->vert = program->instances ? &random_instances_vert : &random_vert;
        pass->vertices = program->instances ? &word_of_instance : NULL;
        t->rows[t->pass_count].instance_count = program->instances ? 2 : 1;
        if (!draw_inputs(t, program))
            return false;
    }
    return true;
}

void run_random_draw(struct run_random_tables *t)
{
    const bool drawn = run_random_chance(t, 10)   ? draw_mip_chain(t)
                       : run_random_chance(t, 45) ? draw_raster(t)
                                                  : draw_compute(t);
    if (drawn)
        run_random_end(t);
}
