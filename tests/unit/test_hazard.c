/* The checker of plans judges a plan written by hand: its barriers and memory. */
#include "tests/support/hazard_checker.h"

#include <stdio.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"

enum {
    SIZE = 16, /* texels, of the hand-written images */
    BYTES = 4 * SIZE * SIZE,
};

#define SHADERS \
    (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | \
     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)
#define SAMPLED  VK_ACCESS_2_SHADER_SAMPLED_READ_BIT
#define READ     VK_ACCESS_2_SHADER_STORAGE_READ_BIT
#define WRITE    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT
#define COMPUTE  VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT
#define FRAGMENT VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT
#define TRANSFER VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT
#define COLOR    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT
#define ALL \
    { \
        VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 \
    }

/* ---- by hand: an image is computed, copied to a second, and drawn from it into a third, which
 * lies where the first was ---- */

static const struct rg_image first = { .name = "first", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image second = { .name = "second", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image third = { .name = "third", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_buffer sums = { .name = "sums", .size = 64 };

static const struct rg_use compute_uses[] = {
    { .image = &first, .access = RG_STORAGE_WRITE },
    { .buffer = &sums, .access = RG_STORAGE_WRITE, .binding = 1 },
    { 0 },
};
static const struct rg_use copy_uses[] = {
    { .image = &first, .access = RG_COPY_SRC },
    { .image = &second, .access = RG_COPY_DST },
    { 0 },
};
static const struct rg_use draw_uses[] = {
    { .image = &second, .access = RG_SAMPLED },
    { 0 },
};

static const struct rg_pass rows[] = {
    { .name = "compute", .kind = RG_COMPUTE, .uses = compute_uses },
    { .name = "copy", .kind = RG_TRANSFER, .uses = copy_uses },
    { .name = "draw", .color = RG_TARGETS({ &third, RG_LOAD_CLEAR }), .uses = draw_uses },
};

static const struct rg_technique technique = RG_TECHNIQUE("by hand", rows);
static const struct rg_technique *const techniques[] = { &technique };

static const struct rg_output outputs[] = {
    { .image = &third, .access = RG_SAMPLED },
    { .buffer = &sums, .access = RG_STORAGE_READ },
};

static const struct rg_compile_params params = {
    .techniques = techniques,
    .technique_count = 1,
    .view = { SIZE, SIZE },
    .outputs = outputs,
    .output_count = 2,
};

struct by_hand {
    struct rg_plan plan;
    struct rg_plan_pass passes[3];
    struct rg_plan_target color; /* of the last pass */
    struct rg_plan_image images[3];
    struct rg_plan_buffer buffers[1];
    struct rg_barrier barriers[8];
    struct rg_plan_use uses[5];
    struct rg_block blocks[2];
};

static const struct by_hand right = {
    .passes = {
        {
            .pass = &rows[0], .technique = &technique, .row = 0, .extent = { SIZE, SIZE },
            .first_barrier = 0, .barrier_count = 2, .depth = { .image = RG_NONE },
            .first_use = 0, .use_count = 2,
        },
        {
            .pass = &rows[1], .technique = &technique, .row = 1, .extent = { SIZE, SIZE },
            .first_barrier = 2, .barrier_count = 2, .depth = { .image = RG_NONE },
            .first_use = 2, .use_count = 2,
        },
        {
            .pass = &rows[2], .technique = &technique, .row = 2, .extent = { SIZE, SIZE },
            .first_barrier = 4, .barrier_count = 2, .depth = { .image = RG_NONE },
            .color_count = 1,
            .first_use = 4, .use_count = 1,
        },
    },
    .color = {
        .image = 2, .load = VK_ATTACHMENT_LOAD_OP_CLEAR, .store = VK_ATTACHMENT_STORE_OP_STORE,
        .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, .resolve = RG_NONE,
    },
    .images = {
        {
            .image = &first, .extent = { SIZE, SIZE }, .depth = 1, .partner = RG_NONE,
            .layers = 1, .mips = 1, .samples = 1,
            .aspects = VK_IMAGE_ASPECT_COLOR_BIT,
            .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
            .import = RG_NONE, .first = 0, .last = 1, .offset = 0, .size = BYTES,
        },
        {
            .image = &second, .extent = { SIZE, SIZE }, .depth = 1, .partner = RG_NONE,
            .layers = 1, .mips = 1, .samples = 1,
            .aspects = VK_IMAGE_ASPECT_COLOR_BIT,
            .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
            .import = RG_NONE, .first = 1, .last = 2, .offset = BYTES, .size = BYTES,
        },
        {
            .image = &third, .extent = { SIZE, SIZE }, .depth = 1, .partner = RG_NONE,
            .layers = 1, .mips = 1, .samples = 1,
            .aspects = VK_IMAGE_ASPECT_COLOR_BIT,
            .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
            .import = RG_NONE, .first = 2, .last = 3, .offset = 0, .size = BYTES,
        },
    },
    .buffers = {
        {
            .buffer = &sums, .size = 64, .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            .import = RG_NONE, .first = 0, .last = 3, .block = 1, .memory_size = 64,
        },
    },
    .blocks = { { BYTES + BYTES, 256, 1, false }, { 64, 256, 1, true } },
    .uses = {
        { &compute_uses[0], 0, RG_NONE, ALL, VK_IMAGE_LAYOUT_GENERAL },
        { &compute_uses[1], RG_NONE, 0, { 0 }, VK_IMAGE_LAYOUT_UNDEFINED },
        { &copy_uses[0], 0, RG_NONE, ALL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL },
        { &copy_uses[1], 1, RG_NONE, ALL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL },
        { &draw_uses[0], 1, RG_NONE, ALL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL },
    },
    .barriers = {
        /* The last frame's copy of "first" is ordered by a chain: before the drawing of "third"
         * (barrier 5), which is before the shaders that read it (barrier 6). */
        { 0, RG_NONE, SHADERS, COMPUTE, 0, WRITE, VK_IMAGE_LAYOUT_UNDEFINED,
          VK_IMAGE_LAYOUT_GENERAL, ALL },
        { RG_NONE, 0, SHADERS, COMPUTE, 0, WRITE, 0, 0, { 0 } },
        { 0, RG_NONE, COMPUTE, TRANSFER, WRITE, VK_ACCESS_2_TRANSFER_READ_BIT,
          VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, ALL },
        { 1, RG_NONE, FRAGMENT, TRANSFER, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT,
          VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, ALL },
        { 1, RG_NONE, TRANSFER, FRAGMENT, VK_ACCESS_2_TRANSFER_WRITE_BIT, SAMPLED,
          VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, ALL },
        { 2, RG_NONE, SHADERS | TRANSFER, COLOR, 0, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
          VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, ALL },
        { 2, RG_NONE, COLOR, SHADERS, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, SAMPLED,
          VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, ALL },
        { RG_NONE, 0, COMPUTE, SHADERS, WRITE, READ, 0, 0, { 0 } },
    },
};

static void join(struct by_hand *plan)
{
    plan->passes[2].color = &plan->color;
    plan->plan = (struct rg_plan){
        .view = { SIZE, SIZE },
        .pass_count = 3,
        .image_count = 3,
        .buffer_count = 1,
        .barrier_count = 8,
        .use_count = 5,
        .block_count = 2,
        .passes = plan->passes,
        .images = plan->images,
        .buffers = plan->buffers,
        .barriers = plan->barriers,
        .first_final_barrier = 6,
        .final_barrier_count = 2,
        .first_initial_barrier = 8,
        .uses = plan->uses,
        .blocks = plan->blocks,
        .batch_count = 4,
        .memory_used = BYTES + BYTES + 64,
        .memory_without_aliasing = 3 * BYTES + 64,
        .memory_bound = BYTES + BYTES + 64,
    };
}

static void test_right_by_hand(void **state)
{
    (void)state;
    struct by_hand plan = right;
    join(&plan);
    assert_int_equal(hazard_check(&plan.plan, &params, stdout), 0);
    /* last frame's readers of "third" are ordered by a chain: barriers 0, 2 and 5 */
    plan.barriers[5].src_stages = TRANSFER;
    assert_int_equal(hazard_check(&plan.plan, &params, stdout), 0);
    plan.barriers[2].dst_stages = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT |
                                  VK_PIPELINE_STAGE_2_RESOLVE_BIT;
    plan.barriers[5].src_stages = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    assert_int_not_equal(hazard_check(&plan.plan, &params, NULL), 0);
}

/* Barriers that do more than they must, in other words. */
static void test_right_with_wide_masks(void **state)
{
    (void)state;
    struct by_hand plan = right;
    join(&plan);
    for (uint32_t i = 0; i < 8; i++) {
        plan.barriers[i].src_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        plan.barriers[i].dst_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        plan.barriers[i].src_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
        plan.barriers[i].dst_access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    }
    assert_int_equal(hazard_check(&plan.plan, &params, stdout), 0);
    plan.barriers[2].src_stages = VK_PIPELINE_STAGE_2_BOTTOM_OF_PIPE_BIT;
    plan.barriers[2].src_access = VK_ACCESS_2_NONE;
    assert_int_not_equal(hazard_check(&plan.plan, &params, NULL), 0);
}

/* Masks that miss one thing each; what that is, is said beside them. */
static void test_wrong_masks_by_hand(void **state)
{
    (void)state;

    static const struct {
        uint32_t barrier;
        VkPipelineStageFlags2 src, dst;
        VkAccessFlags2 src_access, dst_access;
    } wrongs[] = {
        { 5, SHADERS, COLOR, 0, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT }, /* the alias' copy */
        { 0, FRAGMENT, COMPUTE, 0, WRITE }, /* some of last frame's readers of the alias */
        { 3, 0, TRANSFER, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT },         /* last frame's sampling */
        { 3, TRANSFER, TRANSFER, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT },  /* the same */
        { 1, 0, COMPUTE, 0, WRITE },                                   /* last frame's readers */
        { 2, COMPUTE, TRANSFER, 0, VK_ACCESS_2_TRANSFER_READ_BIT },    /* availability */
        { 2, COMPUTE, TRANSFER, READ, VK_ACCESS_2_TRANSFER_READ_BIT }, /* the same */
        { 2, COMPUTE, TRANSFER, WRITE, 0 },                            /* visibility */
        { 2, COMPUTE, FRAGMENT, WRITE, SAMPLED },                      /* the reading stage */
        { 4, TRANSFER, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
          SAMPLED }, /* the stage that samples: only logically later */
        { 6, COLOR, FRAGMENT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, SAMPLED }, /* other shaders */
        { 6, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, SHADERS, 0, SAMPLED },     /* the drawing */
        { 7, COMPUTE, SHADERS, WRITE, SAMPLED },                                 /* storage reads */
        { 7, FRAGMENT, SHADERS, WRITE, READ }, /* the stage that wrote */
        { 7, COMPUTE, SHADERS, WRITE, READ | VK_ACCESS_2_TRANSFER_READ_BIT }, /* impossible */
    };

    for (size_t i = 0; i < sizeof(wrongs) / sizeof(wrongs[0]); i++) {
        struct by_hand plan = right;
        join(&plan);
        struct rg_barrier *barrier = &plan.barriers[wrongs[i].barrier];
        barrier->src_stages = wrongs[i].src;
        barrier->dst_stages = wrongs[i].dst;
        barrier->src_access = wrongs[i].src_access;
        barrier->dst_access = wrongs[i].dst_access;
        if (hazard_check(&plan.plan, &params, NULL) == 0)
            fail_msg("wrong masks %zu were accepted", i);
    }
}

static void test_wrong_memory_by_hand(void **state)
{
    (void)state;
    struct by_hand plan = right;
    join(&plan);
    plan.images[1].offset = 0; /* where "first" is copied from */
    assert_int_not_equal(hazard_check(&plan.plan, &params, NULL), 0);
    plan.images[1].offset = BYTES;
    assert_int_equal(hazard_check(&plan.plan, &params, stdout), 0);
    plan.images[2].offset = BYTES / 2; /* half on "second" */
    assert_int_not_equal(hazard_check(&plan.plan, &params, NULL), 0);

    struct rg_compile_params apart = params;
    apart.sharing = RG_SHARE_NOTHING;
    plan.images[2].offset = 0;
    assert_int_not_equal(hazard_check(&plan.plan, &apart, NULL), 0);
}

#define CHECK_WRONG(change) \
    do { \
        struct by_hand b = right; \
        join(&b); \
        change; \
        if (hazard_check(&b.plan, &params, NULL) == 0) \
            fail_msg("%s was accepted", #change); \
    } while (false)

static void test_wrong_fields(void **state)
{
    (void)state;
    CHECK_WRONG(b.barriers[4].old_layout = VK_IMAGE_LAYOUT_GENERAL);
    CHECK_WRONG(b.barriers[4].new_layout = VK_IMAGE_LAYOUT_GENERAL);
    CHECK_WRONG(b.barriers[6].new_layout = VK_IMAGE_LAYOUT_GENERAL);
    CHECK_WRONG(b.barriers[2].old_layout = VK_IMAGE_LAYOUT_UNDEFINED);
    CHECK_WRONG(b.passes[1].barrier_count = 1);
    CHECK_WRONG(b.passes[2].extent.width = SIZE / 2);
    CHECK_WRONG(b.passes[1].use_count = 1);
    CHECK_WRONG(b.plan.pass_count = 2);
    CHECK_WRONG(b.color.store = VK_ATTACHMENT_STORE_OP_DONT_CARE);
    CHECK_WRONG(b.color.load = VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    CHECK_WRONG(b.color.layout = VK_IMAGE_LAYOUT_GENERAL);
    CHECK_WRONG(b.uses[4].layout = VK_IMAGE_LAYOUT_GENERAL);
    CHECK_WRONG(b.images[0].usage = VK_IMAGE_USAGE_STORAGE_BIT);
    CHECK_WRONG(b.images[0].usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    CHECK_WRONG(b.images[1].layers = 2);
    CHECK_WRONG(b.images[1].samples = 4);
    CHECK_WRONG(b.images[1].persistent = true);
    CHECK_WRONG(b.images[1].partner = 0);
    CHECK_WRONG(b.images[1].last = 1);
    CHECK_WRONG(b.images[1].offset = 2 * BYTES); /* beyond the block */
    CHECK_WRONG(b.buffers[0].usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    CHECK_WRONG(b.buffers[0].size = 32);
    CHECK_WRONG(b.blocks[0].type_bits = 2);
    CHECK_WRONG(b.blocks[0].alignment = 1);
    CHECK_WRONG(b.plan.batch_count = 5);
    CHECK_WRONG(b.plan.memory_used += 64);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_right_by_hand),       cmocka_unit_test(test_right_with_wide_masks),
        cmocka_unit_test(test_wrong_masks_by_hand), cmocka_unit_test(test_wrong_memory_by_hand),
        cmocka_unit_test(test_wrong_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
