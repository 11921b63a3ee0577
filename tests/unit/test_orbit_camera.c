/* test_orbit_camera.c: how a hand moves a camera, and which key does what. */
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cglm/struct.h>
#include <math.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/view/key_bindings.h"
#include "src/view/orbit_camera.h"

static const double tolerance = 1e-4;

static struct camera camera_at(float azimuth_deg, float elevation_deg, float distance)
{
    return camera_orbit(azimuth_deg, elevation_deg, distance, (vec3s){ { 1, 2, 3 } }, 45);
}

static void check_near(vec3s a, vec3s b)
{
    for (int i = 0; i < 3; i++)
        CHECK_NEAR(a.raw[i], b.raw[i], tolerance);
}

static void turning_goes_around_the_target(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    orbit_camera_rotate(&camera, 30, -25);
    const struct camera wanted = camera_at(50, -15, 5);
    check_near(camera.eye, wanted.eye);
    check_near(camera.target, wanted.target);
    CHECK_NEAR(camera.fov_deg, 45, 0);
    orbit_camera_rotate(&camera, 360, 0);
    check_near(camera.eye, wanted.eye);
}

static void orthographic_cameras_stay_so(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    camera.height = 4;
    camera.depth = 50;
    const vec3s eye = camera.eye;
    orbit_camera_zoom(&camera, 1, 0.1F, 100);
    check_near(camera.eye, eye);
    CHECK_NEAR(camera.height, 3.6, tolerance);
    orbit_camera_zoom(&camera, -99, 0.1F, 40);
    CHECK_NEAR(camera.height, 40, tolerance);
    orbit_camera_pan(&camera, 0, 0.5F);
    CHECK_NEAR(glms_vec3_distance(camera.eye, eye), 20, tolerance);
    orbit_camera_rotate(&camera, 30, -25);
    CHECK_NEAR(camera.height, 40, tolerance);
    CHECK_NEAR(camera.depth, 50, 0);
}

static void looking_keeps_target_and_distance(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    orbit_camera_look_from(&camera, 90, 0);
    check_near(camera.eye, camera_at(90, 0, 5).eye);
    check_near(camera.target, camera_at(90, 0, 5).target);
    orbit_camera_look_from(&camera, 0, 90);
    check_near(camera.eye, camera_at(0, 89, 5).eye);
}

static void projecting_twice_is_the_camera_before(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    orbit_camera_toggle_projection(&camera, 70);
    CHECK_NEAR(camera.height, 10 * tan(22.5 * GLM_PI / 180), tolerance);
    CHECK_NEAR(camera.depth, 70, 0);
    orbit_camera_look_from(&camera, 90, 0);
    CHECK_NEAR(camera.depth, 70, 0);
    orbit_camera_zoom(&camera, 1, 0.1F, 100);
    orbit_camera_toggle_projection(&camera, 70);
    check_near(camera.eye, camera_at(90, 0, 4.5F).eye);
    CHECK_NEAR(camera.height, 0, 0);
}

static void every_action_has_words(void **state)
{
    (void)state;
    for (enum view_action a = VIEW_LEFT; a < VIEW_ACTION_COUNT; a++) {
        assert_non_null(key_bindings[a].keys);
        assert_true(strlen(key_bindings[a].label) <= 32); /* has room in F1 */
        assert_true(strlen(key_bindings_help(a)) >= strlen(key_bindings[a].label));
    }
}

static void turning_stops_short_of_the_poles(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    orbit_camera_rotate(&camera, 0, 200);
    check_near(camera.eye, camera_at(20, 89, 5).eye);
    orbit_camera_rotate(&camera, 0, -300);
    check_near(camera.eye, camera_at(20, -89, 5).eye);
    /* from the pole itself one can come back */
    camera = camera_at(0, 90, 5);
    orbit_camera_rotate(&camera, 0, -30);
    CHECK_NEAR(camera.eye.y, 2 + 5 * sin(60 * GLM_PI / 180), tolerance);
}

static void turning_puts_a_leaning_camera_upright(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    camera.up = (vec3s){ { 1, 1, 0 } };
    orbit_camera_rotate(&camera, 1, 0);
    CHECK_NEAR(camera_basis(&camera).right.y, 0, tolerance);
}

/* What lay in the middle of the picture lies half a height further left and up. */
static void panning_moves_by_heights_of_the_picture(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    const vec3s middle = camera.target;
    const vec3s away = glms_vec3_sub(camera.eye, camera.target);
    orbit_camera_pan(&camera, 0.5F, -0.5F);
    check_near(glms_vec3_sub(camera.eye, camera.target), away);
    const mat4s clip_from_world =
        camera_clip_from_world(&camera, 100, 100, 0.1F, (vec2s){ { 0, 0 } });
    const vec4s clip = glms_mat4_mulv(clip_from_world, glms_vec4(middle, 1));
    CHECK_NEAR(clip.x / clip.w, -1, tolerance);
    CHECK_NEAR(clip.y / clip.w, -1, tolerance);
}

static void zooming_keeps_the_target_and_its_limits(void **state)
{
    (void)state;
    struct camera camera = camera_at(20, 10, 5);
    orbit_camera_zoom(&camera, 2, 1, 100);
    check_near(camera.eye, camera_at(20, 10, 5 * 0.81F).eye);
    orbit_camera_zoom(&camera, -2, 1, 100);
    check_near(camera.eye, camera_at(20, 10, 5).eye);
    orbit_camera_zoom(&camera, 1000, 1, 100);
    check_near(camera.eye, camera_at(20, 10, 1).eye);
    orbit_camera_zoom(&camera, -1000, 1, 100);
    CHECK_NEAR(glms_vec3_distance(camera.eye, camera.target), 100, 1e-2);
    /* who starts beyond a limit does not jump, and may only come back */
    camera = camera_at(20, 10, 200);
    orbit_camera_zoom(&camera, -1, 1, 100);
    CHECK_NEAR(glms_vec3_distance(camera.eye, camera.target), 200, 1e-2);
    orbit_camera_zoom(&camera, 1, 1, 100);
    CHECK_NEAR(glms_vec3_distance(camera.eye, camera.target), 180, 1e-2);
}

static enum view_action find(int key, unsigned character, bool repeated)
{
    const struct key_press press = { .key = key, .character = character, .repeated = repeated };
    return key_bindings_find(&press);
}

/* With Ctrl. */
static enum view_action find_controlled(unsigned character)
{
    return key_bindings_find(&(struct key_press){ .character = character, .control = true });
}

static void control_makes_another_key(void **state)
{
    (void)state;
    assert_int_equal(find_controlled('+'), VIEW_LARGER);
    assert_int_equal(find_controlled('='), VIEW_LARGER);
    assert_int_equal(find_controlled('-'), VIEW_SMALLER);
    assert_int_equal(find_controlled('0'), VIEW_RESET_SIZE);
    assert_int_equal(find_controlled('s'), VIEW_SAVE_SESSION);
    assert_int_equal(find_controlled('e'), VIEW_ACTION_NONE);
    assert_int_equal(find_controlled('z'), VIEW_UNDO);
    struct key_press press = { .character = 'z', .control = true, .shift = true };
    assert_int_equal(key_bindings_find(&press), VIEW_REDO);
    press.character = '+'; /* shifted on this keyboard */
    assert_int_equal(key_bindings_find(&press), VIEW_LARGER);
    assert_int_equal(key_bindings_find(&(struct key_press){ .key = GLFW_KEY_F12, .control = true }),
                     VIEW_ACTION_NONE);
}

static void every_key_has_one_meaning(void **state)
{
    (void)state;
    assert_int_equal(find(GLFW_KEY_LEFT, 0, false), VIEW_LEFT);
    assert_int_equal(find(GLFW_KEY_LEFT, 0, true), VIEW_LEFT);
    assert_int_equal(find(GLFW_KEY_F12, 0, false), VIEW_SCREENSHOT);
    assert_int_equal(find(GLFW_KEY_F12, 0, true), VIEW_ACTION_NONE);
    assert_int_equal(find(0, 'q', false), VIEW_QUIT);
    assert_int_equal(find(0, '?', false), VIEW_HELP);
    assert_int_equal(find(0, ' ', true), VIEW_ACTION_NONE);
    assert_int_equal(find(0, '+', true), VIEW_ZOOM_IN);
    assert_int_equal(find(0, 0x263a, false), VIEW_ACTION_NONE);
    /* GLFW names letters by their capitals: those come as characters */
    assert_int_equal(find(GLFW_KEY_Q, 0, false), VIEW_ACTION_NONE);
    assert_int_equal(find(0, 0, false), VIEW_ACTION_NONE);
    /* Shift counts where it has a meaning of its own */
    assert_int_equal(find(0, 'e', true), VIEW_BRIGHTER);
    assert_int_equal(find(0, 'E', true), VIEW_DARKER);
    assert_int_equal(find(0, 'P', false), VIEW_SCREENSHOT);
    assert_int_equal(find(0, ',', true), VIEW_PREVIOUS_FRAME);
    assert_int_equal(find(0, 'd', false), VIEW_ERROR_MAP); /* not "drag" */
    const struct key_press shifted = { .key = GLFW_KEY_LEFT, .shift = true };
    assert_int_equal(key_bindings_find(&shifted), VIEW_LEFT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looking_keeps_target_and_distance),
        cmocka_unit_test(projecting_twice_is_the_camera_before),
        cmocka_unit_test(every_action_has_words),
        cmocka_unit_test(control_makes_another_key),
        cmocka_unit_test(turning_goes_around_the_target),
        cmocka_unit_test(orthographic_cameras_stay_so),
        cmocka_unit_test(turning_stops_short_of_the_poles),
        cmocka_unit_test(turning_puts_a_leaning_camera_upright),
        cmocka_unit_test(panning_moves_by_heights_of_the_picture),
        cmocka_unit_test(zooming_keeps_the_target_and_its_limits),
        cmocka_unit_test(every_key_has_one_meaning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
