/*
 * test_affects.c: checks what each setting's row declares to be rebuilt when it changes: the
 * scene, if other data is loaded or generated; the plan, if it has other passes or other
 * specialisation constants.
 */
#include <stdlib.h>
#include <string.h>

#include "src/app/app.h"
#include "src/render/frame/compile_frame_plan.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/scene/ice_bump_map.h"
#include "tests/support/assertions.h"

enum {
    TEXT_SIZE = 512
};

/* Of a change that was tried, as found by its results. */
static enum setting_effect affected;

/* Numbers of which a scene is made, as text. */
static void describe_scene(const struct setup_scene *o, char text[static TEXT_SIZE])
{
    struct bump_maps_params maps;
    const struct scene_params p = setup_scene_params(o, &maps);
    int length = snprintf(
        text, TEXT_SIZE, "%u %u %d %u|%u %u %a %a %d|%u %u %a %d %a|%u %u %a|%a %a %a",
        p.object_triangles, p.landscape_triangles, p.flat, p.orbiting_ball_count, p.air.count,
        p.air.seed, (double)p.air.size, (double)p.air.frequency, p.has_scattering_medium,
        p.bubbles.count, p.bubbles.seed, (double)p.bubbles.size, (int)p.bubbles.shape,
        (double)p.bubbles.stretch, p.cracks.count, p.cracks.seed, (double)p.cracks.size,
        (double)p.pool.size, (double)p.pool.depth, (double)p.pool.ice);
    if (p.bump)
        length += snprintf(&text[length], TEXT_SIZE - (size_t)length, "|%a %u", (double)maps.smooth,
                           maps.seed);
    assert_true(length < TEXT_SIZE);
}

static bool same_scene(const struct setup_scene *a, const struct setup_scene *b)
{
    char before[TEXT_SIZE], after[TEXT_SIZE];
    describe_scene(a, before);
    describe_scene(b, after);
    return !strcmp(before, after);
}

/* The plan of a frame as text, and the constants; the caller frees it. */
static char *describe_plan(const struct settings *settings, bool has_pool)
{
    const struct scene scene = { .has_pool = has_pool };
    const struct frame_constants constants = frame_view_constants(&scene, settings, NULL);
    const struct frame_request request = {
        .config = { .settings = settings,
                    .refraction = techniques_find_refraction("paper"),
                    .scene = &scene },
        .view = { 64, 64 },
        .layers = UINT64_MAX,
        .beauty = true,
        .display = true,
    };
    struct frame_plan plan;
    char *text;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
    rg_dump(plan.plan, file);
    for (size_t i = 0; i < CONSTANT_COUNT; i++)
        fprintf(file, "%u ", constants.values[i]);
    fclose(file);
    frame_plan_finish(&plan);
    return text;
}

/* Settings, and their plans without a pool and with one. */
struct start {
    struct settings settings;
    char *plans[2];
};

static bool same_plan(const struct start *before, const struct settings *settings)
{
    bool same = true;
    for (int pool = 0; pool < 2 && same; pool++) {
        char *after = describe_plan(settings, pool);
        same = !strcmp(before->plans[pool], after);
        free(after);
    }
    return same;
}

static void check_change(const struct setting *row, const struct start *before, double value)
{
    struct setup_scene a = { .settings = before->settings }, b = a;
    settings_set_value(&b.settings, row, value);
    const enum setting_effect said = settings_changed(&a.settings, &b.settings);
    enum setting_effect found = SETTING_AFFECTS_FRAME;
    if (!same_plan(before, &b.settings))
        found = SETTING_AFFECTS_PLAN;
    if (!same_scene(&a, &b))
        found = SETTING_AFFECTS_SCENE;
    if (said < found)
        print_error("%s=%g: the row says %d, it affects %d\n", row->name, value, said, found);
    assert_true(said >= found);
    affected = affected > found ? affected : found;
}

static void check_row(const struct setting *row, const struct start *before)
{
    const double old = settings_get(&before->settings, row);
    const double step = row->type == SETTING_FLOAT ? (row->max - row->min) / 3 : 1;
    const double values[] = { row->min, old - step, old + step, row->max };
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++) {
        if (values[i] >= row->min && values[i] <= row->max && values[i] != old)
            check_change(row, before, values[i]);
    }
}

/* Settings with which others count: gaps are refracted, frost lies, cracks are there. */
static const char *const states[] = { "tonemap.exposure=0", "frost.amount=1",
                                      "ice_caustics.light=sun", "bump.strength=0" };

static void test_rows_say_what_they_affect(void **state)
{
    (void)state;
    for (size_t s = 0; s < sizeof(states) / sizeof(states[0]); s++) {
        struct start before = { .settings = settings_default() };
        assert_int_equal(settings_assign(&before.settings, states[s], SETTING_USER, NULL),
                         STATUS_OK);
        for (int pool = 0; pool < 2; pool++)
            before.plans[pool] = describe_plan(&before.settings, pool);
        for (const struct setting *row = settings_next(NULL); row; row = settings_next(row))
            check_row(row, &before);
        free(before.plans[0]);
        free(before.plans[1]);
    }
    assert_int_equal(affected, SETTING_AFFECTS_SCENE);
}

/* A change that affects no more than frames does not load the scene anew. */
static void test_no_row_says_too_much(void **state)
{
    struct settings before = settings_default(), after = before;
    (void)state;
    assert_int_equal(settings_changed(&before, &after), SETTING_AFFECTS_NOTHING);
    assert_int_equal(settings_assign(&after, "bump.strength=0.5", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_changed(&before, &after), SETTING_AFFECTS_FRAME);
    assert_int_equal(settings_assign(&after, "tonemap.curve=clip", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_changed(&before, &after), SETTING_AFFECTS_PLAN);
    assert_int_equal(settings_assign(&after, "bump.strength=0", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_changed(&before, &after), SETTING_AFFECTS_SCENE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_say_what_they_affect),
        cmocka_unit_test(test_no_row_says_too_much),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
