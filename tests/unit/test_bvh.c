/* test_bvh.c: BVH traversal agrees with testing all triangles one by one. */
#include <cglm/struct.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "src/scene/bvh/bvh.h"
#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"

static float pick(uint32_t *seed)
{
    *seed = *seed * 747796405u + 2891336453u;
    return (float)(*seed >> 8) * 0x1p-23f - 1.0f;
}

static vec3s pick_point(uint32_t *seed, float size)
{
    vec3s p;
    for (int k = 0; k < 3; k++)
        p.raw[k] = pick(seed) * size;
    return p;
}

/* Returns the distance to the first triangle that a ray meets, by Cramer's rule. */
static double meet_all(const struct mesh *mesh, vec3s origin, vec3s dir)
{
    double nearest = DBL_MAX;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        double m[3][3], from[3], c[4];
        const vec3s a = mesh->vertices[mesh->indices[i]].position;
        for (int k = 0; k < 3; k++) {
            m[0][k] =
                (double)mesh->vertices[mesh->indices[i + 1]].position.raw[k] - (double)a.raw[k];
            m[1][k] =
                (double)mesh->vertices[mesh->indices[i + 2]].position.raw[k] - (double)a.raw[k];
            m[2][k] = -(double)dir.raw[k];
            from[k] = (double)origin.raw[k] - (double)a.raw[k];
        }
        for (int column = 0; column < 4; column++) {
            const double *v[3];
            for (int k = 0; k < 3; k++)
                v[k] = k == column ? from : m[k];
            c[column] = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                        v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                        v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
        }
        const double u = c[0] / c[3], v = c[1] / c[3], t = c[2] / c[3];
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest)
            nearest = t;
    }
    return nearest;
}

/* Compares rays from all around, among them some from inside and some along an axis. */
static void compare(const struct model *model, const struct mesh *mesh, uint32_t part)
{
    struct bvh bvh;
    uint32_t seed = 1, met = 0;
    assert_int_equal(bvh_init(&bvh, &(struct bvh_params){ .model = model, .threads = 2 }),
                     STATUS_OK);
    for (int i = 0; i < 2000; i++) {
        const vec3s origin = pick_point(&seed, i % 3 ? 3.0f : 0.7f);
        const vec3s to = pick_point(&seed, 1.0f);
        vec3s dir = glms_vec3_normalize(glms_vec3_sub(to, origin));
        if (i % 7 == 0)
            dir = (vec3s){ { 0.0f, i % 2 ? 1.0f : -1.0f, 0.0f } };
        struct bvh_hit hit;
        const double expected = meet_all(mesh, origin, dir);
        const struct bvh_ray ray = { origin, dir, 0.0, BVH_NONE };
        assert_int_equal(bvh_intersect(&bvh, part, &ray, &hit), expected < DBL_MAX);
        if (expected < DBL_MAX)
            CHECK_NEAR(hit.t, expected, 2e-5);
        met += expected < DBL_MAX;
    }
    assert_true(met > 200);
    assert_true(bvh.depth <= BVH_DEPTH_MAX);
    bvh_finish(&bvh);
}

static void test_hits(void **state)
{
    (void)state;
    bool (*const generators[])(struct mesh *, uint32_t) = { generate_sphere, generate_ice_cube,
                                                            generate_teapot };
    for (size_t g = 0; g < 3; g++) {
        struct model model = { 0 };
        assert_true(generators[g](&model.object, 3000));
        compare(&model, &model.object, BVH_OBJECTS);
        model.surroundings = model.object;
        model.object = (struct mesh){ 0 };
        compare(&model, &model.surroundings, BVH_SURROUNDINGS);
        for (uint32_t i = 0; i < model.surroundings.vertex_count; i++)
            model.surroundings.vertices[i].material = MESH_ORBITS;
        compare(&model, &model.surroundings, BVH_MOVERS);
        mesh_finish(&model.surroundings);
    }
}

static void test_threads(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct bvh one, many;
    assert_true(generate_teapot(&model.object, 60000));
    assert_int_equal(bvh_init(&one, &(struct bvh_params){ .model = &model, .threads = 1 }),
                     STATUS_OK);
    assert_int_equal(bvh_init(&many, &(struct bvh_params){ .model = &model, .threads = 8 }),
                     STATUS_OK);
    assert_true(one.triangle_count > 50000);
    assert_int_equal(one.nodes.count, many.nodes.count);
    assert_memory_equal(one.nodes.all, many.nodes.all, one.nodes.count * sizeof(*one.nodes.all));
    assert_memory_equal(one.corners.all, many.corners.all,
                        one.corners.count * sizeof(*one.corners.all));
    bvh_finish(&one);
    bvh_finish(&many);
    mesh_finish(&model.object);
}

/* Triangles that no plane parts, and ever smaller ones, which a tree by areas parts one by one. */
static void test_depth(void **state)
{
    (void)state;

    enum {
        COUNT = 3000
    };

    for (int kind = 0; kind < 2; kind++) {
        struct model model = { 0 };
        struct bvh bvh;
        assert_true(mesh_init(&model.object, 3 * COUNT, 3 * COUNT));
        for (uint32_t i = 0; i < 3 * COUNT; i++) {
            const float size = kind ? powf(0.97f, floorf((float)i / 3.0f)) : 1.0f;
            model.object.indices[i] = i;
            model.object.vertices[i].position =
                (vec3s){ { size * (float)(i % 3 == 1), size * (float)(i % 3 == 2), size } };
        }
        assert_int_equal(bvh_init(&bvh, &(struct bvh_params){ .model = &model, .threads = 2 }),
                         STATUS_OK);
        assert_true(bvh.depth > 5 && bvh.depth <= BVH_DEPTH_MAX);
        const struct bvh_ray ray = {
            { { 0.0f, 0.0f, 5.0f } }, { { 0.0f, 0.0f, -1.0f } }, 0.0, BVH_NONE
        };
        struct bvh_hit hit;
        assert_true(bvh_intersect(&bvh, BVH_OBJECTS, &ray, &hit));
        CHECK_NEAR(hit.t, 4.0, 1e-6);
        assert_false(hit.is_back);
        bvh_finish(&bvh);
        mesh_finish(&model.object);
    }
}

/* A sphere in a sphere, and one beside. */
static void test_shells(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct object objects[3] = { { .rank = 2 }, { .rank = 1 }, { .rank = 3 } };
    struct bvh bvh;
    const float radii[3] = { 0.5f, 1.0f, 1.0f };
    for (int i = 0; i < 3; i++) {
        struct mesh ball = { 0 };
        assert_true(generate_sphere(&ball, 500));
        for (uint32_t v = 0; v < ball.vertex_count; v++) {
            ball.vertices[v].position = glms_vec3_scale(ball.vertices[v].position, radii[i]);
            ball.vertices[v].position.x += i == 2 ? 4.0f : 0.0f;
        }
        objects[i].first_index = model.object.index_count;
        objects[i].index_count = ball.index_count;
        assert_true(mesh_append(&model.object, &ball));
        mesh_finish(&ball);
    }
    model.objects = objects;
    model.object_count = 3;
    assert_int_equal(bvh_init(&bvh, &(struct bvh_params){ .model = &model, .threads = 2 }),
                     STATUS_OK);
    assert_int_equal(bvh_interior_list_at(&bvh, (vec3s){ { 0.01f, 0.02f, 0.0f } }).words[0], 3);
    assert_int_equal(bvh_interior_list_at(&bvh, (vec3s){ { 0.7f, 0.02f, 0.0f } }).words[0], 1);
    assert_int_equal(bvh_interior_list_at(&bvh, (vec3s){ { 4.0f, -0.7f, 0.0f } }).words[0], 4);
    assert_int_equal(bvh_interior_list_at(&bvh, (vec3s){ { 0.0f, -3.0f, 0.0f } }).words[0], 0);
    bvh_finish(&bvh);
    mesh_finish(&model.object);
}

/* Forty shells around each other, of which the eight greatest ranks are told; three materials. */
static void test_many_shells(void **state)
{
    (void)state;

    enum {
        COUNT = 40
    };

    struct model model = { .object_count = COUNT, .material_count = 5 };
    struct material materials[5] = { 0 };
    struct object objects[COUNT] = { 0 };
    struct bvh bvh;
    for (uint32_t i = 0; i < COUNT; i++) {
        struct mesh ball = { 0 };
        assert_true(generate_sphere(&ball, 100));
        for (uint32_t v = 0; v < ball.vertex_count; v++)
            ball.vertices[v].position =
                glms_vec3_scale(ball.vertices[v].position, (float)(COUNT - i));
        objects[i] = (struct object){ .first_index = model.object.index_count,
                                      .index_count = ball.index_count,
                                      .material = i % 3 + 2,
                                      .rank = i + 1 };
        assert_true(mesh_append(&model.object, &ball));
        mesh_finish(&ball);
    }
    model.objects = objects;
    model.materials = materials;
    assert_int_equal(bvh_init(&bvh, &(struct bvh_params){ .model = &model, .threads = 2 }),
                     STATUS_OK);
    for (uint32_t i = 0; i < COUNT; i++)
        assert_int_equal(bvh_medium(&bvh, i + 1), i % 3 + 1);
    assert_int_equal(bvh_medium(&bvh, 0), 0);
    const vec3s at = { { 27.5f, 0.02f, 0.0f } };
    const struct bvh_interior_list all =
        bvh_interior_list_at(&bvh, (vec3s){ { 0.01f, 0.02f, 0.0f } });
    struct bvh_interior_list some = bvh_interior_list_at(&bvh, at);
    for (uint32_t rank = 1; rank <= COUNT; rank++) {
        assert_int_equal(bvh_interior_list_contains(&all, &bvh, rank),
                         rank > COUNT - BVH_INTERIOR_LIST_MAX);
        assert_int_equal(bvh_interior_list_contains(&some, &bvh, rank), rank >= 6 && rank <= 13);
    }
    bvh_interior_list_remove(&some, &bvh, 13);
    bvh_interior_list_remove(&some, &bvh, 10);
    bvh_interior_list_insert(&some, &bvh, 7);
    bvh_interior_list_insert(&some, &bvh, 30);
    const struct bvh_interior_list expected = { { 30 | 12 << 16, 11 | 9 << 16, 8 | 7 << 16, 6 } };
    assert_memory_equal(&some, &expected, sizeof(some));
    bvh_finish(&bvh);
    mesh_finish(&model.object);
}

/* ---- poses ---- */

enum {
    MOVING = 50,
    TRIANGLES = 100, /* of each */
};

/* Fifty cubes of ice, turned and in other places at each time; a cube beyond `kept` is broken into
 * triangles that are strewn about. */
static void pose(struct model *model, float time, uint32_t kept)
{
    uint32_t seed = 7;
    *model = (struct model){ .object_count = MOVING };
    model->objects = calloc(MOVING, sizeof(*model->objects));
    assert_non_null(model->objects);
    for (uint32_t i = 0; i < MOVING; i++) {
        struct mesh cube = { 0 };
        assert_true(generate_ice_cube(&cube, TRIANGLES));
        const vec3s axis = glms_vec3_normalize(pick_point(&seed, 1.0f));
        const mat4s turn = glms_rotate(glms_mat4_identity(), time * (float)(i + 1), axis);
        const vec3s place = { { 4.0f * (float)i, time, 0.1f * time * (float)(i % 3) } };
        for (uint32_t v = 0; v < cube.vertex_count; v++) {
            vec3s *p = &cube.vertices[v].position;
            *p = i < kept ? *p : pick_point(&seed, 1.0f);
            *p = glms_vec3_add(glms_mat4_mulv3(turn, *p, 1.0f), place);
        }
        model->objects[i] = (struct object){ .first_index = model->object.index_count,
                                             .index_count = cube.index_count,
                                             .rank = i + 1 };
        assert_true(mesh_append(&model->object, &cube));
        mesh_finish(&cube);
    }
}

/* Begins what poses have in common, as a scene does. */
static struct bvh_rest_pose *begin(void)
{
    struct bvh_rest_pose *rest = bvh_rest_pose_create(true);
    assert_non_null(rest);
    pose(&rest->model, 0.0f, MOVING);
    rest->is_known = true;
    return rest;
}

static struct bvh grow(const struct model *model, struct bvh_rest_pose *rest)
{
    struct bvh bvh;
    const struct bvh_params params = { .model = model, .rest = rest, .threads = 1 };
    assert_int_equal(bvh_init(&bvh, &params), STATUS_OK);
    assert_int_equal(bvh.built + bvh.shared + bvh.refitted > 0, 1);
    return bvh;
}

static void check_same(const struct bvh_words *a, const struct bvh_words *b)
{
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->all, b->all, a->count * sizeof(*a->all));
}

static void check_same_trees(const struct bvh *a, const struct bvh *b)
{
    check_same(&a->nodes, &b->nodes);
    check_same(&a->triangles, &b->triangles);
    check_same(&a->corners, &b->corners);
}

static void check_rays(const struct bvh *bvh, const struct mesh *mesh, int objects)
{
    uint32_t seed = 3, met = 0;
    for (int i = 0; i < 200; i++) {
        const float x = 4.0f * (float)(i % objects);
        const vec3s origin = { { x + pick(&seed), 20.0f, pick(&seed) } };
        const struct bvh_ray ray = { origin, { { 0.0f, -1.0f, 0.0f } }, 0.0, BVH_NONE };
        const double expected = meet_all(mesh, origin, ray.dir);
        struct bvh_hit hit;
        assert_int_equal(bvh_intersect(bvh, BVH_OBJECTS, &ray, &hit), expected < DBL_MAX);
        if (expected < DBL_MAX)
            CHECK_NEAR(hit.t, expected, 1e-4);
        met += expected < DBL_MAX;
    }
    assert_true(met > 50);
}

/* A tree is built for one cube, and none for those that are moved; one pose after others, or alone,
 * has the same words. */
static void test_poses(void **state)
{
    (void)state;
    struct bvh_rest_pose *rest = bvh_rest_pose_create(true), *other = begin();
    struct model model;
    struct bvh before, bvh, fresh;
    pose(&model, 0.0f, MOVING);
    before = grow(&model, rest);
    assert_int_equal(before.built, 1);
    assert_int_equal(before.shared, MOVING - 1);
    rest->model = model;
    rest->is_known = true;
    for (int i = 1; i < 4; i++) {
        pose(&model, (float)i, MOVING);
        bvh = grow(&model, rest);
        assert_int_equal(bvh.built, 0);
        assert_int_equal(bvh.refitted, MOVING);
        assert_true(bvh.depth <= BVH_DEPTH_MAX);
        check_rays(&bvh, &model.object, MOVING);
        if (i == 3) {
            fresh = grow(&model, other);
            assert_int_equal(fresh.built, 1);
            check_same_trees(&bvh, &fresh);
            bvh_finish(&fresh);
        }
        bvh_finish(&bvh);
        model_finish(&model);
    }
    pose(&model, 0.0f, MOVING);
    bvh = grow(&model, rest); /* back at rest */
    check_same_trees(&bvh, &before);
    bvh_finish(&bvh);
    bvh_finish(&before);
    model_finish(&model);
    bvh_rest_pose_destroy(rest);
    bvh_rest_pose_destroy(other);
}

/* Trees of objects that fall apart are built anew. */
static void test_deformed(void **state)
{
    (void)state;
    struct bvh_rest_pose *rest = begin(), *other = begin();
    struct model model;
    struct bvh bvh, fresh;
    pose(&model, 1.0f, MOVING);
    bvh = grow(&model, rest);
    bvh_finish(&bvh);
    model_finish(&model);
    pose(&model, 2.0f, MOVING - 3);
    bvh = grow(&model, rest);
    assert_int_equal(bvh.built, 3);
    assert_int_equal(bvh.refitted, MOVING - 3);
    check_rays(&bvh, &model.object, MOVING);
    fresh = grow(&model, other);
    check_same_trees(&bvh, &fresh);
    bvh_finish(&fresh);
    bvh_finish(&bvh);
    model_finish(&model);
    bvh_rest_pose_destroy(rest);
    bvh_rest_pose_destroy(other);
}

/* Surroundings are apart where none is in the box around the objects, be it at rest or not; if the
 * objects turn, in the box around the corners' way. */
static void test_apart(void **state)
{
    (void)state;
    struct model model = { 0 };
    assert_true(generate_sphere(&model.object, 100));
    assert_true(generate_sphere(&model.surroundings, 100));
    const float shifts[] = { 0.0f, 1.5f, 2.2f, 3.0f };
    for (int i = 0; i < 8; i++) {
        struct bvh bvh;
        for (uint32_t k = 0; k < model.surroundings.vertex_count; k++) {
            struct mesh_vertex *vertex = &model.surroundings.vertices[k];
            vertex->position.x = model.object.vertices[k].position.x + shifts[i % 4];
            vertex->material = i < 4 ? 0 : MESH_ORBITS;
        }
        const struct bvh_params params = { .model = &model, .threads = 1 };
        assert_int_equal(bvh_init(&bvh, &params), STATUS_OK);
        assert_int_equal(bvh.surroundings_are_apart, i % 4 >= 2);
        assert_int_equal(bvh.is_disjoint_rotating, i == 3);
        bvh_finish(&bvh);
    }
    model_finish(&model);
}

/* A ball that has been pressed flat and, if `wildness` is not 0, torn. */
static void deform(struct model *model, float flatness, float wildness)
{
    uint32_t seed = 7;
    *model = (struct model){ 0 };
    assert_true(generate_sphere(&model->object, 3000));
    for (uint32_t i = 0; i < model->object.vertex_count; i++) {
        vec3s *p = &model->object.vertices[i].position;
        p->y *= 1.0f - flatness;
        *p = glms_vec3_add(*p, pick_point(&seed, wildness));
    }
}

/* The only tree of a part is kept while its triangles hardly move apart. */
static void test_melted(void **state)
{
    (void)state;
    struct bvh_rest_pose *rest = bvh_rest_pose_create(false), *other = bvh_rest_pose_create(false);
    struct model model;
    struct bvh bvh, fresh;
    deform(&model, 0.0f, 0.0f);
    bvh = grow(&model, rest);
    assert_int_equal(bvh.built, 1);
    bvh_finish(&bvh);
    rest->model = model;
    deform(&other->model, 0.0f, 0.0f);
    rest->is_known = other->is_known = true;
    for (int torn = 0; torn < 2; torn++) {
        deform(&model, 0.05f, torn ? 0.5f : 0.0f);
        bvh = grow(&model, rest);
        assert_int_equal(bvh.built, torn);
        assert_int_equal(bvh.refitted, 1 - torn);
        check_rays(&bvh, &model.object, 1);
        fresh = grow(&model, other);
        check_same_trees(&bvh, &fresh);
        bvh_finish(&fresh);
        bvh_finish(&bvh);
        model_finish(&model);
    }
    bvh_rest_pose_destroy(rest);
    bvh_rest_pose_destroy(other);
}

static void test_nothing(void **state)
{
    (void)state;
    const struct model model = { 0 };
    const struct bvh_ray ray = { .dir = { { 0.0f, 0.0f, 1.0f } }, .from = BVH_NONE };
    struct bvh bvh;
    struct bvh_hit hit;
    assert_int_equal(bvh_init(&bvh, &(struct bvh_params){ .model = &model, .threads = 1 }),
                     STATUS_OK);
    for (uint32_t part = 0; part < BVH_COUNT; part++)
        assert_false(bvh_intersect(&bvh, part, &ray, &hit));
    assert_int_equal(bvh_interior_list_at(&bvh, ray.origin).words[0], 0);
    bvh_finish(&bvh);
    bvh_finish(&bvh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hits),        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_depth),       cmocka_unit_test(test_shells),
        cmocka_unit_test(test_many_shells), cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_poses),       cmocka_unit_test(test_deformed),
        cmocka_unit_test(test_apart),       cmocka_unit_test(test_melted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
