/*
 * test_generate_cracks.c: generated cracks are curved, irregular sheets across a box, reproducible
 * by seed.
 */
#include <cglm/struct.h>
#include <math.h>

#include "shaders/inclusions/cracks.h"
#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"

static const struct box box = { { { 3, -2, 7 } }, { { 5, 0, 8 } } };

static void generate(struct mesh *mesh, uint32_t count, uint32_t seed)
{
    *mesh = (struct mesh){ 0 };
    const struct generate_cracks params = { count, seed, 1 };
    assert_true(generate_cracks(mesh, box, &params, &(struct mesh){ 0 }));
}

static bool is_same(const struct mesh *a, const struct mesh *b, uint32_t vertex_count)
{
    bool same = true;
    for (uint32_t i = 0; i < vertex_count; i++)
        same &= glms_vec3_eqv(a->vertices[i].position, b->vertices[i].position);
    return same;
}

static void test_seeds(void **state)
{
    (void)state;
    struct mesh a, b, c, more;
    generate(&a, 2, 7);
    generate(&b, 2, 7);
    generate(&c, 2, 8);
    generate(&more, 3, 7);
    assert_int_equal(a.vertex_count, b.vertex_count);
    assert_memory_equal(a.vertices, b.vertices, a.vertex_count * sizeof(*a.vertices));
    assert_memory_equal(a.indices, b.indices, a.index_count * sizeof(*a.indices));
    assert_false(is_same(&a, &c, a.vertex_count));
    assert_true(is_same(&a, &more, a.vertex_count)); /* one more leaves the others */
    mesh_finish(&a);
    mesh_finish(&b);
    mesh_finish(&c);
    mesh_finish(&more);
}

static void test_counts(void **state)
{
    (void)state;
    struct mesh none, one, most, beyond;
    generate(&none, 0, 1);
    generate(&one, 1, 1);
    generate(&most, CRACKS_MAX, 1);
    generate(&beyond, CRACKS_MAX + 1, 1);
    assert_int_equal(none.index_count, 0);
    assert_true(one.index_count >= 3 * 500);
    assert_int_equal(most.index_count, CRACKS_MAX * one.index_count);
    assert_int_equal(beyond.index_count, most.index_count);
    for (uint32_t i = 0; i < most.index_count; i++)
        assert_in_range(most.indices[i], 0, most.vertex_count - 1);
    mesh_finish(&none);
    mesh_finish(&one);
    mesh_finish(&most);
    mesh_finish(&beyond);
}

/* A sheet's size and shape: as numbers that neither turning nor moving changes. */
struct shape {
    double area, volume; /* over its radius squared; the volume under it, over its cube */
    double rim;          /* the nearest corner of its outline over the farthest */
};

static struct shape measure(const struct mesh *mesh, uint32_t sheet, uint32_t sheet_indices)
{
    struct shape shape = { 0 };
    const uint32_t *first = &mesh->indices[(size_t)sheet * sheet_indices];
    vec3s center = glms_vec3_zero();
    double radius = 0;
    for (uint32_t i = 0; i < sheet_indices; i++)
        center = glms_vec3_muladds(mesh->vertices[first[i]].position, 1.0f / (float)sheet_indices,
                                   center);
    for (uint32_t i = 0; i < sheet_indices; i += 3) {
        vec3s p[3];
        for (uint32_t k = 0; k < 3; k++) {
            p[k] = glms_vec3_sub(mesh->vertices[first[i + k]].position, center);
            radius = fmax(radius, (double)glms_vec3_norm(p[k]));
            CHECK_NEAR(glms_vec3_norm(mesh->vertices[first[i + k]].normal), 1, 1e-5);
        }
        const vec3s facet = glms_vec3_cross(glms_vec3_sub(p[1], p[0]), glms_vec3_sub(p[2], p[0]));
        assert_true(glms_vec3_norm(facet) > 0);
        shape.area += (double)glms_vec3_norm(facet) / 2;
        shape.volume += (double)glms_vec3_dot(p[0], facet) / 6;
    }
    assert_true(radius > 0.3 * (double)box_diagonal(box));
    assert_true(radius < 0.8 * (double)box_diagonal(box));
    assert_true(glms_vec3_distance(center, box_center(box)) < 0.3f * box_diagonal(box));
    shape.area /= radius * radius;
    shape.volume /= radius * radius * radius;
    return shape;
}

static void test_shapes(void **state)
{
    (void)state;
    struct mesh mesh;
    generate(&mesh, 6, 3);
    const uint32_t indices = mesh.index_count / 6;
    struct shape shapes[6];
    for (uint32_t i = 0; i < 6; i++)
        shapes[i] = measure(&mesh, i, indices);
    for (int i = 0; i < 3; i++) {
        const int other = (i + 1) % 3;
        /* three models, which come again at other sizes */
        CHECK_NEAR(shapes[i].area, shapes[i + 3].area, 1e-3);
        assert_true(fabs(shapes[i].area - shapes[other].area) > 0.02);
        assert_true(shapes[i].area > 0.8 && shapes[i].area < 3.2); /* a disc has 3.14 */
        assert_true(fabs(shapes[i].volume) > 1e-3);                /* a plane sheet has 0 */
    }
    mesh_finish(&mesh);
}

/* Copies of somebody's own sheet, about as large as the box, at the places of the others. */
static void test_own_sheet(void **state)
{
    (void)state;
    struct mesh sheet, mesh;
    assert_true(mesh_init(&sheet, 3, 3));
    for (uint32_t i = 0; i < 3; i++) {
        sheet.vertices[i].position.raw[i] = 1;
        sheet.vertices[i].normal.y = 1;
        sheet.indices[i] = i;
    }
    const struct generate_cracks params = { 4, 7, 1 };
    assert_true(generate_cracks(&mesh, box, &params, &sheet));
    assert_int_equal(mesh.vertex_count, 12);
    assert_int_equal(mesh.index_count, 12);
    const float half = box_diagonal(box) / 2;
    for (uint32_t i = 0; i < 12; i += 3) {
        const float side =
            glms_vec3_distance(mesh.vertices[i].position, mesh.vertices[i + 1].position);
        assert_true(side > 0.64f * sqrtf(2) * half && side < 0.96f * sqrtf(2) * half);
    }
    mesh_finish(&mesh);
    mesh_finish(&sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_own_sheet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
