/*
 * test_reference.c: the reference renderer against closed forms: sphere, slab, prism, absorption,
 * dispersion, white furnace. Pictures of one pixel, whose ray is the camera's axis.
 */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>

#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"
#include "tests/support/picture.h"
#include "tests/support/reference_ray.h"

static const double air = 1.0003;
static const double ice = 1.3091;

/* ---- sphere ---- */

static const double impacts[] = { 0.1, 0.3, 0.5, 0.7, 0.9 };

enum {
    IMPACT_COUNT = sizeof(impacts) / sizeof(impacts[0])
};

static struct scene sphere_scene(void)
{
    struct scene scene = picture_sphere_scene(glms_vec3_zero(), 160000);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = glms_vec3_one();
    return scene;
}

/* Facets lie a little off the sphere: what weighs depends on the incidence that is met.
 * Along -Z, past the centre on +X. */
static struct reference_ray look_at_sphere(const struct scene *scene,
                                           const struct settings *settings, double impact)
{
    return reference_ray_trace(scene, settings, (struct vec){ impact, 0, 4 },
                               reference_ray_direction(0));
}

static void test_sphere(void **state)
{
    struct scene scene = sphere_scene();
    const struct settings settings = settings_default();
    (void)state;
    for (size_t i = 0; i < IMPACT_COUNT; i++) {
        const double b = impacts[i];
        const double in = asin(b);
        const double inside = asin(b * air / ice);
        const struct reference_ray seen = look_at_sphere(&scene, &settings, b);
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(-2 * (in - inside))) < 0.01);
        CHECK_NEAR(seen.fresnel, reference_ray_fresnel(asin(seen.normal.x), air, ice), 1e-5);
        CHECK_NEAR(seen.path, 2 * cos(inside), 1e-4);
        CHECK_NEAR(seen.bounces, 0, 0);
        CHECK_NEAR(seen.tir, 0, 0);
        CHECK_NEAR(seen.z, 4 - cos(in), 1e-4);
        CHECK_NEAR(seen.normal.x, b, 1e-4);
        CHECK_NEAR(seen.position.x, b, 1e-6);
    }
    scene_finish(&scene);
}

static struct settings settings_of_bounces(int bounces)
{
    char assignment[32];
    snprintf(assignment, sizeof(assignment), "reference.bounces=%d", bounces);
    return SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-6", assignment);
}

/* What leaves after each of the first reflections inside, by letting light meet one surface more:
 * it weighs (1 - F)^2 F^k and has turned by 2 (i - t) + k (REFERENCE_RAY_PI - 2 t). */
static void test_reflections_inside(void **state)
{
    struct scene scene = sphere_scene();
    (void)state;
    picture_use_directions(&scene, 1024);
    for (size_t i = 0; i < IMPACT_COUNT; i++) {
        const double in = asin(impacts[i]);
        const double inside = asin(impacts[i] * air / ice);
        struct settings settings = settings_of_bounces(2);
        struct reference_ray last = look_at_sphere(&scene, &settings, impacts[i]);
        const double f = reference_ray_fresnel(asin(last.normal.x), air, ice);
        CHECK_NEAR(last.remaining.x, 1 - f, 1e-5);
        for (int k = 0; k < 4; k++) {
            const double weight = (1 - f) * (1 - f) * pow(f, k);
            const double turn = 2 * (in - inside) + k * (REFERENCE_RAY_PI - 2 * inside);
            settings = settings_of_bounces(3 + k);
            const struct reference_ray seen = look_at_sphere(&scene, &settings, impacts[i]);
            const struct vec light = vec_add(seen.color, -1, last.color);
            const struct vec want = picture_direction_color(reference_ray_direction(-turn));
            assert_true(vec_difference(light, vec_scale(want, weight)) < 1e-3 * weight + 1e-6);
            CHECK_NEAR(last.remaining.x - seen.remaining.x, weight, 1e-5);
            last = seen;
        }
    }
    scene_finish(&scene);
}

/* ---- slab and prism, of triangles with flat normals ---- */

static const float far = 50; /* of its ends, above and below */

/* The wall from a to b, its outside to the right of whoever walks there. */
static void put_wall(struct mesh *mesh, uint32_t wall, struct vec a, struct vec b)
{
    static const uint32_t corners[6] = { 0, 1, 3, 0, 3, 2 };
    const struct vec normal = vec_unit(vec_cross(vec_add(b, -1, a), (struct vec){ 0, 1, 0 }));
    for (uint32_t k = 0; k < 4; k++) {
        const struct vec p = k % 2 ? b : a;
        mesh->vertices[4 * wall + k] = (struct mesh_vertex){
            .position = { { (float)p.x, k < 2 ? -far : far, (float)p.z } },
            .normal = { { (float)normal.x, 0, (float)normal.z } },
        };
    }
    for (uint32_t k = 0; k < 6; k++)
        mesh->indices[6 * wall + k] = 4 * wall + corners[k];
}

static void put_end(struct mesh *mesh, const struct vec *points, uint32_t count, bool top)
{
    const uint32_t base = top ? 5 * count : 4 * count;
    uint32_t index = 6 * count + (top ? 3 * (count - 2) : 0);
    for (uint32_t i = 0; i < count; i++)
        mesh->vertices[base + i] = (struct mesh_vertex){
            .position = { { (float)points[i].x, top ? far : -far, (float)points[i].z } },
            .normal = { { 0, top ? 1.0F : -1.0F, 0 } },
        };
    for (uint32_t i = 1; i + 1 < count; i++) {
        mesh->indices[index++] = base;
        mesh->indices[index++] = base + i + !top;
        mesh->indices[index++] = base + i + top;
    }
}

/* Upright on a polygon, counter-clockwise seen from +Y. */
static struct scene prism_scene(const struct vec *points, uint32_t count)
{
    struct scene scene = { .background.kind = SCENE_COLOR };
    struct mesh *mesh = &scene.model.object;
    assert_true(mesh_init(mesh, 6 * count, 6 * count + 6 * (count - 2)));
    for (uint32_t i = 0; i < count; i++)
        put_wall(mesh, i, points[i], points[(i + 1) % count]);
    put_end(mesh, points, count, false);
    put_end(mesh, points, count, true);
    scene.box = mesh_box(mesh);
    return scene;
}

static struct scene slab_scene(double thickness)
{
    const struct vec points[4] = {
        { -60, 0, 0 },
        { 60, 0, 0 },
        { 60, 0, -thickness },
        { -60, 0, -thickness },
    };
    return prism_scene(points, 4);
}

static const double angles_deg[] = { 5, 20, 40, 60, 80 };

enum {
    ANGLE_COUNT = sizeof(angles_deg) / sizeof(angles_deg[0])
};

/* The wall behind tells by its colour where light arrives: red is x / 100. */
static void test_slab(void **state)
{
    const double thickness = 2;
    const double wall = -5;
    const struct settings settings = settings_of_bounces(3);
    struct scene scene = slab_scene(thickness);
    (void)state;
    picture_add_quad(&scene, &(struct picture_quad){
                                 .top_left = { { 0, 100, (float)wall } },
                                 .right = { { 100, 0, 0 } },
                                 .down = { { 0, -200, 0 } },
                                 .material = MESH_UNLIT,
                             });
    struct mesh *quad = &scene.model.surroundings;
    for (uint32_t i = 0; i < quad->vertex_count; i++)
        quad->vertices[i].color.x = quad->vertices[i].position.x / 100;
    for (size_t i = 0; i < ANGLE_COUNT; i++) {
        const double in = angles_deg[i] * REFERENCE_RAY_PI / 180;
        const double inside = asin(sin(in) * air / ice);
        const double shift = thickness * sin(in - inside) / cos(inside);
        const double straight = (3 - wall) * tan(in);
        const struct reference_ray seen = reference_ray_trace(
            &scene, &settings, (struct vec){ 0, 0, 3 }, reference_ray_direction(in));
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(in)) < 0.01);
        CHECK_NEAR(seen.path, thickness / cos(inside), 1e-4);
        const double f = reference_ray_fresnel(in, air, ice);
        CHECK_NEAR(seen.refraction.x / (1 - f) * 100, straight - shift / cos(in), 1e-3);
    }
    scene_finish(&scene);
}

/* Beer and Lambert, straight through to a wall. */
static void test_absorption(void **state)
{
    const struct settings settings =
        SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-6", "reference.bounces=3",
                 "absorb.red=0.5", "absorb.green=1", "absorb.blue=0.05");
    const double absorb[3] = { 0.5, 1, 0.05 };
    struct scene scene = slab_scene(2);
    (void)state;
    picture_add_quad(&scene, &(struct picture_quad){
                                 .top_left = { { -9, 9, -5 } },
                                 .right = { { 18, 0, 0 } },
                                 .down = { { 0, -18, 0 } },
                                 .color = { { 1, 1, 1 } },
                                 .material = MESH_UNLIT,
                             });
    const struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 3 }, reference_ray_direction(0));
    const double passed = 1 - reference_ray_fresnel(0, air, ice);
    const double got[3] = { seen.refraction.x, seen.refraction.y, seen.refraction.z };
    const double left[3] = { seen.remaining.x, seen.remaining.y, seen.remaining.z };
    for (int c = 0; c < 3; c++) {
        CHECK_NEAR(got[c], passed * exp(-absorb[c] * 2), 1e-5);
        CHECK_NEAR(left[c], passed * (1 - passed) * exp(-absorb[c] * 4), 1e-5);
    }
    scene_finish(&scene);
}

/* KHR_materials_dispersion: what each colour's index reflects. */
static void test_dispersion(void **state)
{
    const struct settings settings =
        SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-6", "reference.bounces=2",
                 "refract.ior=1.5", "refract.dispersion=1");
    const double indices[3] = { 1.4875, 1.5, 1.5125 };
    struct scene scene = slab_scene(2);
    (void)state;
    scene.background.color = glms_vec3_one();
    const struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 3 }, reference_ray_direction(1));
    const double got[3] = { seen.color.x, seen.color.y, seen.color.z };
    const double left[3] = { seen.remaining.x, seen.remaining.y, seen.remaining.z };
    for (int c = 0; c < 3; c++) {
        CHECK_NEAR(got[c], reference_ray_fresnel(1, air, indices[c]), 1e-5);
        CHECK_NEAR(left[c], 1 - reference_ray_fresnel(1, air, indices[c]), 1e-5);
    }
    CHECK_NEAR(seen.fresnel, reference_ray_fresnel(1, air, 1.5), 1e-5);
    CHECK_NEAR(seen.reflection.x, 1, 1e-5);
    scene_finish(&scene);
}

/* Deviation by a prism whose apex points to -X, of light that enters its face z = 0. */
static void test_prism(void **state)
{
    static const double incidences_deg[] = { 20, 30, 40, 55, 75 };
    const double apex = 50 * REFERENCE_RAY_PI / 180;
    const struct vec points[3] = { { 0, 0, 0 }, { 20, 0, 0 }, { 20, 0, -20 * tan(apex) } };
    const struct settings settings = settings_default();
    struct scene scene = prism_scene(points, 3);
    (void)state;
    for (size_t i = 0; i < 5; i++) {
        const double in = incidences_deg[i] * REFERENCE_RAY_PI / 180;
        const double first = asin(sin(in) * air / ice);
        const double second = apex - first;
        const double out = asin(sin(second) * ice / air);
        const struct vec entry = { 10, 0, 0 };
        const struct vec dir = reference_ray_direction(-in); /* toward the apex */
        const struct reference_ray seen =
            reference_ray_trace(&scene, &settings, vec_add(entry, -2, dir), dir);
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(out - apex)) < 0.01);
        CHECK_NEAR(seen.tir, 0, 0);
    }
    scene_finish(&scene);
}

/* Straight into a face opposite a right angle: reflected totally twice, and back. */
static void test_total_reflection(void **state)
{
    const struct vec points[3] = { { -10, 0, 0 }, { 10, 0, 0 }, { 0, 0, -10 } };
    const struct settings settings = SETTINGS("refract.ior=1.5");
    struct scene scene = prism_scene(points, 3);
    (void)state;
    const struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 2, 0, 3 }, reference_ray_direction(0));
    assert_true(vec_angle_deg(seen.exit, reference_ray_direction(REFERENCE_RAY_PI)) < 0.01);
    CHECK_NEAR(seen.path, 20, 1e-4);
    CHECK_NEAR(seen.bounces, 2, 0);
    CHECK_NEAR(seen.tir, 1, 0);
    scene_finish(&scene);
}

/* ---- normals that are not those of the triangles ---- */

static void tilt_wall(struct scene *scene, uint32_t wall, double degrees)
{
    for (uint32_t k = 0; k < 4; k++) {
        vec3s *n = &scene->model.object.vertices[4 * wall + k].normal;
        *n =
            glms_vec3_rotate(*n, (float)(degrees * REFERENCE_RAY_PI / 180), (vec3s){ { 0, 1, 0 } });
    }
}

/* Reflected outside at such a normal, light would leave the solid through its own wall. */
static void test_reflected_to_the_wrong_side(void **state)
{
    const struct vec points[3] = { { -10, 0, 0 }, { 10, 0, 0 }, { 0, 0, -10 } };
    const struct settings settings = SETTINGS("refract.ior=1.5");
    struct scene scene = prism_scene(points, 3);
    (void)state;
    tilt_wall(&scene, 1, -25);
    const struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 2, 0, 3 }, reference_ray_direction(0));
    assert_true(vec_angle_deg(seen.exit, reference_ray_direction(REFERENCE_RAY_PI)) < 0.01);
    CHECK_NEAR(seen.path, 20, 1e-4);
    CHECK_NEAR(seen.bounces, 2, 0);
    scene_finish(&scene);
}

/* Reflected into the front face it came to, it sees the sky all the same, as it would from the
 * smooth surface; with flat normals nothing is tilted. */
static void test_tilted_front(void **state)
{
    const struct settings tilted = settings_of_bounces(2);
    const struct settings flat = SETTINGS("reference.normals=flat");
    struct scene scene = slab_scene(2);
    (void)state;
    scene.background.color = glms_vec3_one();
    tilt_wall(&scene, 0, 8);
    const double in = 80 * REFERENCE_RAY_PI / 180;
    const struct vec entry = { 5, 3, 0 }; /* on no edge */
    const struct vec eye = vec_add(entry, -3, reference_ray_direction(in));
    struct reference_ray seen =
        reference_ray_trace(&scene, &tilted, eye, reference_ray_direction(in));
    CHECK_NEAR(seen.reflection.x, 1, 1e-5);
    CHECK_NEAR(seen.fresnel, reference_ray_fresnel(88 * REFERENCE_RAY_PI / 180, air, ice), 1e-5);
    seen = reference_ray_trace(&scene, &flat, eye, reference_ray_direction(in));
    CHECK_NEAR(seen.fresnel, reference_ray_fresnel(in, air, ice), 1e-5);
    assert_true(vec_angle_deg(seen.exit, reference_ray_direction(in)) < 0.01);
    scene_finish(&scene);
}

/* ---- white furnace ---- */

/* In light of 1 from everywhere all is 1, and what is cut off is accounted for: at most `most_left`
 * of the picture. Trapped light, at few SEEN_PIxels, is not even dimmed. */
static void check_furnace(bool (*generate)(struct mesh *, uint32_t), uint32_t triangles,
                          struct settings settings, double most_left)
{
    struct scene scene = { .background.kind = SCENE_COLOR, .background.color = glms_vec3_one() };
    assert_true(generate(&scene.model.object, triangles));
    scene.box = mesh_box(&scene.model.object);
    const struct reference_request request = {
        .scene = &scene,
        .settings = &settings,
        .width = 96,
        .height = 72,
        .samples = 2,
        .layers = reference_ray_layers(),
        .linear = true,
    };
    const struct renderer_shot shot = {
        .camera = camera_orbit(30, 20, 3, box_center(scene.box), 45),
    };
    struct render_result result = reference_ray_render_image(&request, &shot);
    const struct picture_layer color = picture_layer(&result.image, "");
    const struct picture_layer rest = picture_layer(&result.image, "remaining");
    double left = 0;
    for (size_t i = 0; i < (size_t)request.width * request.height; i++) {
        const struct vec remaining = picture_at(rest, i);
        const struct vec sum = vec_add(picture_at(color, i), 1, remaining);
        assert_true(vec_difference(sum, (struct vec){ 1, 1, 1 }) < 1e-3);
        left += (remaining.x + remaining.y + remaining.z) / 3 / (request.width * request.height);
    }
    assert_true(left > 0 && left < most_left);
    render_result_finish(&result);
    scene_finish(&scene);
}

static void test_white_furnace(void **state)
{
    (void)state;
    check_furnace(generate_sphere, 960,
                  SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-3"), 1e-3);
    check_furnace(generate_ice_cube, 4800,
                  SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-3"), 1e-3);
    check_furnace(generate_ice_cube, 4800,
                  SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-3",
                           "reference.normals=flat"),
                  1e-3);
    check_furnace(generate_ice_cube, 4800,
                  SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-3",
                           "reference.cutoff=1e-5"),
                  1e-5);
    check_furnace(generate_ice_cube, 4800,
                  SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-3",
                           "reference.cutoff=0.05"),
                  0.05);
    check_furnace(
        generate_ice_cube, 4800,
        SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-3", "refract.dispersion=2"),
        1e-3);
    check_furnace(
        generate_teapot, 3600,
        SETTINGS("reference.russian_roulette=off", "reference.cutoff=1e-3", "refract.ior=2.417"),
        0.01);
}

/* With roulette no light is missing from the mean, although trees are cut early, and no pixel is
 * farther from the radiance of the furnace than its noise allows. The furnace is brighter than the
 * control variate may be, so that there is noise. */
static void test_roulette(void **state)
{
    enum {
        SIDE = 24,
        BRIGHTNESS = 8,
    };
    const struct settings settings =
        SETTINGS("reference.russian_roulette=on", "reference.cutoff=0.05", "reference.bounces=6",
                 "refract.dispersion=2");
    struct scene scene = { .background.kind = SCENE_COLOR,
                           .background.color = glms_vec3_fill(BRIGHTNESS) };
    (void)state;
    assert_true(generate_ice_cube(&scene.model.object, 4800));
    scene.box = mesh_box(&scene.model.object);
    const struct reference_request request = {
        .scene = &scene,
        .settings = &settings,
        .width = SIDE,
        .height = SIDE,
        .samples = 64,
        .layers = reference_ray_layers(),
        .linear = true,
    };
    const struct renderer_shot shot = {
        .camera = camera_orbit(30, 20, 3, box_center(scene.box), 35),
    };
    struct render_result result = reference_ray_render_image(&request, &shot);
    const float *green = image_find(&result.image, "G");
    const float *rest = image_find(&result.image, "remaining.G");
    double sum = 0, square = 0;
    for (size_t k = 0; k < (size_t)SIDE * SIDE; k++) {
        const double off = (double)green[k] / BRIGHTNESS - 1;
        CHECK_NEAR(rest[k], 0, 1e-5);
        assert_true(fabs(off) < 6 * 0.05);
        sum += off;
        square += off * off;
    }
    assert_true(square > 1e-4); /* there is noise */
    assert_true(fabs(sum) < 3 * sqrt(square));
    render_result_finish(&result);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_reflections_inside),
        cmocka_unit_test(test_slab),
        cmocka_unit_test(test_absorption),
        cmocka_unit_test(test_dispersion),
        cmocka_unit_test(test_prism),
        cmocka_unit_test(test_total_reflection),
        cmocka_unit_test(test_reflected_to_the_wrong_side),
        cmocka_unit_test(test_tilted_front),
        cmocka_unit_test(test_white_furnace),
        cmocka_unit_test(test_roulette),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
