/* The barriers of small graphs, worked out by hand: stages, accesses and layouts. */
#include <stdio.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/small_graph.h"

#define ANY_SHADER \
    (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | \
     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)
#define TESTS \
    (VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT)
#define FRAGMENT      VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT
#define DRAWING       (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | FRAGMENT)
#define COMPUTE_STAGE VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT
#define COLOR_STAGE   VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT
#define TRANSFER      VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT
#define ALL_COMMANDS  VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT
#define COLOR_READ    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT
#define COLOR_WRITE   VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT
#define DEPTH_READS   VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT
#define DEPTH_WRITES  VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT
#define SAMPLED_READ  VK_ACCESS_2_SHADER_SAMPLED_READ_BIT
#define STORAGE_WRITE VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT
#define NEW           VK_IMAGE_LAYOUT_UNDEFINED
#define AS_COLOR      VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
#define AS_TEXTURE    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
#define AS_STORAGE    VK_IMAGE_LAYOUT_GENERAL
#define AS_DEPTH      VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
#define AS_DEPTH_READ VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL

static const struct rg_image a = IMAGE(.name = "a");
static const struct rg_image b = IMAGE(.name = "b");
static const struct rg_image c = IMAGE(.name = "c");
static const struct rg_image d = IMAGE(.name = "d");
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_buffer bytes = { .name = "bytes", .size = 64 };

/* The barriers before a pass, or after all, are as many as these and the same, in any order. */
static void check_barriers(const struct rg_plan *plan, uint32_t pass,
                           const struct rg_barrier *expected, uint32_t count)
{
    bool end = pass == plan->pass_count;
    uint32_t first = end ? plan->first_final_barrier : plan->passes[pass].first_barrier;
    assert_int_equal(end ? plan->final_barrier_count : plan->passes[pass].barrier_count, count);
    for (uint32_t e = 0; e < count; e++) {
        const struct rg_barrier *want = &expected[e];
        bool found = false;
        for (uint32_t i = first; i < first + count; i++) {
            const struct rg_barrier *have = &plan->barriers[i];
            found = found ||
                    (have->image == want->image && have->buffer == want->buffer &&
                     have->src_stages == want->src_stages && have->src_access == want->src_access &&
                     have->dst_stages == want->dst_stages && have->dst_access == want->dst_access &&
                     have->old_layout == want->old_layout && have->new_layout == want->new_layout);
        }
        if (!found) {
            print_error("barrier %u before pass %u is not in this plan:\n", e, pass);
            rg_dump(plan, stderr);
        }
        assert_true(found);
    }
}

#define CHECK_BARRIERS(plan, pass, ...) \
    check_barriers(plan, pass, (const struct rg_barrier[]){ __VA_ARGS__ }, \
                   sizeof((const struct rg_barrier[]){ __VA_ARGS__ }) / sizeof(struct rg_barrier))

/* Of an image, from stages, access and layout to others. */
#define MOVE(of, ...) move(plan, &(of), (struct rg_barrier){ __VA_ARGS__ })

static struct rg_barrier move(const struct rg_plan *plan, const struct rg_image *image,
                              struct rg_barrier barrier)
{
    barrier.image = small_graph_find(plan, image);
    barrier.buffer = RG_NONE;
    return barrier;
}

#define FROM(stages, access, layout) \
    .src_stages = (stages), .src_access = (access), .old_layout = (layout)
#define TO(stages, access, layout) \
    .dst_stages = (stages), .dst_access = (access), .new_layout = (layout)

static void test_barriers_of_drawing(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("to a", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
        DRAW("over b", .color = RG_TARGETS({ &b })),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(b) });
    /* both wait for who used them last in the frame before */
    CHECK_BARRIERS(plan, 0,
                   MOVE(a, FROM(FRAGMENT, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    CHECK_BARRIERS(
        plan, 1,
        MOVE(a, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR), TO(FRAGMENT, SAMPLED_READ, AS_TEXTURE)),
        MOVE(b, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    CHECK_BARRIERS(plan, 2,
                   MOVE(b, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR),
                        TO(COLOR_STAGE, COLOR_READ | COLOR_WRITE, AS_COLOR)));
    CHECK_BARRIERS(plan, 3,
                   MOVE(b, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR),
                        TO(ANY_SHADER, SAMPLED_READ, AS_TEXTURE)));
    assert_int_equal(plan->batch_count, 4);
    assert_int_equal(plan->barrier_count, 5);
    rg_plan_destroy(plan);
}

/* Old content is not kept: it may lie in any layout. */
static void test_barriers_of_overwriting(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("to a", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
        DRAW("to a again", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("to c", .color = RG_TARGETS({ CLEARED(c) }), SAMPLING(a)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        .outputs = { { .image = &b, .access = RG_SAMPLED }, { .image = &c, .access = RG_SAMPLED } },
    });
    CHECK_BARRIERS(plan, 2,
                   MOVE(a, FROM(FRAGMENT, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    /* b may wait for the last batch that there is anyway */
    CHECK_BARRIERS(
        plan, 3,
        MOVE(a, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR), TO(FRAGMENT, SAMPLED_READ, AS_TEXTURE)),
        MOVE(b, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR), TO(ANY_SHADER, SAMPLED_READ, AS_TEXTURE)),
        MOVE(c, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    rg_plan_destroy(plan);
}

static void test_barriers_of_depth(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("lay", .depth = { CLEARED(depth) }),
        DRAW("test", .color = RG_TARGETS({ CLEARED(a) }), .depth = { &depth },
             .depth_read_only = true),
        DRAW("fog", .color = RG_TARGETS({ &a }), SAMPLING(depth)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(a) });
    CHECK_BARRIERS(
        plan, 0,
        MOVE(depth, FROM(FRAGMENT, 0, NEW), TO(TESTS, DEPTH_READS | DEPTH_WRITES, AS_DEPTH)));
    CHECK_BARRIERS(
        plan, 1,
        MOVE(depth, FROM(TESTS, DEPTH_WRITES, AS_DEPTH), TO(TESTS, DEPTH_READS, AS_DEPTH_READ)),
        MOVE(a, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    CHECK_BARRIERS(
        plan, 2, MOVE(depth, FROM(TESTS, 0, AS_DEPTH_READ), TO(FRAGMENT, SAMPLED_READ, AS_TEXTURE)),
        MOVE(a, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR),
             TO(COLOR_STAGE, COLOR_READ | COLOR_WRITE, AS_COLOR)));
    rg_plan_destroy(plan);
}

static void test_barriers_of_a_buffer(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        COMPUTE("sum", { .buffer = &bytes, .access = RG_STORAGE_WRITE }),
        DRAW("draw", .color = RG_TARGETS({ CLEARED(a) }),
             .uses = RG_USES({ .buffer = &bytes, .access = RG_VERTEX })),
        COMPUTE("more", { .buffer = &bytes, .access = RG_STORAGE_READ_WRITE }),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        .outputs = { { .image = &a, .access = RG_SAMPLED },
                     { .buffer = &bytes, .access = RG_COPY_SRC } },
    });
#define BYTES_FROM(stages, access) .image = RG_NONE, .src_stages = (stages), .src_access = (access)
#define BYTES_TO(stages, access)   .dst_stages = (stages), .dst_access = (access)
    CHECK_BARRIERS(plan, 0, { BYTES_FROM(TRANSFER, 0), BYTES_TO(COMPUTE_STAGE, STORAGE_WRITE) });
    CHECK_BARRIERS(plan, 1,
                   { BYTES_FROM(COMPUTE_STAGE, STORAGE_WRITE),
                     BYTES_TO(VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
                              VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT) },
                   MOVE(a, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    CHECK_BARRIERS(plan, 2,
                   { BYTES_FROM(VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, 0),
                     BYTES_TO(COMPUTE_STAGE, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | STORAGE_WRITE) },
                   MOVE(a, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR),
                        TO(ANY_SHADER, SAMPLED_READ, AS_TEXTURE)));
    CHECK_BARRIERS(plan, 3,
                   { BYTES_FROM(COMPUTE_STAGE, STORAGE_WRITE),
                     BYTES_TO(TRANSFER, VK_ACCESS_2_TRANSFER_READ_BIT) });
    rg_plan_destroy(plan);
}

static void test_barriers_of_reading_a_buffer(void **state)
{
    (void)state;

    const struct {
        enum rg_access access;
        VkPipelineStageFlags2 stages;
        VkAccessFlags2 mask;
    } rows[] = {
        { RG_VERTEX, VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
          VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT },
        { RG_INDEX, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT },
        { RG_INDIRECT, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
          VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT },
        { RG_UNIFORM, DRAWING, VK_ACCESS_2_UNIFORM_READ_BIT },
        { RG_STORAGE_READ, FRAGMENT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT },
    };

    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_pass passes[] = {
            COMPUTE("sum", { .buffer = &bytes, .access = RG_STORAGE_WRITE }),
            DRAW("draw", .color = RG_TARGETS({ CLEARED(a) }),
                 .uses = RG_USES({ .buffer = &bytes, .access = rows[i].access })),
        };
        struct rg_plan *plan =
            small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(a) });
        CHECK_BARRIERS(
            plan, 1,
            { BYTES_FROM(COMPUTE_STAGE, STORAGE_WRITE), BYTES_TO(rows[i].stages, rows[i].mask) },
            MOVE(a, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
        rg_plan_destroy(plan);
    }
}

static bool never(const struct rg_frame *frame, uint32_t repetition)
{
    (void)frame;
    (void)repetition;
    return false;
}

/* If the only reader does not run, nothing else has waited for the write. */
static void test_a_conditional_reader_leaves_the_write_pending(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        COMPUTE("sum", { .buffer = &bytes, .access = RG_STORAGE_WRITE }),
        DRAW("clear", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("sometimes", .color = RG_TARGETS({ &a }),
             .uses = RG_USES({ .buffer = &bytes, .access = RG_VERTEX }), .when = never),
        COMPUTE("more", { .buffer = &bytes, .access = RG_STORAGE_READ_WRITE }),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        .outputs = { { .image = &a, .access = RG_SAMPLED },
                     { .buffer = &bytes, .access = RG_COPY_SRC } },
    });
    bool is_found = false;
    for (uint32_t i = 0; i < plan->passes[3].barrier_count; i++) {
        const struct rg_barrier *barrier = &plan->barriers[plan->passes[3].first_barrier + i];
        if (barrier->image != RG_NONE)
            continue;
        is_found = true;
        assert_int_equal(barrier->src_stages,
                         COMPUTE_STAGE | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT);
        assert_int_equal(barrier->src_access, STORAGE_WRITE);
    }
    assert_true(is_found);
    rg_plan_destroy(plan);
}

static void test_barriers_of_an_import(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("over", .color = RG_TARGETS({ &a })),
        COMPUTE("compute", { TEXTURE(a) },
                { .image = &b, .access = RG_STORAGE_WRITE, .binding = 1 }),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        .outputs = { { .image = &b, .access = RG_STORAGE_READ } },
        .imports = { { .image = &a, .access = RG_SAMPLED } },
    });
    CHECK_BARRIERS(plan, 0,
                   MOVE(a, FROM(ALL_COMMANDS, 0, AS_TEXTURE),
                        TO(COLOR_STAGE, COLOR_READ | COLOR_WRITE, AS_COLOR)));
    /* and so it goes back as it came, visible to all shaders */
    CHECK_BARRIERS(
        plan, 1,
        MOVE(a, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR), TO(ANY_SHADER, SAMPLED_READ, AS_TEXTURE)),
        MOVE(b, FROM(ANY_SHADER, 0, NEW), TO(COMPUTE_STAGE, STORAGE_WRITE, AS_STORAGE)));
    CHECK_BARRIERS(plan, 2,
                   MOVE(b, FROM(COMPUTE_STAGE, STORAGE_WRITE, AS_STORAGE),
                        TO(ANY_SHADER, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, AS_STORAGE)));
    rg_plan_destroy(plan);
}

static void test_reads_after_reads_are_merged(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("to a", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
        DRAW("to c", .color = RG_TARGETS({ CLEARED(c) }), SAMPLING(a)),
        COMPUTE("to d", { TEXTURE(a) }, { .image = &d, .access = RG_STORAGE_WRITE, .binding = 1 }),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        .outputs = { { .image = &b, .access = RG_SAMPLED },
                     { .image = &c, .access = RG_SAMPLED },
                     { .image = &d, .access = RG_STORAGE_READ } },
    });
    CHECK_BARRIERS(plan, 1,
                   MOVE(a, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR),
                        TO(FRAGMENT | COMPUTE_STAGE, SAMPLED_READ, AS_TEXTURE)),
                   MOVE(b, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)),
                   MOVE(c, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)),
                   MOVE(d, FROM(ANY_SHADER, 0, NEW), TO(COMPUTE_STAGE, STORAGE_WRITE, AS_STORAGE)));
    assert_int_equal(plan->passes[2].barrier_count, 0);
    assert_int_equal(plan->passes[3].barrier_count, 0);
    rg_plan_destroy(plan);
}

/* One barrier covers both reads: it has the stages and accesses of both. */
static void test_different_reads_are_merged(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        COMPUTE("sum", { .buffer = &bytes, .access = RG_STORAGE_WRITE }),
        DRAW("draw", .color = RG_TARGETS({ CLEARED(a) }),
             .uses = RG_USES({ .buffer = &bytes, .access = RG_VERTEX })),
        COMPUTE("read", { .buffer = &bytes, .access = RG_STORAGE_READ },
                { .image = &d, .access = RG_STORAGE_WRITE, .binding = 1 }),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        .outputs = { { .image = &a, .access = RG_SAMPLED },
                     { .image = &d, .access = RG_STORAGE_READ } },
    });
    CHECK_BARRIERS(
        plan, 1,
        { BYTES_FROM(COMPUTE_STAGE, STORAGE_WRITE),
          BYTES_TO(VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT | COMPUTE_STAGE,
                   VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT) },
        MOVE(a, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)),
        MOVE(d, FROM(ANY_SHADER, 0, NEW), TO(COMPUTE_STAGE, STORAGE_WRITE, AS_STORAGE)));
    rg_plan_destroy(plan);
}

/* Who reads it before the frame writes it is served by the frame before, where somebody else reads
 * it anyway. */
static void test_barriers_of_history(void **state)
{
    (void)state;
    static const struct rg_image past = IMAGE(.name = "past", .persistent = true);
    const struct rg_pass passes[] = {
        COMPUTE("from past", { TEXTURE(past) },
                { .image = &a, .access = RG_STORAGE_WRITE, .binding = 1 }),
        DRAW("to past", .color = RG_TARGETS({ CLEARED(past) }), SAMPLING(a)),
        DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(past)),
    };
    struct rg_plan *plan = small_graph_compile(
        &(struct small_graph){ PASSES(passes), WANTS(b), .sharing = RG_SHARE_NOTHING });
    CHECK_BARRIERS(plan, 0,
                   MOVE(a, FROM(FRAGMENT, 0, NEW), TO(COMPUTE_STAGE, STORAGE_WRITE, AS_STORAGE)));
    CHECK_BARRIERS(
        plan, 1,
        MOVE(a, FROM(COMPUTE_STAGE, STORAGE_WRITE, AS_STORAGE),
             TO(FRAGMENT, SAMPLED_READ, AS_TEXTURE)),
        MOVE(past, FROM(FRAGMENT | COMPUTE_STAGE, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    CHECK_BARRIERS(plan, 2,
                   MOVE(past, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR),
                        TO(FRAGMENT | COMPUTE_STAGE, SAMPLED_READ, AS_TEXTURE)),
                   MOVE(b, FROM(ANY_SHADER, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    rg_plan_destroy(plan);
}

static void test_barriers_of_shared_memory(void **state)
{
    (void)state;
    const struct rg_pass relay[] = {
        DRAW("to a", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
        DRAW("to c", .color = RG_TARGETS({ CLEARED(c) }), SAMPLING(b)),
        DRAW("to d", .color = RG_TARGETS({ CLEARED(d) }), SAMPLING(c)),
    };
    for (int sharing = 0; sharing <= RG_SHARE_NOTHING; sharing++) {
        struct rg_plan *plan = small_graph_compile(
            &(struct small_graph){ PASSES(relay), WANTS(d), .sharing = (enum rg_sharing)sharing });
        /* c waits for the last reader of a, whose bytes it may have, and for its own */
        CHECK_BARRIERS(plan, 2,
                       MOVE(b, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR),
                            TO(FRAGMENT, SAMPLED_READ, AS_TEXTURE)),
                       MOVE(c, FROM(FRAGMENT, 0, NEW), TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
        assert_int_equal(plan->batch_count, 5);
        assert_int_equal(plan->memory_used,
                         (sharing == RG_SHARE_NOTHING ? 4 : 2) * SMALL_GRAPH_BYTES);
        rg_plan_destroy(plan);
    }
}

/* The first use of shared memory waits for depth writes, which no barrier has made available. */
static void test_shared_memory_waits_for_writes(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("to a", .color = RG_TARGETS({ CLEARED(a) }), .depth = { CLEARED(depth) }),
        DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(b) });
    CHECK_BARRIERS(
        plan, 1,
        MOVE(a, FROM(COLOR_STAGE, COLOR_WRITE, AS_COLOR), TO(FRAGMENT, SAMPLED_READ, AS_TEXTURE)),
        MOVE(b, FROM(TESTS | ANY_SHADER, DEPTH_WRITES, NEW),
             TO(COLOR_STAGE, COLOR_WRITE, AS_COLOR)));
    rg_plan_destroy(plan);
}

/* Where fewest batches and least memory contradict each other: only c would wait before pass 3. */
static void test_fewest_batches_before_least_memory(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("to a", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
        DRAW("to c", .color = RG_TARGETS({ CLEARED(c) })),
        DRAW("over c", .color = RG_TARGETS({ &c }), SAMPLING(b)),
    };
    struct small_graph graph = { PASSES(passes), WANTS(c) };
    struct rg_plan *plan = small_graph_compile(&graph);
    assert_int_equal(plan->passes[2].barrier_count, 0);
    assert_int_equal(plan->batch_count, 4);
    assert_int_equal(plan->memory_used, 3 * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->memory_bound, 3 * SMALL_GRAPH_BYTES);
    rg_plan_destroy(plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_barriers_of_drawing),
        cmocka_unit_test(test_barriers_of_overwriting),
        cmocka_unit_test(test_barriers_of_depth),
        cmocka_unit_test(test_barriers_of_a_buffer),
        cmocka_unit_test(test_barriers_of_reading_a_buffer),
        cmocka_unit_test(test_a_conditional_reader_leaves_the_write_pending),
        cmocka_unit_test(test_barriers_of_an_import),
        cmocka_unit_test(test_barriers_of_history),
        cmocka_unit_test(test_barriers_of_shared_memory),
        cmocka_unit_test(test_shared_memory_waits_for_writes),
        cmocka_unit_test(test_fewest_batches_before_least_memory),
        cmocka_unit_test(test_reads_after_reads_are_merged),
        cmocka_unit_test(test_different_reads_are_merged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
