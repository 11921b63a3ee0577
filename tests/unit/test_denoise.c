/* test_denoise.c: denoising of lighting: noise falls, and edges between surfaces stay sharp. */
#include <math.h>
#include <string.h>
#include "src/render/denoise.h"
#include "tests/support/assertions.h"

enum {
    WIDTH = 48,
    HEIGHT = 32,
    PIXELS = WIDTH * HEIGHT,
};

static const char *const names[] = { "light.R",      "light.G",      "light.B",      "due",
                                     "throughput.R", "throughput.G", "throughput.B", "position.X",
                                     "position.Y",   "position.Z",   "normal",       "samples" };
static const char *const colors[] = { "R", "G", "B" };

/* Of normal (0, 0, 1): the middle of the octahedron, as denoise_normal() of
 * trace_denoise_inputs.glsl. */
static const float facing = 1.0f + 2047.0f + 4096.0f * 2047.0f;

static float noise(size_t i)
{
    uint32_t x = (uint32_t)i * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28) + 4)) ^ x) * 277803737u;
    return (float)((x >> 22) ^ x) / 4294967296.0f - 0.5f;
}

/* The light of a pixel without noise: a near wall at the left, a far one at the right. */
static float light_at(size_t i)
{
    return i % WIDTH < WIDTH / 2 ? -0.5f : 0.25f;
}

/* A picture of 1 and what is to be added to it: every fourth block of 4 x 4 pixels has gathered
 * light; surfaces send a tenth of it, or of every other pixel a half. */
static void make(struct image *picture, struct image *ground, float samples, float strength)
{
    float *planes[sizeof(names) / sizeof(names[0])];
    image_init(picture, WIDTH, HEIGHT);
    image_init(ground, WIDTH, HEIGHT);
    for (size_t c = 0; c < 3; c++) {
        float *plane = image_add_plane(picture, colors[c], false);
        for (size_t i = 0; i < PIXELS; i++)
            plane[i] = 1.0f;
    }
    for (size_t p = 0; p < sizeof(names) / sizeof(names[0]); p++)
        assert_non_null(planes[p] = image_add_plane(ground, names[p], false));
    for (size_t i = 0; i < PIXELS; i++) {
        const size_t x = i % WIDTH, y = i / WIDTH;
        const float share = i % 2 ? 0.5f : 0.1f;
        const float due = samples > 8.0f ? 1.0f : (x / 4 + y / 4) % 4 == 0 ? 0.25f : 0.0f;
        for (size_t c = 0; c < 3; c++) {
            planes[c][i] = due * share * (light_at(i) + strength * noise(i));
            planes[4 + c][i] = share;
        }
        planes[3][i] = due * share;
        planes[7][i] = 0.001f * (float)x;
        planes[8][i] = 0.001f * (float)y;
        planes[9][i] = x < WIDTH / 2 ? 0.0f : -1.0f;
        planes[10][i] = facing;
        planes[11][i] = samples;
    }
}

/* The root mean square of what the light in a picture is off. */
static double error_of(const struct image *picture)
{
    const float *plane = image_find(picture, "G");
    double sum = 0.0;
    for (size_t i = 0; i < PIXELS; i++) {
        const float share = i % 2 ? 0.5f : 0.1f;
        const double off = (double)((plane[i] - 1.0f) / share - light_at(i));
        sum += off * off;
    }
    return sqrt(sum / PIXELS);
}

static double smoothed_error(float samples, float strength)
{
    struct image picture, ground;
    make(&picture, &ground, samples, strength);
    assert_true(denoise_light(&picture, &(struct image){ 0 }, &ground));
    const double error = error_of(&picture);
    image_finish(&picture);
    image_finish(&ground);
    return error;
}

static void test_few_samples(void **state)
{
    (void)state;
    /* Without noise, what is nearer and brighter stays apart, and colours of surfaces sharp. */
    assert_true(smoothed_error(4.0f, 0.0f) < 1e-3);
    /* Noise of .29 a sample. */
    assert_true(smoothed_error(4.0f, 1.0f) < 0.08);
}

static void test_many_samples(void **state)
{
    (void)state;
    const double error = smoothed_error(64.0f, 0.04f);
    assert_true(error > 0.0113 && error < 0.0118); /* that of the noise: nothing is smoothed */
}

static void test_what_is_no_surface(void **state)
{
    (void)state;
    struct image picture, ground;
    make(&picture, &ground, 4.0f, 1.0f);
    float *normals = image_find(&ground, "normal"), *light = image_find(&ground, "light.R");
    for (size_t i = 0; i < PIXELS; i++) {
        if (i % WIDTH < WIDTH / 2)
            normals[i] = 0.0f;
        else
            light[i] = NAN; /* is left out */
    }
    assert_true(denoise_light(&picture, &(struct image){ 0 }, &ground));
    const float *plane = image_find(&picture, "R");
    for (size_t i = 0; i < PIXELS; i++)
        assert_true(i % WIDTH < WIDTH / 2 ? isfinite(plane[i]) : plane[i] == 1.0f);
    image_finish(&picture);
    image_finish(&ground);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few_samples),
        cmocka_unit_test(test_many_samples),
        cmocka_unit_test(test_what_is_no_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
