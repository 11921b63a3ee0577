/* test_melt.c: melting follows its law continuously, and inclusions follow the surface. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "src/scene/generate/generate.h"
#include "src/scene/geometry/vertex_weld.h"
#include "src/scene/melt/melt.h"
#include "src/scene/melt/melt_curvature_flow.h"
#include "tests/support/assertions.h"

static void check_between(double value, double least, double most)
{
    CHECK_NEAR(value, 0.5 * (least + most), 0.5 * (most - least));
}

/* A flow's surface, and the mesh that it is of. */
struct shell {
    struct mesh mesh;
    struct vertex_weld vertex_weld;
    struct melt_curvature_flow flow;
};

static void shell_start(struct shell *s)
{
    assert_true(vertex_weld_init(&s->vertex_weld, &s->mesh, 0, s->mesh.index_count));
    s->flow = (struct melt_curvature_flow){ .points = calloc(s->vertex_weld.count,
                                                             sizeof(*s->flow.points)),
                                            .count = s->vertex_weld.count,
                                            .corners = s->vertex_weld.corners,
                                            .corner_count = s->vertex_weld.corner_count };
    assert_non_null(s->flow.points);
    for (uint32_t i = 0; i < s->mesh.vertex_count; i++) {
        for (int k = 0; k < 3; k++)
            s->flow.points[s->vertex_weld.points[i]][k] =
                (double)s->mesh.vertices[i].position.raw[k];
    }
}

static void shell_finish(struct shell *s)
{
    free(s->flow.points);
    vertex_weld_finish(&s->vertex_weld);
    mesh_finish(&s->mesh);
}

static double volume_of(const struct melt_curvature_flow *flow)
{
    const double half = melt_curvature_flow_half_width(flow);
    return 8 * half * half * half;
}

/* A block with rounded edges, from the points of a ball. */
static struct shell block(float half, float rounding)
{
    struct shell s = { 0 };
    assert_true(generate_ice_cube(&s.mesh, 12 * 28 * 28));
    for (uint32_t i = 0; i < s.mesh.vertex_count; i++) {
        vec3s *p = &s.mesh.vertices[i].position;
        const vec3s on_cube = glms_vec3_scale(*p, half / glms_vec3_max(glms_vec3_abs(*p)));
        const float inner = half - rounding;
        const vec3s core = glms_vec3_clamp(on_cube, -inner, inner);
        *p = glms_vec3_muladds(glms_vec3_normalize(glms_vec3_sub(on_cube, core)), rounding, core);
    }
    shell_start(&s);
    return s;
}

/* The mean half width along the axes. */
static double half_width(const struct melt_curvature_flow *flow)
{
    double most = 0;
    for (uint32_t i = 0; i < flow->count; i++) {
        for (int k = 0; k < 3; k++)
            most = fmax(most, fabs(flow->points[i][k]));
    }
    return most;
}

/* Returns the radius of the edges along z that makes them reach as far as they do. */
static double edge_radius(const struct melt_curvature_flow *flow)
{
    const double half = half_width(flow);
    double most = 0;
    for (uint32_t i = 0; i < flow->count; i++) {
        const double *p = flow->points[i];
        if (fabs(p[2]) < 0.3 * half)
            most = fmax(most, (fabs(p[0]) + fabs(p[1])) / sqrt(2));
    }
    return (sqrt(2) * half - most) / (sqrt(2) - 1);
}

/* The table of the law: a block of 15 mm with edges of 2.7 mm, and 2 mm at which they stay. */
static void a_block_grows_round(void **state)
{
    static const struct {
        double width, volume, radius; /* of the first width and volume; mm */
    } law[] = { { 0.9, 0.73, 2.35 }, { 0.75, 0.42, 2.14 }, { 0.5, 0.12, 2.03 } };

    (void)state;
    for (size_t i = 0; i < sizeof(law) / sizeof(law[0]); i++) {
        struct shell s = block(15, 2.7f);
        const double first = volume_of(&s.flow);
        double lost;
        assert_true(melt_curvature_flow_run(&s.flow, 1 - law[i].volume, 0, &lost));
        CHECK_NEAR(lost, 1 - law[i].volume, 1e-4);
        CHECK_NEAR(volume_of(&s.flow) / first, law[i].volume, 1e-4);
        CHECK_NEAR(half_width(&s.flow) / 15, law[i].width, 0.02);
        CHECK_NEAR(edge_radius(&s.flow), law[i].radius, 0.15);
        shell_finish(&s);
    }
}

/* A ball of radius r loses 1 + d / r for each length that a face loses, d .118 of half a cube. */
static void a_ball_stays_one(void **state)
{
    struct shell s = { 0 };
    double lost, least = 1e9, most = 0;
    (void)state;
    assert_true(generate_sphere(&s.mesh, 4000));
    shell_start(&s);
    const double half = melt_curvature_flow_half_width(&s.flow), layer = 0.118 * half;
    assert_true(melt_curvature_flow_run(&s.flow, 0, 0.5, &lost));
    for (uint32_t i = 0; i < s.flow.count; i++) {
        const double *p = s.flow.points[i];
        const double radius = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        least = fmin(least, radius);
        most = fmax(most, radius);
    }
    double radius = 1;
    for (int i = 0; i < 1000; i++)
        radius -= 0.5 * half / 1000 * (1 + layer / radius);
    CHECK_NEAR(least, radius, 0.015);
    CHECK_NEAR(most, radius, 0.015);
    shell_finish(&s);
}

/* Returns the longest way of a point between two shares. */
static double way(bool (*generate)(struct mesh *, uint32_t), uint32_t triangles,
                  double lost_fraction, double more)
{
    struct shell a = { 0 }, b = { 0 };
    double lost, longest = 0;
    assert_true(generate(&a.mesh, triangles) && generate(&b.mesh, triangles));
    shell_start(&a);
    shell_start(&b);
    const double half = melt_curvature_flow_half_width(&a.flow);
    assert_true(melt_curvature_flow_run(&a.flow, lost_fraction, 0, &lost));
    CHECK_NEAR(lost, lost_fraction, 1e-4);
    assert_true(melt_curvature_flow_run(&b.flow, more, 0, &lost));
    for (uint32_t i = 0; i < a.flow.count; i++) {
        for (int k = 0; k < 3; k++)
            longest = fmax(longest, fabs(a.flow.points[i][k] - b.flow.points[i][k]));
    }
    shell_finish(&a);
    shell_finish(&b);
    return longest / half;
}

static void nothing_leaps(void **state)
{
    (void)state;
    check_between(way(generate_ice_cube, 1200, 0.3, 0.301), 1e-6, 0.005);
    check_between(way(generate_ice_cube, 1200, 0.97, 0.971), 1e-6, 0.05);
    check_between(way(generate_teapot, 3000, 0.6, 0.601), 1e-6, 0.02);
}

static struct model bare(bool (*generate)(struct mesh *, uint32_t))
{
    static struct object object;
    static struct material material;
    struct model model = {
        .objects = &object, .object_count = 1, .materials = &material, .material_count = 1
    };
    assert_true(generate(&model.object, 1200));
    material = material_make("ice");
    material.flags = MATERIAL_FROM_SETTINGS;
    object = (struct object){ .index_count = model.object.index_count };
    object.box = object_box(&object, &model.object);
    return model;
}

static void ice_stands_where_it_stood(void **state)
{
    struct model model = bare(generate_ice_cube), before = bare(generate_ice_cube);
    struct melted melted;
    (void)state;
    const struct box whole = mesh_box(&before.object);
    model.object.vertices[0].normal = (vec3s){ { 0, 1, 0 } }; /* of a file, which keeps its own */
    before.object.vertices[0].normal = model.object.vertices[0].normal;
    assert_int_equal(melt_model(&model, &(struct melting){ .lost_fraction = 0 }, 9, &melted),
                     STATUS_OK);
    assert_memory_equal(model.object.vertices, before.object.vertices,
                        model.object.vertex_count * sizeof(*model.object.vertices));
    assert_int_equal(melt_model(&model, &(struct melting){ .lost_fraction = 0.5f }, 0, &melted),
                     STATUS_OK);
    assert_memory_equal(model.object.indices, before.object.indices,
                        model.object.index_count * sizeof(*model.object.indices));
    const struct box left = mesh_box(&model.object);
    CHECK_NEAR(melted.lost_fraction, 0.5, 1e-4);
    CHECK_NEAR(left.min.y, whole.min.y, 1e-5);
    const double height = (double)whole.max.y - (double)whole.min.y;
    check_between((double)left.max.y - (double)left.min.y, 0.6 * height, 0.95 * height);
    CHECK_NEAR(melted_frost_factor(&melted), 0, 1e-6);
    CHECK_NEAR(melted.box.max.y - melted.box.min.y, whole.max.y - whole.min.y, 1e-5);
    melted_finish(&melted);
    mesh_finish(&model.object);
    mesh_finish(&before.object);
}

static void bubbles_shrink_at_the_surface(void **state)
{
    static const vec3s places[] = {
        { { 0, -0.2f, 0 } }, { { 0.78f, 0, 0 } }, { { 0.5f, -0.2f, 0 } }, { { 0.2f, -0.2f, 0.1f } }
    };
    struct model model = bare(generate_ice_cube);
    struct bubbles bubbles = { calloc(4, sizeof(*bubbles.all)), 4 };
    struct melted melted;
    (void)state;
    assert_non_null(bubbles.all);
    for (int i = 0; i < 4; i++)
        bubbles.all[i] = (struct bubble){ .center = places[i], .radius = 0.15f };
    bubbles.all[3].axis = (vec3s){ { 1, 0, 0 } };
    bubbles.all[3].stretch = 0.4f;
    bubbles.all[3].radius = 0.02f;
    bubbles.all[3].is_capsule = true;
    assert_int_equal(melt_model(&model, &(struct melting){ .lost_fraction = 0.4f }, 0, &melted),
                     STATUS_OK);
    assert_true(melt_bubbles(&bubbles, &model.object));
    assert_int_equal(bubbles.count, 3); /* the one at the side is gone */
    CHECK_NEAR(bubbles.all[0].radius, 0.15f, 1e-6);
    check_between((double)bubbles.all[1].radius, 0.01, 0.149);
    const struct bubble *shorter = &bubbles.all[2]; /* at one end */
    CHECK_NEAR(shorter->radius, 0.02f, 1e-6);
    check_between((double)shorter->stretch, 0.2, 0.399);
    CHECK_NEAR(shorter->center.x - shorter->stretch, -0.2f, 1e-5);
    free(bubbles.all);
    melted_finish(&melted);
    mesh_finish(&model.object);
}

/* Cracks grow wider at the surface, and are as wide as before deep below it. */
static void cracks_open_at_the_surface(void **state)
{
    const float deep[] = { 0, 0.5f, 0.9f, 2 };
    struct mesh block = { 0 }, cracks;
    (void)state;
    assert_true(generate_ice_cube(&block, 500));
    const float side = mesh_box(&block).max.x;
    assert_true(mesh_init(&cracks, 4, 0));
    for (int i = 0; i < 4; i++) {
        cracks.vertices[i].position = (vec3s){ { deep[i] * side, 0, 0 } };
        cracks.vertices[i].color = (vec3s){ { 0.5f, 0.5f, 0.5f } };
    }
    assert_true(melt_cracks(&cracks, &block, 0.5f));
    CHECK_NEAR(cracks.vertices[0].color.x, 0.5, 1e-6);
    for (int i = 1; i < 4; i++)
        assert_true(cracks.vertices[i].color.x >= cracks.vertices[i - 1].color.x);
    CHECK_NEAR(cracks.vertices[3].color.x, 0.5 * 11 * 11, 1e-3); /* as 1 + 20 m */
    mesh_finish(&block);
    mesh_finish(&cracks);
}

/* Films around the ice spread, with their textures, and go down where the ground does, but fill
 * hollows a little. */
static void films_spread(void **state)
{
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    struct material materials[2] = { material_make("stone"), material_make("film") };
    struct object ice = { 0 };
    struct model model = bare(generate_ice_cube);
    struct melted melted;
    (void)state;
    const struct box box = mesh_box(&model.object);
    materials[0].ior = 1.31f;
    materials[0].transmission = 1;
    materials[1].flags |= MATERIAL_IS_WATER_LAYER;
    ice.index_count = model.object.index_count;
    ice.box = box;
    model.objects = &ice;
    model.object_count = 1;
    model.materials = materials;
    model.material_count = 2;
    assert_true(mesh_init(&model.surroundings, 8, 12));
    for (uint32_t i = 0; i < 8; i++) { /* stone that falls towards +x, and a square of water on it,
                                        * which is level where the stone rises */
        struct mesh_vertex *v = &model.surroundings.vertices[i];
        const float half = i < 4 ? 20 : 2;
        const float x = i % 4 == 1 || i % 4 == 2 ? half : -half, z = i % 4 >= 2 ? half : -half;
        const float y = -0.1f * (i < 4 ? x : fmaxf(x, 0)) + (i < 4 ? 0 : 0.01f);
        v->position = (vec3s){ { x, box.min.y + y, z } };
        v->normal = (vec3s){ { 0, 1, 0 } };
        v->uv = (vec2s){ { 0.25f * x + 3, 0.5f * z } };
        v->material = (i < 4 ? 0u : 2u) << MESH_SURFACE_SHIFT;
    }
    for (uint32_t i = 0; i < 12; i++)
        model.surroundings.indices[i] = corners[i % 6] + i / 6 * 4;
    assert_int_equal(melt_model(&model, &(struct melting){ .lost_fraction = 0.5f }, 0, &melted),
                     STATUS_OK);
    for (uint32_t i = 4; i < 8; i++) {
        const struct mesh_vertex *v = &model.surroundings.vertices[i];
        const double x = (double)v->position.x, z = (double)v->position.z;
        check_between(fabs(x), 2.5, 5);
        CHECK_NEAR(fabs(z), fabs(x), 1e-4);
        CHECK_NEAR(v->uv.x, 0.25 * x + 3, 1e-4);
        CHECK_NEAR(v->uv.y, 0.5 * z, 1e-4);
        const double low = x > 0 ? 0.03 - 0.1 * x : 0.01;
        CHECK_NEAR(v->position.y, (double)box.min.y + low, 1e-4);
        CHECK_NEAR(model.surroundings.vertices[i - 4].position.x,
                   i % 4 == 1 || i % 4 == 2 ? 20 : -20, 0);
    }
    melted_finish(&melted);
    mesh_finish(&model.object);
    mesh_finish(&model.surroundings);
}

enum {
    AROUND = 64,
};

static bool generate_fine_ball(struct mesh *mesh, uint32_t triangles)
{
    return generate_sphere(mesh, 10 * triangles);
}

/* Melts a ball in a film whose rings have these radii, as shares of the ball's. Writes by how much
 * each ring grew, at least and at most. */
static void grow_rings(const float radii[3], float grown[3][2])
{
    struct material film = material_make("film");
    struct model model = bare(generate_fine_ball);
    struct mesh *mesh = &model.surroundings;
    struct melted melted;
    const struct box box = mesh_box(&model.object);
    film.flags |= MATERIAL_IS_WATER_LAYER;
    model.materials = (struct material[]){ model.materials[0], film };
    model.material_count = 2;
    assert_true(mesh_init(mesh, 3 * AROUND, 2 * AROUND * 6));
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float turn = (float)(i % AROUND) / (float)AROUND * 2 * GLM_PIf;
        const float out = radii[i / AROUND] * box.max.x;
        mesh->vertices[i].position =
            (vec3s){ { out * cosf(turn), box.min.y + 0.01f, out * sinf(turn) } };
        mesh->vertices[i].material = 2u << MESH_SURFACE_SHIFT;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const uint32_t k = i / 6, next = k / AROUND * AROUND + (k + 1) % AROUND;
        mesh->indices[i] =
            (const uint32_t[]){ k, next, next + AROUND, k, next + AROUND, k + AROUND }[i % 6];
    }
    assert_int_equal(melt_model(&model, &(struct melting){ .lost_fraction = 0.9f }, 0, &melted),
                     STATUS_OK);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const vec3s p = mesh->vertices[i].position;
        const float by = hypotf(p.x, p.z) / (radii[i / AROUND] * box.max.x);
        float *range = grown[i / AROUND];
        range[0] = i % AROUND ? fminf(range[0], by) : by;
        range[1] = i % AROUND ? fmaxf(range[1], by) : by;
    }
    melted_finish(&melted);
    mesh_finish(&model.object);
    mesh_finish(&model.surroundings);
}

/* Water at the foot of ice goes with it, however near it ends, and where ice bulges over its edge.
 * The reach of the ball's foot is 0.8 to 0.87 of its radius. */
static void water_stays_at_the_foot(void **state)
{
    static const float radii[2][3] = { { 0.5f, 0.9f, 1.1f }, { 0.4f, 0.65f, 0.78f } };
    (void)state;
    for (int i = 0; i < 2; i++) {
        float grown[3][2];
        grow_rings(radii[i], grown);
        check_between((double)grown[0][1], 0.2, 0.8);
        check_between((double)grown[1][1], 0.2, 0.95);
        check_between((double)grown[2][0], 1.3, 4);
    }
}

/* A meniscus of twice the water's height stands at the ice, and is gone with the ice. */
static void the_meniscus_goes_with_the_ice(void **state)
{
    static const float rings[5] = { 0.7f, 1.0f, 1.5f, 2.0f, 2.5f };
    static const float lost[2] = { 0.2f, 1.0f };
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct material film = material_make("film");
        struct model model = bare(generate_fine_ball);
        struct mesh *mesh = &model.surroundings;
        struct melted melted;
        const struct box box = mesh_box(&model.object);
        film.flags |= MATERIAL_IS_WATER_LAYER;
        model.materials = (struct material[]){ model.materials[0], film };
        model.material_count = 2;
        assert_true(mesh_init(mesh, 5 * AROUND, 4 * AROUND * 6));
        for (uint32_t k = 0; k < mesh->vertex_count; k++) {
            const float turn = (float)(k % AROUND) / (float)AROUND * 2 * GLM_PIf;
            const float out = rings[k / AROUND] * box.max.x;
            mesh->vertices[k].position =
                (vec3s){ { out * cosf(turn), box.min.y + (k < AROUND ? 0.02f : 0.01f),
                           out * sinf(turn) } };
            mesh->vertices[k].normal = (vec3s){ { 0, 1, 0 } };
            mesh->vertices[k].material = 2u << MESH_SURFACE_SHIFT;
        }
        for (uint32_t k = 0; k < mesh->index_count; k++) {
            const uint32_t at = k / 6, next = at / AROUND * AROUND + (at + 1) % AROUND;
            mesh->indices[k] = (const uint32_t[]){ at, next,          next + AROUND,
                                                   at, next + AROUND, at + AROUND }[k % 6];
        }
        assert_int_equal(
            melt_model(&model, &(struct melting){ .lost_fraction = lost[i] }, 0, &melted),
            STATUS_OK);
        CHECK_NEAR(mesh->vertices[0].position.y - box.min.y, i ? 0.01 : 0.02, 5e-4);
        CHECK_NEAR(mesh->vertices[2 * AROUND].position.y - box.min.y, 0.01, 1e-5);
        melted_finish(&melted);
        mesh_finish(&model.object);
        mesh_finish(&model.surroundings);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_block_grows_round),
        cmocka_unit_test(a_ball_stays_one),
        cmocka_unit_test(nothing_leaps),
        cmocka_unit_test(ice_stands_where_it_stood),
        cmocka_unit_test(bubbles_shrink_at_the_surface),
        cmocka_unit_test(cracks_open_at_the_surface),
        cmocka_unit_test(films_spread),
        cmocka_unit_test(water_stays_at_the_foot),
        cmocka_unit_test(the_meniscus_goes_with_the_ice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
