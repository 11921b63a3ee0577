/*
 * test_reference_pool.c: the pool in the reference renderer, against closed forms: the view from
 * under water, sunlight on the floor below calm water and below a cosine wave.
 */
#include <cglm/struct.h>
#include <math.h>

#include "src/scene/scene.h"
#include "tests/support/assertions.h"
#include "tests/support/picture.h"
#include "tests/support/reference_ray.h"

enum {
    SIDE = 41, /* pixels, the middle one among them */
    PIXELS = SIDE * SIDE,
};

static struct scene scene;

static int make_scene(void **state)
{
    const struct scene_params params = { .name = "pool", .pool = { 4, 1.2F, 0 } };
    (void)state;
    return scene_load(&scene, &params) == STATUS_OK ? 0 : -1;
}

static int finish_scene(void **state)
{
    (void)state;
    scene_finish(&scene);
    return 0;
}

/* Looks from a point in the water straight up or down, 45 degrees to each side. */
static struct render_result look(const struct settings *settings, float height, float up)
{
    const struct reference_request request = {
        .scene = &scene,
        .settings = settings,
        .width = SIDE,
        .height = SIDE,
        .layers = reference_ray_layers(),
        .linear = true,
    };
    const struct renderer_shot shot = { .camera = {
                                            .eye = { { 0, height, 0 } },
                                            .target = { { 0, height + up, -1e-4F } },
                                            .fov_deg = up > 0 ? 120 : 90,
                                        } };
    return reference_ray_render_image(&request, &shot);
}

#define STILL "water.height=0", "water.red=0", "water.green=0", "water.blue=0"

/* ---- the view ---- */

/* From below, all that is above is seen within 48.6 degrees; beyond, the surface is a mirror. */
static void test_window(void **state)
{
    const struct settings settings = SETTINGS(STILL, "caustics.method=none");
    const double edge = asin(1 / 1.333);
    struct render_result result = look(&settings, -0.6F, 1);
    const float *fresnel = image_find(&result.image, "fresnel.Z");
    int inside = 0, outside = 0;
    (void)state;
    CHECK_NEAR(edge * 180 / REFERENCE_RAY_PI, 48.6, 0.05);
    for (int i = 0; i < PIXELS; i++) {
        const int x = i % SIDE - SIDE / 2, y = i / SIDE - SIDE / 2;
        const double angle = atan(hypot(x, y) * 2 / SIDE * tan(REFERENCE_RAY_PI / 3));
        if (fabs(angle - edge) < 0.002)
            continue;
        assert_true((fresnel[i] >= 1) == (angle > edge));
        if (angle < 0.95 * edge)
            CHECK_NEAR(fresnel[i], reference_ray_fresnel(angle, 1.333, 1), 2e-3);
        inside += angle < edge;
        outside += angle > edge;
    }
    assert_true(inside > 100 && outside > 100);
    render_result_finish(&result);
}

/* ---- light ---- */

/* The light on lines of the floor that are so many metres from the middle, along x: the mean
 * of pixels to both sides of it, along z. */
static void light_at(const struct settings *settings, const double *places, double *lights,
                     int count, int rows)
{
    struct render_result result = look(settings, -0.6F, -1);
    const float *red = image_find(&result.image, "R");
    for (int i = 0; i < count; i++) {
        const int column = SIDE / 2 + (int)lround(places[i] / 0.6 * SIDE / 2);
        lights[i] = 0;
        for (int row = -rows; row <= rows; row++)
            lights[i] += (double)red[(SIDE / 2 + row) * SIDE + column] / (2 * rows + 1);
    }
    render_result_finish(&result);
}

#define HIGH_SUN "sky.sun_elevation=89.9", "reference.photons=300000"
#define COSINE   "water.wave=cosine", "water.scale=1", "water.frequency=6.283185"

/* Photons bring as much light through water at rest as the law of Fresnel says. Below a wave z = A
 * cos k x it is 1 / (1 - h / f) of that under a crest, and 1 / (1 + h / f) under a trough, to first
 * order; exactly 2.003 and 0.669 at half of the focal depth f = n / ((n - 1) A k^2). */
static void test_light(void **state)
{
    static const double places[] = { 0, -0.5, 0.5 };
    const struct settings dark = SETTINGS(STILL, HIGH_SUN, "sky.sun_strength=0");
    const struct settings still = SETTINGS(STILL, HIGH_SUN, "caustics.method=none");
    const struct settings flat = SETTINGS(STILL, HIGH_SUN);
    const struct settings wave = SETTINGS(STILL, HIGH_SUN, COSINE, "water.height=0.042248");
    const struct settings *const all[] = { &dark, &still, &flat, &wave };
    double lights[4][3];
    (void)state;
    for (int k = 0; k < 4; k++)
        light_at(all[k], places, lights[k], 3, SIDE / 2);
    for (int i = 0; i < 3; i++) {
        const double sun = lights[1][i] - lights[0][i];
        assert_true(sun > 0.1);
        CHECK_NEAR((lights[2][i] - lights[0][i]) / sun, 1, 0.02);
        CHECK_NEAR((lights[3][i] - lights[0][i]) / sun, i ? 0.669 : 2.003, i ? 0.02 : 0.06);
    }
}

/* Water at rest absorbs the sun's light on its way down, and the sky's. */
static void test_absorption(void **state)
{
    static const double places[] = { 0 };
    const struct settings settings[2] = {
        SETTINGS(STILL, "sky.sun_elevation=50", "caustics.method=none"),
        SETTINGS(STILL, "sky.sun_elevation=50", "caustics.method=none", "water.red=0.5"),
    };
    const struct settings night[2] = {
        SETTINGS(STILL, "sky.sun_strength=0"),
        SETTINGS(STILL, "sky.sun_strength=0", "water.red=0.5"),
    };
    double light[2], sky[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        light_at(&settings[i], places, &light[i], 1, 0);
        light_at(&night[i], places, &sky[i], 1, 0);
    }
    const double seen = exp(-0.5 * 0.6);
    const double down = 1 / sqrt(1 - pow(cos(50 * REFERENCE_RAY_PI / 180) / 1.333, 2));
    CHECK_NEAR(sky[1] / sky[0], exp(-0.5 * 1.2) * seen, 1e-3);
    CHECK_NEAR((light[1] - sky[1]) / (light[0] - sky[0]), exp(-0.5 * 1.2 * down) * seen, 1e-3);
    /* Photons bring the same. */
    const struct settings lit =
        SETTINGS(STILL, "sky.sun_elevation=50", "reference.photons=200000", "water.red=0.5");
    double both[2];
    light_at(&settings[1], places, &both[0], 1, SIDE / 2);
    light_at(&lit, places, &both[1], 1, SIDE / 2);
    CHECK_NEAR(both[1] / both[0], 1, 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_window),
        cmocka_unit_test(test_light),
        cmocka_unit_test(test_absorption),
    };
    return cmocka_run_group_tests(tests, make_scene, finish_scene);
}
