/*
 * test_reference_run.c: the reference renderer: threads, samples, layers, progress, memory limits.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "src/lab/reference/reference.h"
#include "src/lab/reference/reference_aov_table.h"
#include "src/lab/reference/reference_sample_sums.h"
#include "tests/support/assertions.h"
#include "tests/support/picture.h"

enum {
    WIDTH = 50, /* no whole number of tiles */
    HEIGHT = 37,
};

static const struct renderer_shot shot = {
    .camera = { .eye = { { 0.5F, 0.7F, 3 } }, .fov_deg = 45 },
};

static uint64_t traced_layers(void)
{
    uint64_t layers = 0;
    for (uint32_t i = 0; techniques_layer(i); i++)
        layers |= reference_has_layer(techniques_layer(i)) ? UINT64_C(1) << i : 0;
    return layers;
}

struct fixture {
    struct scene scene;
    struct settings settings;
    struct reference_request request;
};

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof(*f));
    assert_non_null(f);
    f->scene = picture_sphere_scene(glms_vec3_zero(), 960);
    f->settings = settings_default();
    f->request = (struct reference_request){
        .scene = &f->scene,
        .settings = &f->settings,
        .width = WIDTH,
        .height = HEIGHT,
        .samples = 3,
        .layers = traced_layers(),
        .linear = true,
        .display = true,
    };
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    scene_finish(&f->scene);
    free(f);
    return 0;
}

static enum status render(const struct reference_request *request, struct render_result *result,
                          renderer_progress_fn *progress, void *user)
{
    struct reference *reference;
    assert_int_equal(reference_create(&reference, request), STATUS_OK);
    assert_memory_equal(reference_device(reference), "Embree ", 7);
    const enum status status = reference_render(reference, &shot, result, progress, user);
    reference_destroy(reference);
    return status;
}

static struct reference_outcome go_on(const struct reference_request *request,
                                      struct render_result *result)
{
    struct reference *reference;
    struct reference_session session = { 0 };
    assert_int_equal(reference_create(&reference, request), STATUS_OK);
    assert_int_equal(reference_continue(reference, &shot, result, &session, NULL, NULL), STATUS_OK);
    reference_destroy(reference);
    return session.outcome;
}

static struct render_result trace(const struct reference_request *request)
{
    struct render_result result = { 0 };
    assert_int_equal(render(request, &result, NULL, NULL), STATUS_OK);
    return result;
}

static void check_same(const struct render_result *a, const struct render_result *b)
{
    const size_t count = (size_t)WIDTH * HEIGHT;
    assert_int_equal(a->image.plane_count, b->image.plane_count);
    for (uint32_t p = 0; p < a->image.plane_count; p++)
        assert_memory_equal(a->image.planes[p].texels, b->image.planes[p].texels,
                            count * sizeof(float));
    assert_memory_equal(a->rgba, b->rgba, count * 4);
}

static void test_any_number_of_threads(void **state)
{
    struct fixture *f = *state;
    f->request.threads = 1;
    struct render_result one = trace(&f->request);
    const uint32_t counts[] = { 0, 2, 3, 7, 1000000 };
    for (size_t i = 0; i < sizeof(counts) / sizeof(counts[0]); i++) {
        f->request.threads = counts[i];
        struct render_result many = trace(&f->request);
        check_same(&one, &many);
        render_result_finish(&many);
    }
    render_result_finish(&one);
}

/* ---- limits ---- */

/* A picture that ends by a limit is that of its number of samples. */
static void check_limit(struct fixture *f, uint32_t samples)
{
    struct render_result limited = { 0 }, whole = { 0 };
    const struct reference_outcome first = go_on(&f->request, &limited);
    assert_int_equal(first.samples, samples);
    f->request.noise = f->request.seconds = 0;
    f->request.samples = samples;
    const struct reference_outcome second = go_on(&f->request, &whole);
    assert_int_equal(second.samples, samples);
    assert_true(first.noise == second.noise);
    check_same(&limited, &whole);
    render_result_finish(&limited);
    render_result_finish(&whole);
}

static double noise_of(struct fixture *f, uint32_t samples)
{
    struct render_result result = { 0 };
    f->request.samples = samples;
    const double noise = go_on(&f->request, &result).noise;
    render_result_finish(&result);
    return noise;
}

static void test_limits(void **state)
{
    struct fixture *f = *state;
    const double noise_16 = noise_of(f, 16), noise_32 = noise_of(f, 32);
    assert_true(noise_16 > noise_32 && noise_32 > 0);
    assert_true(noise_of(f, 1) == REFERENCE_ERROR_UNKNOWN);
    for (uint32_t threads = 1; threads <= 3; threads++) {
        f->request.threads = threads;
        f->request.samples = 40;
        f->request.noise = noise_32; /* after 1, 2, 4, 8 and 16 samples there is more */
        check_limit(f, 32);
    }
    f->request.samples = 40;
    f->request.noise = 0.499; /* a limit that a few samples reach by chance */
    check_limit(f, REFERENCE_NOISE_SAMPLES);
    f->request.samples = 18;
    f->request.noise = 1e-9;
    check_limit(f, 18);
    f->request.seconds = 1e-9;
    check_limit(f, 1);
    f->request.samples = 3;
    f->request.seconds = 1e9;
    check_limit(f, 3);
}

static double clipped(const struct render_result *result, size_t i, double *total)
{
    static const char *const planes[] = { "R", "G", "B" };
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        const double now = (double)image_find(&result->image, planes[c])[i];
        sum += fmin(fmax(now - total[c], 0), 1) / 3;
        total[c] = now;
    }
    return sum;
}

/* Each sample is what the mean of one more sample tells. */
static void test_error(void **state)
{
    enum {
        SAMPLES = 5
    };

    struct fixture *f = *state;
    struct render_result results[SAMPLES];
    f->scene.background.kind = SCENE_COLOR;
    f->scene.background.color = (vec3s){ { 0.2F, 0.6F, 3 } };
    assert_int_equal(settings_assign(&f->settings, "absorb.green=3", SETTING_USER, NULL),
                     STATUS_OK);
    double noise = 0;
    struct reference_outcome outcome = { 0 };
    for (uint32_t s = 0; s < SAMPLES; s++) {
        f->request.samples = s + 1;
        results[s] = (struct render_result){ 0 };
        outcome = go_on(&f->request, &results[s]);
        for (uint32_t c = 0; c < 3; c++) { /* means to sums */
            static const char *const planes[] = { "R", "G", "B" };
            float *texels = image_find(&results[s].image, planes[c]);
            for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
                texels[i] *= (float)(s + 1);
        }
    }
    const float *errors = image_find(&results[SAMPLES - 1].image, "error.Z");
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        double values[SAMPLES], total[3] = { 0 }, mean = 0, spread = 0;
        for (int s = 0; s < SAMPLES; s++) {
            values[s] = clipped(&results[s], i, total);
            mean += values[s] / SAMPLES;
        }
        for (int s = 0; s < SAMPLES; s++)
            spread += (values[s] - mean) * (values[s] - mean);
        CHECK_NEAR(errors[i], sqrt(spread / (SAMPLES - 1) / SAMPLES), 1e-5);
        noise += (double)errors[i] / (WIDTH * HEIGHT);
    }
    assert_true(noise > 1e-3);
    CHECK_NEAR(outcome.noise, noise, 1e-6);
    for (uint32_t s = 0; s < SAMPLES; s++)
        render_result_finish(&results[s]);
}

static void test_remaining(void **state)
{
    struct fixture *f = *state;
    struct render_result result = { 0 };
    assert_true(go_on(&f->request, &result).pixels_beyond < 10); /* trapped at the silhouette */
    render_result_finish(&result);
    assert_int_equal(settings_assign(&f->settings, "reference.cutoff=0.1", SETTING_USER, NULL),
                     STATUS_OK);
    assert_int_equal(
        settings_assign(&f->settings, "reference.russian_roulette=off", SETTING_USER, NULL),
        STATUS_OK);
    const struct reference_outcome outcome = go_on(&f->request, &result);
    const char *const planes[] = { "remaining.R", "remaining.G", "remaining.B" };
    uint64_t count = 0;
    float largest = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        float most = 0;
        for (int c = 0; c < 3; c++)
            most = fmaxf(most, image_find(&result.image, planes[c])[i]);
        count += (double)most > REFERENCE_REMAINING_MAX;
        largest = fmaxf(largest, most);
    }
    assert_true(count > 100);
    assert_int_equal(outcome.pixels_beyond, count);
    CHECK_NEAR(outcome.remaining, largest, 1e-6);
    render_result_finish(&result);
}

/* Planes are those of the layers asked for, and each has something to say. */
static void test_layers(void **state)
{
    struct fixture *f = *state;
    const size_t count = (size_t)WIDTH * HEIGHT;
    struct render_result result = trace(&f->request);
    uint32_t planes = 4;
    for (uint32_t i = 0; techniques_layer(i); i++) {
        const struct frame_layer *layer = techniques_layer(i);
        for (uint32_t p = 0; p < frame_layer_plane_count(layer); p++) {
            const float *texels = image_find(&result.image, layer->planes[p]);
            assert_true(!texels == !reference_has_layer(layer));
            planes += texels != NULL;
            bool differs = false;
            for (size_t k = 1; texels && k < count; k++)
                differs = differs || texels[k] != texels[0];
            /* a convex, smooth body reflects nothing totally, and nothing is in it */
            const bool is_dull = !strcmp(layer->name, "tir") || !strcmp(layer->name, "bounces") ||
                                 !strcmp(layer->name, "inclusions");
            assert_true(!texels || differs || is_dull);
        }
    }
    assert_int_equal(result.image.plane_count, planes);
    render_result_finish(&result);

    f->request.layers = 0;
    f->request.linear = f->request.display = false;
    result = trace(&f->request);
    assert_int_equal(result.image.plane_count, 0);
    assert_null(result.rgba);
    render_result_finish(&result);
}

static bool is_partial(float coverage)
{
    return coverage > 0.05F && coverage < 0.95F;
}

/* The mean of the samples where a layer has one, else the first; they differ along both axes. */
static void test_samples(void **state)
{
    struct fixture *f = *state;
    f->scene.background.kind = SCENE_COLOR;
    f->scene.background.color = glms_vec3_one();
    f->request.samples = 1;
    struct render_result one = trace(&f->request);
    f->request.samples = 16;
    struct render_result many = trace(&f->request);
    const size_t count = (size_t)WIDTH * HEIGHT;
    assert_memory_equal(image_find(&one.image, "exit.X"), image_find(&many.image, "exit.X"),
                        count * sizeof(float));
    const float *first = image_find(&one.image, "refraction.R");
    const float *mean = image_find(&many.image, "refraction.R");
    size_t edges = 0, upright = 0, level = 0;
    for (size_t i = 0; i < count; i++) { /* 1 on the sphere, 0 beside it */
        assert_false(is_partial(first[i]));
        edges += is_partial(mean[i]);
        upright += is_partial(mean[i]) && i / WIDTH == HEIGHT / 2;
        level += is_partial(mean[i]) && i % WIDTH == WIDTH / 2;
    }
    assert_true(edges > 20 && edges < 200);
    assert_true(upright > 0 && level > 0);
    render_result_finish(&one);
    render_result_finish(&many);
}

/* A wall before the eye, cut out where its texture is not half opaque. */
static void test_holes(void **state)
{
    struct fixture *f = *state;
    picture_add_quad(&f->scene, &(struct picture_quad){
                                    .top_left = { { -5, 5, 2 } },
                                    .right = { { 10, 0, 0 } },
                                    .down = { { 0, -10, 0 } },
                                    .material = 1 | MESH_CUTOUT,
                                });
    for (uint32_t i = 0; i < 2; i++) {
        uint8_t texel[4] = { 255, 255, 255, i ? 129 : 126 };
        f->scene.model.textures = (struct texture_layers){ texel, 1, 1 };
        struct render_result result = trace(&f->request);
        f->scene.model.textures = (struct texture_layers){ 0 };
        const float *z = image_find(&result.image, "Z");
        assert_true((z[0] < 100) == (i == 1));
        render_result_finish(&result);
    }
}

/* What is nearer than a thousandth of the object's diagonal, 3.46, along the axis is not seen. */
static void test_near_plane(void **state)
{
    struct fixture *f = *state;
    const vec3s forward = glms_vec3_normalize(glms_vec3_negate(shot.camera.eye));
    const vec3s right = glms_vec3_normalize(glms_vec3_cross(forward, (vec3s){ { 0, 1, 0 } }));
    const vec3s down = glms_vec3_cross(forward, right);
    const float distances[2] = { 0.0033F, 0.0036F };
    for (int i = 0; i < 2; i++) {
        const vec3s middle = glms_vec3_muladds(forward, distances[i], shot.camera.eye);
        picture_add_quad(&f->scene,
                         &(struct picture_quad){
                             .top_left = glms_vec3_sub(glms_vec3_sub(middle, right), down),
                             .right = glms_vec3_scale(right, 2),
                             .down = glms_vec3_scale(down, 2),
                         });
        struct render_result result = trace(&f->request);
        const float *z = image_find(&result.image, "Z");
        for (size_t k = 0; k < (size_t)WIDTH * HEIGHT; k++) {
            if (i == 0)
                assert_true(z[k] > 1);
            else
                CHECK_NEAR(z[k], distances[1], 1e-5);
        }
        render_result_finish(&result);
    }
}

/* ---- progress ---- */

struct watch {
    uint32_t calls, done, all;
    uint32_t stop_at; /* call; 0: never */
};

static bool watch(void *user, uint32_t done, uint32_t all)
{
    struct watch *w = user;
    assert_true(done >= w->done && done <= all);
    *w = (struct watch){ w->calls + 1, done, all, w->stop_at };
    return w->calls != w->stop_at;
}

static void test_progress(void **state)
{
    struct fixture *f = *state;
    struct render_result result = { 0 };
    struct watch w = { 0 };
    f->request.threads = 1;
    assert_int_equal(render(&f->request, &result, watch, &w), STATUS_OK);
    assert_int_equal(w.all, 4 * 3);
    assert_int_equal(w.done, w.all);
    assert_int_equal(w.calls, w.all);
    render_result_finish(&result);

    w = (struct watch){ .stop_at = 5 };
    assert_int_equal(render(&f->request, &result, watch, &w), STATUS_FAILED);
    assert_int_equal(w.calls, 5);
    assert_null(result.rgba);
    assert_int_equal(result.image.plane_count, 0);
}

static void test_too_little_memory(void **state)
{
    struct fixture *f = *state;
    struct render_result result = { 0 };
    f->request.memory = 1000;
    assert_int_equal(render(&f->request, &result, NULL, NULL), STATUS_TRY_AGAIN);
    assert_int_equal(result.image.plane_count, 0);
    f->request.memory = 1000000;
    assert_int_equal(render(&f->request, &result, NULL, NULL), STATUS_OK);
    render_result_finish(&result);
}

static void test_what_is_left_out(void **state)
{
    (void)state;
    struct settings settings = settings_default();
    char names[REFERENCE_NAMES_SIZE];
    assert_int_equal(settings_assign(&settings, "frost.amount=0.5", SETTING_USER, NULL), STATUS_OK);
    assert_true(reference_unsupported(&settings, names, sizeof(names)));
    assert_string_equal(names, "highlights");
    assert_int_equal(settings_assign(&settings, "light.count=0", SETTING_USER, NULL), STATUS_OK);
    assert_false(reference_unsupported(&settings, names, sizeof(names)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_any_number_of_threads, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_limits, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_error, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_remaining, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_layers, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_samples, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_holes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_near_plane, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_progress, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_too_little_memory, set_up, tear_down),
        cmocka_unit_test(test_what_is_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
