/* test_rg_fallback.c: sampled uses whose image nothing provides, with a fallback and without. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"
#include "tests/support/small_graph.h"

static const struct rg_image shown = IMAGE(.name = "shown");
static const struct rg_image absent = IMAGE(.name = "absent");
static const struct rg_image other = IMAGE(.name = "other");
static const struct rg_buffer bytes = { .name = "bytes", .size = 4 };
static const struct rg_fallback white = { { 1, 1, 1, 1 } };

#define DRAW_SHOWN(...) \
    DRAW("draw", .color = RG_TARGETS({ CLEARED(shown) }), .uses = RG_USES(__VA_ARGS__))

/* A technique of these rows; a plan points to it, so that it must be in the scope of the plan. */
#define TECHNIQUE(rows) (&(const struct rg_technique)RG_TECHNIQUE("test", rows))

static struct rg_plan *compile(const struct rg_technique *technique, const struct rg_import *import)
{
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .techniques = (const struct rg_technique *[]){ technique },
        .technique_count = 1,
        .view = { SMALL_GRAPH_SIZE, SMALL_GRAPH_SIZE },
        .outputs = &(struct rg_output){ .image = &shown, .access = RG_SAMPLED },
        .output_count = 1,
        .imports = import,
        .import_count = import != NULL,
    });
    assert_non_null(plan);
    return plan;
}

static void check_fault(const struct rg_technique *technique, enum rg_error error)
{
    struct rg_plan *plan = compile(technique, NULL);
    assert_int_equal(plan->fault_count, 1);
    assert_int_equal(plan->faults[0].error, error);
    assert_string_equal(plan->faults[0].pass, "draw");
    rg_plan_destroy(plan);
}

static char *dump(const struct rg_plan *plan)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    rg_dump(plan, file);
    rg_dump_json(plan, file);
    assert_int_equal(fclose(file), 0);
    return text;
}

static void without_fallback_it_is_a_fault(void **state)
{
    (void)state;
    const struct rg_pass rows[] = { DRAW_SHOWN({ TEXTURE(absent) }) };
    check_fault(TECHNIQUE(rows), RG_ERROR_READ_BEFORE_WRITE);
}

/* Neither an image nor a use of the plan: it is as if the row had no such use. */
static void the_executor_binds_it(void **state)
{
    (void)state;
    const struct rg_pass with[] = { DRAW_SHOWN({ TEXTURE(absent), .fallback = &white }) };
    const struct rg_pass without[] = { DRAW("draw", .color = RG_TARGETS({ CLEARED(shown) })) };
    struct rg_plan *plan = compile(TECHNIQUE(with), NULL);
    struct rg_plan *bare = compile(TECHNIQUE(without), NULL);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(plan->image_count, 1);
    assert_int_equal(plan->passes[0].use_count, 0);
    assert_int_equal(plan->passes[0].fallback_count, 1);
    assert_ptr_equal(plan->fallbacks[plan->passes[0].first_fallback], &with[0].uses[0]);
    char *dumps[] = { dump(plan), dump(bare) };
    assert_string_equal(dumps[0], dumps[1]);
    free(dumps[0]);
    free(dumps[1]);
    rg_plan_destroy(plan);
    rg_plan_destroy(bare);
}

static void each_repetition_has_its_own(void **state)
{
    (void)state;
    static const struct rg_image faces = IMAGE(.name = "faces", .layers = 3);
    const struct rg_pass rows[] = {
        DRAW("faces", .color = RG_TARGETS({ CLEARED(faces) }), .repeat = RG_PER_LAYER,
             .uses = RG_USES({ TEXTURE(absent), .fallback = &white })),
        DRAW_SHOWN({ TEXTURE(faces) }, { TEXTURE(other), .binding = 1, .fallback = &white }),
    };
    struct rg_plan *plan = compile(TECHNIQUE(rows), NULL);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(plan->fallback_count, 4);
    for (uint32_t p = 0; p < 4; p++) {
        assert_int_equal(plan->passes[p].fallback_count, 1);
        assert_ptr_equal(plan->fallbacks[plan->passes[p].first_fallback]->image,
                         p < 3 ? &absent : &other);
    }
    rg_plan_destroy(plan);
}

static void check_provided(const struct rg_technique *technique, const struct rg_import *import,
                           const struct rg_image *image)
{
    struct rg_plan *plan = compile(technique, import);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(plan->fallback_count, 0);
    assert_int_not_equal(small_graph_find(plan, image), RG_NONE);
    rg_plan_destroy(plan);
}

static void what_is_provided_is_read(void **state)
{
    (void)state;
    const struct rg_import import = { .image = &absent, .access = RG_SAMPLED };
    const struct rg_pass reads[] = { DRAW_SHOWN({ TEXTURE(absent), .fallback = &white }) };
    const struct rg_pass drawn[] = {
        DRAW("fill", .color = RG_TARGETS({ CLEARED(absent) })),
        DRAW_SHOWN({ TEXTURE(absent), .fallback = &white }),
    };
    const struct rg_pass stored[] = {
        COMPUTE("fill", { .image = &absent, .access = RG_STORAGE_WRITE }),
        DRAW_SHOWN({ TEXTURE(absent), .fallback = &white }),
    };
    static const struct rg_image drawn_now = IMAGE(.name = "drawn now");
    static const struct rg_image drawn_last = IMAGE(.name = "drawn last", .previous = &drawn_now);
    const struct rg_pass history[] = {
        DRAW_SHOWN({ TEXTURE(drawn_last), .fallback = &white }),
        DRAW("fill", .color = RG_TARGETS({ CLEARED(drawn_now) })),
    };
    check_provided(TECHNIQUE(history), NULL, &drawn_last);
    check_provided(TECHNIQUE(reads), &import, &absent);
    check_provided(TECHNIQUE(drawn), NULL, &absent);
    check_provided(TECHNIQUE(stored), NULL, &absent);
}

/* A later row writes it: that is a wrong order, not an image that is missing. */
static void a_later_write_is_a_fault(void **state)
{
    (void)state;
    const struct rg_pass rows[] = {
        DRAW_SHOWN({ TEXTURE(absent), .fallback = &white }),
        DRAW("late", .color = RG_TARGETS({ CLEARED(absent) })),
    };
    check_fault(TECHNIQUE(rows), RG_ERROR_READ_BEFORE_WRITE);
}

static void only_sampled_images_have_one(void **state)
{
    (void)state;
    static const struct rg_image many = IMAGE(.name = "many", .samples = 4);
    static const struct rg_image unknown = { .name = "unknown" };
    const struct rg_pass uniform[] = {
        DRAW_SHOWN({ .buffer = &bytes, .access = RG_STORAGE_READ, .fallback = &white }),
    };
    const struct rg_pass samples[] = { DRAW_SHOWN({ TEXTURE(many), .fallback = &white }) };
    const struct rg_pass format[] = { DRAW_SHOWN({ TEXTURE(unknown), .fallback = &white }) };
    struct rg_plan *plan = compile(TECHNIQUE(uniform), NULL);
    assert_int_equal(plan->fault_count, 2);
    assert_int_equal(plan->faults[0].error, RG_ERROR_ACCESS);
    assert_int_equal(plan->faults[1].error, RG_ERROR_READ_BEFORE_WRITE);
    rg_plan_destroy(plan);
    check_fault(TECHNIQUE(samples), RG_ERROR_ACCESS);
    check_fault(TECHNIQUE(format), RG_ERROR_ACCESS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_fallback_it_is_a_fault),
        cmocka_unit_test(the_executor_binds_it),
        cmocka_unit_test(each_repetition_has_its_own),
        cmocka_unit_test(what_is_provided_is_read),
        cmocka_unit_test(a_later_write_is_a_fault),
        cmocka_unit_test(only_sampled_images_have_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
