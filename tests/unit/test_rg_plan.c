/* What the compiler of plans derives, against small graphs worked out by hand: which passes live,
 * what targets load and store, sizes and memory; and that neither addresses nor lengths matter. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/small_graph.h"

enum {
    MANY_PASSES = 2000,
    MANY_IMAGES = 3000,
    MANY_USES = 100,
};

static const struct rg_image a = IMAGE(.name = "a");
static const struct rg_image b = IMAGE(.name = "b");
static const struct rg_image c = IMAGE(.name = "c");
static const struct rg_image d = IMAGE(.name = "d");
static const struct rg_image pages = IMAGE(.name = "pages", .layers = 4);
static const struct rg_image cube = IMAGE(.name = "cube", .width = 8, .height = 8, .cube = true);
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };

static const struct rg_plan_image *image_of(const struct rg_plan *plan,
                                            const struct rg_image *image)
{
    uint32_t index = small_graph_find(plan, image);
    assert_true(index != RG_NONE);
    return &plan->images[index];
}

static const struct rg_plan_buffer *buffer_of(const struct rg_plan *plan,
                                              const struct rg_buffer *buffer)
{
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        if (plan->buffers[i].buffer == buffer)
            return &plan->buffers[i];
    }
    fail_msg("%s is not in the plan", buffer->name);
    return NULL;
}

/* The plan's passes are these rows, in this order. */
static void check_passes(const struct rg_plan *plan, const char *const *names, uint32_t count)
{
    assert_int_equal(plan->pass_count, count);
    for (uint32_t i = 0; i < count; i++)
        assert_string_equal(plan->passes[i].pass->name, names[i]);
}

#define CHECK_PASSES(plan, ...) \
    check_passes(plan, (const char *const[]){ __VA_ARGS__ }, \
                 sizeof((const char *const[]){ __VA_ARGS__ }) / sizeof(const char *))

/* ---- which passes live ---- */

static void test_culling_is_transitive(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("first", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("unwanted", .color = RG_TARGETS({ CLEARED(c) }), SAMPLING(a)),
        DRAW("unwanted too", .color = RG_TARGETS({ CLEARED(d) }), SAMPLING(c)),
        DRAW("last", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(b) });
    CHECK_PASSES(plan, "first", "last");
    assert_int_equal(plan->culled_count, 2);
    assert_ptr_equal(plan->culled[0].pass, &passes[1]);
    assert_ptr_equal(plan->culled[1].pass, &passes[2]);
    assert_int_equal(plan->image_count, 2);
    rg_plan_destroy(plan);

    plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(d) });
    CHECK_PASSES(plan, "first", "unwanted", "unwanted too");
    rg_plan_destroy(plan);
}

static void test_culling_of_repetitions(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("page", .repeat = RG_PER_LAYER, .color = RG_TARGETS({ CLEARED(pages) })),
        DRAW("last", .color = RG_TARGETS({ CLEARED(a) }),
             .uses = RG_USES({ TEXTURE(pages), .range = { .layer = 1, .layer_count = 2 } })),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(a) });
    CHECK_PASSES(plan, "page", "page", "last");
    assert_int_equal(plan->passes[0].repetition, 1);
    assert_int_equal(plan->passes[1].repetition, 2);
    assert_int_equal(plan->culled_count, 2);
    assert_int_equal(plan->culled[0].repetition, 0);
    assert_int_equal(plan->culled[1].repetition, 3);
    rg_plan_destroy(plan);
}

static void test_overwritten_content_is_not_wanted(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("lost", .color = RG_TARGETS({ CLEARED(a) })),
        DRAW("lost too", .color = RG_TARGETS({ &a }), .cull = VK_CULL_MODE_BACK_BIT),
        DRAW("new", .color = RG_TARGETS({ &a, RG_LOAD_DISCARD })),
        COMPUTE("part", { .image = &a, .access = RG_STORAGE_WRITE, .partial = true }),
        DRAW("over", .color = RG_TARGETS({ &a })),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(a) });
    CHECK_PASSES(plan, "new", "part", "over");
    rg_plan_destroy(plan);
}

/* ---- targets ---- */

static void check_ops(const struct rg_plan_target *target, VkAttachmentLoadOp load,
                      VkAttachmentStoreOp store)
{
    assert_int_equal(target->load, load);
    assert_int_equal(target->store, store);
}

#define LOAD(op)  VK_ATTACHMENT_LOAD_OP_##op
#define STORE(op) VK_ATTACHMENT_STORE_OP_##op

static void test_load_and_store(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("clear", .color = RG_TARGETS({ CLEARED(b) }, { CLEARED(a) }),
             .depth = { CLEARED(depth) }),
        DRAW("keep", .color = RG_TARGETS({ &a }, { &c, RG_LOAD_DISCARD }), .depth = { &depth }),
        DRAW("test", .color = RG_TARGETS({ &a }), .depth = { &depth }, .depth_read_only = true,
             SAMPLING(c)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(a) });
    CHECK_PASSES(plan, "clear", "keep", "test");
    check_ops(&plan->passes[0].color[0], LOAD(CLEAR), STORE(DONT_CARE));
    check_ops(&plan->passes[0].color[1], LOAD(CLEAR), STORE(STORE));
    check_ops(&plan->passes[0].depth, LOAD(CLEAR), STORE(STORE));
    check_ops(&plan->passes[1].color[0], LOAD(LOAD), STORE(STORE));
    check_ops(&plan->passes[1].color[1], LOAD(DONT_CARE), STORE(STORE));
    check_ops(&plan->passes[1].depth, LOAD(LOAD), STORE(STORE));
    check_ops(&plan->passes[2].color[0], LOAD(LOAD), STORE(STORE));
    check_ops(&plan->passes[2].depth, LOAD(LOAD), STORE(NONE));
    assert_int_equal(plan->passes[1].color_count, 2);
    assert_int_equal(plan->passes[1].depth.layout,
                     VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    assert_int_equal(plan->passes[2].depth.layout, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
    rg_plan_destroy(plan);
}

static void test_unneeded_last_targets_are_dropped(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("clear", .color = RG_TARGETS({ CLEARED(a) }, { CLEARED(b) }, { CLEARED(c) }),
             .depth = { CLEARED(depth) }),
        DRAW("keep", .color = RG_TARGETS({ &a }, { &c }, { &b })),
        DRAW("sample", .color = RG_TARGETS({ &a }), SAMPLING(c)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(a) });
    CHECK_PASSES(plan, "clear", "keep", "sample");
    assert_int_equal(plan->passes[0].color_count, 3); /* b comes before c */
    check_ops(&plan->passes[0].color[1], LOAD(CLEAR), STORE(DONT_CARE));
    assert_int_equal(plan->passes[1].color_count, 2);
    rg_plan_destroy(plan);
    plan =
        small_graph_compile(&(struct small_graph){ .passes = passes, .pass_count = 2, WANTS(a) });
    assert_int_equal(plan->passes[0].color_count, 1);
    assert_int_equal(plan->passes[1].color_count, 1);
    assert_int_equal(plan->image_count, 2); /* a and depth */
    check_ops(&plan->passes[0].depth, LOAD(CLEAR), STORE(DONT_CARE));
    rg_plan_destroy(plan);
}

static void test_row_per_face(void **state)
{
    (void)state;
    const struct rg_pass passes[] = {
        DRAW("face", .repeat = RG_PER_LAYER, .color = RG_TARGETS({ CLEARED(cube) })),
        DRAW("last", .color = RG_TARGETS({ CLEARED(a) }), SAMPLING(cube)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(a) });
    assert_int_equal(plan->pass_count, 7);
    for (uint32_t i = 0; i < 6; i++) {
        const struct rg_plan_pass *pass = &plan->passes[i];
        assert_int_equal(pass->repetition, i);
        assert_int_equal(pass->color[0].layer, i);
        assert_int_equal(pass->extent.width, 8);
        assert_int_equal(pass->barrier_count, i ? 0 : 1); /* of all faces */
    }
    assert_int_equal(image_of(plan, &cube)->layers, 6);
    assert_int_equal(image_of(plan, &cube)->flags, VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT);
    const struct rg_plan_pass *last = &plan->passes[6];
    assert_int_equal(last->barrier_count, 2); /* of them, and of `a` */
    assert_int_equal(plan->barriers[last->first_barrier].range.layerCount, 6);
    rg_plan_destroy(plan);
}

static void test_row_per_mip(void **state)
{
    (void)state;
    static const struct rg_image chain =
        IMAGE(.name = "chain", .width = 9, .height = 5, .mips = RG_ALL_MIPS);
    const struct rg_pass passes[] = {
        DRAW("top", .color = RG_TARGETS({ CLEARED(chain) })),
        DRAW("halve", .repeat = RG_PER_MIP, .color = RG_TARGETS({ CLEARED(chain), .mip = 1 }),
             .uses = RG_USES({ TEXTURE(chain), .range = { .mip = 0, .each = true } })),
    };
    static const VkExtent2D sizes[] = { { 9, 5 }, { 4, 2 }, { 2, 1 }, { 1, 1 } };

    struct rg_plan *plan =
        small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(chain) });
    assert_int_equal(plan->pass_count, 4);
    assert_int_equal(image_of(plan, &chain)->mips, 4);
    for (uint32_t i = 0; i < 4; i++) {
        const struct rg_plan_pass *pass = &plan->passes[i];
        assert_int_equal(pass->color[0].mip, i);
        assert_int_equal(pass->extent.width, sizes[i].width);
        assert_int_equal(pass->extent.height, sizes[i].height);
        if (i == 0)
            continue;
        const struct rg_plan_use *use = &plan->uses[pass->first_use];
        assert_int_equal(use->range.baseMipLevel, i - 1);
        assert_int_equal(use->range.levelCount, 1);
    }
    rg_plan_destroy(plan);
}

/* Passes draw mips 2, 1 and 0 from the next smaller mip; mip 3 is drawn before. */
static void test_row_per_mip_upwards(void **state)
{
    (void)state;
    static const struct rg_image chain =
        IMAGE(.name = "chain", .width = 9, .height = 5, .mips = RG_ALL_MIPS);
    const struct rg_pass passes[] = {
        DRAW("bottom", .color = RG_TARGETS({ CLEARED(chain), .mip = 3 })),
        DRAW("double", .repeat = RG_PER_MIP_UP, .color = RG_TARGETS({ CLEARED(chain) }),
             .uses = RG_USES({ TEXTURE(chain), .range = { .mip = 1, .each = true } })),
    };
    struct rg_plan *plan =
        small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(chain) });
    assert_int_equal(plan->pass_count, 4);
    for (uint32_t i = 1; i < 4; i++) {
        const struct rg_plan_pass *pass = &plan->passes[i];
        assert_int_equal(pass->repetition, i - 1);
        assert_int_equal(pass->color[0].mip, 3 - i);
        assert_int_equal(plan->uses[pass->first_use].range.baseMipLevel, 4 - i);
        assert_int_equal(plan->uses[pass->first_use].range.levelCount, 1);
    }
    rg_plan_destroy(plan);
}

/* ---- sizes ---- */

static void check_extent(VkExtent2D view, float scale, uint32_t width, uint32_t height)
{
    const struct rg_image scaled = IMAGE(.name = "scaled", .scale = scale);
    const struct rg_pass passes[] = { DRAW("draw", .color = RG_TARGETS({ CLEARED(scaled) })) };
    struct rg_plan *plan =
        small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(scaled), .view = view });
    assert_int_equal(image_of(plan, &scaled)->extent.width, width);
    assert_int_equal(image_of(plan, &scaled)->extent.height, height);
    assert_int_equal(plan->passes[0].extent.width, width);
    rg_plan_destroy(plan);
}

static void test_sizes_relative_to_the_view(void **state)
{
    (void)state;
    check_extent((VkExtent2D){ 1023, 767 }, 0.0f, 1023, 767);
    check_extent((VkExtent2D){ 1023, 767 }, 0.5f, 512, 384);
    check_extent((VkExtent2D){ 1024, 768 }, 0.5f, 512, 384);
    check_extent((VkExtent2D){ 1023, 767 }, 0.25f, 256, 192);
    check_extent((VkExtent2D){ 3, 1 }, 2.0f, 6, 2);
    check_extent((VkExtent2D){ 1, 1 }, 0.001f, 1, 1);
}

static void test_size_instead_of_the_table_s(void **state)
{
    (void)state;
    static const struct rg_image small = IMAGE(.name = "small", .width = 4, .height = 4);
    const struct rg_pass passes[] = {
        DRAW("draw", .color = RG_TARGETS({ CLEARED(small) })),
        DRAW("over", .color = RG_TARGETS({ CLEARED(a) }), SAMPLING(small)),
    };
    struct rg_plan *plan = small_graph_compile(
        &(struct small_graph){ PASSES(passes), WANTS(a), .sizes = { { &small, { 60, 70 } } } });
    assert_int_equal(plan->passes[0].extent.width, 60);
    assert_int_equal(image_of(plan, &small)->extent.height, 70);
    assert_int_not_equal(image_of(plan, &a)->extent.width, 60);
    rg_plan_destroy(plan);
}

/* Copies bring no more than the part; images are of the view all the same. */
static void test_buffers_of_a_part(void **state)
{
    (void)state;
    static const struct rg_buffer down = { "down", 3, 4, RG_MEMORY_READBACK };
    static const struct rg_image image = { "image", VK_FORMAT_R8_UNORM };
    const struct rg_pass passes[] = {
        COPY("copy", { .image = &image, .access = RG_COPY_SRC },
             { .buffer = &down, .access = RG_COPY_DST }),
    };
    const struct rg_technique technique = RG_TECHNIQUE("test", passes);
    const struct rg_technique *techniques = &technique;
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .techniques = &techniques,
        .technique_count = 1,
        .view = { 7, 5 },
        .sizes = &(struct rg_size){ .buffer = &down, .size = 27 },
        .size_count = 1,
        .outputs = &(struct rg_output){ .buffer = &down, .access = RG_HOST_READ },
        .output_count = 1,
        .imports = &(struct rg_import){ .image = &image, .access = RG_SAMPLED },
        .import_count = 1,
    });
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(buffer_of(plan, &down)->size, 27);
    assert_int_equal(plan->images[0].extent.width, 7);
    rg_plan_destroy(plan);
}

static void test_buffers(void **state)
{
    (void)state;
    static const struct rg_buffer texels = { "texels", .size = 12, .size_per_texel = 8 };
    static const struct rg_buffer up = { "up", 16, 0, RG_MEMORY_UPLOAD };
    static const struct rg_buffer down = { "down", 0, 4, RG_MEMORY_READBACK };
    const struct rg_pass passes[] = {
        COMPUTE("compute", { .buffer = &up, .access = RG_UNIFORM },
                { .buffer = &texels, .access = RG_STORAGE_WRITE, .binding = 1 }),
        COPY("copy", { .buffer = &texels, .access = RG_COPY_SRC },
             { .buffer = &down, .access = RG_COPY_DST }),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        .outputs = { { .buffer = &down, .access = RG_HOST_READ } },
        .view = { 7, 5 },
    });
    assert_int_equal(plan->buffer_count, 3);
    assert_int_equal(buffer_of(plan, &texels)->size, 12 + 8 * 35);
    assert_int_equal(buffer_of(plan, &texels)->usage,
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    assert_int_equal(buffer_of(plan, &texels)->block, 0);
    assert_int_equal(buffer_of(plan, &up)->block, RG_NONE);
    assert_int_equal(buffer_of(plan, &down)->block, RG_NONE);
    assert_int_equal(buffer_of(plan, &down)->last, plan->pass_count);
    assert_int_equal(plan->block_count, 1);
    assert_true(plan->blocks[0].buffers);
    assert_int_equal(plan->memory_used, 12 + 8 * 35);
    rg_plan_destroy(plan);
}

/* An import may be larger than declared, with the chain of mips that its own size has. */
static void test_size_of_an_import(void **state)
{
    (void)state;
    static const struct rg_image photo = IMAGE(.name = "photo", .mips = RG_ALL_MIPS);
    const struct rg_pass passes[] = {
        DRAW("draw", .color = RG_TARGETS({ CLEARED(a) }), SAMPLING(photo)),
    };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        WANTS(a),
        .imports = { { .image = &photo, .access = RG_SAMPLED, .extent = { 300, 4 } } },
    });
    assert_int_equal(image_of(plan, &photo)->mips, 9);
    assert_int_equal(image_of(plan, &photo)->extent.width, 300);
    assert_true(image_of(plan, &photo)->imported);
    assert_int_equal(image_of(plan, &photo)->block, RG_NONE);
    rg_plan_destroy(plan);
}

/* ---- memory ---- */

static const struct rg_pass relay[] = {
    DRAW("to a", .color = RG_TARGETS({ CLEARED(a) })),
    DRAW("to b", .color = RG_TARGETS({ CLEARED(b) }), SAMPLING(a)),
    DRAW("to c", .color = RG_TARGETS({ CLEARED(c) }), SAMPLING(b)),
    DRAW("to d", .color = RG_TARGETS({ CLEARED(d) }), SAMPLING(c)),
};

static void test_disjoint_lives_share_memory(void **state)
{
    (void)state;
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){ PASSES(relay), WANTS(d) });
    assert_int_equal(plan->block_count, 1);
    assert_int_equal(image_of(plan, &a)->size, SMALL_GRAPH_BYTES);
    assert_int_equal(image_of(plan, &a)->offset, image_of(plan, &c)->offset);
    assert_int_equal(image_of(plan, &b)->offset, image_of(plan, &d)->offset);
    assert_true(image_of(plan, &a)->offset != image_of(plan, &b)->offset);
    assert_int_equal(image_of(plan, &c)->first, 2);
    assert_int_equal(image_of(plan, &c)->last, 3);
    assert_int_equal(plan->memory_used, 2 * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->memory_bound, 2 * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->memory_without_aliasing, 4 * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->blocks[0].size, 2 * SMALL_GRAPH_BYTES);
    rg_plan_destroy(plan);
}

static void test_share_nothing(void **state)
{
    (void)state;
    struct rg_plan *plan = small_graph_compile(
        &(struct small_graph){ PASSES(relay), WANTS(d), .sharing = RG_SHARE_NOTHING });
    for (uint32_t i = 0; i < plan->image_count; i++)
        assert_int_equal(plan->images[i].offset, i * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->memory_used, 4 * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->memory_without_aliasing, 4 * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->memory_bound, 2 * SMALL_GRAPH_BYTES);
    rg_plan_destroy(plan);
}

static void test_memory_of_layers_and_mips(void **state)
{
    (void)state;
    static const struct rg_image chain =
        IMAGE(.name = "chain", .width = 8, .height = 8, .mips = RG_ALL_MIPS);
    const struct rg_pass passes[] = {
        DRAW("mip", .repeat = RG_PER_MIP, .color = RG_TARGETS({ CLEARED(chain) })),
        DRAW("face", .repeat = RG_PER_LAYER, .color = RG_TARGETS({ CLEARED(cube) }),
             SAMPLING(chain)),
    };
    struct rg_plan *plan =
        small_graph_compile(&(struct small_graph){ PASSES(passes), WANTS(cube) });
    assert_int_equal(image_of(plan, &chain)->size, 4 * (64 + 16 + 4 + 1));
    assert_int_equal(image_of(plan, &cube)->size, 4 * 64 * 6);
    assert_int_equal(image_of(plan, &chain)->offset, 4 * 64 * 6); /* behind: 340 is not aligned */
    assert_int_equal(plan->memory_used, 4 * 64 * 6 + 340);
    assert_int_equal(plan->memory_bound, 4 * 64 * 6 + 340);
    assert_int_equal(plan->memory_without_aliasing, 4 * 64 * 6 + 512);
    rg_plan_destroy(plan);
}

/* ---- neither addresses nor lengths matter ---- */

enum {
    COPIES = 5
};

/* A relay whose images lie in memory forwards or backwards. */
struct tables {
    char names[2][COPIES][8];
    struct rg_image images[COPIES];
    struct rg_use uses[COPIES][2];
    struct rg_pass passes[COPIES];
    struct rg_target targets[COPIES];
};

static struct tables *make_tables(bool backwards)
{
    struct tables *t = calloc(1, sizeof(*t));
    assert_non_null(t);
    for (size_t i = 0; i < COPIES; i++) {
        struct rg_image *image = &t->images[backwards ? COPIES - 1 - i : i];
        snprintf(t->names[0][i], sizeof(t->names[0][i]), "i%zu", i);
        snprintf(t->names[1][i], sizeof(t->names[1][i]), "p%zu", i);
        *image = (struct rg_image)IMAGE(.name = t->names[0][i], .layers = (uint32_t)i + 1);
        t->targets[i] = (struct rg_target){ CLEARED(*image) };
        t->passes[i] = (struct rg_pass)DRAW(t->names[1][i], .color = &t->targets[i],
                                            .color_count = 1, .repeat = RG_PER_LAYER);
        if (i == 0)
            continue;
        t->uses[i][0] = (struct rg_use){ TEXTURE(*t->passes[i - 1].color[0].image) };
        t->passes[i].uses = t->uses[i];
    }
    return t;
}

/* The dump of a plan, twice; the caller frees it. */
static char *dump_tables(const struct tables *t)
{
    struct rg_plan *plan = small_graph_compile(
        &(struct small_graph){ PASSES(t->passes), WANTS(*t->passes[COPIES - 1].color[0].image) });
    char *texts[2];
    for (size_t i = 0; i < 2; i++) {
        size_t size;
        FILE *file = open_memstream(&texts[i], &size);
        assert_non_null(file);
        rg_dump(plan, file);
        fclose(file);
    }
    assert_string_equal(texts[0], texts[1]);
    free(texts[1]);
    rg_plan_destroy(plan);
    return texts[0];
}

static void test_dump_knows_no_addresses(void **state)
{
    (void)state;
    struct tables *forwards = make_tables(false);
    struct tables *backwards = make_tables(true);
    char *first = dump_tables(forwards);
    char *second = dump_tables(backwards);
    assert_string_equal(first, second);
    assert_non_null(
        strstr(first, "\npass 14 p4[4] raster 16x16\n  color i4 layer 4 clear store\n"));
    free(first);
    free(second);
    free(forwards);
    free(backwards);
}

struct many {
    char names[MANY_IMAGES + MANY_PASSES][8];
    struct rg_image images[MANY_IMAGES];
    struct rg_pass passes[MANY_PASSES];
    struct rg_target targets[MANY_PASSES][2];
    struct rg_use uses[MANY_PASSES][2];
    struct rg_use last_uses[MANY_USES + 1];
};

/* Each pass reads an image of the pass before it. Every other pass has an extra first target that
 * nothing reads. The last pass reads MANY_USES images from all over the graph. */
static void make_many(struct many *m)
{
    uint32_t image = 0;
    for (size_t i = 0; i < MANY_IMAGES + MANY_PASSES; i++)
        snprintf(m->names[i], sizeof(m->names[i]), "%zu", i);
    for (size_t i = 0; i < MANY_IMAGES; i++)
        m->images[i] = (struct rg_image)IMAGE(.name = m->names[i]);
    for (size_t i = 0; i < MANY_PASSES; i++) {
        struct rg_pass *pass = &m->passes[i];
        *pass = (struct rg_pass)DRAW(m->names[MANY_IMAGES + i], .color = m->targets[i],
                                     .color_count = 2, .uses = m->uses[i]);
        for (size_t k = 0; k < 1 + i % 2; k++)
            m->targets[i][k] = (struct rg_target){ CLEARED(m->images[image++]) };
        if (i > 0)
            m->uses[i][0] = (struct rg_use){ TEXTURE(*m->passes[i - 1].color[(i - 1) % 2].image) };
    }
    for (size_t i = 0; i < MANY_USES; i++)
        m->last_uses[i] = (struct rg_use){
            TEXTURE(*m->passes[i * (MANY_PASSES / MANY_USES)].color[0].image),
            .binding = (uint16_t)i,
        };
    m->passes[MANY_PASSES - 1].uses = m->last_uses;
    /* its reads leave out the pass before it, which ends a chain of its own */
    m->last_uses[MANY_USES - 1].image = m->passes[MANY_PASSES - 2].color[0].image;
}

static void test_arrays_of_any_length(void **state)
{
    (void)state;
    struct many *m = calloc(1, sizeof(*m));
    assert_non_null(m);
    make_many(m);
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(m->passes), WANTS(*m->passes[MANY_PASSES - 1].color[1].image) });
    assert_int_equal(plan->pass_count, MANY_PASSES);
    assert_int_equal(plan->image_count, MANY_IMAGES);
    assert_int_equal(plan->passes[MANY_PASSES - 1].use_count, MANY_USES);
    assert_int_equal(plan->memory_without_aliasing, MANY_IMAGES * SMALL_GRAPH_BYTES);
    assert_true(plan->memory_used >= plan->memory_bound);
    assert_true(plan->memory_used <= 2 * plan->memory_bound);
    rg_plan_destroy(plan);
    free(m);
}

/* Tables grow while their rows are read, and what is known of the first image moves with them. */
static void test_one_row_names_many_images(void **state)
{
    enum {
        COUNT = 64
    };

    char names[COUNT][4];
    struct rg_image images[COUNT];
    struct rg_use uses[COUNT + 1] = { 0 };
    const struct rg_pass passes[] = {
        { "fill", RG_COMPUTE, .comp = &small_graph_shader, .record = small_graph_record,
          .uses = uses },
    };
    (void)state;
    for (uint32_t i = 0; i < COUNT; i++) {
        snprintf(names[i], sizeof(names[i]), "i%u", i);
        images[i] = (struct rg_image)IMAGE(.name = names[i]);
        uses[i] = (struct rg_use){ &images[i], .access = RG_STORAGE_WRITE, .binding = (uint16_t)i };
    }
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        WANTS(images[0]),
    });
    const struct rg_barrier *last = &plan->barriers[plan->first_final_barrier];
    assert_int_equal(plan->image_count, COUNT);
    assert_int_equal(plan->final_barrier_count, 1);
    assert_int_equal(last->old_layout, VK_IMAGE_LAYOUT_GENERAL);
    assert_int_equal(last->src_stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
    rg_plan_destroy(plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_row_names_many_images),
        cmocka_unit_test(test_culling_is_transitive),
        cmocka_unit_test(test_culling_of_repetitions),
        cmocka_unit_test(test_overwritten_content_is_not_wanted),
        cmocka_unit_test(test_load_and_store),
        cmocka_unit_test(test_unneeded_last_targets_are_dropped),
        cmocka_unit_test(test_row_per_face),
        cmocka_unit_test(test_row_per_mip),
        cmocka_unit_test(test_row_per_mip_upwards),
        cmocka_unit_test(test_sizes_relative_to_the_view),
        cmocka_unit_test(test_size_instead_of_the_table_s),
        cmocka_unit_test(test_buffers),
        cmocka_unit_test(test_buffers_of_a_part),
        cmocka_unit_test(test_size_of_an_import),
        cmocka_unit_test(test_disjoint_lives_share_memory),
        cmocka_unit_test(test_share_nothing),
        cmocka_unit_test(test_memory_of_layers_and_mips),
        cmocka_unit_test(test_dump_knows_no_addresses),
        cmocka_unit_test(test_arrays_of_any_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
