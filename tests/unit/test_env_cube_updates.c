/*
 * test_env_cube_updates.c: conditions under which the environment cube and the caustic maps are
 * redrawn.
 */
#include <cglm/struct.h>
#include <stdlib.h>
#include "src/render/frame/env_cube_updates.h"
#include "tests/support/assertions.h"

struct fixture {
    struct scene scene;
    struct settings settings;
    struct frame_cube cube;
    struct frame_view view;
};

static void change(struct fixture *f, const char *assignment)
{
    assert_int_equal(settings_assign(&f->settings, assignment, SETTING_USER, NULL), STATUS_OK);
}

static int setup(void **state)
{
    struct fixture *f = calloc(1, sizeof(*f));
    assert_non_null(f);
    f->settings = settings_default();
    const struct scene_params params = { .name = "sphere" };
    assert_int_equal(scene_load(&f->scene, &params), STATUS_OK);
    f->view = (struct frame_view){
        .scene = &f->scene,
        .settings = &f->settings,
        .camera = { .eye = { { 0.0f, 1.0f, 6.0f } }, .fov_deg = 40.0f },
        .width = 64,
        .height = 48,
    };
    *state = f;
    return 0;
}

static int teardown(void **state)
{
    struct fixture *f = *state;
    scene_finish(&f->scene);
    free(f);
    return 0;
}

static bool due(const struct fixture *f)
{
    const struct surroundings_push push = frame_view_push(&f->view);
    const struct globals globals = frame_view_globals(&f->view, &push);
    return frame_cube_due(&f->cube, &f->view, &globals).cube;
}

static struct frame_updates draw_all(struct fixture *f)
{
    const struct surroundings_push push = frame_view_push(&f->view);
    const struct globals globals = frame_view_globals(&f->view, &push);
    const struct frame_updates drawn = frame_cube_due(&f->cube, &f->view, &globals);
    frame_cube_mark_drawn(&f->cube, &f->view, &globals, drawn);
    return drawn;
}

/* Whether a frame draws the cube. */
static bool draw(struct fixture *f)
{
    return draw_all(f).cube;
}

static void test_only_what_changes(void **state)
{
    struct fixture *f = *state;
    assert_true(draw(f));
    assert_false(draw(f));
    f->view.camera.eye.x = 3.0f; /* the cube is seen from its own centre */
    change(f, "motion.ice=30");
    assert_false(draw(f));
    static const char *const lights[] = { "sky.strength=2", "sky.sun_azimuth=10",
                                          "sky.sun_strength=2" };
    for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++) {
        change(f, lights[i]);
        assert_true(draw(f));
        assert_false(draw(f));
    }
    f->scene.background.color.y = 0.5f;
    assert_true(draw(f));
    change(f, "env_cube.always=on");
    assert_true(draw(f));
}

static void expect(struct fixture *f, bool cube, bool light)
{
    const struct frame_updates drawn = draw_all(f);
    assert_int_equal(drawn.cube, cube);
    assert_int_equal(drawn.light, light);
}

static void begin_sample(struct fixture *f, uint32_t sample)
{
    f->view.sample = sample;
    f->view.light_jitter.x = 0.25f * (float)sample;
}

static void test_light_through_the_object(void **state)
{
    struct fixture *f = *state;
    change(f, "ice_caustics.light=sun");
    expect(f, true, true);
    expect(f, false, false);
    f->view.camera.eye.x = 3.0f;
    f->view.width = 80;
    expect(f, false, false);
    begin_sample(f, 1); /* another point of the sun: the cube has the first one's light */
    expect(f, false, true);
    begin_sample(f, 0);
    expect(f, false, true);
    change(f, "motion.ice=30");
    expect(f, true, true); /* settings may decide the light in ways not known here */
    f->view.time = 1.0f;   /* the object turns */
    expect(f, true, true);
    expect(f, false, false);
    begin_sample(f, 1);
    f->view.time = 2.0f;
    expect(f, true, true);
    begin_sample(f, 0); /* not the light that the cube has */
    expect(f, true, true);
}

static void test_what_orbits(void **state)
{
    struct fixture *f = *state;
    (void)draw(f);
    f->view.time = 3.0f;
    assert_false(draw(f)); /* nothing does */
    change(f, "motion.count=5");
    assert_true(draw(f));
    assert_false(draw(f));
    f->view.time = 4.0f;
    assert_true(draw(f));
    assert_false(draw(f));
}

/* What nobody sees waits. */
static void test_object_out_of_the_picture(void **state)
{
    struct fixture *f = *state;
    const struct camera there = f->view.camera;
    const vec3s targets[] = { { { 9.0f, 1.0f, 6.0f } },
                              { { -9.0f, 1.0f, 6.0f } },
                              { { 0.0f, 9.0f, 6.0f } },
                              { { 0.0f, 1.0f, 9.0f } } };
    for (size_t i = 0; i < sizeof(targets) / sizeof(targets[0]); i++) {
        f->view.camera.target = targets[i];
        assert_false(due(f));
    }
    f->view.camera.target = (vec3s){ { 2.9f, 0.0f, 0.0f } }; /* a part of it still is there */
    assert_true(due(f));
    f->view.camera.eye = f->scene.box.max; /* in its sphere */
    f->view.camera.target = (vec3s){ { 9.0f, 9.0f, 9.0f } };
    assert_true(due(f));
    f->view.camera = there;
    assert_true(due(f));
}

#define WITH_SCENE(test) cmocka_unit_test_setup_teardown(test, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCENE(test_only_what_changes),
        WITH_SCENE(test_light_through_the_object),
        WITH_SCENE(test_what_orbits),
        WITH_SCENE(test_object_out_of_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
