/* test_framing.c: framing of a model file by the default camera. */
#include "src/scene/geometry/framing.h"

#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "tests/support/assertions.h"

static const vec3s no_size = { { 0, 0, 0 } };

/* A mesh of `count` vertices: the corners of a box first, then points of its inscribed ellipsoid,
 * or those alone if `is_round`. */
static struct mesh make_mesh(vec3s center, vec3s half, uint32_t count, bool is_round)
{
    struct mesh mesh;
    assert_true(mesh_init(&mesh, count, 3));
    srand(1);
    for (uint32_t i = 0; i < count; i++) {
        vec3s p = { { i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1 } };
        if (is_round || i >= 8) {
            for (int k = 0; k < 3; k++)
                p.raw[k] = 2 * (float)rand() / (float)RAND_MAX - 1;
            p = glms_vec3_normalize(p);
        }
        mesh.vertices[i].position = glms_vec3_add(center, glms_vec3_mul(half, p));
    }
    return mesh;
}

/* Checks the projected bounds of a mesh, -1 to 1: the larger is two thirds, both are centred. */
static void check_bounds(const struct mesh *mesh, const struct camera *camera, float aspect)
{
    const mat4s clip =
        camera_clip_from_world(camera, (uint32_t)(1000 * aspect), 1000, 0.01F, (vec2s){ 0 });
    vec2s min = { { 9, 9 } };
    vec2s max = { { -9, -9 } };
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const vec4s p = glms_mat4_mulv(clip, glms_vec4(mesh->vertices[i].position, 1));
        assert_true(p.w > 0);
        min = glms_vec2_minv(min, (vec2s){ { p.x / p.w, p.y / p.w } });
        max = glms_vec2_maxv(max, (vec2s){ { p.x / p.w, p.y / p.w } });
    }
    CHECK_NEAR(fmaxf(max.x - min.x, max.y - min.y) / 2, 0.66, 0.007);
    CHECK_NEAR((min.x + max.x) / 2, 0, 0.007);
    CHECK_NEAR((min.y + max.y) / 2, 0, 0.007);
}

static void test_bounds_of_all_shapes(void **state)
{
    (void)state;
    static const vec3s halves[] = { { { 1, 1, 1 } }, { { 1, 0.7F, 0 } }, { { 2, 0.01F, 0.01F } },
                                    { { 3, 0, 2 } }, { { 0.1F, 5, 1 } }, { { 0, 0, 1 } } };
    static const float aspects[] = { 0.5F, 0.75F, 1, 1.6F, 2.5F };
    static const float fovs[] = { 0, 10, 25, 40 };
    for (int i = 0; i < 6 * 5 * 4 * 2; i++) {
        const struct mesh mesh =
            make_mesh((vec3s){ { 4, -3, 2 } }, halves[i % 6], 2000, i / 120 > 0);
        const struct framing_view view = { .fov_deg = fovs[i / 6 % 4],
                                           .aspect = aspects[i / 24 % 5] };
        struct framing framing;
        framing_init(&framing, &mesh, &(struct mesh){ 0 });
        const struct camera camera = framing_camera(&framing, &view);
        CHECK_NEAR(camera.fov_deg, view.fov_deg > 0 ? view.fov_deg : 24, 1e-6);
        check_bounds(&mesh, &camera, view.aspect);
        struct mesh copy = mesh;
        mesh_finish(&copy);
    }
}

/* Checks which of an object and opaque geometry is framed. */
static struct framing frame_both(vec3s center, vec3s half)
{
    struct mesh object = make_mesh(no_size, (vec3s){ { 1, 1, 1 } }, 500, false);
    struct mesh opaque = make_mesh(center, half, 500, false);
    struct framing framing;
    framing_init(&framing, &object, &opaque);
    mesh_finish(&object);
    mesh_finish(&opaque);
    return framing;
}

static void test_a_room_is_not_framed(void **state)
{
    (void)state;
    const vec3s above = { { 0, 2, 0 } };
    const vec3s below = { { 0, -1.1F, 0 } };
    const struct framing_view view = { .aspect = 1.5F };
    struct framing framing = frame_both(above, (vec3s){ { 0.5F, 1, 0.5F } });
    CHECK_NEAR(framing.box.max.y, 3, 1e-6);
    framing = frame_both(no_size, (vec3s){ { 3, 3, 9 } }); /* not wide enough */
    CHECK_NEAR(framing.box.max.z, 9, 1e-6);
    framing = frame_both(above, (vec3s){ { 9, 1, 9 } }); /* a roof */
    CHECK_NEAR(framing.box.max.x, 9, 1e-6);
    framing = frame_both(below, (vec3s){ { 9, 0.1F, 9 } }); /* a floor */
    CHECK_NEAR(framing.box.max.x, 1, 1e-6);
    CHECK_NEAR(framing_camera(&framing, &view).fov_deg, 24, 1e-6);
    framing = frame_both(no_size, (vec3s){ { 6, 4, 6 } }); /* a room, which the camera is in */
    const struct camera camera = framing_camera(&framing, &view);
    CHECK_NEAR(framing.box.max.x, 1, 1e-6);
    assert_true(camera.fov_deg > 24);
    assert_true(fmaxf(fabsf(camera.eye.x), fabsf(camera.eye.z)) < 6);
}

static void test_target_and_rotation(void **state)
{
    (void)state;
    const vec3s half = { { 0, 1, 2 } };
    const vec3s target = { { 0, 1, 2 } };
    struct mesh mesh = make_mesh(no_size, half, 8, false);
    struct framing framing;
    framing_init(&framing, &mesh, &(struct mesh){ 0 });
    struct framing_view view = { .aspect = 1, .target = &target };
    struct camera camera = framing_camera(&framing, &view);
    CHECK_NEAR(glms_vec3_distance(camera.target, target), 0, 1e-5);
    view = (struct framing_view){ .aspect = 1, .rotates = true };
    camera = framing_camera(&framing, &view);
    struct mesh swept = make_mesh(no_size, (vec3s){ { 2, 1, 2 } }, 4000, false);
    for (uint32_t i = 0; i < swept.vertex_count; i++) {
        const float angle = (float)i * 0.01F;
        swept.vertices[i].position =
            (vec3s){ { 2 * cosf(angle), i & 1 ? 1 : -1, 2 * sinf(angle) } };
    }
    check_bounds(&swept, &camera, 1);
    mesh_finish(&swept);
    mesh_finish(&mesh);
}

static void test_a_point(void **state)
{
    (void)state;
    struct mesh mesh = make_mesh((vec3s){ { 5, 5, 5 } }, no_size, 3, false);
    struct framing framing;
    framing_init(&framing, &mesh, &(struct mesh){ 0 });
    const struct camera camera = framing_camera(&framing, &(struct framing_view){ .aspect = 1 });
    CHECK_NEAR(glms_vec3_distance(camera.eye, mesh.vertices[0].position), 1, 1e-5);
    mesh_finish(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounds_of_all_shapes),
        cmocka_unit_test(test_a_room_is_not_framed),
        cmocka_unit_test(test_target_and_rotation),
        cmocka_unit_test(test_a_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
