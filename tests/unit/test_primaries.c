/* test_primaries.c: conversion matrices from other RGB primaries to Rec.709. */
#include <math.h>
#include "src/file/color_primaries.h"
#include "tests/support/assertions.h"

static const struct primaries acescg = {
    { 0.713F, 0.293F },
    { 0.165F, 0.830F },
    { 0.128F, 0.044F },
    { 0.32168F, 0.33767F },
};
static const struct primaries rec2020 = {
    { 0.708F, 0.292F },
    { 0.170F, 0.797F },
    { 0.131F, 0.046F },
    { 0.3127F, 0.3290F },
};

static void check_matrix(const struct primaries *from, const double expected[static 9])
{
    float matrix[9];
    assert_int_equal(primaries_to_rec709(from, matrix), PRIMARIES_OTHER);
    for (size_t i = 0; i < 9; i++)
        CHECK_NEAR(matrix[i], expected[i], 2e-4);
}

/* As published by the Academy, and in ITU-R BT.2087. */
static void published_matrices(void **state)
{
    (void)state;
    check_matrix(&acescg, (const double[9]){ 1.70505, -0.62179, -0.08326, -0.13026, 1.14080,
                                             -0.01055, -0.02400, -0.12897, 1.15297 });
    check_matrix(&rec2020, (const double[9]){ 1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083,
                                              -0.0182, -0.1006, 1.1187 });
}

static void rec709_is_left_alone(void **state)
{
    (void)state;
    const struct primaries own = {
        { 0.64F, 0.33F },
        { 0.3F, 0.6F },
        { 0.15F, 0.06F },
        { 0.3127F, 0.329F },
    };
    float matrix[9];
    assert_int_equal(primaries_to_rec709(&own, matrix), PRIMARIES_REC709);
    for (size_t i = 0; i < 9; i++)
        CHECK_NEAR(matrix[i], i % 4 == 0, 0);
}

static void nonsense_is_invalid(void **state)
{
    (void)state;
    const struct primaries nonsense[] = {
        { { 0 }, { 0 }, { 0 }, { 0 } },
        { { 0.64F, 0.33F }, { 0.64F, 0.33F }, { 0.15F, 0.06F }, { 0.3127F, 0.329F } },
        { { NAN, 0.33F }, { 0.3F, 0.6F }, { 0.15F, 0.06F }, { 0.3127F, 0.329F } },
        { { 0.64F, 0.33F }, { 0.3F, 0.6F }, { 0.15F, 0.06F }, { 0.3F, 0.0F } },
        { { 0.64F, 0.33F }, { 0.3F, 0.6F }, { 0.15F, 0.06F }, { 0.9F, 0.9F } },
        { { 1e30F, 0.33F }, { 0.3F, -1e30F }, { 0.15F, 0.06F }, { INFINITY, 0.329F } },
    };
    for (size_t i = 0; i < sizeof(nonsense) / sizeof(nonsense[0]); i++) {
        float matrix[9];
        assert_int_equal(primaries_to_rec709(&nonsense[i], matrix), PRIMARIES_INVALID);
        CHECK_NEAR(matrix[0], 1, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_matrices),
        cmocka_unit_test(rec709_is_left_alone),
        cmocka_unit_test(nonsense_is_invalid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
