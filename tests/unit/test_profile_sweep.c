/* test_profile_sweep.c: parameter sweeps: combinations of values, and reports. */
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/profile/profile_reports.h"
#include "tests/support/assertions.h"
#include "tests/support/captured_output.h"
#include "tests/support/profile_sample.h"

/* What --sweep may not be. */
static const char *const wrong[] = {
    "", "=", "a", "a=", "=1", "a=1,", "a=,1", "a=1,,2",
};

static void test_wrong_words(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
        struct profile_sweep sweep = { 0 };
        assert_int_equal(profile_sweep_add(&sweep, wrong[i]), STATUS_USAGE);
        profile_sweep_finish(&sweep);
    }
}

static char *make_numbers(const char *name, int count)
{
    struct printed printed;
    FILE *out = captured_output_begin(&printed);
    fprintf(out, "%s=", name);
    for (int i = 0; i < count; i++)
        fprintf(out, "%s%d", i ? "," : "", i);
    assert_int_equal(fclose(out), 0);
    return printed.text;
}

static void test_limits(void **state)
{
    (void)state;
    char *thousand = make_numbers("a", 1000), *more = make_numbers("a", 1001);
    struct profile_sweep sweep = { 0 };
    assert_int_equal(profile_sweep_add(&sweep, more), STATUS_USAGE);
    profile_sweep_finish(&sweep);
    assert_int_equal(profile_sweep_add(&sweep, thousand), STATUS_OK);
    assert_int_equal(sweep.point_count, 1000);
    assert_int_equal(profile_sweep_add(&sweep, "b=1"), STATUS_OK);
    assert_string_equal(profile_sweep_value(&sweep, 999, 0), "999");
    assert_int_equal(profile_sweep_add(&sweep, "a=1"), STATUS_USAGE); /* it is there */
    assert_int_equal(profile_sweep_add(&sweep, "c=1,2"), STATUS_USAGE);
    profile_sweep_finish(&sweep);
    free(thousand);
    free(more);
}

static void test_product(void **state)
{
    (void)state;
    static const char *const expected[] = { "x 1 on",  "x 1 off", "x 2 on",
                                            "x 2 off", "x 3 on",  "x 3 off" };
    struct profile_sweep sweep = { 0 };
    assert_int_equal(profile_sweep_add(&sweep, "one=x"), STATUS_OK);
    assert_int_equal(profile_sweep_add(&sweep, "two=1,2,3"), STATUS_OK);
    assert_int_equal(profile_sweep_add(&sweep, "three=on,off"), STATUS_OK);
    assert_int_equal(sweep.point_count, 6);
    for (uint32_t i = 0; i < 6; i++) {
        char text[64];
        snprintf(text, sizeof(text), "%s %s %s", profile_sweep_value(&sweep, i, 0),
                 profile_sweep_value(&sweep, i, 1), profile_sweep_value(&sweep, i, 2));
        assert_string_equal(text, expected[i]);
    }
    profile_sweep_finish(&sweep);
}

/* The third pass takes 8 ms * n ^ 2, all else the same; at n = 0 the fourth has another name. */
static void make_sweep(struct profile_sweep *sweep)
{
    *sweep = (struct profile_sweep){ 0 };
    assert_int_equal(profile_sweep_add(sweep, "n=0,1,2"), STATUS_OK);
    assert_int_equal(profile_sweep_add(sweep, "size=8x8"), STATUS_OK);
    sweep->points = calloc(sweep->point_count, sizeof(*sweep->points));
    assert_non_null(sweep->points);
    for (uint32_t i = 0; i < sweep->point_count; i++) {
        struct profile *p = &sweep->points[i];
        profile_sample(p, 1);
        if (i == 0)
            snprintf(p->rows[3].name, PROFILE_NAME_SIZE, "other.pass");
        for (uint32_t run = 0; run < p->run_count; run++)
            p->rows[2].ms[run] = 8 * i * i;
    }
}

static struct printed write_sweep(profile_report_fn *report)
{
    struct profile_sweep sweep;
    struct printed printed;
    make_sweep(&sweep);
    assert_int_equal(report(&sweep, captured_output_begin(&printed)), STATUS_OK);
    assert_int_equal(fclose(printed.out), 0);
    profile_sweep_finish(&sweep);
    return printed;
}

static void test_sweep_table(void **state)
{
    (void)state;
    struct printed printed = write_sweep(profile_table);
    const char *third = captured_output_line(&printed, "refract_paper.color ");
    double ms[3] = { 0 };
    (void)captured_output_line(&printed, "n                                         0 ");
    (void)captured_output_line(&printed, "size                                    8x8        8x8 ");
    assert_int_equal(sscanf(third, "%*s %lf %lf %lf", &ms[0], &ms[1], &ms[2]), 3);
    CHECK_NEAR(ms[0], 0, 0);
    CHECK_NEAR(ms[1], 8, 0);
    CHECK_NEAR(ms[2], 32, 0);
    assert_non_null(
        strstr(captured_output_line(&printed, "other.pass "), "          -          -\n"));
    assert_non_null(
        strstr(captured_output_line(&printed, "wave.simulate "), "           -      2."));
    assert_ptr_equal(strchr(captured_output_line(&printed, "frame "), '\n'),
                     printed.text + printed.size - 1);
    free(printed.text);
}

static void test_sweep_csv(void **state)
{
    (void)state;
    struct printed printed = write_sweep(profile_csv);
    (void)captured_output_line(&printed, "n,size,row,median_ms\r\n");
    (void)captured_output_line(&printed, "2,8x8,refract_paper.color,32\r\n");
    (void)captured_output_line(&printed, "0,8x8,other.pass,");
    free(printed.text);
}

static void test_sweep_json(void **state)
{
    (void)state;
    struct printed printed = write_sweep(profile_json);
    const char *type, *parameters[2], *values[2];
    double median = 0;
    json_t *root = json_loadb(printed.text, printed.size, 0, NULL);
    assert_non_null(root);
    assert_int_equal(json_unpack(root, "{s:s,s:[ss],s:[{},{s:[ss],s:{s:[{},{},{s:{s:f}}]}}]}",
                                 "type", &type, "parameters", &parameters[0], &parameters[1],
                                 "points", "values", &values[0], &values[1], "profile", "rows",
                                 "summary", "median", &median),
                     0);
    assert_string_equal(type, "sweep");
    assert_string_equal(parameters[0], "n");
    assert_string_equal(parameters[1], "size");
    assert_string_equal(values[0], "1");
    assert_string_equal(values[1], "8x8");
    CHECK_NEAR(median, 8, 0);
    json_decref(root);
    free(printed.text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_wrong_words), cmocka_unit_test(test_limits),
        cmocka_unit_test(test_product),     cmocka_unit_test(test_sweep_table),
        cmocka_unit_test(test_sweep_csv),   cmocka_unit_test(test_sweep_json),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
