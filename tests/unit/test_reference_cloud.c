/*
 * test_reference_cloud.c: scattering media in the reference renderer, against closed forms: depth
 * below a surface, transmittance along a ray, phase function, conservation of energy.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "shaders/inclusions/medium_density.h"
#include "shaders/microfacet.h"
#include "src/lab/reference/volume_scattering.h"
#include "src/scene/geometry/distance_field.h"
#include "tests/support/assertions.h"
#include "tests/support/picture.h"
#include "tests/support/reference_ray.h"

enum {
    SAMPLES = 1 << 14,
};

static struct scattering_media ball_clouds;

/* ---- depths ---- */

/* In a ball the depth is the radius less the distance from the middle. */
static void test_depth_in_ball(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 3, -1, 2 } }, 2000);
    struct distance_field field;
    (void)state;
    assert_true(distance_field_init(&field, &scene.model.object));
    CHECK_NEAR(field.max_depth, 1, 0.005);
    for (int i = 0; i < 500; i++) {
        const double r = 0.9 * fmod(0.618 * i, 1), up = cos(0.7 * i), turn = 2.4 * i;
        const double flat = r * sqrt(1 - up * up);
        const vec3s at = { { (float)(3 + flat * cos(turn)), (float)(r * up - 1),
                             (float)(2 + flat * sin(turn)) } };
        CHECK_NEAR(distance_field_at(&field, at) * field.max_depth, 1 - r, 0.03);
    }
    CHECK_NEAR(distance_field_at(&field, (vec3s){ { 2.1F, -1.9F, 1.1F } }), 0,
               0); /* the box's corner */
    distance_field_finish(&field);
    scene_finish(&scene);
}

/* The deepest point of a ring is in its tube, not in its hole. */
static void test_depth_in_ring(void **state)
{
    enum {
        AROUND = 48,
        SIDES = 24
    };
    struct mesh ring;
    struct distance_field field;
    (void)state;
    assert_true(mesh_init(&ring, AROUND * SIDES, AROUND * SIDES * 6));
    const double turn = 2 * REFERENCE_RAY_PI;
    for (uint32_t i = 0; i < AROUND * SIDES; i++) {
        const uint32_t place = i / SIDES, side = i % SIDES;
        const double a = turn * (double)place / AROUND, b = turn * (double)side / SIDES;
        const double r = 1 + 0.3 * cos(b);
        ring.vertices[i].position =
            (vec3s){ { (float)(r * cos(a)), (float)(0.3 * sin(b)), (float)(r * sin(a)) } };
        const uint32_t next = (i / SIDES + 1) % AROUND * SIDES, own = i / SIDES * SIDES;
        const uint32_t k = i % SIDES, l = (k + 1) % SIDES;
        const uint32_t corners[6] = { own + k, own + l, next + k, next + k, own + l, next + l };
        for (uint32_t c = 0; c < 6; c++)
            ring.indices[i * 6 + c] = corners[c];
    }
    assert_true(distance_field_init(&field, &ring));
    CHECK_NEAR(field.max_depth, 0.3, 0.008);
    CHECK_NEAR(distance_field_at(&field, glms_vec3_zero()), 0, 0);
    CHECK_NEAR(distance_field_at(&field, (vec3s){ { 0, 0, 1 } }), 1, 0.1);
    distance_field_finish(&field);
    mesh_finish(&ring);
}

/* ---- what passes, and what is turned ---- */

/* A ball, whose cloud all tests share. */
static struct scene cloudy_ball(void)
{
    struct scene scene = picture_sphere_scene(glms_vec3_zero(), 8000);
    scene.inclusions.media = ball_clouds;
    return scene;
}

static void finish(struct scene *scene)
{
    scene->inclusions.media = (struct scattering_media){ 0 };
    scene_finish(scene);
}

static int make_clouds(void **state)
{
    struct scene scene = picture_sphere_scene(glms_vec3_zero(), 8000);
    (void)state;
    ball_clouds = scattering_media_find(&scene.model, true);
    const bool done = scattering_media_fill(&ball_clouds, &scene.model);
    scene_finish(&scene);
    return done ? 0 : -1;
}

static int finish_clouds(void **state)
{
    (void)state;
    scattering_media_finish(&ball_clouds);
    return 0;
}

/* The rim is clear, and the middle densest; between them there are needles. */
static void test_densities(void **state)
{
    double least = 1, most = 0;
    (void)state;
    CHECK_NEAR(scattering_media_at(&ball_clouds, 0, glms_vec3_zero()), 1, 0.03);
    CHECK_NEAR(scattering_media_at(&ball_clouds, 0, (vec3s){ { 2, 0, 0 } }), 0, 0);
    for (int i = 0; i < 300; i++) {
        const double up = 2 * (i + 0.5) / 300 - 1, turn = 2.4 * i, flat = sqrt(1 - up * up);
        const vec3s dir = { { (float)(flat * cos(turn)), (float)up, (float)(flat * sin(turn)) } };
        const double there =
            (double)scattering_media_at(&ball_clouds, 0, glms_vec3_scale(dir, 0.5F));
        CHECK_NEAR(scattering_media_at(&ball_clouds, 0, glms_vec3_scale(dir, 0.9F)), 0, 0);
        least = fmin(least, there);
        most = fmax(most, there);
    }
    CHECK_NEAR(least, 0, 0.01);
    CHECK_NEAR(most, MEDIUM_VEIL_DENSITY, 0.03);
}

/* The share of light that crosses a ball in `object_from_world` along z, from a point on: exp of
 * the extinction, summed along the way. */
static double passing(double density, mat4s object_from_world, vec3s from)
{
    double sum = 0;
    for (int i = 0; i < 2000; i++) {
        const vec3s to = { { from.x, from.y, from.z - 4 * ((float)i + 0.5F) / 2000 } };
        sum += (double)scattering_media_at(&ball_clouds, 0,
                                           glms_mat4_mulv3(object_from_world, to, 1)) *
               4 / 2000;
    }
    return exp(-density * sum);
}

/* The object is turned and elsewhere: the cloud is where it is. */
static void test_passing(void **state)
{
    const struct settings settings = SETTINGS("air.model=medium", "air.density=3");
    struct scene scene = cloudy_ball();
    (void)state;
    const struct globals globals = {
        .world_from_object =
            glms_rotate(glms_translate_make((vec3s){ { 5, 0, 0 } }), 1.2F, (vec3s){ { 0, 1, 0 } }),
    };
    const struct radiance radiance = radiance_of(&scene, &globals);
    const struct volume_scattering volume_scattering =
        volume_scattering_of(&radiance, &settings, 0);
    for (int i = 0; i < 4; i++) {
        const float besides = 0.22F * (float)i;
        const struct volume_scattering_segment way = { { { 5 + besides, 0, 2 } },
                                                       { { 0, 0, -1 } },
                                                       4 };
        const double expected = passing(1.5, volume_scattering.object_from_world, way.from);
        int count = 0;
        float distance;
        for (uint32_t s = 0; s < SAMPLES; s++)
            count += !volume_scattering_sample_distance(&volume_scattering, &way, s, 7, &distance);
        CHECK_NEAR((double)count / SAMPLES, expected,
                   0.005 + 3 * sqrt(expected * (1 - expected) / SAMPLES));
    }
    finish(&scene);
}

/* The mean cosine is the anisotropy, and directions are even around the old one. */
static void test_turning(void **state)
{
    static const float means[] = { -0.5F, 0, 0.71F };
    const vec3s dir = { { 0.36F, -0.48F, 0.8F } };
    (void)state;
    for (int i = 0; i < 3; i++) {
        const struct volume_scattering volume_scattering = { .anisotropy = means[i] };
        vec3s sum = glms_vec3_zero();
        for (uint32_t s = 0; s < SAMPLES; s++) {
            const vec3s turned =
                volume_scattering_sample_direction(&volume_scattering, dir, microfacet_point(s, 1));
            CHECK_NEAR(glms_vec3_norm(turned), 1, 1e-5);
            sum = glms_vec3_muladds(turned, 1.0F / SAMPLES, sum);
        }
        CHECK_NEAR(glms_vec3_dot(sum, dir), means[i], 0.01);
        CHECK_NEAR(glms_vec3_norm(sum), fabsf(means[i]), 0.01);
    }
}

/* ---- pictures ---- */

static struct render_result picture_of(const struct scene *scene, const struct settings *settings,
                                       float fov_deg, uint32_t samples, uint32_t threads)
{
    const struct reference_request request = {
        .scene = scene,
        .settings = settings,
        .width = 12,
        .height = 12,
        .samples = samples,
        .layers = reference_ray_layers(),
        .linear = true,
        .threads = threads,
    };
    const struct renderer_shot shot = { .camera = { .eye = { { 0, 0, 8 } }, .fov_deg = fov_deg } };
    return reference_ray_render_image(&request, &shot);
}

static double mean_of(const struct render_result *result, const char *plane)
{
    const float *texels = image_find(&result->image, plane);
    double sum = 0;
    for (int i = 0; i < 144; i++)
        sum += (double)texels[i] / 144;
    return sum;
}

/* Through the middle of a ball of air in air, a light far behind it shows what passes. */
static void test_light_behind(void **state)
{
    const struct settings settings =
        SETTINGS("air.model=medium", "air.density=3", "refract.ior=1.0003", "air.anisotropy=0");
    struct scene scene = cloudy_ball();
    struct mesh lamp;
    (void)state;
    scene.background.kind = SCENE_COLOR;
    assert_true(mesh_init(&lamp, 3, 3));
    for (uint32_t i = 0; i < 3; i++) {
        lamp.vertices[i] = (struct mesh_vertex){
            .position = { { i == 1 ? 3.0F : -1, i == 2 ? 3.0F : -1, -60 } },
            .normal = { { 0, 0, 1 } },
            .color = glms_vec3_one(),
            .material = MESH_UNLIT,
        };
        lamp.indices[i] = i;
    }
    assert_true(mesh_append(&scene.model.surroundings, &lamp));
    mesh_finish(&lamp);
    struct render_result result = picture_of(&scene, &settings, 0.1F, 64, 0);
    CHECK_NEAR(mean_of(&result, "R"), passing(1.5, glms_mat4_identity(), (vec3s){ { 0, 0, 2 } }),
               0.015);
    render_result_finish(&result);
    finish(&scene);
}

/* In light of 1, ice that scatters shows 1; its layers are those of clear ice. */
static void test_white_furnace(void **state)
{
    struct scene scene = cloudy_ball();
    struct render_result results[2];
    (void)state;
    scene.background.kind = SCENE_COLOR;
    scene.background.color = glms_vec3_one();
    for (int i = 0; i < 2; i++) {
        const struct settings settings =
            SETTINGS("reference.russian_roulette=off", i ? "air.model=planes" : "air.model=medium",
                     "air.density=12");
        results[i] = picture_of(&scene, &settings, 18, 2, i ? 1 : 3);
        const float *red = image_find(&results[i].image, "R");
        const float *rest = image_find(&results[i].image, "remaining.R");
        for (int k = 0; k < 144; k++)
            CHECK_NEAR((double)red[k] + (double)rest[k], 1, 1e-4);
    }
    CHECK_NEAR(mean_of(&results[0], "path.Z"), mean_of(&results[1], "path.Z"), 0);
    CHECK_NEAR(mean_of(&results[0], "exit.X"), mean_of(&results[1], "exit.X"), 0);
    for (int i = 0; i < 2; i++)
        render_result_finish(&results[i]);
    finish(&scene);
}

/* The same bytes for any number of threads; and from an eye in the cloud nothing is lost. */
static void test_threads(void **state)
{
    const struct settings settings = SETTINGS("air.model=medium", "air.density=12");
    struct scene scene = cloudy_ball();
    (void)state;
    picture_use_directions(&scene, 64);
    struct render_result one = picture_of(&scene, &settings, 18, 2, 1);
    struct render_result four = picture_of(&scene, &settings, 18, 2, 4);
    for (uint32_t i = 0; i < one.image.plane_count; i++)
        assert_memory_equal(one.image.planes[i].texels, four.image.planes[i].texels,
                            sizeof(float) * 144);
    render_result_finish(&one);
    render_result_finish(&four);
    const struct reference_ray seen = reference_ray_trace(
        &scene, &settings, (struct vec){ 0, 0, 0 }, reference_ray_direction(0.3));
    CHECK_NEAR(seen.z, 1, 0.01);
    finish(&scene);
}

/* From inside, the cloud begins at the eye. */
static void test_eye_inside(void **state)
{
    const struct settings settings =
        SETTINGS("air.model=medium", "air.density=1000", "refract.ior=1.0003");
    struct scene scene = cloudy_ball();
    (void)state;
    scene.background.kind = SCENE_COLOR;
    scene.background.color = glms_vec3_one();
    struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 0 }, reference_ray_direction(0));
    CHECK_NEAR(seen.color.x + seen.remaining.x, 1, 1e-4);
    CHECK_NEAR(seen.z, 1, 0.01);
    picture_use_directions(&scene, 64);
    double turned = 0;
    for (int i = 0; i < 40; i++) {
        const struct vec dir = reference_ray_direction(0.15 * i);
        seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 0 }, dir);
        turned += vec_difference(seen.color, picture_direction_color(dir)) > 0.2;
    }
    assert_true(turned > 20); /* light does not come straight through so dense a cloud */
    finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_depth_in_ball), cmocka_unit_test(test_depth_in_ring),
        cmocka_unit_test(test_densities),     cmocka_unit_test(test_passing),
        cmocka_unit_test(test_turning),       cmocka_unit_test(test_light_behind),
        cmocka_unit_test(test_white_furnace), cmocka_unit_test(test_threads),
        cmocka_unit_test(test_eye_inside),
    };
    return cmocka_run_group_tests(tests, make_clouds, finish_clouds);
}
