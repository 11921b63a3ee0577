/* random_graph_passes.c: generates random valid passes; tracks the written subresources. */
#include <string.h>
#include "tests/support/random_graph_private.h"

static void record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
}

static const struct rg_shader shader = { .name = "none" };

static bool is_null_frame(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame == NULL;
}

static bool is_any_frame(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame != NULL;
}

static bool is_never(const struct rg_frame *frame, uint32_t repetition)
{
    (void)frame;
    (void)repetition;
    return false;
}

static rg_when_fn *const conditions[CONDITIONS] = { is_null_frame, is_any_frame, is_never };

/* Marks a range as written under `condition`, which replaces an earlier condition. */
static void define(struct random_known *known, const struct rg_range *range, uint32_t condition)
{
    for (uint32_t layer = range->layer; layer < range->layer + range->layer_count; layer++)
        for (uint32_t mip = range->mip; mip < range->mip + range->mip_count; mip++) {
            uint8_t *defined = &known->defined[layer * known->mips + mip];
            *defined = (uint8_t)((*defined & 1U) | 1U << condition);
        }
    known->written = true;
}

bool random_graph_is_defined(const struct random_known *known, const struct rg_range *range,
                             uint32_t condition)
{
    for (uint32_t layer = range->layer; layer < range->layer + range->layer_count; layer++)
        for (uint32_t mip = range->mip; mip < range->mip + range->mip_count; mip++)
            if (!(known->defined[layer * known->mips + mip] & (1U | 1U << condition)))
                return false;
    return true;
}

/* Returns true if the range is defined whenever the pass being generated runs. */
static bool is_defined(const struct random_tables *t, uint32_t resource,
                       const struct rg_range *range)
{
    return random_graph_is_defined(&t->known[resource], range, t->condition);
}

struct rg_range random_graph_whole(const struct random_known *known)
{
    return (struct rg_range){ .mip_count = known->mips, .layer_count = known->layers };
}

static uint32_t pick_image(struct random_tables *t)
{
    if (!t->local || t->image_count < 4)
        return random_graph_below(t, t->image_count);
    uint32_t first = t->pass_count * (t->image_count - 3) / t->wanted_count;
    return first + random_graph_below(t, 4);
}

static uint32_t pick(struct random_tables *t)
{
    if (t->buffer_count == 0 || random_graph_chance(t, 65))
        return pick_image(t);
    return IMAGES + random_graph_below(t, t->buffer_count);
}

static bool overlaps(const struct rg_range *a, const struct rg_range *b)
{
    return a->mip < b->mip + b->mip_count && b->mip < a->mip + a->mip_count &&
           a->layer < b->layer + b->layer_count && b->layer < a->layer + a->layer_count;
}

/* Reserves a range of a resource for the pass being generated; false if it overlaps another. */
static bool claim(struct random_tables *t, uint32_t resource, struct rg_range range, bool writes)
{
    if (writes && t->known[resource].history)
        return false;
    for (uint32_t i = 0; i < t->claim_count; i++)
        if (t->claims[i].resource == resource && overlaps(&t->claims[i].range, &range))
            return false;
    t->claims[t->claim_count++] = (struct random_claim){ resource, range, writes };
    return true;
}

/* Returns a random range of an image: all of it, or some mips and layers. */
static struct rg_range draw_range(struct random_tables *t, const struct random_known *known)
{
    struct rg_range range = random_graph_whole(known);
    if (random_graph_chance(t, 50))
        return range;
    range.mip = random_graph_below(t, known->mips);
    range.mip_count = 1 + random_graph_below(t, known->mips - range.mip);
    range.layer = random_graph_below(t, known->layers);
    range.layer_count = 1 + random_graph_below(t, known->layers - range.layer);
    return range;
}

static struct rg_use *add_use(struct random_tables *t, uint32_t resource, enum rg_access access)
{
    struct rg_use *use = &t->uses[t->pass_count][t->use_count];
    *use = (struct rg_use){ .access = access, .binding = (uint16_t)t->use_count };
    if (resource < IMAGES)
        use->image = &t->images[resource];
    else
        use->buffer = &t->buffers[resource - IMAGES];
    t->use_count++;
    if (use->image && use->image->format == VK_FORMAT_R8G8B8A8_UNORM && access >= RG_SAMPLED &&
        access <= RG_STORAGE_READ_WRITE && random_graph_chance(t, 10))
        use->view_format = VK_FORMAT_R32_UINT;
    return use;
}

/* Randomly sets mip and layer counts to 0, which means all that remain. */
static struct rg_range written_range(struct random_tables *t, const struct random_known *known,
                                     struct rg_range range)
{
    if (range.mip + range.mip_count == known->mips && random_graph_chance(t, 50))
        range.mip_count = 0;
    if (range.layer + range.layer_count == known->layers && random_graph_chance(t, 50))
        range.layer_count = 0;
    return range;
}

/* Randomly makes a buffer access use a texel buffer view. */
static void draw_texels(struct random_tables *t, struct rg_use *use)
{
    bool known = use->buffer && use->buffer->format;
    if (known && use->access >= RG_STORAGE_READ && use->access <= RG_STORAGE_READ_WRITE)
        use->texels = random_graph_chance(t, 50);
    if (known && use->access == RG_UNIFORM && random_graph_chance(t, 50))
        use->access = RG_SAMPLED;
}

static enum rg_access draw_read(struct random_tables *t, const struct rg_pass *pass,
                                uint32_t resource)
{
    static const enum rg_access raster[] = { RG_UNIFORM, RG_STORAGE_READ, RG_VERTEX, RG_INDEX,
                                             RG_INDIRECT };

    static const enum rg_access compute[] = { RG_UNIFORM, RG_STORAGE_READ, RG_INDIRECT };

    if (t->known[resource].structure)
        return RG_TRACE;
    if (pass->kind == RG_TRANSFER)
        return RG_COPY_SRC;
    if (resource < IMAGES)
        return t->known[resource].storage && random_graph_chance(t, 30) ? RG_STORAGE_READ
                                                                        : RG_SAMPLED;
    return pass->kind == RG_RASTER ? raster[random_graph_below(t, 5)]
                                   : compute[random_graph_below(t, 3)];
}

static void draw_stages(struct random_tables *t, const struct rg_pass *pass, struct rg_use *use)
{
    bool shader_access = use->access == RG_SAMPLED || use->access == RG_UNIFORM ||
                         use->access == RG_STORAGE_READ || use->access == RG_TRACE;
    if (pass->kind != RG_RASTER || !shader_access || random_graph_chance(t, 70))
        return;
    use->stages = VK_SHADER_STAGE_VERTEX_BIT;
    if (random_graph_chance(t, 50))
        use->stages |= VK_SHADER_STAGE_FRAGMENT_BIT;
}

static const struct rg_image missing = { .name = "missing", .format = VK_FORMAT_R16_SFLOAT };
static const struct rg_fallback black = { { 0 } };

/* Sometimes adds a fallback to `use`; if `use` is NULL, sometimes samples an unwritten image. */
static void draw_fallback(struct random_tables *t, const struct rg_pass *pass, struct rg_use *use)
{
    const bool sampled = use && use->image && use->access == RG_SAMPLED && !use->view_format;
    if (sampled && use->image->samples <= 1 && random_graph_chance(t, 15))
        use->fallback = &black;
    if (use || pass->kind == RG_TRANSFER || t->use_count == USES || random_graph_chance(t, 95))
        return;
    use = add_use(t, 0, RG_SAMPLED);
    *use = (struct rg_use){ &missing, .access = RG_SAMPLED, .binding = use->binding };
    use->fallback = &black;
    draw_stages(t, pass, use);
}

static void draw_reads(struct random_tables *t, const struct rg_pass *pass)
{
    uint32_t wanted = (t->local ? 1 : 0) + random_graph_below(t, USES - 2);
    for (uint32_t tries = 0; tries < 12 && wanted && t->use_count < USES; tries++) {
        uint32_t resource = t->local && tries < 2 ? t->last_written : pick(t);
        struct random_known *known = &t->known[resource];
        if ((resource >= IMAGES && t->buffers[resource - IMAGES].memory == RG_MEMORY_READBACK) ||
            (pass->kind == RG_TRANSFER && !known->copies))
            continue;
        struct rg_range range = draw_range(t, known);
        if (!is_defined(t, resource, &range) || !claim(t, resource, range, false))
            continue;
        struct rg_use *use = add_use(t, resource, draw_read(t, pass, resource));
        if (resource < IMAGES)
            use->range = written_range(t, known, range);
        draw_texels(t, use);
        if (known->stencil && use->access != RG_COPY_SRC)
            use->range.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
        draw_stages(t, pass, use);
        draw_fallback(t, pass, use);
        wanted--;
    }
    draw_fallback(t, pass, NULL);
}

static enum rg_access draw_write(struct random_tables *t, const struct rg_pass *pass, bool defined)
{
    if (pass->kind == RG_TRANSFER)
        return RG_COPY_DST;
    return defined && random_graph_chance(t, 40) ? RG_STORAGE_READ_WRITE : RG_STORAGE_WRITE;
}

static bool can_write(const struct random_tables *t, const struct rg_pass *pass, uint32_t resource)
{
    const struct random_known *known = &t->known[resource];
    if (known->structure)
        return false;
    if (resource >= IMAGES)
        return t->buffers[resource - IMAGES].memory != RG_MEMORY_UPLOAD;
    return pass->kind == RG_TRANSFER ? !known->depth && known->copies : known->storage;
}

static bool add_write(struct random_tables *t, const struct rg_pass *pass, uint32_t resource)
{
    struct random_known *known = &t->known[resource];
    struct rg_range range = draw_range(t, known);
    if (!claim(t, resource, range, true))
        return false;
    bool defined = is_defined(t, resource, &range);
    struct rg_use *use = add_use(t, resource, draw_write(t, pass, defined));
    use->partial = defined && use->access != RG_STORAGE_READ_WRITE && random_graph_chance(t, 20);
    draw_texels(t, use);
    if (resource < IMAGES)
        use->range = written_range(t, known, range);
    return true;
}

static bool draw_writes(struct random_tables *t, const struct rg_pass *pass)
{
    uint32_t wanted = 1 + random_graph_below(t, 2);
    bool any = false;
    for (uint32_t tries = 0; tries < 20 && wanted && t->use_count < USES; tries++) {
        uint32_t resource = pick(t);
        if (can_write(t, pass, resource) && add_write(t, pass, resource)) {
            any = true;
            wanted--;
        }
    }
    return any;
}

static uint32_t mip_size(uint32_t size, uint32_t mip)
{
    return size >> mip ? size >> mip : 1;
}

/* Returns the range that a target covers over all repetitions of the pass. */
static struct rg_range target_range(const struct random_known *known, const struct rg_pass *pass,
                                    uint32_t mip, uint32_t layer)
{
    struct rg_range range = { .mip = mip, .mip_count = 1, .layer = layer, .layer_count = 1 };
    if (pass->layers)
        range.layer_count = pass->layers;
    if (pass->repeat == RG_PER_LAYER)
        range.layer_count = known->layers - layer;
    if (pass->repeat == RG_PER_MIP)
        range.mip_count = known->mips - mip;
    return range;
}

/* blend states that preserve or read the target: a partial write mask, another blend equation */
static const VkPipelineColorBlendAttachmentState blends[] = {
    { .colorWriteMask = VK_COLOR_COMPONENT_R_BIT },
    { .blendEnable = VK_TRUE,
      .srcColorBlendFactor = VK_BLEND_FACTOR_DST_COLOR,
      .colorBlendOp = VK_BLEND_OP_MAX,
      .colorWriteMask = 0xf },
};

static bool claim_target(struct random_tables *t, const struct rg_pass *pass,
                         struct rg_target *target, uint32_t resource)
{
    const struct random_known *known = &t->known[resource];
    struct rg_range range = target_range(known, pass, target->mip, target->layer);
    bool read_only = target == &pass->depth && pass->depth_read_only;
    bool defined = is_defined(t, resource, &range);
    if (known->volume || (read_only && !defined) || !claim(t, resource, range, !read_only))
        return false;
    target->image = &t->images[resource];

    static const enum rg_load loads[] = { RG_LOAD_CLEAR, RG_LOAD_DISCARD, RG_LOAD_KEEP,
                                          RG_LOAD_KEEP };

    target->load = read_only ? RG_LOAD_KEEP : loads[random_graph_below(t, defined ? 4 : 2)];
    if (target != &pass->depth && defined && random_graph_chance(t, 20))
        target->blend = RG_BLEND_OVER;
    else if (target != &pass->depth && defined && random_graph_chance(t, 20))
        target->blend_state = &blends[random_graph_below(t, 2)];
    return true;
}

/* Returns true if a target has the extent and repetition count of the pass's first target. */
static bool fits(const struct rg_pass *pass, const struct random_known *main,
                 const struct rg_target *first, const struct random_known *known,
                 const struct rg_target *target)
{
    if (mip_size(known->width, target->mip) != mip_size(main->width, first->mip) ||
        mip_size(known->height, target->mip) != mip_size(main->height, first->mip) ||
        pass->layers > known->layers - target->layer)
        return false;
    if (pass->repeat == RG_PER_LAYER && known->layers > 1)
        return known->layers - target->layer == main->layers - first->layer;
    return pass->repeat != RG_PER_MIP || known->mips - target->mip == main->mips - first->mip;
}

static struct rg_target *colors_of(struct random_tables *t, const struct rg_pass *pass)
{
    return t->targets[pass - t->passes];
}

/* Sometimes adds a resolve attachment to a multisampled colour target. */
static void draw_resolve(struct random_tables *t, const struct rg_pass *pass,
                         struct rg_target *target, uint32_t of)
{
    const struct random_known *from = &t->known[of];
    const struct rg_target *first = pass->color[0].image ? &pass->color[0] : &pass->depth;
    const struct random_known *main = &t->known[first->image - t->images];
    for (uint32_t tries = 0; from->samples > 1 && !from->depth && tries < 4; tries++) {
        /* the next image is often generated as the resolve destination */
        uint32_t resource = tries == 0 && of + 1 < t->image_count ? of + 1 : pick_image(t);
        const struct random_known *known = &t->known[resource];
        struct rg_target to = { .mip = random_graph_below(t, known->mips),
                                .layer = random_graph_below(t, known->layers) };
        struct rg_range range = target_range(known, pass, to.mip, to.layer);
        if (known->format != from->format || known->samples > 1 || known->volume ||
            !fits(pass, main, first, known, &to) || !claim(t, resource, range, true))
            continue;
        target->resolve = &t->images[resource];
        target->resolve_mip = to.mip;
        target->resolve_layer = to.layer;
        return;
    }
}

/* Adds targets of the same extent as the first target, which is image `of`. */
static void draw_other_targets(struct random_tables *t, struct rg_pass *pass, uint32_t of,
                               const struct rg_target *first)
{
    struct random_known *main = &t->known[of];
    uint32_t colors = pass->color[0].image ? 1 : RG_COLOR_COUNT; /* none beside depth */
    for (uint32_t tries = 0; tries < 10; tries++) {
        uint32_t resource = pick_image(t);
        const struct random_known *known = &t->known[resource];
        struct rg_target target = { .mip = random_graph_below(t, known->mips),
                                    .layer = random_graph_below(t, known->layers) };
        if (known->samples != main->samples || !fits(pass, main, first, known, &target))
            continue;
        struct rg_target *place =
            known->depth ? &pass->depth : &colors_of(t, pass)[colors % RG_COLOR_COUNT];
        if (place->image || (!known->depth && colors >= 4))
            continue;
        *place = target;
        pass->depth_read_only |= known->depth && random_graph_chance(t, 30);
        if (claim_target(t, pass, place, resource)) {
            colors += !known->depth;
            draw_resolve(t, pass, place, resource);
        } else {
            *place = (struct rg_target){ 0 };
            pass->depth_read_only &= pass->depth.image != NULL;
        }
    }
}

static bool draw_targets(struct random_tables *t, struct rg_pass *pass)
{
    uint32_t resource = pick_image(t);
    struct random_known *known = &t->known[resource];
    struct rg_target *target = known->depth ? &pass->depth : colors_of(t, pass);
    if (known->layers > 1 && random_graph_chance(t, 50))
        pass->repeat = RG_PER_LAYER;
    else if (known->mips > 1 && random_graph_chance(t, 50))
        pass->repeat = RG_PER_MIP;
    bool from_start = pass->repeat == RG_ONCE || random_graph_chance(t, 70);
    target->mip = pass->repeat == RG_PER_MIP && from_start ? 0 : random_graph_below(t, known->mips);
    target->layer =
        pass->repeat == RG_PER_LAYER && from_start ? 0 : random_graph_below(t, known->layers);
    if (pass->repeat != RG_PER_LAYER && random_graph_chance(t, 40))
        pass->layers = 1 + random_graph_below(t, known->layers - target->layer);
    pass->multiview = pass->layers && pass->layers <= RG_MAX_VIEWS && random_graph_chance(t, 50);
    if (!claim_target(t, pass, target, resource))
        return false;
    draw_resolve(t, pass, target, resource);
    draw_other_targets(t, pass, resource, target);
    return true;
}

/* Generates a mip chain: each repetition reads the mip that the previous one wrote, downwards or
 * upwards. */
static bool draw_mip_chain(struct random_tables *t, struct rg_pass *pass)
{
    uint32_t resource = pick_image(t);
    struct random_known *known = &t->known[resource];
    struct rg_range top = random_graph_whole(known);
    const uint32_t up = random_graph_chance(t, 40);
    top.mip = up ? known->mips - 1 : 0;
    top.mip_count = 1;
    bool layered = pass->kind != RG_RASTER;
    if (!layered)
        top.layer_count = 1;
    if (known->mips < 2 || known->depth || (known->volume && pass->kind == RG_RASTER) ||
        !is_defined(t, resource, &top))
        return false;
    struct rg_range all = top;
    all.mip = 0;
    all.mip_count = known->mips;
    if (!claim(t, resource, all, true))
        return false;
    pass->repeat = up ? RG_PER_MIP_UP : RG_PER_MIP;
    struct rg_range each = { .mip = up, .layer_count = layered ? 0 : 1, .each = true };
    add_use(t, resource, pass->kind == RG_TRANSFER ? RG_COPY_SRC : RG_SAMPLED)->range = each;
    each.mip = 1 - up;
    if (layered)
        add_use(t, resource, pass->kind == RG_TRANSFER ? RG_COPY_DST : RG_STORAGE_WRITE)->range =
            each;
    else
        *colors_of(t, pass) = (struct rg_target){ .image = &t->images[resource],
                                                  .load = RG_LOAD_DISCARD,
                                                  .mip = 1 - up };
    return true;
}

/* Generates a pass that copies or shades each layer of an image from another image. */
static bool draw_layer_copy(struct random_tables *t, struct rg_pass *pass)
{
    uint32_t from = pick_image(t), to = pick_image(t);
    struct random_known *source = &t->known[from], *target = &t->known[to];
    struct rg_range reads = random_graph_whole(source), writes = random_graph_whole(target);
    if (from == to || source->layers < target->layers || source->depth || !can_write(t, pass, to) ||
        !is_defined(t, from, &reads) || (pass->kind == RG_TRANSFER && !source->copies))
        return false;
    if (!claim(t, from, reads, false) || !claim(t, to, writes, true))
        return false;
    pass->repeat = RG_PER_LAYER;
    struct rg_range each = { .each = true };
    add_use(t, from, pass->kind == RG_TRANSFER ? RG_COPY_SRC : RG_SAMPLED)->range = each;
    add_use(t, to, pass->kind == RG_TRANSFER ? RG_COPY_DST : RG_STORAGE_WRITE)->range = each;
    return true;
}

/* Sometimes samples the depth target that a pass only tests. */
static void draw_tested_depth(struct random_tables *t, const struct rg_pass *pass)
{
    if (!pass->depth_read_only || !pass->depth.image || random_graph_chance(t, 50))
        return;
    uint32_t resource = (uint32_t)(pass->depth.image - t->images);
    struct random_known *known = &t->known[resource];
    struct rg_range range = random_graph_chance(t, 50)
                                ? draw_range(t, known)
                                : target_range(known, pass, pass->depth.mip, pass->depth.layer);
    if (!is_defined(t, resource, &range))
        return;
    struct rg_use *use = add_use(t, resource, RG_SAMPLED);
    use->range = written_range(t, known, range);
    use->range.aspect = known->stencil ? VK_IMAGE_ASPECT_DEPTH_BIT : 0;
    draw_stages(t, pass, use);
}

static bool draw_body(struct random_tables *t, struct rg_pass *pass)
{
    if (random_graph_chance(t, 15) && draw_mip_chain(t, pass))
        return true;
    if (pass->kind == RG_RASTER) {
        if (t->claim_count || !draw_targets(t, pass))
            return false;
        draw_tested_depth(t, pass);
        if (random_graph_chance(t, 10) && pass->repeat == RG_ONCE)
            draw_writes(t, pass);
        return true;
    }
    if (random_graph_chance(t, 20) && !t->claim_count && draw_layer_copy(t, pass))
        return true;
    return t->claim_count == 0 && draw_writes(t, pass);
}

static const struct rg_stencil marks = {
    .front = { .passOp = VK_STENCIL_OP_INVERT, .writeMask = 1 },
};
static const struct rg_stencil tests = { .back = { .compareOp = VK_COMPARE_OP_EQUAL } };
static const VkVertexInputAttributeDescription second_attributes[] = {
    { 1, 1, VK_FORMAT_R32G32_SFLOAT, 0 },
};
static const struct rg_vertex_layout second_vertices = {
    .stride = 8,
    .attribute_count = 1,
    .attributes = second_attributes,
    .rate = VK_VERTEX_INPUT_RATE_INSTANCE,
};
static const VkVertexInputAttributeDescription first_attributes[] = {
    { 0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0 },
};
static const struct rg_vertex_layout first_vertices = {
    .stride = 12,
    .attribute_count = 1,
    .attributes = first_attributes,
    .next = &second_vertices,
};
static const struct rg_set own_set = { "own" };

/* Chooses state that affects no barrier: stencil, depth bias, vertex layout, descriptor set. */
static void draw_state(struct random_tables *t, struct rg_pass *pass)
{
    bool stencil = pass->depth.image && t->known[pass->depth.image - t->images].stencil;
    if (stencil && random_graph_chance(t, 50))
        pass->stencil = pass->depth_read_only ? &tests : &marks;
    if (pass->kind == RG_RASTER && random_graph_chance(t, 20))
        pass->vertices = &first_vertices;
    if (pass->depth.image && random_graph_chance(t, 20))
        pass->depth_bias.slope = 1;
    if (pass->kind != RG_TRANSFER && random_graph_chance(t, 10))
        pass->set = &own_set;
}

/* Merges some neighbouring uses with the same descriptor type into a descriptor array. */
static void draw_arrays(struct random_tables *t)
{
    struct rg_use *uses = t->uses[t->pass_count];
    for (uint32_t i = 1; i < t->use_count; i++) {
        const VkDescriptorType type = rg_use_descriptor(&uses[i]);
        if (type == VK_DESCRIPTOR_TYPE_MAX_ENUM || type != rg_use_descriptor(&uses[i - 1]) ||
            uses[i].stages != uses[i - 1].stages || random_graph_chance(t, 50))
            continue;
        uses[i].binding = uses[i - 1].binding;
        uses[i].element = (uint16_t)(uses[i - 1].element + 1);
    }
}

void random_graph_draw(struct random_tables *t)
{
    struct rg_pass *pass = &t->passes[t->pass_count];
    *pass = (struct rg_pass){
        .kind = random_graph_chance(t, 50)   ? RG_RASTER
                : random_graph_chance(t, 60) ? RG_COMPUTE
                                             : RG_TRANSFER,
        .color = colors_of(t, pass),
        .color_count = RG_COLOR_COUNT,
        .uses = t->uses[t->pass_count],
        .record = record,
    };
    memset(colors_of(t, pass), 0, sizeof(t->targets[0]));
    t->claim_count = t->use_count = 0;
    t->condition = 0;
    if (t->condition_count && random_graph_chance(t, 35)) {
        t->condition = 1 + random_graph_below(t, t->condition_count);
        pass->when = conditions[t->condition - 1];
    }
    bool drawn = draw_body(t, pass);
    if (drawn && random_graph_chance(t, t->local ? 100 : 85))
        draw_reads(t, pass);
    t->uses[t->pass_count][t->use_count] = (struct rg_use){ 0 };
    if (!drawn)
        return;
    draw_state(t, pass);
    draw_arrays(t);
    pass->name = random_graph_name(t, 'p', t->pass_count, RESOURCES + t->pass_count);
    if (pass->kind != RG_TRANSFER && random_graph_chance(t, 85)) /* others bind own pipelines */
        *(pass->kind == RG_RASTER ? &pass->vert : &pass->comp) = &shader;
    pass->frag = pass->vert;
    for (uint32_t i = 0; i < t->claim_count; i++)
        if (t->claims[i].writes) {
            define(&t->known[t->claims[i].resource], &t->claims[i].range, t->condition);
            t->last_written = t->claims[i].resource;
        }
    t->pass_count++;
}

void random_graph_draw_last(struct random_tables *t)
{
    struct rg_pass *pass = &t->passes[t->pass_count];
    struct rg_range range = random_graph_whole(&t->known[0]);
    *pass = (struct rg_pass){
        .name = "last",
        .kind = RG_TRANSFER,
        .color = colors_of(t, pass),
        .color_count = RG_COLOR_COUNT,
        .uses = t->uses[t->pass_count],
        .record = record,
    };
    memset(colors_of(t, pass), 0, sizeof(t->targets[0]));
    t->use_count = 0;
    add_use(t, 0, RG_COPY_DST);
    t->uses[t->pass_count][1] = (struct rg_use){ 0 };
    define(&t->known[0], &range, 0);
    t->pass_count++;
}
