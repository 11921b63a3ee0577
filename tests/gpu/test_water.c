/*
 * test_water.c: calm water against closed forms: reflection, refraction, absorption; and floating
 * ice.
 */
#include <math.h>

#include "tests/support/assertions.h"

#include "shaders/water/water.h"
#include "src/tech/water/pool_parameters.h"
#include "tests/support/brute_force_trace.h"
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

/* Ice in it hides less of what is below. */
static const struct picture_request low = {
    .camera = {
        .eye = { { 1.1F, 0.7F, 1.2F } },
        .target = { { 0, -0.2F, 0 } },
        .fov_deg = 50,
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
        assert_int_equal(settings_assign(settings, assignments[i], SETTING_USER, NULL), STATUS_OK);
}

static struct scene load(float background, float ice)
{
    const vec3s color = { { background, background, background } };
    const struct scene_params params = {
        .name = "pool",
        .background = &color,
        .pool = { 2 * (float)half, (float)depth, ice },
    };
    struct scene scene;
    assert_int_equal(scene_load(&scene, &params), STATUS_OK);
    return scene;
}

static struct render_result draw_from(const struct picture_request *view, struct gpu *gpu,
                                      float background, const char *const *assignments)
{
    struct settings settings = settings_default();
    set_all(&settings, level);
    set_all(&settings, assignments);
    struct scene scene = load(background, pool_push_of(&settings).pool.ice);
    struct picture_request drawn = *view;
    drawn.scene = &scene;
    drawn.settings = &settings;
    struct render_result result = picture_render(gpu, &drawn);
    scene_finish(&scene);
    return result;
}

static struct render_result draw(struct gpu *gpu, float background, const char *const *assignments)
{
    return draw_from(&request, gpu, background, assignments);
}

/* ---- a ray ---- */

struct seen {
    struct vec at;     /* on the water */
    double fresnel;    /* share of what is mirrored */
    bool is_sky;       /* that is */
    double path;       /* to the ground, metres */
    double below;      /* how deep the ground lies there */
    struct vec inside; /* direction in the water */
    struct vec ground;
};

/* How far a ray from within gets to walls that stand at x and z = +-half. */
static double to_walls(struct vec from, struct vec dir)
{
    return fmin((copysign(half, dir.x) - from.x) / dir.x, (copysign(half, dir.z) - from.z) / dir.z);
}

static struct seen look_from(const struct picture_request *view, size_t i)
{
    const struct vec eye = vec_from(view->camera.eye);
    const struct vec e = picture_pixel_ray(view, i);
    struct seen seen = { .at = vec_add(eye, -eye.y / e.y, e) };
    const double ci = -e.y;
    const double st = sqrt(1 - ci * ci) / index_ratio;
    const double ct = sqrt(1 - st * st);
    const double rs = (ci - index_ratio * ct) / (ci + index_ratio * ct);
    const double rp = (index_ratio * ci - ct) / (index_ratio * ci + ct);
    const struct vec mirrored = { e.x, -e.y, e.z };
    const struct vec inside = { e.x / index_ratio, -ct, e.z / index_ratio };
    seen.inside = inside;
    seen.fresnel = (rs * rs + rp * rp) / 2;
    seen.is_sky = to_walls(seen.at, mirrored) * mirrored.y > (double)POOL_RIM + 0.01;
    seen.path = fmin(to_walls(seen.at, inside), depth / ct);
    seen.below = seen.path * ct;
    seen.ground = vec_add(seen.at, seen.path, inside);
    return seen;
}

static struct seen look(size_t i)
{
    return look_from(&request, i);
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
        CHECK_NEAR(vec_difference(picture_at(position, i), seen.at), 0, 3e-4);
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
    const double angle = acos(-1) * 50 / 180;
    const double sine = cos(angle) / index_ratio;
    const double end = half - 0.2 / tan(angle); /* of light that passes the rim */
    size_t lit = 0;
    size_t dark = 0;
    assert_non_null(caustics);
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct seen seen = look(i);
        const double entry = seen.ground.x + seen.below * sine / sqrt(1 - sine * sine);
        const bool at_edge = fabs(entry - end) < 0.05 || fabs(seen.ground.z) > half - 0.05;
        if (!is_water(&seen) || at_edge)
            continue;
        CHECK_NEAR(caustics[i], entry < end ? 1 : 0, 5e-3);
        *(entry < end ? &lit : &dark) += 1;
    }
    assert_true(lit > 1000 && dark > 300);
    render_result_finish(&result);
}

/* ---- ice ---- */

/* What stands out of the water hides it. */
static bool is_dry(const struct render_result *result, size_t i)
{
    return image_find(&result->image, "P.Y")[i] > 1e-3F;
}

/* Ice of the water's own index and absorption shows only where it stands out. */
static void ice_like_water_is_not_seen(void **state)
{
    static const char *const both[] = { "water.red=0.3",  "water.green=0.1",  "water.blue=0.2",
                                        "absorb.red=0.3", "absorb.green=0.1", "absorb.blue=0.2",
                                        "water.ior=1.35", "refract.ior=1.35", "pool.ice=0.8" };
    const char *words[16] = { NULL };
    for (size_t i = 0; i < sizeof(both) / sizeof(both[0]); i++)
        words[i] = both[i];
    struct render_result iced = draw(*state, 0.4F, words);
    words[sizeof(both) / sizeof(both[0]) - 1] = NULL;
    struct render_result bare = draw(*state, 0.4F, words);
    const float *seen = image_find(&iced.image, "G");
    const float *wanted = image_find(&bare.image, "G");
    size_t dry = 0;
    size_t off = 0;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        dry += is_dry(&iced, i) && !is_dry(&bare, i);
        off += !is_dry(&iced, i) && fabs((double)seen[i] / (double)wanted[i] - 1) > 2e-3;
    }
    print_message("%zu pixels dry, %zu off\n", dry, off);
    assert_true(dry > 100 && off < 20); /* beside what is dry tiles are drawn as if far away */
    render_result_finish(&iced);
    render_result_finish(&bare);
}

/* As long as rays are in the ice by its triangles, so much is absorbed. */
static void ice_below_absorbs(void **state)
{
    const char *words[] = { "water.red=0",  "water.green=0",  "water.blue=0",
                            "pool.ice=0.8", "absorb.green=2", NULL };
    struct scene scene = load(0, 0.8F);
    struct render_result dim = draw_from(&low, *state, 0, words);
    words[4] = NULL;
    struct render_result clear = draw_from(&low, *state, 0, words);
    const float *after = image_find(&dim.image, "G");
    const float *before = image_find(&clear.image, "G");
    double errors[PIXEL_COUNT];
    size_t count = 0;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct seen seen = look_from(&low, i);
        if (fmax(fabs(seen.at.x), fabs(seen.at.z)) > half - 0.01 || is_dry(&dim, i))
            continue;
        const struct trace_path way =
            trace_transmitted(&scene.model.object, seen.at, seen.inside, 1.333 / 1.3091, 4);
        const double path = -log((double)after[i] / (double)before[i]) / 2;
        if (way.hit || path > 0.01)
            errors[count++] = fabs(path - way.path);
    }
    assert_true(count > 500);
    const double median = picture_quantile(errors, count, 0.5);
    const double most = picture_quantile(errors, count, 0.9);
    print_message("%zu pixels of ice: path off by %.4f, 90 %%: %.4f metres\n", count, median, most);
    assert_true(median < 0.01 && most < 0.05);
    render_result_finish(&dim);
    render_result_finish(&clear);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirrors),
        cmocka_unit_test(refracts_and_absorbs),
        cmocka_unit_test(layers_show_the_surface),
        cmocka_unit_test(rim_casts_a_shadow),
        cmocka_unit_test(ice_like_water_is_not_seen),
        cmocka_unit_test(ice_below_absorbs),
    };
    return RUN_ON_DEVICE(tests);
}
