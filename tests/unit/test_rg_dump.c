/* The dumps of a plan that has one of everything, word by word; names that are hard to write. */
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/dump_plan.h"
#include "tests/support/small_graph.h"

typedef void dump_fn(const struct rg_plan *plan, FILE *out);

/* The caller frees it. */
static char *dump(dump_fn *write, const struct rg_plan *plan)
{
    char *text;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    write(plan, file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(strlen(text), size);
    return text;
}

static void check_dump(dump_fn *write, const char *expected)
{
    struct dump_plan plan;
    dump_plan_init(&plan, dump_plan_names);
    char *text = dump(write, &plan.plan);
    assert_string_equal(text, expected);
    free(text);
}

static const char everything_text[] =
    "view 64x48\n"
    "image scene R8G8B8A8_UNORM 64x48 samples 4, block 0 offset 0 size 4096, passes 0-0\n"
    "image depth D24_UNORM_S8_UINT 64x48 samples 4, block 0 offset 4096 size 1024, passes 0-2\n"
    "image resolved R8G8B8A8_UNORM 64x48 layers 2 mips 3, block 0 offset 5120 size 1024, "
    "passes 0-1\n"
    "image history R8G8B8A8_UNORM 64x48x5, persistent size 8192, passes 1-1\n"
    "image shown R8G8B8A8_UNORM 64x48, imported, passes 2-end\n"
    "image field R8G8B8A8_UNORM 64x48 layers 6 cube, block 0 offset 0 size 3000, passes 1-1\n"
    "buffer sums 999 bytes, block 1 offset 0 size 1000, passes 0-3\n"
    "buffer counters 16 bytes, persistent size 256, passes 1-1\n"
    "buffer globals 128 bytes, host, passes 0-2\n"
    "buffer result 999 bytes, host, passes 3-end\n"
    "buffer given 64 bytes, imported, passes 2-2\n"
    "block 0 images size 6144\n"
    "block 1 buffers size 1000\n"
    "transient memory: used 7144, without aliasing 10144, bound 7000\n"
    "persistent memory: 8448\n"
    "barriers: 4 in 4 batches\n"
    "  initial barrier history: transfer_dst -> general  transfer/transfer_write -> "
    "all/memory_read|memory_write\n"
    "  barrier scene: undefined -> color  none/none -> color/color_write\n"
    "pass 0 draw raster 64x48\n"
    "  color scene clear dont_care resolve resolved mip 1 layer 1\n"
    "  depth depth dont_care store\n"
    "  barrier resolved mip 1: color -> shader_read  color/color_write -> compute/sampled_read\n"
    "pass 1 update compute 32x24 conditional\n"
    "  sampled resolved mips 1-2 binding 3\n"
    "  storage read write history binding 1\n"
    "  storage write field layers 2-4 binding 0\n"
    "  uniform globals binding 7\n"
    "  storage read write counters texels binding 0[2]\n"
    "  set own\n"
    "  barrier depth stencil: depth -> depth_read  late/depth_write -> "
    "early|late/depth_read|0x1000000000000000\n"
    "pass 2 overlay[1] raster 64x48\n"
    "  color shown load store\n"
    "  depth read depth load none\n"
    "pass 3 read transfer 64x48\n"
    "  copy source sums\n"
    "  copy destination result\n"
    "  barrier result:  transfer/transfer_write -> host/host_read\n"
    "culled draw\n"
    "culled overlay[0]\n";

static void test_text(void **state)
{
    (void)state;
    check_dump(rg_dump, everything_text);
}

/* A plan without the rare things has no word of them. */
static void test_what_is_absent_is_not_said(void **state)
{
    (void)state;
    static const char *const words[] = {
        "samples", "persistent", "resolve", "conditional", "initial", "least", "culled",
    };
    static const struct rg_image image = IMAGE(.name = "image");
    const struct rg_pass passes[] = { DRAW("draw", .color = RG_TARGETS({ CLEARED(image) })) };
    struct rg_plan *plan = small_graph_compile(&(struct small_graph){
        PASSES(passes),
        WANTS(image),
    });
    char *text = dump(rg_dump, plan);
    assert_non_null(strstr(text, "\ntransient memory: used 1024, without aliasing 1024, bound "
                                 "1024\nbarriers: "));
    for (size_t i = 0; i < sizeof(words) / sizeof(words[0]); i++)
        assert_null(strstr(text, words[i]));
    free(text);
    rg_plan_destroy(plan);
}

/* Every name in the JSON form, in the order of dump_plan_names. */
static void check_names(const json_t *root, const char *const *expected)
{
    static const char *const arrays[] = { "images", "buffers", "passes" };
    for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); i++) {
        const json_t *array = json_object_get(root, arrays[i]);
        for (size_t k = 0; k < json_array_size(array); k++) {
            const json_t *name = json_object_get(json_array_get(array, k), "name");
            assert_string_equal(json_string_value(name), *expected++);
        }
    }
}

static json_t *load(const struct rg_plan *plan)
{
    json_error_t error;
    char *text = dump(rg_dump_json, plan);
    json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    if (!root)
        print_error("line %d: %s\n", error.line, error.text);
    free(text);
    assert_non_null(root);
    return root;
}

#define BAD "\xef\xbf\xbd" /* U+FFFD */

static void test_json_names(void **state)
{
    (void)state;
    const char *expected[DUMP_PLAN_NAMES];
    struct dump_plan plan;
    dump_plan_init(&plan, dump_plan_awkward_names);
    memcpy(expected, dump_plan_awkward_names, sizeof(expected));
    expected[6] = BAD " broken " BAD "(";
    expected[7] = BAD BAD BAD " " BAD BAD BAD BAD " " BAD BAD " " BAD BAD BAD " " BAD BAD BAD BAD;
    expected[12] = BAD;
    json_t *root = load(&plan.plan);
    check_names(root, expected);
    json_decref(root);
}

static void test_json_faults(void **state)
{
    (void)state;
    json_t *root = load(&dump_plan_faults);
    const json_t *faults = json_object_get(root, "faults");
    const json_t *first = json_array_get(faults, 0), *second = json_array_get(faults, 1);
    assert_int_equal(json_object_size(root), 1);
    assert_int_equal(json_array_size(faults), DUMP_PLAN_FAULTS);
    assert_int_equal(json_integer_value(json_object_get(first, "error")),
                     RG_ERROR_READ_BEFORE_WRITE);
    assert_int_equal(json_integer_value(json_object_get(first, "row")), 7);
    assert_string_equal(json_string_value(json_object_get(first, "technique")),
                        "<tech> \"&\" " BAD);
    assert_string_equal(json_string_value(json_object_get(first, "pass")), "pass");
    assert_string_equal(json_string_value(json_object_get(first, "resource")), "image");
    assert_string_equal(json_string_value(json_object_get(first, "hint")), "write it first");
    assert_int_equal(json_object_size(second), 3); /* error, text, hint */
    json_decref(root);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text),
        cmocka_unit_test(test_what_is_absent_is_not_said),
        cmocka_unit_test(test_json_names),
        cmocka_unit_test(test_json_faults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
