/* test_noise_estimate.c: the noise of a mean is that of its samples. */
#include <math.h>
#include "src/view/noise_estimate.h"
#include "tests/support/assertions.h"

enum {
    WIDTH = 20, /* the last blocks are narrower */
    HEIGHT = 9,
    SAMPLES = 16,
};

static void add(struct image *sums, float value)
{
    for (uint32_t p = 0; p < sums->plane_count; p++) {
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
            sums->planes[p].texels[i] += value;
    }
}

static void begin(struct image *sums)
{
    image_init(sums, WIDTH, HEIGHT);
    assert_true(image_add_plane(sums, "R", false) && image_add_plane(sums, "G", false) &&
                image_add_plane(sums, "B", false));
}

static void it_is_the_standard_error(void **state)
{
    struct image sums;
    struct noise_estimate noise = { 0 };
    (void)state;
    begin(&sums);
    for (uint32_t i = 0; i < SAMPLES; i++) {
        add(&sums, i % 2 ? 1.5f : 0.5f);
        noise_estimate_add(&noise, &sums, i);
        assert_true((noise_estimate_now(&noise) < 0.0) == (i == 0)); /* of one it is not known */
    }
    CHECK_NEAR(noise_estimate_now(&noise), 0.5 / sqrt(SAMPLES - 1), 1e-6);
    image_finish(&sums);
    begin(&sums); /* anew, and all samples are the same */
    for (uint32_t i = 0; i < 3; i++) {
        add(&sums, 0.25f);
        noise_estimate_add(&noise, &sums, i);
    }
    CHECK_NEAR(noise_estimate_now(&noise), 0.0, 1e-6);
    image_finish(&sums);
    noise_estimate_finish(&noise);
    assert_true(noise_estimate_now(&noise) < 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_the_standard_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
