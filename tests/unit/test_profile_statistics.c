/* Numbers whose answers are known, or are counted here one by one. */
#include <math.h>
#include <stdlib.h>
#include "src/lab/profile/statistics.h"
#include "tests/support/assertions.h"

enum {
    MANY = 21 /* more than are taken exactly */
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
    assert_true(profile_quantile(below, 5, 0) <= -1e300);
    assert_true(profile_quantile(below, 5, 0.25) <= -5);
    CHECK_NEAR(profile_quantile(below, 5, 0.5), -1e-9, 0);
    assert_true(profile_quantile(below, 5, 1) >= 3e300);
    assert_false(signbit(profile_quantile(below, 5, 0.75))); /* 0, not -0 */
    check_summary(profile_summarize(eight, 0), (struct profile_summary){ 0 });
}

/* Each number from 1 to 100 in some order: quantiles are linear. */
static void test_quantiles(void **state)
{
    (void)state;
    double numbers[100];
    for (int i = 0; i < 100; i++)
        numbers[i] = (i * 37) % 100 + 1;
    for (int i = 0; i <= 100; i++)
        CHECK_NEAR(profile_quantile(numbers, 100, i / 100.0), 1 + 99 * i / 100.0, 1e-9);
}

static void test_fences(void **state)
{
    (void)state;
    const double numbers[] = { 30, 1, 2, 3, 4, 5, 6, 7, 8 };
    const struct profile_fences fences = profile_fences(numbers, 9);
    CHECK_NEAR(fences.low, 3 - 1.5 * 4, 1e-12);
    CHECK_NEAR(fences.high, 7 + 1.5 * 4, 1e-12);
}

static double test_of(const double *a, uint32_t a_count, const double *b, uint32_t b_count)
{
    return profile_mann_whitney(&(struct profile_pair){ a, b, a_count, b_count });
}

/* Chooses which 4 of 9 ranks are a's, in all 126 ways; each against all the others. */
static void test_exact_probability(void **state)
{
    (void)state;
    double us[126], ps[126];
    int count = 0;
    for (unsigned set = 0; set < 512; set++) {
        double a[4], b[5];
        uint32_t of_a = 0, of_b = 0;
        if (__builtin_popcount(set) != 4)
            continue;
        us[count] = 0;
        for (uint32_t rank = 0; rank < 9; rank++) {
            if (set >> rank & 1) {
                a[of_a++] = rank;
            } else {
                us[count] += of_a;
                b[of_b++] = rank;
            }
        }
        ps[count++] = test_of(a, 4, b, 5);
    }
    assert_int_equal(count, 126);
    for (int i = 0; i < count; i++) {
        int as_far = 0;
        for (int k = 0; k < count; k++)
            as_far += fabs(us[k] - 10) >= fabs(us[i] - 10);
        CHECK_NEAR(ps[i], as_far / 126.0, 1e-12);
    }
    CHECK_NEAR(profile_mann_whitney_min(4, 5), 2 / 126.0, 1e-12);
}

static void test_probabilities(void **state)
{
    (void)state;
    /* 14 of 126 orders are as far off */
    const double males[] = { 16, 19, 22, 24, 29 }, females[] = { 11, 12, 17, 20 };
    CHECK_NEAR(test_of(males, 5, females, 4), 1 / 9.0, 1e-12);
    CHECK_NEAR(test_of(females, 4, males, 5), 1 / 9.0, 1e-12);
    const double a[] = { 1, 2, 3, 4, 5 }, b[] = { 6, 7, 8, 9, 10 };
    CHECK_NEAR(test_of(a, 5, b, 5), 2 / 252.0, 1e-12);

    /* ties: U = 17.5 of 20, variance 20 / 12 * (10 - (2 * 6 + 24 + 0) / 72) */
    const double c[] = { 1, 2, 2, 3 }, d[] = { 2, 3, 4, 5, 5 };
    CHECK_NEAR(test_of(c, 4, d, 5), erfc(7 / sqrt(2 * 20 / 12.0 * (10 - 36 / 72.0))), 1e-12);
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
    assert_true(profile_mann_whitney_min(MANY, MANY) < 1e-7);
    CHECK_NEAR(profile_mann_whitney_min(20, 20), 2 / 137846528820.0, 1e-20);
}

static void test_holm(void **state)
{
    (void)state;
    const double p[] = { 0.01, 0.04, 0.03, 0.005, 0.03 };
    const double expected[] = { 0.04, 0.09, 0.09, 0.025, 0.09 };
    double adjusted[5];
    profile_holm(p, adjusted, 5);
    for (int i = 0; i < 5; i++)
        CHECK_NEAR(adjusted[i], expected[i], 1e-12);
    profile_holm((const double[]){ 0.7, 0.6 }, adjusted, 2);
    CHECK_NEAR(adjusted[0], 1, 0);
    CHECK_NEAR(adjusted[1], 1, 0);
    profile_holm(p, adjusted, 0);
}

/* All quotients, sorted; the interval leaves out as many at either end as the normal distribution
 * says: floor(200 - 2.5758 * sqrt(400 * 41 / 12)) = 104 counts from 1. */
static void test_ratio(void **state)
{
    (void)state;
    double a[20], b[20], quotients[400];
    for (int i = 0; i < 20; i++) {
        a[i] = 10 + i * i;
        b[i] = 13 + 3 * i;
    }
    for (int i = 0; i < 400; i++)
        quotients[i] = b[i % 20] / a[i / 20];
    profile_sort(quotients, 400);
    const struct profile_ratio ratio = profile_ratio(&(struct profile_pair){ a, b, 20, 20 });
    CHECK_NEAR(ratio.ratio, (quotients[199] + quotients[200]) / 2, 1e-15);
    CHECK_NEAR(ratio.low, quotients[103], 0);
    CHECK_NEAR(ratio.high, quotients[296], 0);

    const double few[] = { 1, 2, 4 }, twice[] = { 2, 4, 8 };
    const struct profile_ratio of_few = profile_ratio(&(struct profile_pair){ few, twice, 3, 3 });
    CHECK_NEAR(of_few.low, 0.5, 0);
    CHECK_NEAR(of_few.ratio, 2, 0);
    CHECK_NEAR(of_few.high, 8, 0);
    const double below[] = { -1, 2, 4 };
    CHECK_NEAR(profile_ratio(&(struct profile_pair){ few, below, 3, 3 }).ratio, 0, 0);
}

static void test_fit(void **state)
{
    (void)state;
    double x[] = { 256, 1024, 4096, 65536, 0 }, y[5];
    for (int i = 0; i < 5; i++)
        y[i] = 3 * pow(x[i], 1.5);
    struct profile_fit fit = profile_fit(x, y, 5);
    CHECK_NEAR(fit.exponent, 1.5, 1e-12);
    CHECK_NEAR(fit.factor, 3, 1e-11);
    CHECK_NEAR(fit.r2, 1, 1e-12);
    assert_int_equal(fit.point_count, 4);

    /* logarithms 0, 1, 2 and 0, 1, 1 */
    const double e = exp(1), one_e[] = { 1, e, e * e }, flat[] = { 1, e, e };
    fit = profile_fit(one_e, flat, 3);
    CHECK_NEAR(fit.exponent, 0.5, 1e-12);
    CHECK_NEAR(fit.factor, exp(1.0 / 6), 1e-12);
    CHECK_NEAR(fit.r2, 0.75, 1e-12);

    const double same[] = { 5, 5, 5 };
    fit = profile_fit(one_e, same, 3);
    CHECK_NEAR(fit.exponent, 0, 1e-12);
    assert_int_equal(fit.point_count, 3);
    assert_int_equal(profile_fit(same, one_e, 3).point_count, 0);
    assert_int_equal(profile_fit(x + 3, y + 3, 2).point_count, 0);
    y[2] = 0;
    assert_int_equal(profile_fit(x, y, 5).point_count, 0);
    assert_int_equal(profile_fit(x, y, 0).point_count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_summary),       cmocka_unit_test(test_quantiles),
        cmocka_unit_test(test_fences),        cmocka_unit_test(test_exact_probability),
        cmocka_unit_test(test_probabilities), cmocka_unit_test(test_holm),
        cmocka_unit_test(test_ratio),         cmocka_unit_test(test_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
