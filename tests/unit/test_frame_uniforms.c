/* test_frame_uniforms.c: uniform data of camera and time, against closed forms. */
#include <cglm/struct.h>
#include <math.h>

#include "shaders/inclusions/bubbles.h"
#include "shaders/lighting/ice_caustics.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/render/frame/pass_list.h"
#include "src/render/frame/thin_lens.h"
#include "src/tech/inclusions/bubbles.h"
#include "src/tech/lighting/ice_caustics.h"
#include "tests/support/assertions.h"

static const vec3s center = { { 0.0f, 0.0f, 0.0f } };

static struct camera at_distance(float distance)
{
    return (struct camera){ .eye = { { 0.0f, 0.0f, distance } }, .fov_deg = 45.0f };
}

/* Depth of what lies `distance` metres before the eye. */
static double depth_at(const struct camera *camera, mat4s clip_from_world, float distance)
{
    const vec4s point = { { 0.0f, 0.0f, camera->eye.z - distance, 1.0f } };
    const vec4s clip = glms_mat4_mulv(clip_from_world, point);
    return (double)clip.z / (double)clip.w;
}

static mat4s fitted(const struct camera *camera, float radius, vec2s *planes)
{
    const mat4s clip = camera_clip_from_world(camera, 64, 64, 0.1f, (vec2s){ { 0.0f, 0.0f } });
    return frame_view_fit(camera, clip, center, radius, planes);
}

static void test_planes_touch_the_sphere(void **state)
{
    (void)state;
    const struct camera camera = at_distance(5.0f);
    vec2s planes;
    const mat4s clip = fitted(&camera, 1.0f, &planes);
    assert_float_equal(planes.x, 4.0f, 1e-6);
    assert_float_equal(planes.y, 6.0f, 1e-6);
    assert_float_equal(depth_at(&camera, clip, 4.0f), 0.0, 1e-6);
    assert_float_equal(depth_at(&camera, clip, 6.0f), 1.0, 1e-6);
}

/* How far depth rises for each metre, 5 metres away: planes 0.1 and 100 m away against fitted ones
 * (an object with a box of diagonal 2 m). */
static void test_fitted_depth_is_finer(void **state)
{
    (void)state;
    const struct camera camera = at_distance(5.0f);
    vec2s planes;
    const mat4s near_by = fitted(&camera, 1.0f, &planes);
    const double step = 0.25;
    const double fine =
        (depth_at(&camera, near_by, 5.25f) - depth_at(&camera, near_by, 5.0f)) / step;
    const double near = 0.1;
    const double far = 100.0;
    const double before = far / (far - near) * (1.0 - near / 5.0);
    const double after = far / (far - near) * (1.0 - near / 5.25);
    const double coarse = (after - before) / step;
    print_message("%.1f times finer\n", fine / coarse);
    assert_true(fine / coarse >= 100.0);
}

static void test_eye_inside(void **state)
{
    (void)state;
    const struct camera camera = at_distance(0.25f);
    vec2s planes;
    const mat4s clip = fitted(&camera, 1.0f, &planes);
    assert_true(planes.x > 0.0f && planes.x < 0.01f);
    assert_float_equal(planes.y, 1.25f, 1e-6);
    assert_float_equal(depth_at(&camera, clip, 1.25f), 1.0, 1e-5);
    const struct camera behind = { .eye = { { 0.0f, 0.0f, -3.0f } }, /* and looks away from it */
                                   .target = { { 0.0f, 0.0f, -9.0f } },
                                   .fov_deg = 45.0f };
    (void)fitted(&behind, 1.0f, &planes);
    assert_true(planes.x > 0.0f && planes.y > planes.x);
}

/* Where a point is in a picture, pixels. */
static vec2s pixel_of(const struct frame_view *view, vec3s point)
{
    const mat4s clip_from_world =
        camera_clip_from_world(&view->camera, view->width, view->height, 0.01F, view->jitter);
    const vec4s clip = glms_mat4_mulv(clip_from_world, glms_vec4(point, 1));
    return (vec2s){ { (clip.x / clip.w + 1) / 2 * (float)view->width,
                      (clip.y / clip.w + 1) / 2 * (float)view->height } };
}

/* Points of a sphere's surface lie inside, with a texel around them; some close to each edge. */
static void check_reach(const struct frame_view *view, const struct globals *globals, float radii)
{
    const VkRect2D reach = frame_view_reach(view, globals, radii);
    const float left = (float)reach.offset.x, top = (float)reach.offset.y;
    const float right = left + (float)reach.extent.width, low = top + (float)reach.extent.height;
    float ends[4] = { 1e9F, 1e9F, -1e9F, -1e9F };
    for (uint32_t i = 0; i < 64 * 32; i++) {
        const uint32_t row = i / 64;
        const float across = (float)(i % 64) / 64 * 6.2831853F;
        const float up = (float)row / 31 * 3.14159F;
        const vec3s dir = { { sinf(up) * cosf(across), cosf(up), sinf(up) * sinf(across) } };
        const float radius = globals->radius * (radii > 0 ? radii : 1) * 1.02F;
        const vec3s point = glms_vec3_add(globals->center, glms_vec3_scale(dir, radius));
        const vec2s p = pixel_of(view, point);
        if (p.x >= 0 && p.x < (float)view->width && p.y >= 0 && p.y < (float)view->height)
            assert_true(p.x >= left && p.x <= right && p.y >= top && p.y <= low);
        ends[0] = fminf(ends[0], p.x);
        ends[1] = fminf(ends[1], p.y);
        ends[2] = fmaxf(ends[2], p.x);
        ends[3] = fmaxf(ends[3], p.y);
    }
    const float room = 0.04F * (ends[2] - ends[0]) + 8;
    assert_true(left == 0 || fabsf(left - ends[0]) < room);
    assert_true(top == 0 || fabsf(top - ends[1]) < room);
    assert_true(right == (float)view->width || fabsf(right - ends[2]) < room);
    assert_true(low == (float)view->height || fabsf(low - ends[3]) < room);
    assert_int_equal(reach.offset.x % 2 + reach.offset.y % 2, 0);
}

static void test_reach_holds_the_sphere(void **state)
{
    (void)state;
    const struct globals globals = { .center = { { 0.5F, 1, -2 } }, .radius = 0.75F };
    for (int i = 0; i < 60; i++) {
        const float turn = (float)i * 0.7F;
        const float distance = 2 + 0.1F * (float)i;
        struct globals seen = globals;
        const vec3s eye = { { 0.5F + distance * cosf(turn), 1 + 0.5F * sinf(3 * turn),
                              -2 + distance * sinf(turn) } };
        const struct frame_view view = {
            .camera = { .eye = eye,
                        .target = { { 0.5F + sinf(turn), 1 + 0.4F * cosf(turn), -2 } },
                        .fov_deg = 30 + (float)(i % 7) * 10 },
            .width = 501,
            .height = i % 2 ? 300 : 700,
            .jitter = { { 0.45F, -0.45F } },
        };
        seen.eye = eye;
        check_reach(&view, &seen, i % 3 ? 0 : 1.5F);
    }
}

/* A pixel of what is beside the picture or behind the eye, or all. */
static void test_reach_without_a_sphere(void **state)
{
    (void)state;
    const struct frame_view view = {
        .camera = { .target = { { 0, 0, -1 } }, .fov_deg = 45 },
        .width = 64,
        .height = 48,
    };
    struct globals globals = { .center = { { 0, 0, -0.5F } }, .radius = 1 };
    VkRect2D reach = frame_view_reach(&view, &globals, 0);
    assert_int_equal(reach.extent.width, 64); /* around the eye */
    assert_int_equal(reach.extent.height, 48);
    globals.center = (vec3s){ { 50, 0, -5 } };
    reach = frame_view_reach(&view, &globals, 0);
    assert_int_equal(reach.offset.x, 63);
    assert_int_equal(reach.extent.width, 1);
    globals.center = (vec3s){ { 0, 50, -5 } };
    reach = frame_view_reach(&view, &globals, 0);
    assert_int_equal(reach.offset.y, 0);
    assert_true(reach.extent.height >= 1 && reach.extent.height < 8);
}

/* A ball of radius 1 that a camera frames, or that leaves the picture, or is near. */
static void test_beyond(void **state)
{
    static const struct {
        vec3s eye;
        bool is_beyond;
    } cases[] = {
        { { { 0, 0, 4 } }, false }, { { { 0, 0, 2.2F } }, true }, { { { 0, 1, 4 } }, true },
        { { { 2, 0, 5 } }, true },  { { { 0, 0, 0.5F } }, true },
    };

    const float half = 1 / sqrtf(3);
    const struct scene scene = { .box = { { { -half, -half, -half } }, { { half, half, half } } } };
    (void)state;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const vec3s eye = cases[i].eye;
        const struct frame_view view = {
            .scene = &scene,
            .camera = { .eye = eye, .target = { { eye.x, eye.y, 0 } }, .fov_deg = 45 },
            .width = 64,
            .height = 48,
        };
        assert_int_equal(frame_view_exceeds_image(&view), cases[i].is_beyond);
    }
}

/* The corners' pixels lie inside, the outermost close to each edge. */
static void check_object_area(const struct frame_view *view, const struct globals *globals,
                              VkExtent2D size)
{
    const VkRect2D area = frame_view_box_area(view, globals, view->scene->box, size, 0.0f);
    const struct box *box = &view->scene->box;
    float ends[4] = { 1e9f, 1e9f, -1e9f, -1e9f };
    for (int i = 0; i < 8; i++) {
        const vec3s corner = { { i & 1 ? box->max.x : box->min.x, i & 2 ? box->max.y : box->min.y,
                                 i & 4 ? box->max.z : box->min.z } };
        const vec2s p = pixel_of(view, glms_mat4_mulv3(globals->world_from_object, corner, 1.0f));
        const float x = p.x * (float)size.width / (float)view->width;
        const float y = p.y * (float)size.height / (float)view->height;
        ends[0] = fminf(ends[0], x);
        ends[1] = fminf(ends[1], y);
        ends[2] = fmaxf(ends[2], x);
        ends[3] = fmaxf(ends[3], y);
    }
    const float left = (float)area.offset.x, top = (float)area.offset.y;
    assert_true(left <= fmaxf(ends[0], 0.0f) && left >= ends[0] - 4);
    assert_true(top <= fmaxf(ends[1], 0.0f) && top >= ends[1] - 4);
    const float right = left + (float)area.extent.width, low = top + (float)area.extent.height;
    assert_true(right >= fminf(ends[2], (float)size.width) && right <= ends[2] + 4);
    assert_true(low >= fminf(ends[3], (float)size.height) && low <= ends[3] + 4);
}

static void test_object_area_holds_the_box(void **state)
{
    (void)state;
    const struct settings settings = settings_default();
    const struct scene scene = { .box = { { { -0.5f, 0.2f, -0.3f } }, { { 0.7f, 1.0f, 0.4f } } } };
    for (int i = 0; i < 40; i++) {
        const float turn = 0.7f * (float)i;
        const struct frame_view view = {
            .scene = &scene,
            .settings = &settings,
            .camera = { .eye = { { 3 * cosf(turn), 1 + sinf(3 * turn), 3 * sinf(turn) } },
                        .target = { { 0.3f * sinf(turn), 0.5f, 0 } },
                        .fov_deg = 30 + (float)(i % 7) * 10 },
            .width = 640,
            .height = i % 2 ? 480 : 960,
        };
        const struct globals globals = {
            .clip_from_world = frame_view_push(&view).clip_from_world,
            .world_from_object =
                glms_rotate(glms_mat4_identity(), 0.3f * turn, (vec3s){ { 0, 1, 0 } }),
            .radius = 1,
        };
        check_object_area(&view, &globals, (VkExtent2D){ view.width, view.height });
        check_object_area(&view, &globals, (VkExtent2D){ view.width / 2, view.height / 3 });
    }
}

static void test_object_area_around_the_eye(void **state)
{
    (void)state;
    const struct settings settings = settings_default();
    const struct scene scene = { .box = { { { -1, -1, -1 } }, { { 1, 1, 1 } } } };
    const struct frame_view view = {
        .scene = &scene,
        .settings = &settings,
        .camera = { .target = { { 0, 0, -1 } }, .fov_deg = 45 },
        .width = 64,
        .height = 48,
    };
    const struct globals globals = {
        .clip_from_world = frame_view_push(&view).clip_from_world,
        .world_from_object = glms_mat4_identity(),
        .radius = 1.7f,
    };
    const VkRect2D area =
        frame_view_box_area(&view, &globals, view.scene->box, (VkExtent2D){ 32, 48 }, 0.0f);
    assert_int_equal(area.offset.x, 0);
    assert_int_equal(area.offset.y, 0);
    assert_int_equal(area.extent.width, 32);
    assert_int_equal(area.extent.height, 48);
}

/* The third is behind the second one's rim, though its centre is nearer to the eye. */
static void test_bubbles_are_sorted(void **state)
{
    (void)state;
    struct bubbles_drawn spheres[3] = {
        { { { 0.0f, 0.0f, 0.9f } }, 0.05f },
        { { { 0.0f, 0.0f, 0.0f } }, 0.8f },
        { { { 0.9f, 0.0f, 0.15f } }, 0.1f },
    };
    struct bubble all[3];
    for (int i = 0; i < 3; i++)
        all[i] = (struct bubble){ spheres[i].center, spheres[i].radius };
    const struct scene scene = { .inclusions.bubbles = { all, 3 } };
    const struct frame_view view = { .scene = &scene };
    struct bubbles_drawn sorted[3];
    struct globals globals = { .world_from_object = glms_mat4_identity(),
                               .eye = { { 0.0f, 0.0f, 3.0f } } };
    bubbles_write(sorted, &view, &globals);
    assert_memory_equal(&sorted[0], &spheres[2], sizeof(sorted[0]));
    assert_memory_equal(&sorted[1], &spheres[1], sizeof(sorted[0]));
    assert_memory_equal(&sorted[2], &spheres[0], sizeof(sorted[0]));
    globals.world_from_object = glms_rotate_y(glms_mat4_identity(), 3.14159265f);
    bubbles_write(sorted, &view, &globals);
    assert_float_equal(sorted[0].radius, 0.05f, 0.0f);
    assert_float_equal(sorted[0].center.z, -0.9f, 1e-6);
    assert_float_equal(sorted[1].radius, 0.1f, 0.0f);
    assert_float_equal(sorted[1].center.x, -0.9f, 1e-6);
    assert_float_equal(sorted[2].radius, 0.8f, 0.0f);
}

/* The sun looks at the middle of the object, whatever the view is and in what tiles it is drawn. */
static void test_sun_sees_all_of_it(void **state)
{
    (void)state;
    const struct settings settings = settings_default();
    const struct scene scene = { .box = { { { -1, -1, -1 } }, { { 1, 1, 1 } } } };
    const struct frame_view view = {
        .scene = &scene,
        .settings = &settings,
        .jitter = { { 300, -200 } },
        .lod_bias = -3,
    };
    const struct globals globals = {
        .sun_dir = { { 0.6F, 0.8F, 0 } },
        .radius = 2,
        .lod_bias = -3,
    };
    struct globals sun;
    struct ice_caustics_light map;
    ice_caustics_write_globals(&sun, &view, &globals);
    ice_caustics_write_light(&map, &view, &globals);
    const vec4s middle = { { 0, 0, 0, 1 } };
    const vec4s clip = glms_mat4_mulv(sun.clip_from_world, middle);
    const vec4s edge = glms_mat4_mulv(map.clip_from_world, (vec4s){ { 0, 0, 2, 1 } });
    CHECK_NEAR(clip.x / clip.w, 0, 1e-3);
    CHECK_NEAR(clip.y / clip.w, 0, 1e-3);
    CHECK_NEAR(fmax(fabs((double)edge.x), fabs((double)edge.y)) / (double)edge.w,
               1 / (1.02 * (double)map.reach), 1e-3);
    CHECK_NEAR(sun.lod_bias, 0, 0);
    CHECK_NEAR(glms_vec3_norm(sun.eye) / 2, 1000, 1);
}

/* A small picture of a large environment reads the mip whose texels are as large as its pixels. */
static void test_environment_lod(void **state)
{
    (void)state;
    const struct settings settings = settings_default();
    struct scene scene = { .background.environment = { .width = 8192, .height = 4096 },
                           .box = { { { -1, -1, -1 } }, { { 1, 1, 1 } } } };
    struct frame_view view = {
        .scene = &scene,
        .settings = &settings,
        .camera = { .eye = { { 0, 0, 4 } }, .fov_deg = 90 },
        .width = 64,
        .height = 64,
        .face_size = 512,
    };
    const double texel = 2 * acos(-1) / 8192;
    CHECK_NEAR(frame_view_push(&view).environment_lod, log2(2.0 / 64 / texel), 1e-4);
    CHECK_NEAR(frame_view_face(&view, 0).environment_lod, log2(2.0 / 512 / texel), 1e-4);
    view.height = 8192; /* pixels are smaller than texels */
    CHECK_NEAR(frame_view_push(&view).environment_lod, 0, 0);
    scene.background.environment.width = 0;
    view.height = 64;
    CHECK_NEAR(frame_view_push(&view).environment_lod, 0, 0);
}

/* The faces of the environment cube are about as wide as the picture is high. */
static void test_faces_by_height(void **state)
{
    static const uint32_t sizes[][2] = {
        { 1, 128 },    { 142, 128 },   { 143, 256 },   { 480, 512 },
        { 768, 1024 }, { 1080, 1024 }, { 2160, 2048 }, { 65536, 2048 },
    };
    struct settings settings = settings_default();
    (void)state;
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++)
        assert_int_equal(frame_face_size(&settings, sizes[i][0]), sizes[i][1]);
    const struct settings settled =
        frame_resolve_settings(&settings, &(struct scene){ 0 }, NULL, 768);
    assert_int_equal(frame_face_size(&settled, 1), 1024);
    assert_int_equal(settings_assign(&settings, "env_cube.size=64", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(frame_face_size(&settings, 768), 64);
    assert_int_equal(settings_assign(&settings, "env_cube.size=auto", SETTING_USER, NULL),
                     STATUS_OK);
    assert_int_equal(frame_face_size(&settings, 768), 1024);
    assert_int_equal(settings_assign(&settings, "env_cube.size=15", SETTING_USER, NULL),
                     STATUS_USAGE);
}

/* Every sample sees the point that is in focus at the same place, from another point of the lens;
 * the first one from its middle. */
static void test_lens_keeps_the_focus(void **state)
{
    (void)state;
    struct settings settings = settings_default();
    struct scene scene = { .box = { { { -1.0f, -1.0f, -1.0f } }, { { 1.0f, 1.0f, 1.0f } } } };
    float widest = 0.0f;
    assert_int_equal(settings_assign(&settings, "lens.f_stop=4", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&settings, "lens.focus=3", SETTING_USER, NULL), STATUS_OK);
    for (uint32_t sample = 0; sample < 64; sample++) {
        struct frame_view view = { .scene = &scene,
                                   .settings = &settings,
                                   .camera = at_distance(5.0f),
                                   .width = 64,
                                   .height = 48,
                                   .sample = sample };
        const vec4s focus = { { 0.4f, -0.3f, 2.0f, 1.0f } };
        const mat4s before = frame_view_push(&view).clip_from_world;
        frame_lens_apply(&view);
        const vec4s moved = glms_mat4_mulv(frame_view_push(&view).clip_from_world, focus);
        const vec4s middle = glms_mat4_mulv(before, focus);
        assert_float_equal(moved.x / moved.w, middle.x / middle.w, 1e-5);
        assert_float_equal(moved.y / moved.w, middle.y / middle.w, 1e-5);
        const float aside = hypotf(view.camera.eye.x, view.camera.eye.y);
        assert_true(sample || aside == 0.0f);
        widest = fmaxf(widest, aside);
    }
    /* 36 mm wide, 45 degrees high at 3 to 4: the focal length, by 2 f-stops */
    const float radius = 0.018f / (tanf(0.3926991f) * 4.0f / 3.0f) / 8.0f;
    assert_true(widest <= 1.0001f * radius && widest > 0.9f * radius);
}

static void test_directions_of_the_sun(void **state)
{
    (void)state;

    static const struct {
        float azimuth, elevation;
        vec3s direction;
    } rows[] = { { 0, 0, { { 0, 0, 1 } } },
                 { 90, 0, { { 1, 0, 0 } } },
                 { -90, 60, { { -0.5F, 0.866025F, 0 } } } };

    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const vec3s found = environment_direction(rows[i].azimuth, rows[i].elevation);
        CHECK_NEAR(glms_vec3_distance(found, rows[i].direction), 0, 1e-5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_environment_lod),
        cmocka_unit_test(test_faces_by_height),
        cmocka_unit_test(test_planes_touch_the_sphere),
        cmocka_unit_test(test_fitted_depth_is_finer),
        cmocka_unit_test(test_eye_inside),
        cmocka_unit_test(test_reach_holds_the_sphere),
        cmocka_unit_test(test_reach_without_a_sphere),
        cmocka_unit_test(test_beyond),
        cmocka_unit_test(test_object_area_holds_the_box),
        cmocka_unit_test(test_object_area_around_the_eye),
        cmocka_unit_test(test_bubbles_are_sorted),
        cmocka_unit_test(test_sun_sees_all_of_it),
        cmocka_unit_test(test_lens_keeps_the_focus),
        cmocka_unit_test(test_directions_of_the_sun),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
