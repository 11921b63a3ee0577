/*
 * test_generate_bubbles.c: generated bubbles are inside the object, do not overlap, and have the
 * requested shapes.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "src/scene/generate/generate.h"
#include "src/scene/generate/random.h"
#include "tests/support/assertions.h"

static void make(struct bubbles *bubbles, const struct mesh *mesh, uint32_t count, float size)
{
    const struct generate_bubbles params = { .count = count, .seed = 1, .size = size };
    assert_true(generate_bubbles(bubbles, mesh, &params));
}

static void check_apart(const struct bubbles *bubbles, float largest)
{
    for (uint32_t i = 0; i < bubbles->count; i++) {
        const struct bubble a = bubbles->all[i];
        assert_true(a.radius > 0 && a.radius <= largest);
        for (uint32_t k = 0; k < i; k++) {
            const struct bubble b = bubbles->all[k];
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
            const struct bubble s = bubbles->all[i];
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
    free(few.all);
    free(many.all);
    free(none.all);
    mesh_finish(&mesh);
}

static void away_from_the_rim(void **state)
{
    (void)state;
    const struct generate_bubbles params = { .count = 200, .seed = 1, .size = 0.02F, .rim = 0.2F };
    struct bubbles bubbles;
    struct mesh mesh = { 0 };
    assert_true(generate_sphere(&mesh, 960));
    assert_true(generate_bubbles(&bubbles, &mesh, &params));
    assert_int_equal(bubbles.count, 200);
    float outermost = 0;
    for (uint32_t i = 0; i < bubbles.count; i++)
        outermost = fmaxf(outermost, glms_vec3_norm(bubbles.all[i].center));
    /* Along the axes at least .4 of the radius, so at least that by the root of 3 in all. */
    assert_in_range(1000 * outermost, 600, 1000 * (1 - 0.4F / 1.7320508F));
    free(bubbles.all);
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
        const vec3s c = bubbles.all[i].center;
        const float away = fmaxf(fabsf(c.x), fabsf(c.y));
        assert_true(away > block_side / 2 && away < 1.5F * block_side);
        assert_true(fabsf(c.z) < block_side / 2);
        quarters[2 * (c.x > 0) + (c.y > 0)]++;
    }
    for (int i = 0; i < 4; i++)
        assert_in_range(quarters[i], 75, 175);
    free(bubbles.all);
    mesh_finish(&mesh);
}

static void seeds_repeat(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    struct bubbles bubbles[3];
    assert_true(generate_ice_cube(&mesh, GENERATE_ICE_CUBE_TRIANGLES));
    for (uint32_t i = 0; i < 3; i++) {
        const struct generate_bubbles params = { .count = 100,
                                                 .seed = i < 2 ? 1 : 2,
                                                 .size = 0.03F };
        assert_true(generate_bubbles(&bubbles[i], &mesh, &params));
        assert_int_equal(bubbles[i].count, 100);
    }
    const size_t size = 100 * sizeof(struct bubble);
    assert_memory_equal(bubbles[0].all, bubbles[1].all, size);
    assert_memory_not_equal(bubbles[0].all, bubbles[2].all, size);
    for (uint32_t i = 0; i < 3; i++)
        free(bubbles[i].all);
    mesh_finish(&mesh);
}

/* ---- shapes ---- */

/* Whatever the shape, the places are the same, and the longest diameters. */
static void shapes_keep_places(void **state)
{
    static const float stretch = 4;
    struct mesh mesh = { 0 };
    struct bubbles spheres, others;
    uint32_t kinds[3] = { 0 };
    (void)state;
    assert_true(generate_ice_cube(&mesh, 1200));
    make(&spheres, &mesh, 100, 0.1F);
    const struct generate_bubbles params = {
        .count = 100, .seed = 1, .size = 0.1F, .shape = GENERATE_BUBBLES_MIXED, .stretch = stretch
    };
    assert_true(generate_bubbles(&others, &mesh, &params));
    assert_int_equal(others.count, spheres.count);
    for (uint32_t i = 0; i < others.count; i++) {
        const struct bubble *a = &spheres.all[i], *b = &others.all[i];
        const float along = b->radius + b->stretch, longest = fmaxf(along, b->radius);
        assert_memory_equal(&a->center, &b->center, sizeof(a->center));
        CHECK_NEAR(longest, a->radius, 1e-6);
        if (bubble_is_sphere(b))
            continue;
        CHECK_NEAR(longest / fminf(along, b->radius), stretch, 1e-4);
        CHECK_NEAR(glms_vec3_norm(b->axis), 1, 1e-6);
        assert_true(glms_vec3_dot(b->axis, glms_vec3_normalize(b->center)) > 0.9F);
        assert_true(!b->is_capsule || b->stretch > 0);
        kinds[b->is_capsule ? 2 : b->stretch < 0]++;
    }
    for (int i = 0; i < 3; i++)
        assert_in_range(kinds[i], 10, 40);
    free(spheres.all);
    free(others.all);
    mesh_finish(&mesh);
}

/* Worms, beads and eggs are apart, away from the rim, and most lie along the way to the middle. */
static void grown(void **state)
{
    const struct generate_bubbles params = {
        .count = 300, .seed = 1, .size = 0.13F, .shape = GENERATE_BUBBLES_GROWN, .stretch = 20
    };
    struct mesh mesh = { 0 };
    struct bubbles bubbles;
    uint32_t worms = 0, inwards = 0;
    (void)state;
    assert_true(generate_ice_cube(&mesh, 1200));
    assert_true(generate_bubbles(&bubbles, &mesh, &params));
    assert_int_equal(bubbles.count, params.count);
    const float longest = params.size * box_diagonal(mesh_box(&mesh)) / 2;
    for (uint32_t i = 0; i < bubbles.count; i++) {
        const struct bubble *a = &bubbles.all[i];
        CHECK_NEAR(glms_vec3_norm(a->axis), 1, 1e-6);
        assert_true(a->radius < 2.3F * longest / params.stretch && a->stretch < longest);
        for (int step = -8; step <= 8; step++) {
            const float along = 0.125f * (float)step * a->stretch;
            const vec3s at = glms_vec3_muladds(a->axis, along, a->center);
            assert_true(fabsf(at.x) < 0.8F && fabsf(at.y) < 0.8F && fabsf(at.z) < 0.8F);
            for (uint32_t k = 0; k < i; k++)
                assert_false(bubble_contains(&bubbles.all[k], at));
        }
        worms += a->is_capsule;
        inwards += glms_vec3_dot(a->axis, glms_vec3_normalize(a->center)) < -0.7F;
    }
    assert_in_range(worms, 40, 200);
    assert_in_range(inwards, 180, 300);
    free(bubbles.all);
    mesh_finish(&mesh);
}

/* One of each shape, along no axis of the world. */
static struct bubble shape_of(uint32_t i)
{
    const struct bubble shapes[] = {
        { .radius = 0.5F },
        { .radius = 0.2F, .stretch = 0.6F },
        { .radius = 0.9F, .stretch = -0.6F },
        { .radius = 0.3F, .stretch = 0.5F, .is_capsule = true },
    };
    struct bubble bubble = shapes[i % 4];
    bubble.center = (vec3s){ { 3, -2, 5 } };
    bubble.axis = glms_vec3_normalize((vec3s){ { 1, 2, -2 } });
    return bubble;
}

/* Where a ray is inside is where points are; its box and its faces touch it. */
static void rays_and_points(void **state)
{
    uint32_t crossed = 0;
    (void)state;
    for (uint32_t i = 0; i < 4000; i++) {
        struct random random = random_begin(1, i);
        const struct bubble bubble = shape_of(i);
        const struct box box = bubble_box(&bubble);
        const vec3s out = random_box(&random), to = random_box(&random);
        const vec3s origin = glms_vec3_muladds(out, 3, bubble.center);
        vec3s dir = glms_vec3_sub(glms_vec3_muladds(to, 0.9F, bubble.center), origin);
        if (i % 11 < 4) /* some along the axis */
            dir = glms_vec3_scale(bubble.axis, 2);
        double at[2] = { 2, 2 };
        const bool is_hit = bubble_intersect(&bubble, origin, dir, at);
        for (int k = 0; k <= 400; k++) {
            const double t = -2 + k * 0.01;
            const vec3s point = glms_vec3_muladds(dir, (float)t, origin);
            if (fabs(t - at[0]) > 1e-4 && fabs(t - at[1]) > 1e-4)
                assert_int_equal(bubble_contains(&bubble, point), is_hit && t > at[0] && t < at[1]);
        }
        for (int k = 0; k < 2 && is_hit; k++) {
            const struct bubble_face face = bubble_face_at(&bubble, origin, dir, at[k]);
            const vec3s in = glms_vec3_muladds(face.normal, -1e-4F, face.position);
            const vec3s beside = glms_vec3_muladds(face.normal, 1e-4F, face.position);
            const vec3s met = glms_vec3_muladds(dir, (float)at[k], origin);
            assert_true(glms_vec3_distance(met, face.position) < 1e-5F);
            assert_true(bubble_contains(&bubble, in) && !bubble_contains(&bubble, beside));
            assert_int_equal(k, glms_vec3_dot(face.normal, dir) > 0);
            for (int axis = 0; axis < 3; axis++)
                assert_true(face.position.raw[axis] > box.min.raw[axis] - 1e-5F &&
                            face.position.raw[axis] < box.max.raw[axis] + 1e-5F);
        }
        crossed += is_hit;
    }
    assert_in_range(crossed, 800, 3200);
}

/* Boxes are no larger than they must be. */
static void boxes(void **state)
{
    enum {
        COUNT = 60, /* points along each side of the box */
    };

    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        const struct bubble bubble = shape_of(i);
        const struct box box = bubble_box(&bubble);
        const vec3s size = glms_vec3_sub(box.max, box.min);
        struct box found = { bubble.center, bubble.center };
        for (uint32_t k = 0; k < COUNT * COUNT * COUNT; k++) {
            const uint32_t row = k / COUNT, layer = row / COUNT;
            const vec3s share = { { ((float)(k % COUNT) + 0.5F) / COUNT,
                                    ((float)(row % COUNT) + 0.5F) / COUNT,
                                    ((float)layer + 0.5F) / COUNT } };
            const vec3s point = glms_vec3_add(box.min, glms_vec3_mul(size, share));
            if (!bubble_contains(&bubble, point))
                continue;
            found.min = glms_vec3_minv(found.min, point);
            found.max = glms_vec3_maxv(found.max, point);
        }
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(found.max.raw[k] - found.min.raw[k], size.raw[k], 0.1 * (double)size.raw[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_inside_a_sphere),     cmocka_unit_test(away_from_the_rim),
        cmocka_unit_test(inside_a_body_with_a_hole), cmocka_unit_test(seeds_repeat),
        cmocka_unit_test(shapes_keep_places),        cmocka_unit_test(grown),
        cmocka_unit_test(rays_and_points),           cmocka_unit_test(boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
