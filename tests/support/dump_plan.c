/* dump_plan.c: a hand-written plan with every construct that dumps can contain. */
#include "tests/support/dump_plan.h"

#include <string.h>

enum {
    SCENE,
    DEPTH,
    RESOLVED,
    HISTORY,
    SHOWN,
    FIELD,
};

enum {
    SUMS,
    COUNTERS,
    GLOBALS,
    RESULT,
    GIVEN,
};

const char *const dump_plan_names[DUMP_PLAN_NAMES] = {
    "scene",   "depth",  "resolved", "history", "shown",  "field",   "sums", "counters",
    "globals", "result", "given",    "draw",    "update", "overlay", "read",
};

const char *const dump_plan_awkward_names[DUMP_PLAN_NAMES] = {
    "quotes \" and ' and \\",
    "<b>&amp;</b>",
    "]]></script></style></title>",
    "line\nfeed\r\ttab",
    "controls \x01\x1f\x7f\xc2\x85",
    "\xe6\xb0\xb7 \xf0\x9f\xa7\x8a", /* the ideograph for ice, and an emoji of an ice cube */
    "\xff broken \xc3(",             /* invalid UTF-8: a stray byte and a truncated sequence */
    /* invalid UTF-8: a surrogate, a code point above U+10FFFF, three overlong encodings */
    "\xed\xa0\x80 \xf4\x90\x80\x80 \xc0\xaf \xe0\x80\xaf \xf0\x80\x80\xaf",
    "\xef\xbf\xbe \xef\xbf\xbf", /* the noncharacters U+FFFE and U+FFFF */
    "",
    "%s%n",
    "--><!--",
    "\xc3",
    "{\"a\": [null]}",
    " spaces  ",
};

static bool never(const struct rg_frame *frame, uint32_t repetition)
{
    (void)frame;
    (void)repetition;
    return false;
}

static const struct rg_use uses[] = {
    { .access = RG_SAMPLED, .binding = 3 },
    { .access = RG_STORAGE_READ_WRITE, .binding = 1 },
    { .access = RG_STORAGE_WRITE },
    { .access = RG_UNIFORM, .binding = 7 },
    { .access = RG_STORAGE_READ_WRITE, .element = 2, .texels = true },
    { .access = RG_COPY_SRC },
    { .access = RG_COPY_DST, .binding = 99 }, /* copies have no descriptor to dump */
};

static const struct rg_set own = { "own" };

#define COLOR_RANGE(...) \
    { \
        VK_IMAGE_ASPECT_COLOR_BIT, __VA_ARGS__ \
    }

static const struct rg_plan_use plan_uses[] = {
    { &uses[0], RESOLVED, RG_NONE, COLOR_RANGE(1, 2, 0, 2) },
    { &uses[1], HISTORY, RG_NONE, COLOR_RANGE(0, 1, 0, 1) },
    { &uses[2], FIELD, RG_NONE, COLOR_RANGE(0, 1, 2, 3) },
    { &uses[3], RG_NONE, GLOBALS },
    { &uses[4], RG_NONE, COUNTERS },
    { &uses[5], RG_NONE, SUMS },
    { &uses[6], RG_NONE, RESULT },
};

static const struct rg_barrier barriers[] = {
    {
        .image = SCENE,
        .buffer = RG_NONE,
        .dst_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
        .dst_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
        .new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .range = COLOR_RANGE(0, 1, 0, 1),
    },
    {
        .image = RESOLVED,
        .buffer = RG_NONE,
        .src_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
        .src_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
        .dst_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
        .dst_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
        .old_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        .range = COLOR_RANGE(1, 1, 0, 2),
    },
    {
        .image = DEPTH,
        .buffer = RG_NONE,
        .src_stages = VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        .src_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        .dst_stages = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                      VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        .dst_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | 1ull << 60, /* unnamed */
        .old_layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        .new_layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
        .range = { VK_IMAGE_ASPECT_STENCIL_BIT, 0, 1, 0, 1 },
    },
    {
        .image = RG_NONE,
        .buffer = RESULT,
        .src_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .src_access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dst_stages = VK_PIPELINE_STAGE_2_HOST_BIT,
        .dst_access = VK_ACCESS_2_HOST_READ_BIT,
    },
    {
        .image = HISTORY,
        .buffer = RG_NONE,
        .src_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .src_access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dst_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dst_access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        .old_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        .new_layout = VK_IMAGE_LAYOUT_GENERAL,
        .range = COLOR_RANGE(0, 1, 0, 1),
    },
};

static const struct rg_block blocks[] = {
    { .size = 6144, .alignment = 256, .type_bits = 1 },
    { .size = 1000, .alignment = 256, .type_bits = 1, .buffers = true },
};

static const struct rg_plan_image images[DUMP_PLAN_IMAGES] = {
    [SCENE] = { .samples = 4, .last = 0, .size = 4096 },
    [DEPTH] = { .samples = 4, .last = 2, .offset = 4096, .size = 1024 },
    [RESOLVED] = { .layers = 2, .mips = 3, .last = 1, .offset = 5120, .size = 1024 },
    [HISTORY] = { .persistent = true, .first = 1, .last = 1, .block = RG_NONE, .size = 8192 },
    [SHOWN] = { .imported = true, .first = 2, .last = 4, .block = RG_NONE },
    [FIELD] = { .layers = 6, .first = 1, .last = 1, .size = 3000 },
};

static const struct rg_plan_buffer buffers[DUMP_PLAN_BUFFERS] = {
    [SUMS] = { .size = 999, .last = 3, .block = 1, .memory_size = 1000 },
    [COUNTERS] = { .size = 16,
                   .persistent = true,
                   .first = 1,
                   .last = 1,
                   .block = RG_NONE,
                   .memory_size = 256 },
    [GLOBALS] = { .size = 128, .last = 2, .block = RG_NONE },
    [RESULT] = { .size = 999, .first = 3, .last = 4, .block = RG_NONE },
    [GIVEN] = { .size = 64, .imported = true, .first = 2, .last = 2, .block = RG_NONE },
};

#define TARGET(...) \
    { \
        .resolve = RG_NONE, __VA_ARGS__ \
    }

static const struct rg_plan_pass passes[DUMP_PLAN_PASSES] = {
    {
        .extent = { 64, 48 },
        .barrier_count = 1,
        .color_count = 1,
        .color =
            (const struct rg_plan_target[]){
                { SCENE, .load = VK_ATTACHMENT_LOAD_OP_CLEAR,
                  .store = VK_ATTACHMENT_STORE_OP_DONT_CARE, .resolve = RESOLVED, .resolve_mip = 1,
                  .resolve_layer = 1 },
            },
        .depth = TARGET(.image = DEPTH, .load = VK_ATTACHMENT_LOAD_OP_DONT_CARE),
    },
    {
        .row = 1,
        .extent = { 32, 24 },
        .first_barrier = 1,
        .barrier_count = 1,
        .depth = TARGET(.image = RG_NONE),
        .use_count = 5,
    },
    {
        .repetition = 1,
        .extent = { 64, 48 },
        .first_barrier = 2,
        .barrier_count = 1,
        .color_count = 1,
        .color =
            (const struct rg_plan_target[]){
                TARGET(.image = SHOWN, .load = VK_ATTACHMENT_LOAD_OP_LOAD),
            },
        .depth = TARGET(.image = DEPTH, .store = VK_ATTACHMENT_STORE_OP_NONE),
    },
    {
        .row = 1,
        .extent = { 64, 48 },
        .depth = TARGET(.image = RG_NONE),
        .first_use = 5,
        .use_count = 2,
    },
};

static void init_rows(struct dump_plan *p, const char *const *names)
{
    const char *const *buffer_names = names + DUMP_PLAN_IMAGES;
    const char *const *pass_names = buffer_names + DUMP_PLAN_BUFFERS;
    for (uint32_t i = 0; i < DUMP_PLAN_IMAGES; i++) {
        p->image_rows[i].name = names[i];
        p->image_rows[i].format =
            i == DEPTH ? VK_FORMAT_D24_UNORM_S8_UINT : VK_FORMAT_R8G8B8A8_UNORM;
    }
    p->image_rows[FIELD].cube = true;
    p->image_rows[HISTORY].depth = 5;
    for (uint32_t i = 0; i < DUMP_PLAN_BUFFERS; i++)
        p->buffer_rows[i].name = buffer_names[i];
    p->buffer_rows[GLOBALS].memory = RG_MEMORY_UPLOAD;
    p->buffer_rows[RESULT].memory = RG_MEMORY_READBACK;
    for (uint32_t i = 0; i < DUMP_PLAN_PASSES; i++)
        p->pass_rows[i].name = pass_names[i];
    p->pass_rows[1].kind = RG_COMPUTE;
    p->pass_rows[1].when = never;
    p->pass_rows[1].set = &own;
    p->pass_rows[2].repeat = RG_PER_LAYER;
    p->pass_rows[2].depth_read_only = true;
    p->pass_rows[3].kind = RG_TRANSFER;
    p->techniques[0].name = names[0];
    p->techniques[1].name = names[1];
}

static void init_plan(struct rg_plan *plan)
{
    *plan = (struct rg_plan){
        .view = { 64, 48 },
        .pass_count = DUMP_PLAN_PASSES,
        .image_count = DUMP_PLAN_IMAGES,
        .buffer_count = DUMP_PLAN_BUFFERS,
        .barrier_count = sizeof(barriers) / sizeof(barriers[0]) - 1, /* the last is initial */
        .use_count = sizeof(plan_uses) / sizeof(plan_uses[0]),
        .block_count = sizeof(blocks) / sizeof(blocks[0]),
        .culled_count = 2,
        .batch_count = 4,
        .barriers = barriers,
        .first_final_barrier = 3,
        .final_barrier_count = 1,
        .first_initial_barrier = 4,
        .initial_barrier_count = 1,
        .uses = plan_uses,
        .blocks = blocks,
        .memory_used = 7144,
        .memory_without_aliasing = 10144,
        .memory_bound = 7000,
        .memory_persistent = 8448,
    };
}

void dump_plan_init(struct dump_plan *p, const char *const names[DUMP_PLAN_NAMES])
{
    *p = (struct dump_plan){ 0 };
    init_rows(p, names);
    init_plan(&p->plan);
    memcpy(p->images, images, sizeof(images));
    for (uint32_t i = 0; i < DUMP_PLAN_IMAGES; i++) {
        struct rg_plan_image *image = &p->images[i];
        image->partner = RG_NONE;
        image->image = &p->image_rows[i];
        image->extent = (VkExtent2D){ 64, 48 };
        image->depth = i == HISTORY ? 5 : 1;
        image->layers += !image->layers;
        image->mips += !image->mips;
        image->samples += !image->samples;
        image->aspects = rg_format_info(image->image->format)->aspects;
        image->usage = i == DEPTH   ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                       : i == FIELD ? VK_IMAGE_USAGE_STORAGE_BIT
                                    : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    }
    memcpy(p->buffers, buffers, sizeof(buffers));
    for (uint32_t i = 0; i < DUMP_PLAN_BUFFERS; i++)
        p->buffers[i].buffer = &p->buffer_rows[i];
    memcpy(p->passes, passes, sizeof(passes));
    for (uint32_t i = 0; i < DUMP_PLAN_PASSES; i++) {
        p->passes[i].pass = &p->pass_rows[i];
        p->passes[i].technique = &p->techniques[i / 2];
    }
    p->culled[0] = (struct rg_culled){ &p->pass_rows[0], 0 };
    p->culled[1] = (struct rg_culled){ &p->pass_rows[2], 0 };
    p->plan.images = p->images;
    p->plan.buffers = p->buffers;
    p->plan.passes = p->passes;
    p->plan.culled = p->culled;
}

static const struct rg_fault faults[DUMP_PLAN_FAULTS] = {
    {
        .error = RG_ERROR_READ_BEFORE_WRITE,
        .technique = "<tech> \"&\" \xff",
        .pass = "pass",
        .resource = "image",
        .row = 7,
        .hint = "write it first",
    },
    { .error = RG_ERROR_NO_OUTPUT, .row = RG_NONE, .hint = "ask for one" },
};

const struct rg_plan dump_plan_faults = { .faults = faults, .fault_count = DUMP_PLAN_FAULTS };
