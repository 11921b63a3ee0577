/* interpret_graph.c: CPU reference interpreter of render graphs. */
#include "tests/support/interpret_graph.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/interpret_texel_format.h"

enum {
    GARBAGE = 0xa5,
    ALL_CHANNELS = 0xf,
};

const uint32_t interpret_set_words[RANDOM_OWN_WORDS] = { 7, 70, 700, 7000 };

/* ---- geometry of images and buffers ---- */

static uint32_t at_least_one(uint32_t size)
{
    return size ? size : 1;
}

static uint32_t scaled(uint32_t view, float scale)
{
    const float exact = (float)view * (scale > 0 ? scale : 1);
    const uint32_t whole = (uint32_t)exact;
    return at_least_one((float)whole < exact ? whole + 1 : whole);
}

static struct interpret_part whole_image(const struct interpret_tables *tables,
                                         const struct rg_image *image)
{
    return (struct interpret_part){
        .volume = image->depth,
        .mip_count = at_least_one(image->mips),
        .layer_count = image->depth ? image->depth : at_least_one(image->layers),
        .width = image->width ? image->width : scaled(tables->view.width, image->scale),
        .height = image->height ? image->height : scaled(tables->view.height, image->scale),
    };
}

static struct interpret_part at_mip(struct interpret_part part, uint32_t mip)
{
    part.width = at_least_one(part.width >> mip);
    part.height = at_least_one(part.height >> mip);
    if (part.volume)
        part.layer_count = at_least_one(part.layer_count >> mip);
    part.mip_count -= mip;
    part.mip = mip;
    return part;
}

uint32_t *interpret_texel(const struct interpret_image *image, uint32_t mip, const uint32_t at[3])
{
    size_t first = 0;
    for (uint32_t m = 0; m < mip; m++) {
        const struct interpret_part level = at_mip(image->all, m);
        first += (size_t)level.width * level.height * level.layer_count;
    }
    const struct interpret_part level = at_mip(image->all, mip);
    assert(at[0] < level.width && at[1] < level.height && at[2] < level.layer_count);
    return image->texels[first + ((size_t)at[2] * level.height + at[1]) * level.width + at[0]];
}

struct interpret_part interpret_part(const struct interpret_tables *tables,
                                     const struct rg_pass *pass, uint32_t repetition,
                                     const struct rg_use *use)
{
    const struct rg_range *range = &use->range;
    const bool each_layer = range->each && pass->repeat == RG_PER_LAYER;
    const bool each_mip = range->each && pass->repeat == RG_PER_MIP;
    struct interpret_part part = whole_image(tables, use->image);
    part = at_mip(part, range->mip + (each_mip ? repetition : 0));
    part.layer = range->layer + (each_layer ? repetition : 0);
    part.layer_count -= part.layer;
    if (each_mip || range->mip_count)
        part.mip_count = each_mip ? 1 : range->mip_count;
    if (!part.volume && (each_layer || range->layer_count))
        part.layer_count = each_layer ? 1 : range->layer_count;
    return part;
}

static struct interpret_image *image_of(const struct interpret *in, const struct rg_image *image)
{
    return &in->images[image - in->tables->images];
}

uint32_t *interpret_words(const struct interpret *in, const struct rg_buffer *buffer)
{
    return in->words[buffer - in->tables->buffers];
}

static uint32_t word_count(const struct rg_buffer *buffer)
{
    return (uint32_t)(buffer->size / sizeof(uint32_t));
}

const struct rg_use *interpret_use(const struct rg_pass *pass, enum rg_access access)
{
    for (const struct rg_use *use = pass->uses; use->access; use++) {
        if (use->access == access)
            return use;
    }
    return NULL;
}

const struct rg_use *interpret_written(const struct rg_pass *pass)
{
    static const enum rg_access writes[] = { RG_STORAGE_WRITE, RG_STORAGE_READ_WRITE, RG_COPY_DST };
    const struct rg_use *use = NULL;
    for (size_t i = 0; i < sizeof(writes) / sizeof(writes[0]) && !use; i++)
        use = interpret_use(pass, writes[i]);
    return use;
}

struct random_push interpret_push(const struct rg_frame *frame, const struct rg_pass *pass)
{
    const struct interpret_row *row = &frame->tables->rows[pass - frame->tables->passes];
    struct random_push push = {
        .salt = random_mix(row->salt, frame->number),
        .shift = row->shift + frame->number,
        .from = { row->from[0], row->from[1] },
        .to = { row->to[0], row->to[1] },
        .depth = row->depth,
    };
    for (uint32_t i = 0; i < RANDOM_TARGETS && i < pass->color_count && pass->color[i].image; i++)
        push.masks[i] = interpret_format_mask(pass->color[i].image->format);
    if (pass->kind == RG_COMPUTE) {
        const struct rg_image *image = interpret_written(pass)->image;
        push.masks[0] = image ? interpret_format_mask(image->format) : UINT32_MAX;
    }
    return push;
}

/* ---- shaders: random.frag and random.comp ---- */

/* The pass repetition being interpreted. */
struct running {
    struct interpret *in;
    const struct rg_pass *pass;
    uint32_t repetition;
    struct random_push push;
    uint32_t instance;
};

static uint32_t fold(uint32_t sum, const uint32_t texel[4])
{
    for (uint32_t i = 0; i < 4; i++)
        sum = random_mix(sum, texel[i]);
    return sum;
}

/* Mixes the texels that a shader fetches, one per mip, into the hash `sum`. */
static uint32_t fetch(const struct running *run, const struct rg_use *use, const uint32_t at[3],
                      uint32_t sum)
{
    const struct interpret_part part =
        interpret_part(run->in->tables, run->pass, run->repetition, use);
    const struct interpret_image *image = image_of(run->in, use->image);
    const uint32_t mip_count = use->access == RG_SAMPLED ? part.mip_count : 1;
    for (uint32_t mip = part.mip; mip < part.mip + mip_count; mip++) {
        const struct interpret_part level = at_mip(image->all, mip);
        const uint32_t place[3] = {
            (at[0] + run->push.shift) % level.width,
            (at[1] + run->push.shift) % level.height,
            part.layer +
                (at[2] + at[0] + 2 * at[1]) % (part.volume ? level.layer_count : part.layer_count),
        };
        sum = fold(sum, interpret_texel(image, mip, place));
    }
    return sum;
}

/* Mixes a shader input into the hash `sum`. Read-write resources are read where it writes. */
static uint32_t input(const struct running *run, const struct rg_use *use, const uint32_t at[3],
                      uint32_t sum)
{
    const bool changes = use->access == RG_STORAGE_READ_WRITE;
    if (use->image && !changes)
        return fetch(run, use, at, sum);
    if (use->image) {
        const struct interpret_part part =
            interpret_part(run->in->tables, run->pass, run->repetition, use);
        const uint32_t place[3] = { at[0], at[1], part.layer + at[2] };
        return fold(sum, interpret_texel(image_of(run->in, use->image), part.mip, place));
    }
    uint32_t index = random_word(at[0], at[1], at[2]) + run->push.shift;
    if (use->access == RG_UNIFORM)
        index = (at[0] + at[1]) % RANDOM_UNIFORM_WORDS;
    if (changes)
        index = at[0];
    return random_mix(sum, interpret_words(run->in, use->buffer)[index % word_count(use->buffer)]);
}

static uint32_t inputs(const struct running *run, const uint32_t at[3])
{
    const uint32_t start[4] = { at[0], at[1], at[2], 0 };
    uint32_t sum = fold(run->push.salt, start);
    for (uint32_t binding = 0; binding < RANDOM_BINDING_COUNT; binding++) {
        for (const struct rg_use *use = run->pass->uses; use->access; use++) {
            const struct rg_access_info *info = rg_access_info(use->access);
            if (use->binding == binding && use->access >= RG_SAMPLED && use->access <= RG_UNIFORM &&
                info->reads_content)
                sum = input(run, use, at, sum);
        }
    }
    if (run->pass->set)
        sum = random_mix(sum, interpret_set_words[(at[0] + 2 * at[1]) % RANDOM_OWN_WORDS]);
    const struct rg_use *instances = interpret_use(run->pass, RG_VERTEX);
    if (instances)
        sum = random_mix(sum, interpret_words(run->in, instances->buffer)[run->instance]);
    return sum;
}

/* Writes a texel. `mask` selects the channels that are written. */
static void output(uint32_t *texel, VkFormat format, uint32_t sum, uint32_t target,
                   VkColorComponentFlags mask)
{
    uint32_t value[4];
    for (uint32_t i = 0; i < 4; i++)
        value[i] = mask >> i & 1 ? random_mix(sum, 4 * target + i) : texel[i];
    interpret_format_store(texel, format, value);
}

/* Returns the parameters of an indirect draw or dispatch, or NULL if the pass has none. */
static const uint32_t *arguments(const struct running *run, uint32_t offset)
{
    const struct rg_use *use = interpret_use(run->pass, RG_INDIRECT);
    return use ? interpret_words(run->in, use->buffer) + offset / sizeof(uint32_t) : NULL;
}

/* ---- raster ---- */

struct bound {
    struct interpret_image *image; /* NULL if there is no attachment */
    uint32_t mip, layer;
    VkFormat format;
};

static struct bound bind(const struct running *run, const struct rg_target *target)
{
    if (!target->image)
        return (struct bound){ 0 };
    struct bound bound = {
        .image = image_of(run->in, target->image),
        .mip = target->mip,
        .layer = target->layer,
        .format = target->image->format,
    };
    if (run->pass->repeat == RG_PER_LAYER && bound.image->all.layer_count > 1)
        bound.layer += run->repetition;
    if (run->pass->repeat == RG_PER_MIP && bound.image->all.mip_count > 1)
        bound.mip += run->repetition;
    return bound;
}

static uint32_t *bound_texel(const struct bound *bound, const uint32_t at[3])
{
    const uint32_t place[3] = { at[0], at[1], bound->layer };
    return interpret_texel(bound->image, bound->mip, place);
}

static void load(const struct bound *bound, const struct rg_target *target,
                 struct interpret_part area)
{
    uint32_t value[4];
    memcpy(value, &target->clear, sizeof(value));
    if (target->load == RG_LOAD_DISCARD)
        memset(value, GARBAGE, sizeof(value));
    if (target->load == RG_LOAD_KEEP)
        return;
    for (uint32_t i = 0; i < area.width * area.height; i++) {
        const uint32_t at[3] = { i % area.width, i / area.width, 0 };
        interpret_format_store(bound_texel(bound, at), bound->format, value);
    }
}

static bool compares(VkCompareOp compare, float reference, float with)
{
    /* VkCompareOp constants are bit masks of these outcomes */
    const unsigned outcome = reference < with   ? VK_COMPARE_OP_LESS
                             : reference > with ? VK_COMPARE_OP_GREATER
                                                : VK_COMPARE_OP_EQUAL;
    return (unsigned)compare & outcome;
}

static void change_stencil(uint32_t *stencil, VkStencilOp op, const VkStencilOpState *state)
{
    uint32_t changed = *stencil;
    if (op == VK_STENCIL_OP_REPLACE)
        changed = state->reference;
    else if (op == VK_STENCIL_OP_INCREMENT_AND_WRAP)
        changed = *stencil + 1;
    else
        assert(op == VK_STENCIL_OP_KEEP);
    *stencil = ((*stencil & ~state->writeMask) | (changed & state->writeMask)) & 0xff;
}

static bool test_depth(const struct running *run, const struct bound *depth, const uint32_t at[3])
{
    const struct rg_pass *pass = run->pass;
    const VkStencilOpState *stencil = pass->stencil ? &pass->stencil->front : NULL;
    uint32_t *texel = bound_texel(depth, at);
    float old;
    memcpy(&old, texel, sizeof(old));
    if (stencil && !compares(stencil->compareOp, (float)(stencil->reference & stencil->compareMask),
                             (float)(texel[1] & stencil->compareMask))) {
        change_stencil(&texel[1], stencil->failOp, stencil);
        return false;
    }
    const bool passes =
        compares(pass->depth_compare ? pass->depth_compare : VK_COMPARE_OP_LESS_OR_EQUAL,
                 run->push.depth, old);
    if (stencil)
        change_stencil(&texel[1], passes ? stencil->passOp : stencil->depthFailOp, stencil);
    if (passes && !pass->depth_read_only)
        memcpy(texel, &run->push.depth, sizeof(old));
    return passes;
}

/* Blends one channel. Supports only the blend equations of random graphs. */
static void blend(uint32_t *texel, uint32_t sum, const struct rg_target *target)
{
    const VkPipelineColorBlendAttachmentState *state = target->blend_state;
    float value = (float)random_small(sum);
    float old;
    memcpy(&old, texel, sizeof(old));
    if (target->blend == RG_BLEND_ADD)
        value += old;
    else if (state && state->colorBlendOp == VK_BLEND_OP_REVERSE_SUBTRACT)
        value = old - value;
    else if (state && state->colorBlendOp == VK_BLEND_OP_MAX)
        value = old > value ? old : value;
    memcpy(texel, &value, sizeof(value));
}

static void draw_texel(const struct running *run, const struct bound *targets, const uint32_t at[3])
{
    const struct bound *depth = &targets[RG_COLOR_COUNT];
    if (depth->image && !test_depth(run, depth, at))
        return;
    const uint32_t sum = inputs(run, at);
    for (uint32_t i = 0; i < RG_COLOR_COUNT && targets[i].image; i++) {
        const VkPipelineColorBlendAttachmentState *state = run->pass->color[i].blend_state;
        if (targets[i].format == VK_FORMAT_R32_SFLOAT) {
            blend(bound_texel(&targets[i], at), sum, &run->pass->color[i]);
            continue;
        }
        output(bound_texel(&targets[i], at), targets[i].format, sum, i,
               state ? state->colorWriteMask : ALL_CHANNELS);
    }
}

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static void draw_instances(struct running *run, const struct bound *targets,
                           struct interpret_part area, uint32_t count)
{
    for (run->instance = 0; run->instance < count; run->instance++) {
        for (uint32_t y = run->push.from[1]; y < run->push.to[1] && y < area.height; y++) {
            for (uint32_t x = run->push.from[0]; x < run->push.to[0] && x < area.width; x++) {
                const uint32_t at[3] = { x, y, 0 };
                draw_texel(run, targets, at);
            }
        }
    }
}

static void run_raster(struct running *run)
{
    const struct rg_pass *pass = run->pass;
    struct bound targets[RG_COLOR_COUNT + 1] = { 0 };
    struct interpret_part area = { 0 };
    for (uint32_t i = 0; i <= RG_COLOR_COUNT; i++) {
        if (i < RG_COLOR_COUNT && i >= pass->color_count)
            continue;
        const struct rg_target *target = i < RG_COLOR_COUNT ? &pass->color[i] : &pass->depth;
        targets[i] = bind(run, target);
        if (!targets[i].image)
            continue;
        area = at_mip(targets[i].image->all, targets[i].mip);
        load(&targets[i], target, area);
    }
    const struct interpret_row *row = &run->in->tables->rows[pass - run->in->tables->passes];
    const uint32_t *draw = arguments(run, INTERPRET_DRAW);
    uint32_t draw_count = 1;
    if (draw && row->is_counted)
        draw_count = smaller(*arguments(run, INTERPRET_COUNT), INTERPRET_DRAW_COUNT);
    for (uint32_t i = 0; i < draw_count; i++) {
        const size_t at = i * sizeof(VkDrawIndirectCommand) / sizeof(*draw);
        draw_instances(run, targets, area, draw ? draw[at + 1] : row->instance_count);
    }
}

/* ---- compute ---- */

static void run_thread(const struct running *run, const struct rg_use *to,
                       struct interpret_part part, const uint32_t at[3])
{
    const uint32_t sum = inputs(run, at);
    if (to->image) {
        const uint32_t place[3] = { at[0], at[1], part.layer + at[2] };
        output(interpret_texel(image_of(run->in, to->image), part.mip, place), to->image->format,
               sum, 0, ALL_CHANNELS);
    } else {
        interpret_words(run->in, to->buffer)[at[0]] = random_mix(sum, 0);
    }
}

static void run_compute(struct running *run)
{
    const struct rg_use *to = interpret_written(run->pass);
    struct interpret_part part = { .layer_count = 1, .height = 1 };
    if (to->image)
        part = interpret_part(run->in->tables, run->pass, run->repetition, to);
    else
        part.width = word_count(to->buffer);
    uint32_t end[3] = { smaller(run->push.to[0], part.width), smaller(run->push.to[1], part.height),
                        part.layer_count };
    const uint32_t *groups = arguments(run, INTERPRET_DISPATCH);
    for (uint32_t i = 0; i < 3 && groups; i++)
        end[i] = smaller(end[i], groups[i] * (i < 2 ? RANDOM_GROUP : 1));
    uint32_t at[3];
    for (at[2] = 0; at[2] < end[2]; at[2]++) {
        for (at[1] = run->push.from[1]; at[1] < end[1]; at[1]++) {
            for (at[0] = run->push.from[0]; at[0] < end[0]; at[0]++)
                run_thread(run, to, part, at);
        }
    }
}

/* ---- copies ---- */

/* Copies between a tightly packed buffer and the first mip of an image range. */
static void copy_texels(const struct running *run, const struct rg_use *use, unsigned char *bytes,
                        bool to_image)
{
    const struct interpret_part part =
        interpret_part(run->in->tables, run->pass, run->repetition, use);
    const struct interpret_image *image = image_of(run->in, use->image);
    const uint32_t size = interpret_format_size(use->image->format);
    for (uint32_t i = 0; i < part.width * part.height * part.layer_count; i++) {
        const uint32_t at[3] = {
            i % part.width,
            i / part.width % part.height,
            part.layer + i / part.width / part.height,
        };
        uint32_t *texel = interpret_texel(image, part.mip, at);
        if (to_image)
            interpret_format_decode(texel, use->image->format, bytes + (size_t)i * size);
        else
            interpret_format_encode(bytes + (size_t)i * size, use->image->format, texel);
    }
}

static void copy_image(const struct running *run, const struct rg_use *from,
                       const struct rg_use *to)
{
    const struct interpret_tables *tables = run->in->tables;
    const struct interpret_part a = interpret_part(tables, run->pass, run->repetition, from);
    const struct interpret_part b = interpret_part(tables, run->pass, run->repetition, to);
    for (uint32_t i = 0; i < a.width * a.height * a.layer_count; i++) {
        const uint32_t x = i % a.width;
        const uint32_t y = i / a.width % a.height;
        const uint32_t layer = i / a.width / a.height;
        const uint32_t source[3] = { x, y, a.layer + layer };
        const uint32_t place[3] = { x, y, b.layer + layer };
        memcpy(interpret_texel(image_of(run->in, to->image), b.mip, place),
               interpret_texel(image_of(run->in, from->image), a.mip, source),
               4 * sizeof(uint32_t));
    }
}

static void run_copy(struct running *run)
{
    const struct interpret_row *row = &run->in->tables->rows[run->pass - run->in->tables->passes];
    const struct rg_use *from = interpret_use(run->pass, RG_COPY_SRC);
    const struct rg_use *to = interpret_use(run->pass, RG_COPY_DST);
    unsigned char *source = NULL;
    unsigned char *place = NULL;
    if (from->buffer)
        source = (unsigned char *)interpret_words(run->in, from->buffer) + row->src_offset;
    if (to->buffer)
        place = (unsigned char *)interpret_words(run->in, to->buffer) + row->dst_offset;
    if (source && place)
        memcpy(place, source, row->size);
    else if (source)
        copy_texels(run, to, source, true);
    else if (place)
        copy_texels(run, from, place, false);
    else
        copy_image(run, from, to);
}

/* ---- frames ---- */

static uint32_t repetitions(const struct interpret_tables *tables, const struct rg_pass *pass)
{
    const struct rg_target *target =
        pass->color_count && pass->color[0].image ? &pass->color[0] : &pass->depth;
    struct rg_use use = { .image = target->image };
    use.range.mip = target->mip;
    use.range.layer = target->layer;
    if (pass->repeat == RG_ONCE)
        return 1;
    if (!use.image)
        use = *interpret_written(pass);
    const struct interpret_part all = whole_image(tables, use.image);
    return pass->repeat == RG_PER_LAYER ? all.layer_count - use.range.layer
                                        : all.mip_count - use.range.mip;
}

void interpret_frame(struct interpret *in, const struct rg_frame *frame)
{
    static void (*const kinds[])(struct running *) = {
        [RG_RASTER] = run_raster,
        [RG_COMPUTE] = run_compute,
        [RG_TRANSFER] = run_copy,
    };
    for (uint32_t p = 0; p < in->tables->pass_count; p++) {
        const struct rg_pass *pass = &in->tables->passes[p];
        struct running run = { .in = in, .pass = pass, .push = interpret_push(frame, pass) };
        for (; run.repetition < repetitions(in->tables, pass); run.repetition++) {
            if (!pass->when || pass->when(frame, run.repetition))
                kinds[pass->kind](&run);
        }
    }
}

static size_t texel_count(const struct interpret_image *image)
{
    size_t count = 0;
    for (uint32_t m = 0; m < image->all.mip_count; m++) {
        const struct interpret_part level = at_mip(image->all, m);
        count += (size_t)level.width * level.height * level.layer_count;
    }
    return count;
}

bool interpret_init(struct interpret *in, const struct interpret_tables *tables)
{
    bool good = true;
    *in = (struct interpret){
        .tables = tables,
        .images = calloc(tables->image_count + 1, sizeof(*in->images)),
        .words = calloc(tables->buffer_count + 1, sizeof(*in->words)),
    };
    for (uint32_t i = 0; i < tables->image_count && in->images; i++) {
        struct interpret_image *image = &in->images[i];
        image->all = whole_image(tables, &tables->images[i]);
        image->texels = calloc(texel_count(image), sizeof(*image->texels));
        for (size_t k = 0; k < texel_count(image) && image->texels; k++)
            interpret_format_store(image->texels[k], tables->images[i].format,
                                   (const uint32_t[4]){ 0 });
        good = good && image->texels;
    }
    for (uint32_t i = 0; i < tables->buffer_count && in->words; i++) {
        in->words[i] = calloc(word_count(&tables->buffers[i]), sizeof(uint32_t));
        good = good && in->words[i];
    }
    if (good && in->images && in->words)
        return true;
    interpret_finish(in);
    return false;
}

void interpret_finish(struct interpret *in)
{
    for (uint32_t i = 0; in->images && i < in->tables->image_count; i++)
        free(in->images[i].texels);
    for (uint32_t i = 0; in->words && i < in->tables->buffer_count; i++)
        free(in->words[i]);
    free(in->images);
    free(in->words);
    *in = (struct interpret){ 0 };
}

void interpret_begin(struct interpret *in)
{
    for (uint32_t i = 0; i < in->tables->image_count; i++) {
        if (!in->tables->images[i].persistent)
            memset(in->images[i].texels, GARBAGE,
                   texel_count(&in->images[i]) * sizeof(*in->images[i].texels));
    }
    for (uint32_t i = 0; i < in->tables->buffer_count; i++) {
        if (!in->tables->buffers[i].persistent)
            memset(in->words[i], GARBAGE, (size_t)in->tables->buffers[i].size);
    }
}
