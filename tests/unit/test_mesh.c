/* test_mesh.c: storage, appending, boxes, normals. */
#include "src/scene/geometry/mesh.h"

#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"

/* Two triangles of a square in the plane z = 0, facing +Z. */
static struct mesh make_square(float side)
{
    static const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    struct mesh mesh = { 0 };
    assert_true(mesh_init(&mesh, 4, 6));
    mesh.vertices[1].position.x = side;
    mesh.vertices[2].position = (vec3s){ { side, side, 0 } };
    mesh.vertices[3].position.y = side;
    for (int i = 0; i < 6; i++)
        mesh.indices[i] = indices[i];
    return mesh;
}

static void test_init_is_zero_and_finish_leaves_nothing(void **state)
{
    (void)state;
    struct mesh mesh;
    assert_true(mesh_init(&mesh, 100, 30));
    assert_int_equal(mesh.vertex_count, 100);
    assert_int_equal(mesh.index_count, 30);
    for (int i = 0; i < 100; i++) {
        assert_true(mesh.vertices[i].normal.y == 0);
        assert_int_equal(mesh.vertices[i].material, 0);
    }
    for (int i = 0; i < 30; i++)
        assert_int_equal(mesh.indices[i], 0);
    mesh_finish(&mesh);
    assert_null(mesh.vertices);
    assert_null(mesh.indices);
    assert_int_equal(mesh.vertex_count + mesh.index_count, 0);
    mesh_finish(&mesh);

    assert_true(mesh_init(&mesh, 0, 0));
    assert_null(mesh.vertices);
    mesh_finish(&mesh);
}

static void test_append_renumbers(void **state)
{
    (void)state;
    struct mesh all = { 0 };
    struct mesh first = make_square(1);
    struct mesh second = make_square(3);
    second.vertices[2].material = MESH_UNLIT | 7;
    struct mesh nothing = { 0 };
    assert_true(mesh_append(&all, &first));
    assert_true(mesh_append(&all, &nothing));
    assert_true(mesh_append(&all, &second));
    assert_int_equal(all.vertex_count, 8);
    assert_int_equal(all.index_count, 12);
    for (uint32_t i = 0; i < 6; i++) {
        assert_int_equal(all.indices[i], first.indices[i]);
        assert_int_equal(all.indices[6 + i], 4 + second.indices[i]);
    }
    CHECK_NEAR(all.vertices[1].position.x, 1, 0);
    CHECK_NEAR(all.vertices[5].position.x, 3, 0);
    assert_int_equal(all.vertices[6].material, MESH_UNLIT | 7);
    /* copies, not the same arrays */
    mesh_finish(&second);
    CHECK_NEAR(all.vertices[6].position.y, 3, 0);
    mesh_finish(&first);
    mesh_finish(&all);
}

static void test_append_refuses_too_many(void **state)
{
    (void)state;
    struct mesh mesh = make_square(1);
    struct mesh_vertex *vertices = mesh.vertices;
    struct mesh other = { .vertices = mesh.vertices, .vertex_count = UINT32_MAX - 3 };
    assert_false(mesh_append(&mesh, &other));
    other = (struct mesh){ .indices = mesh.indices, .index_count = UINT32_MAX - 5 };
    assert_false(mesh_append(&mesh, &other));
    assert_ptr_equal(mesh.vertices, vertices);
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.index_count, 6);
    mesh_finish(&mesh);
}

static void test_box(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    assert_true(box_diagonal(mesh_box(&mesh)) == 0);
    assert_true(mesh_init(&mesh, 3, 0));
    mesh.vertices[0].position = (vec3s){ { 5, -1, 2 } };
    mesh.vertices[1].position = (vec3s){ { 7, -3, 2 } };
    mesh.vertices[2].position = (vec3s){ { 6, 1, 6 } };
    struct box box = mesh_box(&mesh);
    assert_true(glms_vec3_eqv(box.min, (vec3s){ { 5, -3, 2 } }));
    assert_true(glms_vec3_eqv(box.max, (vec3s){ { 7, 1, 6 } }));
    assert_true(glms_vec3_eqv(box_center(box), (vec3s){ { 6, -1, 4 } }));
    CHECK_NEAR(box_diagonal(box), 6, 1e-6);

    mesh_fit(&mesh, 1);
    box = mesh_box(&mesh);
    assert_true(glms_vec3_eqv(box.min, (vec3s){ { -0.5F, -1, -1 } }));
    assert_true(glms_vec3_eqv(box.max, (vec3s){ { 0.5F, 1, 1 } }));
    mesh_finish(&mesh);

    box = (struct box){ .min = { { 3e38F, 0, 0 } }, .max = { { 3.2e38F, 0, 0 } } };
    CHECK_NEAR(box_center(box).x / 3.1e38F, 1, 1e-6);
}

static void test_normals_are_weighted_by_angle(void **state)
{
    (void)state;
    /* a square facing +Z and a triangle facing +Y share vertex 0, at angles of 2 * 45 and 60 */
    struct mesh mesh = make_square(2);
    struct mesh wall = { 0 };
    assert_true(mesh_init(&wall, 3, 3));
    wall.vertices[1].position.z = 1;
    wall.vertices[2].position = (vec3s){ { sqrtf(3), 0, 1 } };
    for (uint32_t i = 0; i < 3; i++)
        wall.indices[i] = i;
    assert_true(mesh_append(&mesh, &wall));
    mesh.indices[6] = 0;
    mesh_make_normals(&mesh);
    CHECK_NEAR(mesh.vertices[0].normal.z, 3 / sqrt(13), 1e-6);
    CHECK_NEAR(mesh.vertices[0].normal.y, 2 / sqrt(13), 1e-6);
    CHECK_NEAR(mesh.vertices[2].normal.z, 1, 0);
    CHECK_NEAR(mesh.vertices[5].normal.y, 1, 0);
    /* vertex 4 is now in no triangle */
    CHECK_NEAR(mesh.vertices[4].normal.y, 1, 0);
    mesh_finish(&wall);
    mesh_finish(&mesh);
}

static void test_normals_of_extreme_sizes(void **state)
{
    (void)state;
    static const float sides[] = { 1e-30F, 1e-12F, 1e-6F, 1e6F, 1e30F };
    for (size_t i = 0; i < sizeof(sides) / sizeof(*sides); i++) {
        struct mesh mesh = make_square(sides[i]);
        mesh_make_normals(&mesh);
        for (int k = 0; k < 4; k++)
            CHECK_NEAR(mesh.vertices[k].normal.z, 1, 1e-6);
        mesh_finish(&mesh);
    }
    static const float bad[] = { 0, INFINITY };
    for (int i = 0; i < 2; i++) {
        struct mesh mesh = make_square(bad[i]);
        mesh_make_normals(&mesh);
        CHECK_NEAR(mesh.vertices[0].normal.y, 1, 0);
        CHECK_NEAR(mesh.vertices[0].normal.z, 0, 0);
        mesh_finish(&mesh);
    }
}

static void check_convex(bool expected, struct mesh *mesh)
{
    assert_int_equal(mesh_is_convex(mesh), expected);
    for (uint32_t i = 0; i < mesh->index_count; i += 3) { /* inside out */
        const uint32_t corner = mesh->indices[i];
        mesh->indices[i] = mesh->indices[i + 1];
        mesh->indices[i + 1] = corner;
    }
    assert_false(mesh_is_convex(mesh));
    mesh_finish(mesh);
}

static void test_what_is_convex(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    check_convex(false, &mesh);
    assert_true(generate_sphere(&mesh, 960));
    check_convex(true, &mesh);
    assert_true(generate_sphere(&mesh, 960));
    mesh.index_count -= 3; /* open */
    check_convex(false, &mesh);
    assert_true(generate_sphere(&mesh, 960));
    mesh.vertices[17].position = glms_vec3_scale(mesh.vertices[17].position, 0.99f); /* a dent */
    check_convex(false, &mesh);
    assert_true(generate_teapot(&mesh, 960));
    check_convex(false, &mesh);
}

/* A triangle's nearest corner counts; those of nearly one distance keep their order. */
static void test_sort_by_distance(void **state)
{
    (void)state;
    static const float distances[] = { 5, 0, 80, 4.9f, 1e-20f, 5.05f, 3e19f, 3.6f, 3, 0.5f };
    static const uint32_t order[] = { 1, 4, 9, 8, 7, 0, 3, 5, 2, 6 };

    enum {
        COUNT = sizeof(distances) / sizeof(distances[0])
    };

    const vec3s from = { { 0.0f, 0.0f, 0.0f } };
    struct mesh mesh;
    assert_true(mesh_init(&mesh, 3 * COUNT, 3 * COUNT));
    for (uint32_t i = 0; i < 3 * COUNT; i++) {
        const float more = i % 3 == 1 ? 0.0f : 1.0f + (float)i;
        mesh.vertices[i].position.raw[i % 2] = distances[i / 3] + more;
        mesh.indices[i] = i;
    }
    assert_true(mesh_sort_by_distance(&mesh, from, NULL));
    for (uint32_t i = 0; i < 3 * COUNT; i++)
        assert_int_equal(mesh.indices[i], 3 * order[i / 3] + i % 3);
    mesh_finish(&mesh);
    assert_true(mesh_sort_by_distance(&mesh, from, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_init_is_zero_and_finish_leaves_nothing),
        cmocka_unit_test(test_append_renumbers),
        cmocka_unit_test(test_append_refuses_too_many),
        cmocka_unit_test(test_box),
        cmocka_unit_test(test_normals_are_weighted_by_angle),
        cmocka_unit_test(test_normals_of_extreme_sizes),
        cmocka_unit_test(test_what_is_convex),
        cmocka_unit_test(test_sort_by_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
