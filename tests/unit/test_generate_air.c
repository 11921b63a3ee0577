/*
 * test_generate_air.c: generated air planes pass near the object's centre, and their textures are
 * dense there.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"

static const struct box box = { { { 1, 2, 3 } }, { { 3, 6, 7 } } };
static const struct generate_air usual = { .count = 19, .seed = 1, .size = 0.01F, .frequency = 24 };

static void planes_pass_near_the_middle(void **state)
{
    (void)state;
    struct mesh mesh;
    assert_true(generate_air_planes(&mesh, box, &usual));
    assert_int_equal(mesh.vertex_count, 4 * 19);
    assert_int_equal(mesh.index_count, 6 * 19);
    for (uint32_t i = 0; i < mesh.vertex_count; i += 4) {
        const struct mesh_vertex *v = &mesh.vertices[i];
        const vec3s middle = glms_vec3_scale(glms_vec3_add(v[0].position, v[3].position), 0.5F);
        assert_true(glms_vec3_distance(middle, box_center(box)) < 0.2F * box_diagonal(box) / 2);
        CHECK_NEAR(glms_vec3_distance(v[0].position, v[1].position), box_diagonal(box), 1e-4);
        CHECK_NEAR(glms_vec3_distance(v[0].position, v[2].position), box_diagonal(box), 1e-4);
        for (uint32_t k = 0; k < 4; k++) {
            const vec3s in_plane = glms_vec3_sub(v[k].position, middle);
            CHECK_NEAR(glms_vec3_dot(in_plane, v[k].normal), 0, 1e-4);
            assert_in_range(v[k].material, 1, 4);
        }
    }
    for (uint32_t i = 0; i < mesh.index_count; i++)
        assert_true(mesh.indices[i] / 4 == i / 6);
    mesh_finish(&mesh);
}

/* Mean of a channel between two distances from the middle, in halves of the picture's side. */
static double ring(const struct air_layers *layers, size_t channel, double from, double to)
{
    const double size = layers->size;
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)layers->size * layers->size * layers->count; i++) {
        const double x = (double)(i % layers->size) + 0.5 - size / 2;
        const double y = (double)(i / layers->size % layers->size) + 0.5 - size / 2;
        const double away = hypot(x, y) / (size / 2);
        if (away < from || away >= to)
            continue;
        sum += layers->texels[2 * i + channel];
        count++;
    }
    return sum / (double)count;
}

static void density_rises_towards_the_middle(void **state)
{
    (void)state;
    struct air_layers layers;
    assert_true(generate_air_layers(&layers, &usual));
    for (size_t channel = 0; channel < 2; channel++) {
        const double middle = ring(&layers, channel, 0, 0.2);
        double before = middle;
        assert_true(before > 10);
        for (int step = 1; step < 5; step++) {
            const double here = ring(&layers, channel, step / 5.0, (step + 1) / 5.0);
            print_message("%zu: %.2f\n", channel, here);
            assert_true(here < 0.8 * before);
            before = here;
        }
        assert_true(before < 0.02 * middle);
    }
    free(layers.texels);
}

static double covered(struct generate_air air)
{
    struct air_layers layers;
    assert_true(generate_air_layers(&layers, &air));
    const double share = ring(&layers, 0, 0, 0.5);
    free(layers.texels);
    return share;
}

/* Larger or more frequent bubbles cover more; the largest of all are no trouble. */
static void sizes_and_frequencies(void **state)
{
    (void)state;
    struct generate_air larger = usual;
    struct generate_air frequent = usual;
    const struct generate_air most = { .count = 1, .size = 0.1F, .frequency = 128 };
    larger.size *= 2;
    frequent.frequency *= 1.5F;
    assert_true(covered(larger) > 1.5 * covered(usual));
    assert_true(covered(frequent) > 1.5 * covered(usual));
    assert_true(covered(most) > 128);
}

static double area(const struct mesh *mesh)
{
    double sum = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const vec3s a = mesh->vertices[mesh->indices[i]].position;
        const vec3s b = mesh->vertices[mesh->indices[i + 1]].position;
        const vec3s c = mesh->vertices[mesh->indices[i + 2]].position;
        sum += (double)glms_vec3_norm(glms_vec3_cross(glms_vec3_sub(b, a), glms_vec3_sub(c, a)));
    }
    return sum / 2;
}

/* Whether a point of the plane is in one of its triangles, or hardly beyond. */
static bool covers(const struct mesh *mesh, vec3s normal, vec3s point)
{
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        vec3s corners[3];
        float most = 0;
        for (uint32_t k = 0; k < 3; k++)
            corners[k] = mesh->vertices[mesh->indices[i + k]].position;
        if (!glms_vec3_eqv(mesh->vertices[mesh->indices[i]].normal, normal))
            continue;
        const vec3s whole = glms_vec3_cross(glms_vec3_sub(corners[1], corners[0]),
                                            glms_vec3_sub(corners[2], corners[0]));
        for (uint32_t k = 0; k < 3; k++) {
            const vec3s along = glms_vec3_sub(corners[(k + 1) % 3], corners[k]);
            const vec3s part = glms_vec3_cross(along, glms_vec3_sub(point, corners[k]));
            const float away = -glms_vec3_dot(part, glms_vec3_normalize(whole));
            most = fmaxf(most, away / glms_vec3_norm(along));
        }
        if (most < 1e-4F)
            return true;
    }
    return false;
}

/* Where the object's edges go through the square, the polygon is. Returns how many do. */
static size_t check_section(const struct mesh *object, const struct mesh_vertex *square,
                            const struct mesh *cut)
{
    size_t crossings = 0;
    for (uint32_t i = 0; i < object->index_count; i++) {
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        const vec3s a = object->vertices[object->indices[i]].position;
        const vec3s b = object->vertices[object->indices[next]].position;
        const float at_a = glms_vec3_dot(glms_vec3_sub(a, square->position), square->normal);
        const float at_b = glms_vec3_dot(glms_vec3_sub(b, square->position), square->normal);
        if ((at_a < 0) == (at_b < 0))
            continue;
        const vec3s point = glms_vec3_lerp(a, b, at_a / (at_a - at_b));
        assert_true(covers(cut, square->normal, point));
        crossings++;
    }
    return crossings;
}

static void planes_end_near_the_object(void **state)
{
    static const struct {
        bool (*generate)(struct mesh *mesh, uint32_t triangles);
        uint32_t triangles;
        double most; /* of the area that was there */
    } objects[] = { { generate_sphere, 320, 0.8 }, { generate_teapot, 1440, 0.5 } };

    (void)state;
    for (size_t o = 0; o < sizeof(objects) / sizeof(objects[0]); o++) {
        struct mesh object, squares, cut;
        size_t crossings = 0;
        assert_true(objects[o].generate(&object, objects[o].triangles));
        const struct box around = mesh_box(&object);
        assert_true(generate_air_planes(&squares, around, &usual));
        assert_true(generate_air_planes(&cut, around, &usual));
        assert_true(generate_air_clip(&cut, &object));
        for (uint32_t i = 0; i < usual.count; i++)
            crossings += check_section(&object, &squares.vertices[(size_t)4 * i], &cut);
        const double left = area(&cut) / area(&squares);
        print_message("%zu points of the object; %.2f of the squares is left\n", crossings, left);
        assert_true(crossings > 300);
        assert_true(left < objects[o].most);
        mesh_finish(&object);
        mesh_finish(&squares);
        mesh_finish(&cut);
    }
}

/* What is nowhere near is gone; what lies within is as it was. */
static void planes_without_object(void **state)
{
    struct mesh mesh, object;
    (void)state;
    assert_true(generate_sphere(&object, 320));
    for (uint32_t i = 0; i < object.vertex_count; i++)
        object.vertices[i].position = glms_vec3_scale(object.vertices[i].position, 100);
    assert_true(generate_air_planes(&mesh, box, &usual));
    const double before = area(&mesh);
    assert_true(generate_air_clip(&mesh, &object));
    CHECK_NEAR(area(&mesh), before, 1e-3 * before);
    for (uint32_t i = 0; i < object.vertex_count; i++)
        object.vertices[i].position.y += 1000;
    mesh_finish(&mesh);
    assert_true(generate_air_planes(&mesh, box, &usual));
    assert_true(generate_air_clip(&mesh, &object));
    assert_int_equal(mesh.vertex_count, 0);
    assert_int_equal(mesh.index_count, 0);
    mesh_finish(&mesh);
    mesh_finish(&object);
}

static void seeds_repeat(void **state)
{
    (void)state;
    struct generate_air other = usual;
    other.seed = 2;
    struct mesh meshes[3];
    struct air_layers layers[3];
    for (int i = 0; i < 3; i++) {
        assert_true(generate_air_planes(&meshes[i], box, i < 2 ? &usual : &other));
        assert_true(generate_air_layers(&layers[i], i < 2 ? &usual : &other));
    }
    const size_t size = (size_t)layers[0].size * layers[0].size * layers[0].count * 2;
    const size_t vertices = meshes[0].vertex_count * sizeof(*meshes[0].vertices);
    assert_memory_equal(layers[0].texels, layers[1].texels, size);
    assert_memory_not_equal(layers[0].texels, layers[2].texels, size);
    assert_memory_equal(meshes[0].vertices, meshes[1].vertices, vertices);
    assert_memory_not_equal(meshes[0].vertices, meshes[2].vertices, vertices);
    for (int i = 0; i < 3; i++) {
        mesh_finish(&meshes[i]);
        free(layers[i].texels);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_pass_near_the_middle),
        cmocka_unit_test(planes_end_near_the_object),
        cmocka_unit_test(planes_without_object),
        cmocka_unit_test(density_rises_towards_the_middle),
        cmocka_unit_test(sizes_and_frequencies),
        cmocka_unit_test(seeds_repeat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
