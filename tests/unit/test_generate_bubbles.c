/* test_generate_bubbles.c: spheres within the object that do not overlap. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "src/scene/generate/generate.h"
#include "tests/support/check.h"

static void make(struct bubbles *bubbles, const struct mesh *mesh, uint32_t count, float size)
{
    const struct generate_bubbles params = { .count = count, .seed = 1, .size = size };
    assert_true(generate_bubbles(bubbles, mesh, &params));
}

static void check_apart(const struct bubbles *bubbles, float largest)
{
    for (uint32_t i = 0; i < bubbles->count; i++) {
        const struct bubbles_sphere a = bubbles->spheres[i];
        assert_true(a.radius > 0 && a.radius <= largest);
        for (uint32_t k = 0; k < i; k++) {
            const struct bubbles_sphere b = bubbles->spheres[k];
            assert_true(glms_vec3_distance(a.center, b.center) >= a.radius + b.radius);
        }
    }
}

/* The planes of a convex mesh's triangles are beyond every sphere. */
static void check_inside_convex(const struct bubbles *bubbles, const struct mesh *mesh)
{
    for (uint32_t t = 0; t < mesh->index_count; t += 3) {
        const uint32_t *corners = &mesh->indices[t];
        const vec3s a = mesh->vertices[corners[0]].position;
        const vec3s b = mesh->vertices[corners[1]].position;
        const vec3s c = mesh->vertices[corners[2]].position;
        const vec3s normal = glms_vec3_crossn(glms_vec3_sub(b, a), glms_vec3_sub(c, a));
        for (uint32_t i = 0; i < bubbles->count; i++) {
            const struct bubbles_sphere s = bubbles->spheres[i];
            assert_true(glms_vec3_dot(normal, glms_vec3_sub(s.center, a)) + s.radius < 1e-5F);
        }
    }
}

static void whole_inside_a_sphere(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    struct bubbles few, many, none;
    assert_true(generate_sphere(&mesh, 960));
    make(&few, &mesh, 40, 0.1F);
    make(&many, &mesh, BUBBLES_COUNT_MAX, 0.02F);
    make(&none, &mesh, 40, 4); /* no room */
    assert_int_equal(few.count, 40);
    assert_int_equal(many.count, BUBBLES_COUNT_MAX);
    assert_int_equal(none.count, 0);
    check_apart(&few, 0.1F * box_diagonal(mesh_box(&mesh)) / 2);
    check_apart(&many, 0.02F * box_diagonal(mesh_box(&mesh)) / 2);
    check_inside_convex(&few, &mesh);
    check_inside_convex(&many, &mesh);
    free(few.spheres);
    free(many.spheres);
    free(none.spheres);
    mesh_finish(&mesh);
}

/* A cube with a hole: 8 blocks of a 3 x 3 x 1 board, without faces between them. */
static const float block_side = 0.4F;

static void add_square(struct mesh *mesh, vec3s center, vec3s normal)
{
    static const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    const vec3s u = { { normal.y, normal.z, normal.x } };
    const vec3s v = glms_vec3_cross(normal, u);
    struct mesh square;
    assert_true(mesh_init(&square, 4, 6));
    for (uint32_t i = 0; i < 4; i++) {
        const float right = i == 1 || i == 2 ? block_side / 2 : -block_side / 2;
        const float up = i >= 2 ? block_side / 2 : -block_side / 2;
        square.vertices[i].position = glms_vec3_muladds(v, up, glms_vec3_muladds(u, right, center));
    }
    for (uint32_t i = 0; i < 6; i++)
        square.indices[i] = indices[i];
    assert_true(mesh_append(mesh, &square));
    mesh_finish(&square);
}

static bool is_block(int x, int y, int z)
{
    return abs(x) <= 1 && abs(y) <= 1 && z == 0 && (x || y);
}

static void make_frame(struct mesh *mesh)
{
    *mesh = (struct mesh){ 0 };
    for (int i = 0; i < 9; i++) {
        const int at[3] = { i % 3 - 1, i / 3 - 1, 0 };
        for (int side = 0; side < 6 && is_block(at[0], at[1], 0); side++) {
            vec3s normal = { { 0 } };
            normal.raw[side / 2] = side % 2 ? -1 : 1;
            if (is_block(at[0] + (int)normal.x, at[1] + (int)normal.y, (int)normal.z))
                continue;
            vec3s center = { { (float)at[0], (float)at[1], 0 } };
            center = glms_vec3_scale(glms_vec3_muladds(normal, 0.5F, center), block_side);
            add_square(mesh, center, normal);
        }
    }
}

/* None in the hole. */
static void inside_a_body_with_a_hole(void **state)
{
    (void)state;
    struct mesh mesh;
    struct bubbles bubbles;
    make_frame(&mesh);
    make(&bubbles, &mesh, 500, 0.02F);
    assert_int_equal(bubbles.count, 500);
    check_apart(&bubbles, 0.02F * box_diagonal(mesh_box(&mesh)) / 2);
    uint32_t quarters[4] = { 0 };
    for (uint32_t i = 0; i < bubbles.count; i++) {
        const vec3s c = bubbles.spheres[i].center;
        const float away = fmaxf(fabsf(c.x), fabsf(c.y));
        assert_true(away > block_side / 2 && away < 1.5F * block_side);
        assert_true(fabsf(c.z) < block_side / 2);
        quarters[2 * (c.x > 0) + (c.y > 0)]++;
    }
    for (int i = 0; i < 4; i++)
        assert_in_range(quarters[i], 75, 175);
    free(bubbles.spheres);
    mesh_finish(&mesh);
}

static void seeds_repeat(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    struct bubbles bubbles[3];
    assert_true(generate_ice_cube(&mesh, GENERATE_ICE_CUBE_TRIANGLES));
    for (uint32_t i = 0; i < 3; i++) {
        const struct generate_bubbles params = { 100, i < 2 ? 1 : 2, 0.03F };
        assert_true(generate_bubbles(&bubbles[i], &mesh, &params));
        assert_int_equal(bubbles[i].count, 100);
    }
    const size_t size = 100 * sizeof(struct bubbles_sphere);
    assert_memory_equal(bubbles[0].spheres, bubbles[1].spheres, size);
    assert_memory_not_equal(bubbles[0].spheres, bubbles[2].spheres, size);
    for (uint32_t i = 0; i < 3; i++)
        free(bubbles[i].spheres);
    mesh_finish(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_inside_a_sphere),
        cmocka_unit_test(inside_a_body_with_a_hole),
        cmocka_unit_test(seeds_repeat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
