/* test_profile_statistics.c: timing statistics, against known results and brute force. */
#include <math.h>
#include <stdlib.h>
#include "src/lab/profile/statistics.h"
#include "tests/support/assertions.h"

enum {
    MANY = 21
};

static void check_summary(struct profile_summary s, struct profile_summary expected)
{
    CHECK_NEAR(s.mean, expected.mean, 1e-12);
    CHECK_NEAR(s.sigma, expected.sigma, 1e-12);
    CHECK_NEAR(s.min, expected.min, 0);
    CHECK_NEAR(s.median, expected.median, 1e-12);
    CHECK_NEAR(s.p95, expected.p95, 1e-12);
    CHECK_NEAR(s.max, expected.max, 0);
}

static void test_summary(void **state)
{
    (void)state;
    const double eight[] = { 9, 4, 2, 5, 4, 7, 4, 5 };
    check_summary(profile_summarize(eight, 8),
                  (struct profile_summary){ 5, sqrt(32.0 / 7), 2, 4.5, 8.3, 9 });
    const double below[] = { -1e-9, -5, 3e300, -0.0, -1e300 };
    check_summary(profile_summarize(below + 1, 1),
                  (struct profile_summary){ -5, 0, -5, -5, -5, -5 });
    assert_true(profile_summarize(below, 5).min <= -1e300);
    CHECK_NEAR(profile_summarize(below, 5).median, -1e-9, 0);
    assert_true(profile_summarize(below, 5).max >= 3e300);
    assert_false(signbit(profile_summarize(below + 3, 1).median)); /* 0, not -0 */
    check_summary(profile_summarize(eight, 0), (struct profile_summary){ 0 });
}

/* Each number from 1 to 100 in some order: quantiles are linear. */
static void test_quantiles(void **state)
{
    (void)state;
    double numbers[100];
    for (int i = 0; i < 100; i++)
        numbers[i] = (i * 37) % 100 + 1;
    check_summary(profile_summarize(numbers, 100),
                  (struct profile_summary){ 50.5, sqrt(101 * 100 / 12.0), 1, 50.5, 95.05, 100 });
}

static double test_of(const double *a, uint32_t a_count, const double *b, uint32_t b_count)
{
    return profile_mann_whitney(&(struct profile_pair){ a, b, a_count, b_count });
}

/* The normal approximation with continuity correction, of U of all pairs counted one by one. */
static double expected_of(const double *a, uint32_t a_count, const double *b, uint32_t b_count)
{
    double u = 0;
    for (uint32_t i = 0; i < a_count; i++)
        for (uint32_t k = 0; k < b_count; k++)
            u += a[i] < b[k] ? 1 : a[i] > b[k] ? 0 : 0.5;
    const double pairs = (double)a_count * b_count;
    const double z =
        fmax(0, fabs(u - pairs / 2) - 0.5) / sqrt(pairs * (a_count + b_count + 1) / 12);
    return erfc(z / sqrt(2));
}

static void test_probabilities(void **state)
{
    (void)state;
    const double a[] = { 11, 12, 17, 20 }, b[] = { 16, 19, 22, 24, 29 };
    const double c[] = { 1, 2, 2, 3 }, d[] = { 2, 3, 4, 5, 5 };
    CHECK_NEAR(test_of(a, 4, b, 5), 1 / 9.0, 0.01); /* exactly: 14 of 126 orders are as far off */
    CHECK_NEAR(test_of(b, 5, a, 4), test_of(a, 4, b, 5), 1e-12);
    CHECK_NEAR(test_of(c, 4, d, 5), expected_of(c, 4, d, 5), 1e-12);
    CHECK_NEAR(test_of(d, 5, c, 4), expected_of(c, 4, d, 5), 1e-12);
    const double same[] = { 7, 7, 7 };
    CHECK_NEAR(test_of(same, 3, same, 3), 1, 0);

    /* many: U = 350 of 441 */
    double low[MANY], high[MANY];
    for (int i = 0; i < MANY; i++) {
        low[i] = i;
        high[i] = i + 7.5;
    }
    CHECK_NEAR(test_of(low, MANY, high, MANY), erfc(129 / sqrt(2 * 441 / 12.0 * 43)), 1e-9);
    CHECK_NEAR(test_of(low, MANY, low, MANY), 1, 0);
    for (int i = 0; i < MANY; i++)
        high[i] += MANY;
    CHECK_NEAR(profile_mann_whitney_min(MANY, MANY), test_of(low, MANY, high, MANY), 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_summary),
        cmocka_unit_test(test_quantiles),
        cmocka_unit_test(test_probabilities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
