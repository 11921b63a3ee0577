/* test_closed_mesh.c: point-in-mesh tests of closed meshes. */
#include <cglm/struct.h>
#include <math.h>

#include "src/scene/generate/generate.h"
#include "src/scene/geometry/mesh_depth_complexity.h"
#include "src/scene/geometry/point_in_mesh.h"
#include "tests/support/assertions.h"

/* Evenly spread, without end. */
static vec3s spread(uint32_t i, float size)
{
    const double steps[3] = { 0.8191725133961645, 0.6710436067037893, 0.5497004779019703 };
    vec3s p;
    for (int k = 0; k < 3; k++)
        p.raw[k] = (float)(2 * (i * steps[k] - floor(i * steps[k])) - 1) * size;
    return p;
}

/* Inside if the triangles, seen from there, cover the whole sphere of directions. */
static bool is_surrounded(const struct mesh *mesh, vec3s p)
{
    double sum = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        vec3s v[3];
        double length[3];
        for (uint32_t k = 0; k < 3; k++) {
            v[k] = glms_vec3_sub(mesh->vertices[mesh->indices[i + k]].position, p);
            length[k] = (double)glms_vec3_norm(v[k]);
        }
        const double triple = (double)glms_vec3_dot(v[0], glms_vec3_cross(v[1], v[2]));
        const double below = length[0] * length[1] * length[2] +
                             (double)glms_vec3_dot(v[0], v[1]) * length[2] +
                             (double)glms_vec3_dot(v[1], v[2]) * length[0] +
                             (double)glms_vec3_dot(v[2], v[0]) * length[1];
        sum += 2 * atan2(triple, below);
    }
    return sum > 6.28318530717958648;
}

static void test_points(void **state)
{
    (void)state;
    bool (*const generators[])(struct mesh *, uint32_t) = { generate_sphere, generate_ice_cube,
                                                            generate_teapot };
    for (size_t g = 0; g < 3; g++) {
        struct mesh mesh = { 0 };
        struct closed_mesh closed_mesh;
        uint32_t inside = 0;
        assert_true(generators[g](&mesh, 4000));
        assert_true(closed_mesh_init(&closed_mesh, &mesh));
        for (uint32_t i = 0; i < 1500; i++) {
            const vec3s p = spread(i, 1.1f);
            const bool contained = closed_mesh_contains(&closed_mesh, p);
            assert_int_equal(contained, is_surrounded(&mesh, p));
            inside += contained;
        }
        assert_true(inside > 100 && inside < 1400);
        closed_mesh_finish(&closed_mesh);
        mesh_finish(&mesh);
    }
}

/* A cube of four squares a side: rays up from whole and half coordinates meet corners and edges. */
static void test_points_below_corners_and_edges(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    struct closed_mesh closed_mesh;
    assert_true(generate_sphere(&mesh, 960));
    assert_true(closed_mesh_init(&closed_mesh, &mesh));
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        for (int k = -20; k <= 20; k++) {
            vec3s p = mesh.vertices[i].position;
            p.y = 0.0731f * (float)k;
            const float r = glms_vec3_norm(p);
            if (r < 0.97f) /* within the facets */
                assert_true(closed_mesh_contains(&closed_mesh, p));
            if (r > 1.01f)
                assert_false(closed_mesh_contains(&closed_mesh, p));
        }
    }
    closed_mesh_finish(&closed_mesh);
    mesh_finish(&mesh);
}

static void test_nothing(void **state)
{
    (void)state;
    const struct mesh empty = { 0 };
    struct closed_mesh closed_mesh = { 0 };
    closed_mesh_finish(&closed_mesh);
    assert_true(closed_mesh_init(&closed_mesh, &empty));
    assert_false(closed_mesh_contains(&closed_mesh, (vec3s){ { 0, 0, 0 } }));
    closed_mesh_finish(&closed_mesh);
}

/* Of a ball and one half as wide in it, a quarter of the lines that meet any meets both. */
static void test_fold(void **state)
{
    (void)state;

    static const struct {
        bool (*generate)(struct mesh *, uint32_t);
        float least, most;
    } cases[] = {
        { generate_sphere, 0.0f, 0.0f },
        { generate_ice_cube, 0.0f, 0.01f },
        { generate_teapot, 0.07f, 0.2f },
    };
    struct mesh mesh, inner;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        assert_true(cases[i].generate(&mesh, 4000));
        const float fold = mesh_depth_complexity(&mesh);
        assert_true(fold >= cases[i].least && fold <= cases[i].most);
        mesh_finish(&mesh);
    }
    assert_true(generate_sphere(&mesh, 1000) && generate_sphere(&inner, 1000));
    for (uint32_t i = 0; i < inner.vertex_count; i++)
        inner.vertices[i].position = glms_vec3_scale(inner.vertices[i].position, 0.5f);
    assert_true(mesh_append(&mesh, &inner));
    CHECK_NEAR(mesh_depth_complexity(&mesh), 0.25, 0.02);
    mesh_finish(&inner);
    mesh_finish(&mesh);
}

/* Between two balls and in the inner one, but not beside them, nor in the hole of a ring. */
static void test_cavity(void **state)
{
    (void)state;
    struct mesh mesh, inner;
    struct closed_mesh closed_mesh;
    assert_true(generate_sphere(&mesh, 1000) && generate_sphere(&inner, 1000));
    for (uint32_t i = 0; i < inner.vertex_count; i++)
        inner.vertices[i].position = glms_vec3_scale(inner.vertices[i].position, 0.5f);
    assert_true(mesh_append(&mesh, &inner));
    mesh_finish(&inner);
    assert_true(closed_mesh_init(&closed_mesh, &mesh));
    for (int i = 0; i < 12; i++) {
        const vec3s p = { { 0.05f + 0.1f * (float)i, 0.03f, 0.04f } };
        assert_int_equal(closed_mesh_contains(&closed_mesh, p), i >= 5 && i < 10);
        assert_int_equal(closed_mesh_surrounds(&closed_mesh, p), i < 10);
    }
    closed_mesh_finish(&closed_mesh);
    mesh_finish(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points),  cmocka_unit_test(test_points_below_corners_and_edges),
        cmocka_unit_test(test_cavity),  cmocka_unit_test(test_fold),
        cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
