/* test_ao_occluders.c: occluders fitted to objects, and the light that they transmit. */
#include <cglm/struct.h>

#include "src/scene/ao_occluder_transmission.h"
#include "tests/support/assertions.h"

/* Puts a box, of 12 triangles, into arrays; indices[0] is that of its first vertex. */
static void put_box(struct mesh_vertex *vertices, uint32_t *indices, vec3s min, vec3s max)
{
    static const uint32_t faces[12][3] = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 },
                                           { 0, 1, 4 }, { 1, 5, 4 }, { 2, 6, 3 }, { 3, 6, 7 },
                                           { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
    const uint32_t first = indices[0];
    for (uint32_t i = 0; i < 8; i++)
        vertices[i].position =
            (vec3s){ { i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z } };
    for (uint32_t i = 0; i < 36; i++)
        indices[i] = first + faces[i / 3][i % 3];
}

static struct ao find(uint32_t count, const vec3s corners[][2])
{
    struct mesh_vertex vertices[32] = { 0 };
    uint32_t indices[144];
    struct object objects[4] = { 0 };
    const struct mesh mesh = {
        .vertices = vertices,
        .indices = indices,
        .vertex_count = 8 * count,
        .index_count = 36 * count,
    };
    struct ao ao;
    for (uint32_t i = 0; i < count; i++) {
        indices[(size_t)36 * i] = 8 * i;
        put_box(&vertices[(size_t)8 * i], &indices[(size_t)36 * i], corners[i][0], corners[i][1]);
        objects[i].first_index = 36 * i;
        objects[i].index_count = 36;
    }
    objects[1].enclosing_object = 1;
    assert_int_equal(ao_find(&ao, &mesh, objects, count), STATUS_OK);
    return ao;
}

static const vec3s cubes[][2] = {
    { { { -1, 0, -1 } }, { { 1, 2, 1 } } },           /* the largest, */
    { { { -.5f, .5f, -.5f } }, { { .5f, 1, .5f } } }, /* one in it, */
    { { { 3, 0, 0 } }, { { 4, 1, 1 } } },             /* one beside it, */
    { { { -9, 0, -9 } }, { { 9, .1f, 9 } } },         /* and a film */
};

static void test_bodies(void **state)
{
    (void)state;
    const struct ao ao = find(4, cubes);
    assert_int_equal(ao.count, 2);
    assert_int_equal(ao.shapes[0].member_count, 2);
    assert_float_equal(ao.shapes[0].members[0].volume_fraction, 15.0f / 16.0f, 1e-3f);
    assert_float_equal(ao.shapes[0].members[1].volume_fraction, 1.0f / 16.0f, 1e-3f);
    assert_float_equal(ao.shapes[0].relative_width, 1.0f, 1e-3f);
    assert_int_equal(ao.shapes[1].members[0].object, 2);
}

/* Clear things lose no light, black ones keep what their surface does not mirror. */
static void test_light(void **state)
{
    (void)state;
    const struct ao ao = find(1, cubes);
    const vec3s up = { { 0, 1, 0 } };
    struct ao_medium medium = { .ior = 1.31f, .scattering = 1.0f, .tint = glms_vec3_one() };
    const struct ao_light clear = ao_light_of(&ao.shapes[0], &medium, up);
    medium.absorption = glms_vec3_fill(1e3f);
    const struct ao_light black = ao_light_of(&ao.shapes[0], &medium, up);
    assert_float_equal(clear.sky.y + clear.ground.y, 1.0f, 1e-5f);
    assert_true(clear.sky.y > clear.ground.y);
    assert_true(black.sky.y + black.ground.y < 0.2f);
    assert_true(black.sky.y + black.ground.y > 0.02f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bodies),
        cmocka_unit_test(test_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
