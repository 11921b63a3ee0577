/* test_camera.c: projection of points to images and to cube map faces. */
#include "src/scene/camera.h"

#include <cglm/struct.h>
#include <math.h>

#include "tests/support/assertions.h"

static const vec2s still = { { 0, 0 } };

#define CHECK_VEC3(v, a, b, c) \
    do { \
        CHECK_NEAR((v).x, a, 1e-5); \
        CHECK_NEAR((v).y, b, 1e-5); \
        CHECK_NEAR((v).z, c, 1e-5); \
    } while (0)

/* x and y in clip space after the division, z the depth. */
static vec3s project(mat4s clip_from_world, vec3s p)
{
    vec4s clip = glms_mat4_mulv(clip_from_world, (vec4s){ { p.x, p.y, p.z, 1 } });
    assert_true(clip.w > 0);
    return glms_vec3_divs((vec3s){ { clip.x, clip.y, clip.z } }, clip.w);
}

static float dot(vec3s a, vec3s b)
{
    return glms_vec3_dot(a, b);
}

static float random_float(uint32_t *state)
{
    *state = *state * 1664525U + 1013904223U;
    return (float)(*state >> 8) / 8388608.0F - 1;
}

static void test_points_by_hand(void **state)
{
    (void)state;
    /* at (0, 0, 5) looking to the origin; 90 degrees: 1 up at distance 1 is the upper edge */
    struct camera camera = { .eye = { { 0, 0, 5 } }, .fov_deg = 90 };
    mat4s clip_from_world = camera_clip_from_world(&camera, 200, 100, 0.1F, still);
    vec3s p = project(clip_from_world, (vec3s){ { 0, 0, 0 } });
    CHECK_VEC3(p, 0, 0, 0.1 / 5);
    p = project(clip_from_world, (vec3s){ { 0, 2, 3 } });
    CHECK_VEC3(p, 0, -1, 0.1 / 2);
    p = project(clip_from_world, (vec3s){ { 2, -1, 3 } });
    CHECK_VEC3(p, 0.5, 0.5, 0.1 / 2);
    p = project(clip_from_world, (vec3s){ { 0, 0, 4.9F } });
    CHECK_VEC3(p, 0, 0, 1);
    p = project(clip_from_world, (vec3s){ { 0, 0, -1e9F } });
    CHECK_VEC3(p, 0, 0, 0);
    assert_true(p.z > 0);

    /* 60 degrees, tall picture, looking along -X from above the target's level */
    camera = (struct camera){ { { 9, 2, 1 } }, { { 4, 2, 1 } }, { { 0, 3, 0 } }, 60 };
    clip_from_world = camera_clip_from_world(&camera, 50, 100, 1, still);
    p = project(clip_from_world, (vec3s){ { -1, 7, -3 } });
    /* 10 away, 5 up, 4 to the right (-Z); tan 30 = 1 / sqrt 3 */
    CHECK_VEC3(p, 0.4 * sqrt(3) * 2, -0.5 * sqrt(3), 0.1);
}

static void check_square(struct camera_basis b)
{
    CHECK_NEAR(dot(b.right, b.right), 1, 1e-5);
    CHECK_NEAR(dot(b.up, b.up), 1, 1e-5);
    CHECK_NEAR(dot(b.forward, b.forward), 1, 1e-5);
    CHECK_NEAR(dot(b.right, b.up), 0, 1e-5);
    CHECK_NEAR(dot(b.right, b.forward), 0, 1e-5);
    CHECK_NEAR(dot(b.up, b.forward), 0, 1e-5);
}

static void test_basis(void **state)
{
    (void)state;
    uint32_t random = 1;
    for (int i = 0; i < 200; i++) {
        struct camera camera = { .fov_deg = 40 };
        for (int k = 0; k < 3; k++) {
            camera.eye.raw[k] = 10 * random_float(&random);
            camera.target.raw[k] = 10 * random_float(&random);
            camera.up.raw[k] = i % 2 ? 3 * random_float(&random) : 0;
        }
        struct camera_basis b = camera_basis(&camera);
        check_square(b);
        CHECK_NEAR(dot(glms_vec3_cross(b.right, b.up), b.forward), -1, 1e-5);
        assert_true(dot(b.forward, glms_vec3_sub(camera.target, camera.eye)) > 0);
        assert_true(dot(b.up, i % 2 ? camera.up : (vec3s){ { 0, 1, 0 } }) > 0);
    }
    /* along up, both ways, and along another up */
    static const vec3s ways[] = {
        { { 0, 1, 0 } }, { { 0, -1, 0 } }, { { 0, 0, 2 } }, { { 1, 1, 0 } }, { { -3, 0, 0 } },
    };
    for (size_t i = 0; i < sizeof(ways) / sizeof(*ways); i++) {
        struct camera camera = { .target = ways[i], .up = ways[i], .fov_deg = 40 };
        struct camera_basis b = camera_basis(&camera);
        check_square(b);
        CHECK_NEAR(dot(b.forward, ways[i]), glms_vec3_norm(ways[i]), 1e-5);
    }
}

static void check_jitter(const struct camera *camera)
{
    const float width = 320, height = 200;
    vec2s jitter = { { 0.375F, -0.25F } };
    mat4s plain = camera_clip_from_world(camera, 320, 200, 0.1F, still);
    mat4s moved = camera_clip_from_world(camera, 320, 200, 0.1F, jitter);
    uint32_t random = 2;
    for (int i = 0; i < 50; i++) {
        vec3s p = { { random_float(&random), random_float(&random), random_float(&random) } };
        vec3s before = project(plain, p);
        vec3s after = project(moved, p);
        /* samples go right and up, so the point goes left and down */
        CHECK_NEAR((after.x - before.x) * width / 2, -0.375, 1e-4);
        CHECK_NEAR((after.y - before.y) * height / 2, 0.25, 1e-4);
        CHECK_NEAR(after.z, before.z, 1e-7);
    }
}

static void test_jitter_is_in_pixels(void **state)
{
    (void)state;
    struct camera camera = camera_orbit(30, 20, 5, (vec3s){ { 0, 1, 0 } }, 50);
    check_jitter(&camera);
    camera.height = 4;
    camera.depth = 20;
    check_jitter(&camera);
}

static void test_view_looks_down_minus_z(void **state)
{
    (void)state;
    struct camera camera = { { { 1, 2, 3 } }, { { 1, 2, -7 } }, { { 0, 0, 0 } }, 30 };
    mat4s view_from_world = camera_view_from_world(&camera);
    vec4s p = glms_mat4_mulv(view_from_world, (vec4s){ { 2, 5, -4, 1 } });
    CHECK_VEC3(p, 1, 3, -7);
    CHECK_NEAR(p.w, 1, 0);

    camera = camera_orbit(-50, 35, 4, (vec3s){ { 1, 0, 2 } }, 30);
    view_from_world = camera_view_from_world(&camera);
    p = glms_mat4_mulv(view_from_world, (vec4s){ { 1, 0, 2, 1 } });
    CHECK_VEC3(p, 0, 0, -4);
    CHECK_NEAR(glms_mat4_det(view_from_world), 1, 1e-5);
}

/* Vulkan 1.3, table "Cube map face and coordinate selection", written down on its own. */
static uint32_t select_face(vec3s r, float *s, float *t)
{
    float ax = fabsf(r.x), ay = fabsf(r.y), az = fabsf(r.z);
    float sc, tc, ma;
    uint32_t face;
    if (az >= ax && az >= ay) {
        face = r.z > 0 ? 4 : 5;
        sc = r.z > 0 ? r.x : -r.x;
        tc = -r.y;
        ma = az;
    } else if (ay >= ax) {
        face = r.y > 0 ? 2 : 3;
        sc = r.x;
        tc = r.y > 0 ? r.z : -r.z;
        ma = ay;
    } else {
        face = r.x > 0 ? 0 : 1;
        sc = r.x > 0 ? -r.z : r.z;
        tc = -r.y;
        ma = ax;
    }
    *s = (sc / ma + 1) / 2;
    *t = (tc / ma + 1) / 2;
    return face;
}

static void test_cube_faces_follow_vulkan(void **state)
{
    (void)state;
    const vec3s center = { { 3, -1, 2 } };
    uint32_t random = 3;
    int seen[6] = { 0 };
    for (int i = 0; i < 600; i++) {
        vec3s r = { { random_float(&random), random_float(&random), random_float(&random) } };
        float s, t;
        uint32_t face = select_face(r, &s, &t);
        seen[face]++;
        mat4s clip_from_world = camera_cube_clip_from_world(face, center, 0.05F);
        vec3s p = project(clip_from_world, glms_vec3_muladds(r, 7, center));
        CHECK_NEAR((p.x + 1) / 2, s, 1e-4);
        CHECK_NEAR((p.y + 1) / 2, t, 1e-4);
        CHECK_NEAR(p.z * 7 * glms_vec3_max(glms_vec3_abs(r)), 0.05, 1e-5);

        struct camera_basis b = camera_cube_basis(face);
        check_square(b);
        CHECK_NEAR(dot(b.right, r) / dot(b.forward, r), 2 * s - 1, 1e-4);
        CHECK_NEAR(-dot(b.up, r) / dot(b.forward, r), 2 * t - 1, 1e-4);
        CHECK_NEAR(dot(glms_vec3_cross(b.right, b.up), b.forward), 1, 0);
    }
    for (int i = 0; i < 6; i++)
        assert_true(seen[i] > 50);
}

static void test_orbit_directions(void **state)
{
    (void)state;
    const vec3s target = { { 1, 2, 3 } };
    struct camera camera = camera_orbit(0, 0, 4, target, 35);
    CHECK_VEC3(camera.eye, 1, 2, 7);
    CHECK_VEC3(camera.target, 1, 2, 3);
    CHECK_NEAR(camera.fov_deg, 35, 0);
    camera = camera_orbit(90, 0, 4, target, 35);
    CHECK_VEC3(camera.eye, 5, 2, 3);
    camera = camera_orbit(-180, 0, 4, target, 35);
    CHECK_VEC3(camera.eye, 1, 2, -1);
    camera = camera_orbit(45, 30, 4, target, 35);
    CHECK_VEC3(camera.eye, 1 + sqrt(6), 4, 3 + sqrt(6));
    camera = camera_orbit(10, 90, 4, target, 35);
    CHECK_VEC3(camera.eye, 1, 6, 3);
    check_square(camera_basis(&camera));
}

/* Lengths whose squares are no floats. */
static void test_basis_of_any_length(void **state)
{
    (void)state;
    static const float lengths[] = { 1e-42F, 1e-30F, 1e-19F, 1, 1e19F, 1e30F };
    for (size_t i = 0; i < sizeof(lengths) / sizeof(lengths[0]); i++) {
        const float length = lengths[i];
        const struct camera camera = {
            .target = { { 0, 0, -length } },
            .up = { { 0, length, 0 } },
            .fov_deg = 45,
        };
        const struct camera_basis basis = camera_basis(&camera);
        CHECK_VEC3(basis.forward, 0, 0, -1);
        CHECK_VEC3(basis.up, 0, 1, 0);
        check_square(basis);
    }
}

static void test_framing_fills_the_smaller_side(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = { { 100, 100 }, { 300, 100 }, { 100, 300 } };
    const float diagonal = 3;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            float fov_deg = 10 + 40 * (float)k;
            float distance = camera_framing_distance(diagonal, fov_deg, sizes[i][0], sizes[i][1]);
            /* the angle of the sphere's outline against that of the picture's side */
            double half = tan((double)fov_deg * 3.14159265358979 / 360);
            if (sizes[i][0] < sizes[i][1])
                half *= (double)sizes[i][0] / sizes[i][1];
            double outline = asin((double)(diagonal / 2 / distance));
            assert_true(outline < atan(half));
            assert_true(outline > 0.6 * atan(half));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_by_hand),
        cmocka_unit_test(test_basis),
        cmocka_unit_test(test_jitter_is_in_pixels),
        cmocka_unit_test(test_view_looks_down_minus_z),
        cmocka_unit_test(test_cube_faces_follow_vulkan),
        cmocka_unit_test(test_orbit_directions),
        cmocka_unit_test(test_basis_of_any_length),
        cmocka_unit_test(test_framing_fills_the_smaller_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
