/* test_dynamic_resolution.c: a moving picture is a draft, whose size follows what frames cost. */
#include "src/settings/quality.h"
#include "src/settings/scene_settings.h"
#include "src/view/draft_renderer.h"
#include "src/view/dynamic_resolution.h"
#include "tests/support/assertions.h"

/* Frames of a picture that takes `passes` seconds in full size, and `rest` for all else. */
static void run(struct dynamic_resolution *m, double passes, double rest, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const double taken =
            passes * m->k * m->k / (DYNAMIC_RESOLUTION_MAX * DYNAMIC_RESOLUTION_MAX);
        dynamic_resolution_add(m, taken + rest, taken);
    }
}

static void begins_where_it_should_be(void **state)
{
    struct dynamic_resolution m;
    (void)state;
    dynamic_resolution_begin(&m, 0.0);
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MAX);
    dynamic_resolution_begin(&m, 0.01);
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MAX);
    dynamic_resolution_begin(&m, 0.04);
    assert_in_range(m.k, 10, 13);
    dynamic_resolution_begin(&m, 5.0);
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MIN);
}

static void late_frames_are_smaller_at_once(void **state)
{
    struct dynamic_resolution m;
    (void)state;
    dynamic_resolution_begin(&m, 0.0);
    run(&m, 0.04, 0.004, 1); /* 44 ms once is no reason */
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MAX);
    run(&m, 0.04, 0.004, 1);
    assert_int_equal(m.k, 12); /* 26.5 ms */
    dynamic_resolution_begin(&m, 0.0);
    run(&m, 0.5, 0.004, 1);
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MIN);
    dynamic_resolution_begin(&m, 0.0);
    dynamic_resolution_add(&m, 0.5, 0.0); /* nobody knows what the passes took */
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MIN);
}

/* One step a time, and not at all where it would be late again. */
static void early_frames_are_larger_after_a_while(void **state)
{
    struct dynamic_resolution m;
    (void)state;
    dynamic_resolution_begin(&m, 5.0);
    run(&m, 0.01, 0.004, 4);
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MIN);
    run(&m, 0.01, 0.004, 400);
    assert_int_equal(m.k, DYNAMIC_RESOLUTION_MAX);
    dynamic_resolution_begin(&m, 5.0);
    run(&m, 0.04, 0.004, 400);
    const uint32_t k = m.k;
    assert_in_range(k, 10, 12);
    for (uint32_t i = 0; i < 100; i++) {
        run(&m, 0.04, 0.004, 1);
        assert_int_equal(m.k, k); /* it does not swing */
    }
}

static void parts_are_even_and_never_empty(void **state)
{
    (void)state;
    for (uint32_t length = 1; length < 300; length++) {
        assert_int_equal(dynamic_resolution_scale(length, DYNAMIC_RESOLUTION_MAX), length);
        for (uint32_t k = DYNAMIC_RESOLUTION_MIN; k < DYNAMIC_RESOLUTION_MAX; k++) {
            const uint32_t part = dynamic_resolution_scale(length, k);
            assert_in_range(part, 1, length);
            assert_true(part == length || part % 2 == 0);
            assert_true(16 * (part + 2) >= DYNAMIC_RESOLUTION_MIN * length);
        }
    }
}

static double value_of(const struct settings *settings, const char *name)
{
    return settings_get(settings, settings_find(name));
}

static void movements_are_drafts(void **state)
{
    struct settings settings = settings_default();
    (void)state;
    for (uint32_t level = 0; level < QUALITY_COUNT; level++) {
        quality_apply(&settings, level, SETTING_QUALITY);
        const struct settings quick =
            draft_renderer_settings(&settings, DRAFT_RENDERER_COARSE_MESH);
        assert_int_equal(quality_find(&quick), 0);
        assert_true(value_of(&quick, "ground.shading") == (double)GROUND_VERTICES);
        assert_true(value_of(&quick, "cracks.count") == value_of(&settings, "cracks.count"));
        assert_true(value_of(&quick, "bubbles.count") == value_of(&settings, "bubbles.count"));
        assert_true(value_of(&quick, "air.count") == value_of(&settings, "air.count"));
        assert_true(value_of(&quick, "bump.strength") == value_of(&settings, "bump.strength"));
        assert_true(value_of(&quick, "refract_bounce.inclusions") ==
                    value_of(&settings, "refract_bounce.inclusions"));
    }
    /* what no level has, somebody has chosen */
    settings_set_value(&settings, settings_find("env_cube.size"), 333.0);
    const struct settings quick = draft_renderer_settings(&settings, DRAFT_RENDERER_COARSE_MESH);
    assert_true(value_of(&quick, "env_cube.size") == 333.0);
    assert_int_equal(quality_find(&quick), QUALITY_COUNT);
    /* a movement never has more than the picture */
    settings_set_value(&settings, settings_find("refract_bounce.reflections"), 1.0);
    const struct settings less = draft_renderer_settings(&settings, DRAFT_RENDERER_FULL);
    assert_true(value_of(&less, "refract_bounce.reflections") == 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(begins_where_it_should_be),
        cmocka_unit_test(late_frames_are_smaller_at_once),
        cmocka_unit_test(early_frames_are_larger_after_a_while),
        cmocka_unit_test(parts_are_even_and_never_empty),
        cmocka_unit_test(movements_are_drafts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
