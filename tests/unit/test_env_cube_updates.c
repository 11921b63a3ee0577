/* Which faces of the environment cube are due, against a search through what moves. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "shaders/mesh_layout.h"
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
    const struct scene_params params = { .name = "sphere", .orbiting_ball_count = 5 };
    assert_int_equal(scene_load(&f->scene, &params), STATUS_OK);
    assert_int_equal(frame_cube_init(&f->cube, &f->scene), STATUS_OK);
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
    frame_cube_finish(&f->cube);
    scene_finish(&f->scene);
    free(f);
    return 0;
}

static uint32_t due(const struct fixture *f)
{
    const struct surroundings_push push = frame_view_push(&f->view);
    const struct globals globals = frame_view_globals(&f->view, &push);
    return frame_cube_due(&f->cube, &f->view, &globals).faces;
}

static struct frame_updates draw_all(struct fixture *f)
{
    const struct surroundings_push push = frame_view_push(&f->view);
    const struct globals globals = frame_view_globals(&f->view, &push);
    const struct frame_updates drawn = frame_cube_due(&f->cube, &f->view, &globals);
    frame_cube_mark_drawn(&f->cube, &f->view, &globals, drawn);
    return drawn;
}

/* The faces that a frame draws. */
static uint32_t draw(struct fixture *f)
{
    return draw_all(f).faces;
}

static void test_only_what_changes(void **state)
{
    struct fixture *f = *state;
    assert_int_equal(draw(f), FRAME_CUBE_ALL);
    assert_int_equal(draw(f), 0);
    f->view.camera.eye.x = 3.0f; /* the cube is seen from its own centre */
    change(f, "motion.ice=30");
    assert_int_equal(draw(f), 0);
    static const char *const lights[] = { "sky.strength=2", "sky.sun_azimuth=10",
                                          "sky.sun_strength=2" };
    for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++) {
        change(f, lights[i]);
        assert_int_equal(draw(f), FRAME_CUBE_ALL);
        assert_int_equal(draw(f), 0);
    }
    f->scene.background.color.y = 0.5f;
    assert_int_equal(draw(f), FRAME_CUBE_ALL);
    change(f, "env_cube.always=on");
    assert_int_equal(draw(f), FRAME_CUBE_ALL);
}

static void expect(struct fixture *f, uint32_t faces, bool light)
{
    const struct frame_updates drawn = draw_all(f);
    assert_int_equal(drawn.faces, faces);
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
    expect(f, FRAME_CUBE_ALL, true);
    expect(f, 0, false);
    f->view.camera.eye.x = 3.0f;
    f->view.width = 80;
    expect(f, 0, false);
    begin_sample(f, 1); /* another point of the sun: the faces have the first one's light */
    expect(f, 0, true);
    begin_sample(f, 0);
    expect(f, 0, true);
    change(f, "motion.ice=30");
    expect(f, FRAME_CUBE_ALL, true); /* settings may decide the light in ways not known here */
    f->view.time = 1.0f;             /* the object turns */
    expect(f, FRAME_CUBE_ALL, true);
    expect(f, 0, false);
    begin_sample(f, 1);
    f->view.time = 2.0f;
    expect(f, FRAME_CUBE_ALL, true);
    begin_sample(f, 0); /* not the light that faces have */
    expect(f, FRAME_CUBE_ALL, true);
}

/* Faces that see a corner of a moving triangle, by the largest part of its direction. */
static uint32_t see_corners(const struct fixture *f)
{
    const struct surroundings_push push = frame_view_push(&f->view);
    const struct globals globals = frame_view_globals(&f->view, &push);
    const struct mesh *mesh = &f->scene.model.surroundings;
    uint32_t faces = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (!(mesh->vertices[i].material & MESH_ORBITS))
            continue;
        const vec3s at = glms_vec3_sub(
            glms_mat4_mulv3(globals.world_from_movers, mesh->vertices[i].position, 1.0f),
            globals.center);
        int axis = fabsf(at.x) >= fabsf(at.y) ? 0 : 1;
        axis = fabsf(at.raw[axis]) >= fabsf(at.z) ? axis : 2;
        faces |= 1u << (2 * axis + (at.raw[axis] < 0.0f));
    }
    return faces;
}

static void test_where_things_move(void **state)
{
    struct fixture *f = *state;
    uint32_t seen[FRAME_CUBE_FACES] = { 0 }, spared = 0;
    change(f, "motion.objects=1");
    (void)draw(f);
    uint32_t before = see_corners(f);
    for (int i = 1; i < 720; i++) {
        f->view.time = 0.5f * (float)i;
        const uint32_t now = see_corners(f);
        const uint32_t faces = draw(f);
        assert_int_equal((before | now) & ~faces, 0);
        assert_int_equal(draw(f), 0);
        for (uint32_t face = 0; face < FRAME_CUBE_FACES; face++) {
            seen[face] += now >> face & 1;
            spared += !(faces >> face & 1);
        }
        assert_false(faces & 1u << 3); /* nothing ever is below */
        before = now;
    }
    assert_true(seen[0] > 0 && seen[1] > 0 && seen[4] > 0 && seen[5] > 0);
    print_message("%.2f faces of 6 are spared in a frame\n", spared / 719.0);
    assert_true(spared >= 719);
}

/* Of one thing that leaps: where it was, it is no longer, and the face has to say so. */
static void test_where_things_were(void **state)
{
    struct fixture *f = *state;
    struct scene scene = { 0 };
    const struct scene_params params = { .name = "sphere", .orbiting_ball_count = 1 };
    uint32_t leaps = 0;
    assert_int_equal(scene_load(&scene, &params), STATUS_OK);
    frame_cube_finish(&f->cube);
    assert_int_equal(frame_cube_init(&f->cube, &scene), STATUS_OK);
    scene_finish(&f->scene);
    f->scene = scene;
    change(f, "motion.objects=1");
    for (int i = 0; i < 8; i++) {
        f->view.time = 90.0f * (float)i;
        const uint32_t before = see_corners(f);
        (void)draw(f);
        f->view.time = 90.0f * (float)i + 180.0f;
        const uint32_t now = see_corners(f);
        assert_int_equal((before | now) & ~draw(f), 0);
        leaps += (before & now) == 0;
    }
    assert_true(leaps > 0);
}

static void test_in_turn(void **state)
{
    struct fixture *f = *state;
    f->cube.round_robin = true;
    change(f, "env_cube.faces=2");
    assert_int_equal(draw(f), FRAME_CUBE_ALL); /* nothing is there yet */
    change(f, "sky.strength=3");
    assert_int_equal(draw(f), 1 << 0 | 1 << 1);
    assert_int_equal(draw(f), 1 << 2 | 1 << 3);
    change(f, "sky.strength=4");
    assert_int_equal(draw(f), 1 << 4 | 1 << 5);
    assert_int_equal(draw(f), 1 << 0 | 1 << 1);
    assert_int_equal(draw(f), 1 << 2 | 1 << 3);
    assert_int_equal(draw(f), 0);
    change(f, "sky.strength=5");
    f->cube.round_robin = false;
    assert_int_equal(draw(f), FRAME_CUBE_ALL);
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
        assert_int_equal(due(f), 0);
    }
    f->view.camera.target = (vec3s){ { 2.9f, 0.0f, 0.0f } }; /* a part of it still is there */
    assert_int_equal(due(f), FRAME_CUBE_ALL);
    f->view.camera.eye = f->scene.box.max; /* in its sphere */
    f->view.camera.target = (vec3s){ { 9.0f, 9.0f, 9.0f } };
    assert_int_equal(due(f), FRAME_CUBE_ALL);
    f->view.camera = there;
    assert_int_equal(due(f), FRAME_CUBE_ALL);
}

static void test_nothing_moves(void **state)
{
    struct fixture *f = *state;
    struct scene scene = { 0 };
    const struct scene_params params = { .name = "sphere" };
    assert_int_equal(scene_load(&scene, &params), STATUS_OK);
    frame_cube_finish(&f->cube);
    assert_int_equal(frame_cube_init(&f->cube, &scene), STATUS_OK);
    f->view.scene = &scene;
    (void)draw(f);
    f->view.time = 3.0f;
    change(f, "motion.objects=50");
    assert_int_equal(draw(f), 0);
    scene_finish(&scene);
}

#define WITH_SCENE(test) cmocka_unit_test_setup_teardown(test, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCENE(test_only_what_changes), WITH_SCENE(test_light_through_the_object),
        WITH_SCENE(test_where_things_move), WITH_SCENE(test_where_things_were),
        WITH_SCENE(test_in_turn),           WITH_SCENE(test_object_out_of_the_picture),
        WITH_SCENE(test_nothing_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
