/* Faults between a row and its shaders: each mistake is one fault, with the names of both. */
#include <stdlib.h>
#include <string.h>

#include "graph/rg.h"
#include "tests/gpu/test_shaders.h"
#include "tests/support/assertions.h"
#include "tests/support/fault_case.h"

#define COLOR_FORMAT VK_FORMAT_R8G8B8A8_UNORM

static const struct rg_image target = { "target", COLOR_FORMAT };
static const struct rg_image second = { "second", COLOR_FORMAT };
static const struct rg_image thin = { "thin", VK_FORMAT_R16_SFLOAT };
static const struct rg_image whole = { "whole", VK_FORMAT_R8G8B8A8_UINT };
static const struct rg_image cube = { "cube", COLOR_FORMAT, .width = 8, .height = 8, .cube = true };
static const struct rg_buffer camera = { "camera", 76, .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer small = { "small", 64, .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer lights = { "lights", 64, .memory = RG_MEMORY_UPLOAD };

static const VkVertexInputAttributeDescription vec3[] = { { 0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0 } };
static const VkVertexInputAttributeDescription vec2[] = { { 0, 0, VK_FORMAT_R32G32_SFLOAT, 0 } };
static const VkVertexInputAttributeDescription uvec3[] = { { 0, 0, VK_FORMAT_R32G32B32_UINT, 0 } };
static const VkVertexInputAttributeDescription late[] = { { 1, 0, VK_FORMAT_R32G32B32_SFLOAT, 0 } };
static const struct rg_vertex_layout positions = { 12, 1, vec3 };
static const struct rg_vertex_layout flat = { 12, 1, vec2 };
static const struct rg_vertex_layout numbers = { 12, 1, uvec3 };
static const struct rg_vertex_layout elsewhere = { 12, 1, late };

/* ---- rows ---- */

#define PICTURE(number) \
    { \
        .image = &fault_case_picture, .access = RG_SAMPLED, .binding = (number) \
    }
#define PICTURE_OF_VERTICES \
    { \
        .image = &fault_case_picture, .access = RG_SAMPLED, .binding = 2, \
        .stages = VK_SHADER_STAGE_VERTEX_BIT \
    }
#define STORE(to) \
    { \
        .image = &(to), .access = RG_STORAGE_WRITE, .binding = 0 \
    }
#define STORE_SECOND \
    { \
        .image = &second, .access = RG_STORAGE_WRITE, .binding = 2 \
    }
#define UNIFORM(of) \
    { \
        .buffer = &(of), .access = RG_UNIFORM, .binding = 3 \
    }
#define LIGHTS \
    { \
        .buffer = &lights, .access = RG_STORAGE_READ, .binding = 4 \
    }
#define COMPUTES(push, ...) \
    { \
        .name = "compute", .kind = RG_COMPUTE, .comp = &match_comp, .push_size = (push), \
        .record = small_graph_record, .uses = RG_USES(__VA_ARGS__) \
    }
#define DRAWS(push, layout, source, ...) \
    { \
        .name = "draw", .vert = &match_vert, .frag = &match_frag, .push_size = (push), \
        .vertices = (layout), .record = small_graph_record, .color = RG_TARGETS(__VA_ARGS__), \
        .uses = RG_USES(source) \
    }
#define SHADER(stage_, shader) \
    { \
        .name = "compute", .kind = RG_COMPUTE, .stage_ = &(shader), .record = small_graph_record, \
        .uses = RG_USES(STORE(target)) \
    }

#define BOTH \
    { &target, RG_LOAD_CLEAR }, \
    { \
        &second, RG_LOAD_CLEAR \
    }

static const struct rg_pass good_rows[] = {
    COMPUTES(12, STORE(target), PICTURE(2), UNIFORM(camera), LIGHTS),
    DRAWS(12, &positions, PICTURE(2), BOTH),
};

/* Code that is damaged, or has not what the row wants of it. */
static const uint32_t no_words[] = { 1, 2, 3, 4, 5, 6, 7, 8 };
static const struct rg_shader no_spirv = { "no_spirv", no_words, 8 };

#define IS(kind, line, ...) \
    { \
        .error = (kind), .text = "bad row 0 " line, .row = true, .row_count = 1, .rows = { \
            __VA_ARGS__ \
        } \
    }

static const struct fault_case push_cases[] = {
    IS(RG_ERROR_SHADER_PUSH,
       "(draw): push push constants differ from those of the shader; push_size: expected the 12 "
       "bytes of match_vert, got 0",
       DRAWS(0, &positions, PICTURE(2), BOTH)),
    IS(RG_ERROR_SHADER_PUSH,
       "(draw): push push constants differ from those of the shader; push_size: expected the 12 "
       "bytes of match_vert, got 8",
       DRAWS(8, &positions, PICTURE(2), BOTH)),
    IS(RG_ERROR_SHADER_PUSH,
       "(draw): push push constants differ from those of the shader; push_size: expected the 12 "
       "bytes of match_vert, got 20",
       DRAWS(20, &positions, PICTURE(2), BOTH)),
};

#define BINDING "binding differs from that of the shader; "

static const struct fault_case binding_cases[] = {
    IS(RG_ERROR_SHADER_BINDING,
       "(draw): source " BINDING
       "binding 2 of 'match_frag' is not in the row; no shader uses binding 1 ('picture')",
       DRAWS(12, &positions, PICTURE(1), BOTH)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): Lights " BINDING "binding 4 of 'match_comp' is not in the row",
       COMPUTES(12, STORE(target), PICTURE(2), UNIFORM(camera))),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): picture " BINDING "binding 1: no shader of the row uses it",
       COMPUTES(12, STORE(target), PICTURE(1), PICTURE(2), UNIFORM(camera), LIGHTS)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): source " BINDING
       "binding 2 is a combined image sampler in 'match_comp', 'second' "
       "is a storage image",
       COMPUTES(12, STORE(target), STORE_SECOND, UNIFORM(camera), LIGHTS)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): target " BINDING
       "binding 0: format R8G8B8A8_UNORM is not the R16_SFLOAT of 'thin'",
       COMPUTES(12, STORE(thin), PICTURE(2), UNIFORM(camera), LIGHTS)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): target " BINDING
       "binding 0: format R8G8B8A8_UNORM is not the R8G8B8A8_UINT of 'whole'",
       COMPUTES(12, STORE(whole), PICTURE(2), UNIFORM(camera), LIGHTS)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): target " BINDING "binding 0: 'cube' is a 2D array in the row",
       COMPUTES(12, STORE(cube), PICTURE(2), UNIFORM(camera), LIGHTS)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): camera " BINDING "binding 3: expected 76 bytes or more, 'small' has 64",
       COMPUTES(12, STORE(target), PICTURE(2), UNIFORM(small), LIGHTS)),
    IS(RG_ERROR_SHADER_BINDING,
       "(draw): source " BINDING
       "binding 2: name the stage of 'match_frag' in .stages of 'picture'",
       DRAWS(12, &positions, PICTURE_OF_VERTICES, BOTH)),
};

#define VERTEX         "vertex attribute differs from that of the shader; "
#define OUTPUT_DIFFERS "target differs from the output of the shader; "

static const struct fault_case raster_cases[] = {
    IS(RG_ERROR_SHADER_VERTEX,
       "(draw): position " VERTEX
       "location 0: 'match_vert' reads 3 x float, the format has 2 x float",
       DRAWS(12, &flat, PICTURE(2), BOTH)),
    IS(RG_ERROR_SHADER_VERTEX,
       "(draw): position " VERTEX
       "location 0: 'match_vert' reads 3 x float, the format has 3 x uint",
       DRAWS(12, &numbers, PICTURE(2), BOTH)),
    IS(RG_ERROR_SHADER_VERTEX,
       "(draw): position " VERTEX "location 0 of 'match_vert' is in no vertex layout",
       DRAWS(12, &elsewhere, PICTURE(2), BOTH)),
    IS(RG_ERROR_SHADER_OUTPUT,
       "(draw): normal " OUTPUT_DIFFERS "output 1 of 'match_frag' has no target",
       DRAWS(12, &positions, PICTURE(2), { &target, RG_LOAD_CLEAR })),
    IS(RG_ERROR_SHADER_OUTPUT,
       "(draw): other " OUTPUT_DIFFERS "'match_frag' has no output 2 for it",
       DRAWS(12, &positions, PICTURE(2), BOTH, { &fault_case_other, RG_LOAD_CLEAR })),
    IS(RG_ERROR_SHADER_OUTPUT,
       "(draw): normal " OUTPUT_DIFFERS "output 1 of 'match_frag' is float, the target has uint",
       DRAWS(12, &positions, PICTURE(2), { &target, RG_LOAD_CLEAR }, { &whole, RG_LOAD_CLEAR })),
    { ROW(RG_ERROR_SHADER_INPUT, "uv",
          { .name = "draw",
            .vert = &triangle_vert,
            .frag = &match_frag,
            .push_size = 36,
            .record = small_graph_record,
            .color = RG_TARGETS(BOTH),
            .uses = RG_USES(PICTURE(2)) }) },
};

static const struct fault_case shader_cases[] = {
    IS(RG_ERROR_SHADER,
       "(compute): no_spirv is not a valid shader; expected a SPIR-V module in native byte order",
       SHADER(comp, no_spirv)),
    IS(RG_ERROR_SHADER,
       "(compute): match_frag is not a valid shader; expected an entry point 'main' of this stage",
       SHADER(comp, match_frag)),
};

/* ---- other resources ---- */

static const struct rg_set own = { "own" };
static const struct rg_image deep = { "deep", VK_FORMAT_R32_UINT, .depth = 4 };
static const struct rg_image level = { "level", VK_FORMAT_R32_UINT };
static const struct rg_buffer seed = { "seed", 4, .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer texels = { "texels", 64, .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer floats = { "floats", 64, .format = VK_FORMAT_R32_SFLOAT };
static const struct rg_buffer up = { "up", 64, .memory = RG_MEMORY_UPLOAD,
                                     .format = VK_FORMAT_R32_UINT };

#define ELEMENT(number) \
    { \
        .image = &fault_case_picture, .access = RG_SAMPLED, .binding = 1, .element = (number) \
    }
#define ARRAY(with, ...) \
    { \
        .name = "compute", .kind = RG_COMPUTE, .comp = &match_array_comp, .set = (with), \
        .record = small_graph_record, .uses = RG_USES(STORE(target), __VA_ARGS__) \
    }
#define VOLUME(of) \
    { \
        .name = "compute", .kind = RG_COMPUTE, .comp = &volume_comp, .record = small_graph_record, \
        .uses = RG_USES({ .buffer = &seed, .access = RG_UNIFORM }, \
                        { .image = &(of), .access = RG_STORAGE_WRITE, .binding = 2 }) \
    }
#define TEXELS(to, as_texels) \
    { \
        .name = "compute", .kind = RG_COMPUTE, .comp = &texels_comp, .record = small_graph_record, \
        .uses = RG_USES( \
            { .buffer = &(to), .access = RG_STORAGE_WRITE, .binding = 1, .texels = (as_texels) }, \
            { .buffer = &up, .access = RG_SAMPLED, .binding = 2 }) \
    }

static const struct rg_pass good_resources[] = {
    ARRAY(&own, ELEMENT(0), ELEMENT(1)),
    VOLUME(deep),
    TEXELS(texels, true),
};

static const struct fault_case resource_cases[] = {
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): sources " BINDING
       "binding 1: 2 descriptors in 'match_array_comp', 1 in the row (rg_use.element)",
       ARRAY(&own, ELEMENT(0))),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): sources " BINDING
       "binding 1: 2 descriptors in 'match_array_comp', 3 in the row (rg_use.element)",
       ARRAY(&own, ELEMENT(0), ELEMENT(1), ELEMENT(2))),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): own " BINDING
       "it is in set 1 of 'match_array_comp': use set 0, or set 1 with rg_pass.set",
       ARRAY(NULL, ELEMENT(0), ELEMENT(1))),
    IS(RG_ERROR_SHADER_BINDING, "(draw): own " BINDING "set 1: no shader of the row uses it",
       { .name = "draw",
         .vert = &match_vert,
         .frag = &match_frag,
         .push_size = 12,
         .vertices = &positions,
         .record = small_graph_record,
         .color = RG_TARGETS(BOTH),
         .set = &own,
         .uses = RG_USES(PICTURE(2)) }),
    IS(RG_ERROR_SHADER_BINDING, "(compute): volume " BINDING "binding 2: 'level' is 2D in the row",
       VOLUME(level)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): numbers " BINDING
       "binding 1 is a storage texel buffer in 'texels_comp', 'texels' is a storage buffer",
       TEXELS(texels, false)),
    IS(RG_ERROR_SHADER_BINDING,
       "(compute): numbers " BINDING "binding 1: format R32_UINT is not the R32_SFLOAT of 'floats'",
       TEXELS(floats, true)),
};

/* ---- loads and stores ---- */

#define GRID(title) \
    { \
        (title), VK_FORMAT_R32_UINT \
    }
static const struct rg_image grids[] = { GRID("stored"), GRID("loaded"), GRID("counted") };
static const struct rg_buffer blocks[] = {
    { "count", 4 },
    { "items", 64 },
    { "sources", 64 },
    { "fixed", 64 },
};

/* Two passes: the first writes all resources that access.comp loads; the second runs access.comp
 * with the declared accesses. */
#define STORED(number, use) \
    { \
        .image = &grids[number], .access = (use), .binding = (number) \
    }
#define BLOCK(number, use) \
    { \
        .buffer = &blocks[(number)-3], .access = (use), .binding = (number) \
    }
#define FILL_GRIDS \
    COPY("write", { &grids[0], .access = RG_COPY_DST }, { &grids[1], .access = RG_COPY_DST }, \
         { &grids[2], .access = RG_COPY_DST }, { .buffer = &blocks[0], .access = RG_COPY_DST }, \
         { .buffer = &blocks[1], .access = RG_COPY_DST }, \
         { .buffer = &blocks[2], .access = RG_COPY_DST }, \
         { .buffer = &blocks[3], .access = RG_COPY_DST })
#define ACCESSES(...) \
    { \
        .name = "access", .kind = RG_COMPUTE, .comp = &access_comp, .record = small_graph_record, \
        .uses = RG_USES(__VA_ARGS__) \
    }
#define ACCESS(use0, use1, use2, use3, use4, use5) \
    ACCESSES(STORED(0, RG_STORAGE_##use0), STORED(1, RG_STORAGE_##use1), \
             STORED(2, RG_STORAGE_##use2), BLOCK(3, RG_STORAGE_##use3), \
             BLOCK(4, RG_STORAGE_##use4), BLOCK(5, RG_STORAGE_##use5), BLOCK(6, RG_STORAGE_READ))
#define LIES(name, line, ...) \
    { \
        .error = RG_ERROR_SHADER_ACCESS, .row = true, .row_count = 2, \
        .text = "bad row 1 (access): " name " access differs from that of the shader; " line, \
        .rows = { \
            FILL_GRIDS, \
            ACCESS(__VA_ARGS__) \
        } \
    }

static const struct rg_pass honest_rows[] = {
    FILL_GRIDS,
    ACCESS(WRITE, READ, READ_WRITE, READ_WRITE, WRITE, READ),
};

static const struct fault_case access_cases[] = {
    LIES("stored", "binding 0: 'access_comp' stores to 'stored': expected RG_STORAGE_WRITE", READ,
         READ, READ_WRITE, READ_WRITE, WRITE, READ),
    LIES("loaded", "binding 1: 'access_comp' loads from 'loaded': expected RG_STORAGE_READ", WRITE,
         WRITE, READ_WRITE, READ_WRITE, WRITE, READ),
    LIES("counted", "binding 2: 'access_comp' stores to 'counted': expected RG_STORAGE_READ_WRITE",
         WRITE, READ, READ, READ_WRITE, WRITE, READ),
    LIES("count", "binding 3: 'access_comp' loads from 'Count': expected RG_STORAGE_READ_WRITE",
         WRITE, READ, READ_WRITE, WRITE, WRITE, READ),
    LIES("items", "binding 4: 'access_comp' stores to 'Items': expected RG_STORAGE_WRITE", WRITE,
         READ, READ_WRITE, READ_WRITE, READ, READ),
    LIES("sources", "binding 5: 'access_comp' loads from 'Source': expected RG_STORAGE_READ", WRITE,
         READ, READ_WRITE, READ_WRITE, WRITE, WRITE),
};

static void skip_shaders(struct rg_compile_params *params)
{
    params->skip_shaders = true;
}

static void test_skipped(void **state)
{
    (void)state;
    struct fault_case fc = push_cases[0];
    fc.edit = skip_shaders;
    struct rg_plan *plan = fault_case_compile(&fc);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    rg_plan_destroy(plan);
}

static void test_good_resources(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(good_resources) / sizeof(good_resources[0]); i++) {
        struct rg_plan *plan = fault_case_compile(&(struct fault_case){
            .row_count = 1,
            .rows = { good_resources[i] },
        });
        assert_non_null(plan);
        if (plan->fault_count)
            rg_dump(plan, stderr);
        assert_int_equal(plan->fault_count, 0);
        rg_plan_destroy(plan);
    }
}

static void test_good_accesses(void **state)
{
    (void)state;
    struct rg_plan *plan = fault_case_compile(&(struct fault_case){
        .row_count = 2,
        .rows = { honest_rows[0], honest_rows[1] },
    });
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    rg_plan_destroy(plan);
}

/* Replaces the loads that follow access chains by another instruction, from load `first` on. */
static void lose_pointers(uint32_t *words, size_t count, uint32_t first)
{
    enum {
        HEADER_WORDS = 5,
        OP_LOAD = 61,
        OP_ACCESS_CHAIN = 65,
        OP_SELECT = 169,
    };

    uint32_t last = 0, found = 0;
    for (size_t i = HEADER_WORDS; i < count; i += words[i] >> 16) {
        const uint32_t op = words[i] & 0xffff;
        if (last == OP_ACCESS_CHAIN && op == OP_LOAD && found++ >= first)
            words[i] = words[i] - OP_LOAD + OP_SELECT;
        last = op;
    }
}

/* A pointer that is not only loaded from may be stored to, unless the shader says readonly. */
static void test_lost_pointers(void **state)
{
    (void)state;
    const size_t count = access_comp.word_count;
    uint32_t *words = malloc(count * sizeof(*words));
    assert_non_null(words);
    memcpy(words, access_comp.words, count * sizeof(*words));
    const struct rg_shader shader = { "lost", words, count };
    struct fault_case fc = { .row_count = 2, .rows = { honest_rows[0], honest_rows[1] } };
    fc.rows[1].comp = &shader;
    for (uint32_t faults = 0; faults < 2; faults++) { /* of `fixed`, then also of `source` */
        lose_pointers(words, count, 1 - faults);
        struct rg_plan *plan = fault_case_compile(&fc);
        assert_non_null(plan);
        assert_int_equal(plan->fault_count, faults);
        assert_true(!faults || !strcmp(plan->faults[0].resource, "sources"));
        rg_plan_destroy(plan);
    }
    free(words);
}

/* ---- rows ---- */

static void test_every_case(void **state)
{
    static const struct fault_cases tables[] = {
        FAULT_CASES(push_cases),   FAULT_CASES(binding_cases),  FAULT_CASES(raster_cases),
        FAULT_CASES(shader_cases), FAULT_CASES(resource_cases), FAULT_CASES(access_cases),
    };
    bool provoked[RG_ERROR_COUNT] = { false };
    (void)state;
    fault_case_check(tables, sizeof(tables) / sizeof(tables[0]), provoked);
    for (int error = RG_ERROR_SHADER; error < RG_ERROR_COUNT; error++)
        assert_true(provoked[error]);
}

/* Compiles a good row with damaged code. Nothing but the allocated words may be read. */
static void compile_damaged(const uint32_t *words, size_t count)
{
    uint32_t *copy = malloc(count * sizeof(*copy));
    assert_non_null(copy);
    memcpy(copy, words, count * sizeof(*copy));
    const struct rg_shader shader = { "damaged", copy, count };
    struct rg_pass row = good_rows[0];
    row.comp = &shader;
    struct rg_plan *plan = fault_case_compile(&(struct fault_case){
        .row_count = 1,
        .rows = { row },
    });
    assert_non_null(plan);
    rg_plan_destroy(plan);
    free(copy);
}

/* Each word in turn becomes several others, and the module ends after each. */
static void damage(const struct rg_shader *shader)
{
    static const uint32_t instead[] = { 0, 1, UINT32_MAX, 0x00010000, 0x7fffffff };
    const size_t count = shader->word_count;
    uint32_t *words = malloc(count * sizeof(*words));
    assert_non_null(words);
    for (size_t i = 0; i < count; i++) {
        memcpy(words, shader->words, count * sizeof(*words));
        compile_damaged(words, i + 1);
        for (size_t k = 0; k < sizeof(instead) / sizeof(instead[0]); k++) {
            words[i] = instead[k];
            compile_damaged(words, count);
        }
        words[i] = shader->words[(i * 7) % count];
        compile_damaged(words, count);
    }
    free(words);
}

static void test_damaged_code(void **state)
{
    (void)state;
    damage(&match_comp);
    damage(&access_comp);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_case),     cmocka_unit_test(test_skipped),
        cmocka_unit_test(test_good_resources), cmocka_unit_test(test_good_accesses),
        cmocka_unit_test(test_lost_pointers),  cmocka_unit_test(test_damaged_code),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
