/* test_water.c: level water against closed forms: what it mirrors, refracts and absorbs. */
#include <math.h>

#include "tests/support/check.h"

#include "shaders/water.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    WIDTH = 96,
    HEIGHT = 72,
    PIXEL_COUNT = WIDTH * HEIGHT,
};

static const double index_ratio = 1.333 / 1.0003;
static const double half = 1.5; /* of the pool's size */
static const double depth = 0.8;

/* Of its walls all are seen from here, mirrored too. */
static const struct picture_request request = {
    .camera = {
        .eye = { { 0.3F, 1.2F, 0.5F } },
        .target = { { -0.2F, -0.4F, -0.4F } },
        .fov_deg = 70,
    },
    .width = WIDTH,
    .height = HEIGHT,
    .layers = PICTURE_ALL_LAYERS,
};

static const char *const level[] = {
    "pool.water=on",  "pool.size=3",          "pool.depth=0.8",
    "water.height=0", "caustics.method=none", NULL,
};

static void set_all(struct settings *settings, const char *const *assignments)
{
    for (size_t i = 0; assignments[i]; i++)
        assert_int_equal(settings_set(settings, assignments[i]), STATUS_OK);
}

static struct render_result draw(struct gpu *gpu, float background, const char *const *assignments)
{
    const vec3s color = { { background, background, background } };
    const struct scene_params params = {
        .name = "pool",
        .background = &color,
        .pool = { 2 * (float)half, (float)depth },
    };
    struct settings settings = settings_default();
    struct scene scene;
    set_all(&settings, level);
    set_all(&settings, assignments);
    assert_int_equal(scene_load(&scene, &params), STATUS_OK);
    struct picture_request drawn = request;
    drawn.scene = &scene;
    drawn.settings = &settings;
    struct render_result result = picture_render(gpu, &drawn);
    scene_finish(&scene);
    return result;
}

/* ---- a ray ---- */

struct seen {
    struct vec at;  /* on the water */
    double fresnel; /* share of what is mirrored */
    bool is_sky;    /* that is */
    double path;    /* to the ground, metres */
    double below;   /* how deep the ground lies there */
    struct vec ground;
};

/* How far a ray from within gets to walls that stand at x and z = +-half. */
static double to_walls(struct vec from, struct vec dir)
{
    return fmin((copysign(half, dir.x) - from.x) / dir.x, (copysign(half, dir.z) - from.z) / dir.z);
}

static struct seen look(size_t i)
{
    const struct vec eye = vec_from(request.camera.eye);
    const struct vec e = picture_pixel_ray(&request, i);
    struct seen seen = { .at = vec_add(eye, -eye.y / e.y, e) };
    const double ci = -e.y;
    const double st = sqrt(1 - ci * ci) / index_ratio;
    const double ct = sqrt(1 - st * st);
    const double rs = (ci - index_ratio * ct) / (ci + index_ratio * ct);
    const double rp = (index_ratio * ci - ct) / (index_ratio * ci + ct);
    const struct vec mirrored = { e.x, -e.y, e.z };
    const struct vec inside = { e.x / index_ratio, -ct, e.z / index_ratio };
    seen.fresnel = (rs * rs + rp * rp) / 2;
    seen.is_sky = to_walls(seen.at, mirrored) * mirrored.y > (double)POOL_RIM + 0.01;
    seen.path = fmin(to_walls(seen.at, inside), depth / ct);
    seen.below = seen.path * ct;
    seen.ground = vec_add(seen.at, seen.path, inside);
    return seen;
}

/* A pixel in the middle of what it shows, and not near an edge of it. */
static bool is_water(const struct seen *seen)
{
    return fmax(fabs(seen->at.x), fabs(seen->at.z)) < half - 0.01 && seen->is_sky;
}

/* ---- tests ---- */

/* Water that lets nothing through, below a white sky. */
static void mirrors(void **state)
{
    struct render_result result =
        draw(*state, 1, (const char *const[]){ "water.red=100", "water.green=100", NULL });
    const float *red = image_find(&result.image, "R");
    double least = 1;
    double most = 0;
    size_t count = 0;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct seen seen = look(i);
        if (!is_water(&seen) || seen.below < 0.2)
            continue;
        CHECK_NEAR(red[i], seen.fresnel, 5e-4);
        least = fmin(least, seen.fresnel);
        most = fmax(most, seen.fresnel);
        count++;
    }
    assert_true(count > PIXEL_COUNT / 4);
    assert_true(least < 0.021 && most > 0.04);
    render_result_finish(&result);
}

/* The same light comes up from the ground, but for what is absorbed on its way down and up. */
static void refracts_and_absorbs(void **state)
{
    const double absorption[3] = { 0.2, 0.5, 1 };
    struct render_result clear =
        draw(*state, 0,
             (const char *const[]){ "sky.sun_strength=0", "water.red=0", "water.green=0",
                                    "water.blue=0", NULL });
    struct render_result dim =
        draw(*state, 0,
             (const char *const[]){ "sky.sun_strength=0", "water.red=0.2", "water.green=0.5",
                                    "water.blue=1", NULL });
    const struct picture_layer before = picture_layer(&clear.image, "");
    const struct picture_layer after = picture_layer(&dim.image, "");
    size_t floor = 0;
    size_t walls = 0;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct seen seen = look(i);
        if (!is_water(&seen))
            continue;
        for (size_t c = 0; c < 3; c++) {
            const double share = (double)after.planes[c][i] / (double)before.planes[c][i];
            CHECK_NEAR(share, exp(-absorption[c] * (seen.path + seen.below)), 3e-3);
        }
        *(seen.below < depth - 0.01 ? &walls : &floor) += 1;
    }
    assert_true(floor > 1000 && walls > 200);
    render_result_finish(&clear);
    render_result_finish(&dim);
}

/* The layers N, P and Z show the surface. */
static void layers_show_the_surface(void **state)
{
    struct render_result result = draw(*state, 0, (const char *const[]){ NULL });
    const struct picture_layer normal = picture_layer(&result.image, "N");
    const struct picture_layer position = picture_layer(&result.image, "P");
    const struct vec up = { 0, 1, 0 };
    size_t count = 0;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct seen seen = look(i);
        if (!is_water(&seen))
            continue;
        CHECK_NEAR(vec_difference(picture_at(normal, i), up), 0, 1e-6);
        CHECK_NEAR(vec_difference(picture_at(position, i), seen.at), 0, 1e-4);
        count++;
    }
    assert_true(count > PIXEL_COUNT / 4);
    render_result_finish(&result);
}

/* The layer caustics is 1 where the sun, which stands on +x, shines on floor and walls past the
 * pool's rim, and 0 in its shadow. */
static void rim_casts_a_shadow(void **state)
{
    struct render_result result =
        draw(*state, 0,
             (const char *const[]){ "caustics.method=area", "sky.sun_azimuth=90",
                                    "sky.sun_elevation=50", NULL });
    const float *caustics = image_find(&result.image, "caustics.Z");
    const double sine = cos(acos(-1) * 50 / 180) / index_ratio;
    size_t lit = 0;
    size_t dark = 0;
    assert_non_null(caustics);
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct seen seen = look(i);
        const double entry = seen.ground.x + seen.below * sine / sqrt(1 - sine * sine);
        const bool at_edge = fabs(entry - half) < 0.05 || fabs(seen.ground.z) > half - 0.05;
        if (!is_water(&seen) || at_edge)
            continue;
        CHECK_NEAR(caustics[i], entry < half ? 1 : 0, 5e-3);
        *(entry < half ? &lit : &dark) += 1;
    }
    assert_true(lit > 1000 && dark > 300);
    render_result_finish(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(mirrors),
        ON_DEVICE(refracts_and_absorbs),
        ON_DEVICE(layers_show_the_surface),
        ON_DEVICE(rim_casts_a_shadow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
