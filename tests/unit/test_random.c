/* test_random.c: random numbers: even distribution, reproducibility, independence of seeds. */
#include "src/scene/generate/random.h"

#include <cglm/struct.h>
#include <math.h>

#include "tests/support/assertions.h"

enum {
    COUNT = 10000,
};

static void numbers_are_even(void **state)
{
    (void)state;
    struct random random = random_begin(5, 0);
    int bins[10] = { 0 };
    for (int i = 0; i < COUNT; i++) {
        const float x = random_unit(&random);
        assert_true(x >= 0 && x < 1);
        bins[(int)(x * 10)]++;
    }
    for (int i = 0; i < 10; i++)
        assert_in_range(bins[i], 900, 1100); /* 1000, deviation 30 */
}

/* Correlation of two sequences. */
static double correlate(struct random a, struct random b)
{
    double sum = 0;
    for (int i = 0; i < COUNT; i++)
        sum += ((double)random_unit(&a) - 0.5) * ((double)random_unit(&b) - 0.5);
    return sum / COUNT * 12;
}

static void sequences_are_unrelated(void **state)
{
    (void)state;
    const struct random random = random_begin(5, 0);
    struct random next = random;
    (void)random_unit(&next);
    CHECK_NEAR(correlate(random, random), 1, 0.05);
    CHECK_NEAR(correlate(random, random_begin(5, 0)), 1, 0.05);
    CHECK_NEAR(correlate(random, random_begin(6, 0)), 0, 0.05);
    CHECK_NEAR(correlate(random, random_begin(5, 1)), 0, 0.05);
    CHECK_NEAR(correlate(random, next), 0, 0.05);
}

/* Rotations, and every axis is turned to all sides. */
static void rotations(void **state)
{
    (void)state;
    struct random random = random_begin(5, 0);
    vec3s mean[3] = { { { 0 } } };
    for (int i = 0; i < COUNT; i++) {
        const mat3s axes = random_rotation(&random);
        CHECK_NEAR(glms_mat3_det(axes), 1, 1e-5);
        for (int a = 0; a < 3; a++) {
            CHECK_NEAR(glms_vec3_norm(axes.col[a]), 1, 1e-5);
            CHECK_NEAR(glms_vec3_dot(axes.col[a], axes.col[(a + 1) % 3]), 0, 1e-5);
            mean[a] = glms_vec3_add(mean[a], axes.col[a]);
        }
    }
    for (int a = 0; a < 3; a++)
        assert_true(glms_vec3_norm(mean[a]) < 0.03F * COUNT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_even),
        cmocka_unit_test(sequences_are_unrelated),
        cmocka_unit_test(rotations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
