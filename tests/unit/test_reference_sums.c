/*
 * test_reference_sums.c: sample sums of the reference in files: bit-identical round trip, and
 * rejection of invalid values.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "src/lab/reference/reference_sample_sums.h"
#include "tests/support/assertions.h"

enum {
    WIDTH = 3,
    HEIGHT = 2,
};

static const double awkward[] = { 0.1, -0.0, DBL_MAX, DBL_TRUE_MIN, (double)NAN, -1.0 / 3.0 };

static float firsts[2][WIDTH * HEIGHT] = { { 1, -2, 1e-30F, 4, INFINITY, 6 } };

static void begin(struct reference_sums *sums, float *first)
{
    reference_sums_init(sums, WIDTH, HEIGHT);
    assert_int_equal(reference_sums_add_value(sums, 0), 5);
    assert_int_equal(reference_sums_add_value(sums, REFERENCE_SUM_SQUARE), 1);
    reference_sums_add_first(sums, (uint32_t)reference_layers_find("exit.Y"), first);
    assert_true(reference_sums_allocate(sums));
}

static void test_every_bit(void **state)
{
    (void)state;
    struct reference_sums from, to;
    float row[WIDTH];
    begin(&from, firsts[0]);
    begin(&to, firsts[1]);
    const size_t count = (size_t)WIDTH * HEIGHT * from.count;
    for (size_t i = 0; i < count; i++)
        from.sums[i] = awkward[i * 7 % 6] * (i % 2 ? 1.0 : 0.7);
    assert_int_equal(reference_sums_plane_count(&from), 6 * 3 + 1);
    for (uint32_t p = 0; p < reference_sums_plane_count(&from); p++) {
        for (uint32_t y = 0; y < HEIGHT; y++) {
            reference_sums_get_row(&from, p, y, row);
            assert_true(reference_sums_set_row(&to, p, y, row));
        }
    }
    assert_memory_equal(from.sums, to.sums, count * sizeof(double));
    assert_memory_equal(firsts[0], firsts[1], sizeof(firsts[0]));
    reference_sums_finish(&from);
    reference_sums_finish(&to);
}

static void test_names(void **state)
{
    (void)state;
    static const char *const names[] = { "brightness.sum.0",  "brightness.sum.1", "square.sum.0",
                                         "remaining.R.sum.2", "R.sum.0",          "exit.Y" };
    const uint32_t planes[] = { 0, 1, 3, 8, 15, 18 };
    struct reference_sums sums;
    char name[IMAGE_NAME_SIZE];
    begin(&sums, firsts[0]);
    for (size_t i = 0; i < sizeof(planes) / sizeof(planes[0]); i++) {
        reference_sums_plane_name(&sums, planes[i], name);
        assert_string_equal(name, names[i]);
    }
    reference_sums_finish(&sums);
}

static void test_other_numbers(void **state)
{
    (void)state;
    static const float wrong[] = { -1, 0.5F, 1 << 22, 1e30F, -INFINITY, INFINITY, NAN };
    struct reference_sums sums;
    begin(&sums, firsts[0]);
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
        const float row[WIDTH] = { 0, 0, wrong[i] };
        for (uint32_t part = 0; part < 3; part++)
            assert_false(reference_sums_set_row(&sums, 3 + part, 1, row));
    }
    const float row[WIDTH] = { 0, 0, 1 << 21 }; /* the first part alone has 22 bits */
    assert_true(reference_sums_set_row(&sums, 3, 0, row));
    assert_false(reference_sums_set_row(&sums, 4, 0, row));
    assert_false(reference_sums_set_row(&sums, 5, 0, row));
    reference_sums_finish(&sums);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_bit),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_other_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
