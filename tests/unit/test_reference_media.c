/*
 * test_reference_media.c: nested media in the reference renderer, against closed forms: slabs
 * inside each other, the view from under water, thin walls, rough balls, priorities.
 */
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>

#include "shaders/microfacet.h"
#include "src/lab/reference/nested_media.h"
#include "src/scene/generate/generate.h"
#include "src/tech/refract/refract.h"
#include "tests/support/assertions.h"
#include "tests/support/picture.h"
#include "tests/support/reference_ray.h"

static const double glass = 1.5;
static const double water = 1.333;

/* ---- scenes of boxes ---- */

/* Adds a box with flat normals; corners are least and greatest. */
static void add_box(struct scene *scene, vec3s least, vec3s most, struct material material)
{
    struct model *model = &scene->model;
    struct mesh box;
    const uint32_t first = model->object.index_count;
    assert_true(mesh_init(&box, 24, 36));
    for (uint32_t side = 0; side < 6; side++) {
        const uint32_t axis = side / 2;
        const bool is_far = side % 2;
        for (uint32_t k = 0; k < 4; k++) {
            struct mesh_vertex *vertex = &box.vertices[4 * side + k];
            vertex->normal.raw[axis] = is_far ? 1.0F : -1.0F;
            vertex->position.raw[axis] = is_far ? most.raw[axis] : least.raw[axis];
            const uint32_t u = (axis + 1) % 3;
            const uint32_t v = (axis + 2) % 3;
            vertex->position.raw[u] = k % 2 ? most.raw[u] : least.raw[u];
            vertex->position.raw[v] = k / 2 ? most.raw[v] : least.raw[v];
        }
        static const uint32_t corners[2][6] = { { 0, 2, 1, 1, 2, 3 }, { 0, 1, 2, 1, 3, 2 } };
        for (uint32_t k = 0; k < 6; k++)
            box.indices[6 * side + k] = 4 * side + corners[is_far][k];
    }
    assert_true(mesh_append(&model->object, &box));
    mesh_finish(&box);
    model->objects = realloc(model->objects, (model->object_count + 1) * sizeof(struct object));
    model->materials =
        realloc(model->materials, (model->material_count + 1) * sizeof(struct material));
    assert_true(model->objects && model->materials);
    model->objects[model->object_count++] = (struct object){
        .first_index = first,
        .index_count = 36,
        .material = model->material_count,
    };
    model->materials[model->material_count++] = material;
    scene->box = mesh_box(&model->object);
}

/* A box of 100 m across, from z = near down to z = far. */
static void add_slab(struct scene *scene, float near, float far, struct material material)
{
    add_box(scene, (vec3s){ { -50, -50, far } }, (vec3s){ { 50, 50, near } }, material);
}

static struct material clear(double ior)
{
    struct material material = material_make("clear");
    material.transmission = 1;
    material.roughness = 0;
    material.thickness = 1;
    material.ior = (float)ior;
    return material;
}

static struct material with_priority(struct material material, int32_t priority)
{
    material.priority = priority;
    material.flags |= MATERIAL_HAS_PRIORITY;
    return material;
}

static struct scene white_scene(void)
{
    return (struct scene){ .background.kind = SCENE_COLOR, .background.color = glms_vec3_one() };
}

static void rank(struct scene *scene)
{
    assert_int_equal(object_assign_ranks(scene->model.objects, scene->model.object_count,
                                         &scene->model.object, scene->model.materials),
                     STATUS_OK);
    assert_true(coincident_shells_find(&scene->contacts, scene->model.objects,
                                       scene->model.object_count, &scene->model.object));
    const struct settings settings = settings_default();
    const struct refract_params *refract = settings_of(&settings, &refract_settings);
    scene->model_ior = refract->ior; /* so the materials' own indices count */
}

/* ---- order ---- */

/* Rank of the boxes: b in a, and c beside them, which came last. */
static void ranks_of(struct scene *scene, struct material a, struct material b, uint32_t ranks[3])
{
    add_box(scene, (vec3s){ { 0, 0, 0 } }, (vec3s){ { 4, 4, 4 } }, a);
    add_box(scene, (vec3s){ { 9, 9, 9 } }, (vec3s){ { 10, 10, 10 } }, clear(2));
    add_box(scene, (vec3s){ { 1, 1, 1 } }, (vec3s){ { 2, 2, 2 } }, b);
    rank(scene);
    for (int i = 0; i < 3; i++)
        ranks[i] = scene->model.objects[i].rank;
    scene_finish(scene);
}

static void test_ranks(void **state)
{
    struct scene scene = { 0 };
    uint32_t ranks[3];
    (void)state;
    ranks_of(&scene, clear(1.5), clear(1.3), ranks); /* what lies inside wins */
    assert_true(ranks[2] > ranks[1] && ranks[1] > ranks[0]);
    ranks_of(&scene, with_priority(clear(1.5), -7), clear(1.3), ranks); /* stated beats none */
    assert_true(ranks[0] > ranks[2] && ranks[2] > ranks[1]);
    ranks_of(&scene, with_priority(clear(1.5), 3), with_priority(clear(1.3), 2), ranks);
    assert_true(ranks[0] > ranks[2] && ranks[2] > ranks[1]);
    ranks_of(&scene, with_priority(clear(1.5), 2), with_priority(clear(1.3), 2), ranks);
    assert_true(ranks[2] > ranks[0] && ranks[0] > ranks[1]);
}

/* The innermost of three containers is the smallest; of two that are equal, the last one. */
static void test_containers(void **state)
{
    struct scene scene = { 0 };
    (void)state;
    add_box(&scene, (vec3s){ { 0, 0, 0 } }, (vec3s){ { 4, 4, 4 } }, clear(1.5));
    add_box(&scene, (vec3s){ { 2, 2, 2 } }, (vec3s){ { 3, 3, 3 } }, clear(1.3));
    add_box(&scene, (vec3s){ { 1, 1, 1 } }, (vec3s){ { 3.5f, 3.5f, 3.5f } }, clear(1.4));
    add_box(&scene, (vec3s){ { 1, 1, 1 } }, (vec3s){ { 3.5f, 3.5f, 3.5f } }, clear(1.4));
    rank(&scene);
    assert_int_equal(scene.model.objects[1].enclosing_object, 4);
    assert_int_equal(scene.model.objects[1].container_rank, scene.model.objects[3].rank);
    assert_int_equal(scene.model.objects[0].enclosing_object, 0);
    scene_finish(&scene);
}

/* ---- slabs ---- */

/* What a stack of surfaces reflects without interference, from the first on: each pair as two
 * plates of the same reflectance from both sides. */
static double reflected(const double *surfaces, size_t count)
{
    double all = 0;
    for (size_t i = count; i-- > 0;) {
        const double pass = 1 - surfaces[i];
        all = surfaces[i] + pass * pass * all / (1 - surfaces[i] * all);
    }
    return all;
}

/* Checks water between panes of glass, into which its box reaches by `overlap`; behind is white,
 * before it black. */
static void check_glass_water_glass(float overlap, struct material pane, struct material liquid)
{
    static const double angles[] = { 0, 20, 40, 60, 75 };
    const struct settings settings = SETTINGS("reference.cutoff=1e-6");
    struct scene scene = white_scene();
    add_slab(&scene, -2 + overlap, -3 - overlap, liquid);
    add_slab(&scene, -1, -2, pane);
    add_slab(&scene, -3, -4, pane);
    rank(&scene);
    picture_add_quad(&scene, &(struct picture_quad){
                                 .top_left = { { -300, 300, 8 } },
                                 .right = { { 600, 0, 0 } },
                                 .down = { { 0, -600, 0 } },
                                 .material = MESH_UNLIT,
                             });
    for (uint32_t i = 0; i < scene.model.surroundings.vertex_count; i++)
        scene.model.surroundings.vertices[i].color = glms_vec3_zero();
    for (size_t i = 0; i < sizeof(angles) / sizeof(angles[0]); i++) {
        const double in = angles[i] * REFERENCE_RAY_PI / 180;
        const double in_glass = asin(sin(in) / glass);
        const double outer = reference_ray_fresnel(in, 1, glass);
        const double inner = reference_ray_fresnel(in_glass, glass, water);
        const double surfaces[] = { outer, inner, inner, outer };
        const struct reference_ray seen = reference_ray_trace(
            &scene, &settings, (struct vec){ 0, 0, 3 }, reference_ray_direction(in));
        CHECK_NEAR(seen.color.x, 1 - reflected(surfaces, 4), 1e-4);
        CHECK_NEAR(seen.fresnel, outer, 1e-5);
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(in)) < 0.01);
    }
    scene_finish(&scene);
}

/* Panes and water that share faces, or nearly, are as if they overlapped. */
static void test_glass_water_glass(void **state)
{
    (void)state;
    check_glass_water_glass(0.5F, with_priority(clear(glass), 3), with_priority(clear(water), 1));
    for (int i = -1; i <= 1; i++)
        check_glass_water_glass(2e-3F * (float)i, clear(glass), clear(water));
}

/* Makes one object of two adjacent ones. */
static void join_objects(struct model *model)
{
    model->objects[0].index_count += model->objects[1].index_count;
    model->objects[0].solid_count = 2;
    model->object_count = 1;
}

/* A slab in two parts that share a face is one slab, also of a tint and a rough surface, and if the
 * parts are one object. */
static void test_split_slab(void **state)
{
    const struct settings settings = SETTINGS("reference.cutoff=1e-6");
    struct material material = clear(glass);
    struct reference_ray seen[3];
    (void)state;
    material.base_color = (vec3s){ { 0.5F, 0.7F, 0.9F } };
    material.roughness = 0.1F;
    for (int i = 0; i < 3; i++) {
        struct scene scene = white_scene();
        add_slab(&scene, -1, i ? -1.7F : -3, material);
        if (i)
            add_slab(&scene, -1.7F, -3, material);
        if (i == 2)
            join_objects(&scene.model);
        rank(&scene);
        assert_int_equal(scene.contacts.pair_count, i == 1);
        seen[i] = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 3 },
                                      reference_ray_direction(0.5));
        scene_finish(&scene);
    }
    for (int i = 1; i < 3; i++) {
        CHECK_NEAR(seen[0].color.x, seen[i].color.x, 1e-3);
        CHECK_NEAR(seen[0].color.z, seen[i].color.z, 1e-3);
    }
    assert_true(seen[0].color.z > 0.5);
}

/* Light is attenuated by each medium over its own length, and by none where none is. */
static void test_attenuation(void **state)
{
    const struct settings settings = SETTINGS("reference.cutoff=1e-6", "reference.bounces=6");
    struct material red = clear(1), blue = clear(1);
    struct scene scene = white_scene();
    (void)state;
    red.attenuation_color = (vec3s){ { 1, 0.5F, 0.25F } };
    red.attenuation_distance = 2;
    blue.attenuation_color = (vec3s){ { 0.5F, 0.5F, 1 } };
    blue.attenuation_distance = 1;
    add_slab(&scene, -1, -4, red);
    add_slab(&scene, -2, -3, blue); /* inside: 1 m of blue, 2 m of red */
    rank(&scene);
    const struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 3 }, reference_ray_direction(0));
    CHECK_NEAR(seen.color.x, 0.5, 1e-5);
    CHECK_NEAR(seen.color.y, 0.5 * 0.5, 1e-5);
    CHECK_NEAR(seen.color.z, 0.25, 1e-5);
    scene_finish(&scene);
}

/* ---- the eye inside ---- */

/* Under water the sky fills a cone of 48.6 degrees around straight on; beyond, the surface is a
 * mirror. The water's surface is z = 0, and the eye looks out of it toward +Z. */
static void test_snells_window(void **state)
{
    static const double inside[] = { 0, 20, 40, 48 };
    const struct settings settings = settings_default();
    struct scene scene = white_scene();
    (void)state;
    add_slab(&scene, 0, -40, clear(water));
    rank(&scene);
    for (size_t i = 0; i < sizeof(inside) / sizeof(inside[0]); i++) {
        const double in = inside[i] * REFERENCE_RAY_PI / 180;
        const double out = asin(sin(in) * water);
        const struct reference_ray seen =
            reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, -2 },
                                reference_ray_direction(REFERENCE_RAY_PI - in));
        CHECK_NEAR(seen.fresnel, reference_ray_fresnel(in, water, 1), 1e-4);
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(REFERENCE_RAY_PI - out)) <
                    0.05);
        CHECK_NEAR(seen.z, 2 / cos(in), 1e-4);
    }
    const double limit = asin(1 / water);
    CHECK_NEAR(limit * 180 / REFERENCE_RAY_PI, 48.6, 0.05);
    for (int sign = -1; sign <= 1; sign += 2) {
        const struct reference_ray seen =
            reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, -2 },
                                reference_ray_direction(REFERENCE_RAY_PI - limit - sign * 0.002));
        assert_int_equal(seen.fresnel >= 1, sign > 0);
    }
    scene_finish(&scene);
}

/* ---- walls ---- */

/* A thin pane sends light straight on, and reflects 2 R / (1 + R). */
static void test_thin_wall(void **state)
{
    const struct settings settings = settings_default();
    struct material pane = clear(glass);
    struct scene scene = white_scene();
    (void)state;
    pane.thickness = 0;
    pane.base_color = (vec3s){ { 1, 0.5F, 0.25F } };
    add_slab(&scene, -1, -2, pane); /* two panes */
    rank(&scene);
    const double in = 1;
    const double one = reference_ray_fresnel(in, 1, glass);
    const struct reference_ray seen = reference_ray_trace(
        &scene, &settings, (struct vec){ 0, 0, 3 }, reference_ray_direction(in));
    CHECK_NEAR(seen.fresnel, 2 * one / (1 + one), 1e-5);
    assert_true(vec_angle_deg(vec_unit(seen.exit), reference_ray_direction(in)) < 1e-3);
    CHECK_NEAR(seen.path, 0, 0);
    assert_true(seen.refraction.y < 0.6 && seen.refraction.z < seen.refraction.y);
    scene_finish(&scene);
}

/* A sheet that is open is crossed as it faces, wherever the light was before. */
static void test_open_sheet(void **state)
{
    const struct settings settings = settings_default();
    struct scene scene = white_scene();
    (void)state;
    add_slab(&scene, -1, -2, clear(glass));
    scene.model.object.index_count = 36;
    rank(&scene);
    memset(&scene.model.object.indices[24], 0, 6 * sizeof(uint32_t)); /* no side at z = -2 */
    const struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, -4 },
                            reference_ray_direction(REFERENCE_RAY_PI - 0.5));
    CHECK_NEAR(seen.fresnel, reference_ray_fresnel(0.5, glass, 1),
               1e-5); /* leaves what it never entered */
    scene_finish(&scene);
}

/* ---- rough ---- */

/* What single scattering loses of light that is 1 everywhere (Cycles, GGX with a width of the
 * roughness squared: .990, .924, .635). */
static void test_rough_ball(void **state)
{
    static const double table[][2] = { { 0, 1 }, { 0.15, 0.990 }, { 0.3, 0.924 }, { 0.6, 0.635 } };
    const struct settings settings = settings_default();
    (void)state;
    for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
        struct scene scene = white_scene();
        add_slab(&scene, -1, -2, clear(glass));
        scene.model.materials[0].roughness = (float)table[i][0];
        mesh_finish(&scene.model.object);
        assert_true(generate_sphere(&scene.model.object, 20480));
        scene.model.objects[0].index_count = scene.model.object.index_count;
        scene.box = mesh_box(&scene.model.object);
        rank(&scene);
        const struct reference_request request = {
            .scene = &scene,
            .settings = &settings,
            .width = 24,
            .height = 24,
            .samples = 16,
            .layers = reference_ray_layers(),
            .linear = true,
        };
        const struct renderer_shot shot = {
            .camera = { .eye = { { 0, 0, 6 } }, .fov_deg = 18 },
        };
        struct render_result result = reference_ray_render_image(&request, &shot);
        const float *red = image_find(&result.image, "R");
        const float *fresnel = image_find(&result.image, "fresnel.Z");
        double sum = 0;
        size_t count = 0;
        for (size_t k = 0; k < (size_t)24 * 24; k++) {
            if (!(fresnel[k] > 0))
                continue;
            assert_true(red[k] < 1.001F);
            sum += (double)red[k];
            count++;
        }
        CHECK_NEAR(sum / (double)count, table[i][1], 0.02);
        render_result_finish(&result);
        scene_finish(&scene);
    }
}

/* The first 16 points are one in each of 16 columns, rows and squares, whatever the seed. */
static void test_points(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 8; seed++) {
        uint32_t columns = 0, rows = 0, squares = 0;
        for (uint32_t i = 0; i < 16; i++) {
            const vec2s p = microfacet_point(i, seed);
            columns |= 1u << (uint32_t)(p.x * 16);
            rows |= 1u << (uint32_t)(p.y * 16);
            squares |= 1u << ((uint32_t)(p.x * 4) * 4 + (uint32_t)(p.y * 4));
        }
        assert_int_equal(columns, 0xffff);
        assert_int_equal(rows, 0xffff);
        assert_int_equal(squares, 0xffff);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranks),
        cmocka_unit_test(test_containers),
        cmocka_unit_test(test_glass_water_glass),
        cmocka_unit_test(test_split_slab),
        cmocka_unit_test(test_attenuation),
        cmocka_unit_test(test_snells_window),
        cmocka_unit_test(test_thin_wall),
        cmocka_unit_test(test_open_sheet),
        cmocka_unit_test(test_rough_ball),
        cmocka_unit_test(test_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
