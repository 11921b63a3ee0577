/* The checker of plans judges a plan written by hand, with history, a condition and a resolve. */
#include <stdio.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/hazard_checker.h"

enum {
    SIZE = 16, /* texels of the view */
    BYTES = 4 * SIZE * SIZE,
    MANY_BYTES = 4 * BYTES,
    BLOCK_BYTES = MANY_BYTES + BYTES,
};

#define SHADERS \
    (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | \
     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)
#define FRAGMENT       VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT
#define TRANSFER       VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT
#define COLOR          VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT
#define SAMPLED        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT
#define TRANSFER_READ  VK_ACCESS_2_TRANSFER_READ_BIT
#define TRANSFER_WRITE VK_ACCESS_2_TRANSFER_WRITE_BIT
#define COLOR_WRITE    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT
#define NEW            VK_IMAGE_LAYOUT_UNDEFINED
#define AS_COLOR       VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
#define AS_TEXTURE     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
#define AS_SOURCE      VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
#define AS_TARGET      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL
#define ALL \
    { \
        VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 \
    }

/* "draw" mixes the picture before ("past") into many samples, which are resolved into "now"; "keep"
 * makes that the past, if it runs. The light comes from outside, larger than declared. */
static const struct rg_image many = {
    .name = "many",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
    .samples = 4,
};
static const struct rg_image now = { .name = "now", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image past = {
    .name = "past",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
    .persistent = true,
};
static const struct rg_image light = {
    .name = "light",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
    .width = 1,
    .height = 1,
};

static const struct rg_use draw_uses[] = {
    { .image = &past, .access = RG_SAMPLED },
    { .image = &light, .access = RG_SAMPLED, .binding = 1 },
    { 0 },
};
static const struct rg_use keep_uses[] = {
    { .image = &now, .access = RG_COPY_SRC },
    { .image = &past, .access = RG_COPY_DST },
    { 0 },
};

static bool is_kept(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame != NULL;
}

enum {
    DRAW,
    KEEP,
    ROWS,
};

enum {
    MANY,
    NOW,
    PAST,
    LIGHT,
    IMAGES,
};

enum {
    MANY_TO_COLOR,
    NOW_TO_COLOR,
    NOW_TO_SOURCE,
    PAST_TO_TARGET,
    NOW_TO_TEXTURE,
    PAST_TO_TEXTURE,
    INITIAL,
    BARRIERS,
};

/* A plan, and tables that a test may change as well. */
struct by_hand {
    struct rg_compile_params params;
    struct rg_technique technique;
    const struct rg_technique *techniques[1];
    struct rg_pass rows[ROWS];
    struct rg_import import;
    struct rg_output output;
    struct rg_plan plan;
    struct rg_plan_pass passes[ROWS];
    struct rg_plan_target color; /* of DRAW */
    struct rg_plan_image images[IMAGES];
    struct rg_barrier barriers[BARRIERS];
    struct rg_plan_use uses[4];
    struct rg_block block;
};

static const struct by_hand right = {
    .rows = {
        {
            .name = "draw",
            .color = RG_TARGETS({ .image = &many, .load = RG_LOAD_CLEAR, .resolve = &now }),
            .uses = draw_uses,
        },
        { .name = "keep", .kind = RG_TRANSFER, .uses = keep_uses, .when = is_kept },
    },
    .import = { .image = &light, .access = RG_SAMPLED, .extent = { SIZE, 2 }, .layers = 3 },
    .output = { .image = &now, .access = RG_SAMPLED },
    .passes = {
        {
            .row = DRAW, .extent = { SIZE, SIZE }, .first_barrier = 0, .barrier_count = 2,
            .color_count = 1,
            .depth = { .image = RG_NONE }, .first_use = 0, .use_count = 2,
        },
        {
            .row = KEEP, .extent = { SIZE, SIZE }, .first_barrier = 2, .barrier_count = 2,
            .depth = { .image = RG_NONE }, .first_use = 2, .use_count = 2,
        },
    },
    .color = {
        .image = MANY, .load = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .store = VK_ATTACHMENT_STORE_OP_DONT_CARE, .layout = AS_COLOR, .resolve = NOW,
    },
    .images = {
        {
            .image = &many, .extent = { SIZE, SIZE }, .depth = 1, .partner = RG_NONE,
            .layers = 1, .mips = 1, .samples = 4,
            .aspects = VK_IMAGE_ASPECT_COLOR_BIT, .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
            .import = RG_NONE, .first = 0, .last = 0, .offset = 0, .size = MANY_BYTES,
        },
        {
            .image = &now, .extent = { SIZE, SIZE }, .depth = 1, .partner = RG_NONE,
            .layers = 1, .mips = 1, .samples = 1,
            .aspects = VK_IMAGE_ASPECT_COLOR_BIT,
            .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                     VK_IMAGE_USAGE_SAMPLED_BIT,
            .import = RG_NONE, .first = 0, .last = 2, .offset = MANY_BYTES, .size = BYTES,
        },
        {
            .image = &past, .extent = { SIZE, SIZE }, .depth = 1, .partner = RG_NONE,
            .layers = 1, .mips = 1, .samples = 1,
            .aspects = VK_IMAGE_ASPECT_COLOR_BIT,
            .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
            .persistent = true, .import = RG_NONE, .first = 0, .last = 1, .block = RG_NONE,
            .size = BYTES,
        },
        {
            .image = &light, .extent = { SIZE, 2 }, .depth = 1, .partner = RG_NONE,
            .layers = 3, .mips = 1, .samples = 1,
            .aspects = VK_IMAGE_ASPECT_COLOR_BIT, .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
            .imported = true, .first = 0, .last = 0, .block = RG_NONE,
        },
    },
    .block = { BLOCK_BYTES, 256, 1, false },
    .uses = {
        { &draw_uses[0], PAST, RG_NONE, ALL, AS_TEXTURE },
        { &draw_uses[1], LIGHT, RG_NONE, { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 3 }, AS_TEXTURE },
        { &keep_uses[0], NOW, RG_NONE, ALL, AS_SOURCE },
        { &keep_uses[1], PAST, RG_NONE, ALL, AS_TARGET },
    },
    .barriers = {
        [MANY_TO_COLOR] = { MANY, RG_NONE, COLOR, COLOR, COLOR_WRITE, COLOR_WRITE, NEW, AS_COLOR,
                            ALL },
        [NOW_TO_COLOR] = { NOW, RG_NONE, SHADERS, COLOR, 0, COLOR_WRITE, NEW, AS_COLOR, ALL },
        [NOW_TO_SOURCE] = { NOW, RG_NONE, COLOR, TRANSFER, COLOR_WRITE, TRANSFER_READ, AS_COLOR,
                            AS_SOURCE, ALL },
        [PAST_TO_TARGET] = { PAST, RG_NONE, FRAGMENT, TRANSFER, 0, TRANSFER_WRITE, AS_TEXTURE,
                             AS_TARGET, ALL },
        [NOW_TO_TEXTURE] = { NOW, RG_NONE, TRANSFER, SHADERS, 0, SAMPLED, AS_SOURCE, AS_TEXTURE,
                             ALL },
        [PAST_TO_TEXTURE] = { PAST, RG_NONE, TRANSFER, FRAGMENT, TRANSFER_WRITE, SAMPLED,
                              AS_TARGET, AS_TEXTURE, ALL },
        [INITIAL] = { PAST, RG_NONE, TRANSFER, FRAGMENT, TRANSFER_WRITE, SAMPLED, AS_TARGET,
                      AS_TEXTURE, ALL },
    },
};

static void join(struct by_hand *b)
{
    b->technique = (struct rg_technique){ "by hand", b->rows, ROWS };
    b->techniques[0] = &b->technique;
    b->params = (struct rg_compile_params){
        .techniques = b->techniques,
        .technique_count = 1,
        .view = { SIZE, SIZE },
        .outputs = &b->output,
        .output_count = 1,
        .imports = &b->import,
        .import_count = 1,
    };
    for (uint32_t i = 0; i < ROWS; i++) {
        b->passes[i].pass = &b->rows[i];
        b->passes[i].technique = &b->technique;
    }
    b->passes[DRAW].color = &b->color;
    b->plan = (struct rg_plan){
        .view = { SIZE, SIZE },
        .pass_count = ROWS,
        .image_count = IMAGES,
        .barrier_count = INITIAL,
        .use_count = 4,
        .block_count = 1,
        .batch_count = 3,
        .passes = b->passes,
        .images = b->images,
        .barriers = b->barriers,
        .first_final_barrier = NOW_TO_TEXTURE,
        .final_barrier_count = 2,
        .first_initial_barrier = INITIAL,
        .initial_barrier_count = 1,
        .uses = b->uses,
        .blocks = &b->block,
        .memory_used = BLOCK_BYTES,
        .memory_without_aliasing = BLOCK_BYTES,
        .memory_bound = BLOCK_BYTES,
        .memory_persistent = BYTES,
    };
}

static void test_right_frames(void **state)
{
    (void)state;
    struct by_hand b = right;
    join(&b);
    assert_int_equal(hazard_check(&b.plan, &b.params, stdout), 0);
    b.rows[KEEP].when = NULL;
    assert_int_equal(hazard_check(&b.plan, &b.params, stdout), 0);
    /* now nothing is lost by forgetting what will be overwritten */
    b.barriers[PAST_TO_TARGET].old_layout = NEW;
    assert_int_equal(hazard_check(&b.plan, &b.params, stdout), 0);
}

/* ---- one thing wrong each ---- */

#define CHECK_WRONG(change) \
    do { \
        struct by_hand b = right; \
        join(&b); \
        change; \
        if (hazard_check(&b.plan, &b.params, NULL) == 0) \
            fail_msg("%s was accepted", #change); \
    } while (false)

static void test_wrong_frames(void **state)
{
    (void)state;
    CHECK_WRONG(b.plan.initial_barrier_count = 0);
    CHECK_WRONG(b.barriers[INITIAL].image = NOW);
    CHECK_WRONG(b.barriers[INITIAL].src_access = 0);
    CHECK_WRONG(b.barriers[INITIAL].new_layout = AS_SOURCE);
    CHECK_WRONG(b.barriers[PAST_TO_TARGET].old_layout = NEW);
    CHECK_WRONG(b.plan.final_barrier_count = 1);
    CHECK_WRONG(b.barriers[PAST_TO_TARGET].src_stages = TRANSFER);
    CHECK_WRONG(b.barriers[PAST_TO_TEXTURE].dst_access = 0);
    CHECK_WRONG(b.barriers[NOW_TO_SOURCE].src_access = 0);
    CHECK_WRONG(b.barriers[MANY_TO_COLOR].src_access = 0);
    CHECK_WRONG(b.color.resolve = RG_NONE);
    CHECK_WRONG(b.color.resolve = PAST);
    CHECK_WRONG(b.images[MANY].samples = 1);
    CHECK_WRONG(b.images[PAST].block = 0);
    CHECK_WRONG(b.images[PAST].persistent = false);
    CHECK_WRONG(b.images[PAST].usage &= ~(VkImageUsageFlags)VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    CHECK_WRONG(b.plan.memory_persistent = 0);
    CHECK_WRONG(b.images[LIGHT].extent.width = 1);
    CHECK_WRONG(b.uses[1].range.layerCount = 1);
    CHECK_WRONG(b.plan.memory_bound += BYTES);
    /* with the initial one, which does not count */
    CHECK_WRONG(b.plan.batch_count = 4);
    /* then "now" is not there when its condition is not */
    CHECK_WRONG(b.rows[DRAW].when = is_kept);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_right_frames),
        cmocka_unit_test(test_wrong_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
