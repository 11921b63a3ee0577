/* Parameters, the product of their values, and how cost grows with them. */
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/profile/sweep_power_law.h"
#include "src/lab/profile/utf8_text.h"
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
    char text[3 * PROFILE_NAME_SIZE];
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
        struct profile_sweep sweep = { 0 };
        assert_int_equal(profile_sweep_add(&sweep, wrong[i]), STATUS_USAGE);
        profile_sweep_finish(&sweep);
    }
    for (int i = 0; i < 2; i++) { /* a name, then a value, that is one byte too long */
        struct profile_sweep sweep = { 0 };
        snprintf(text, sizeof(text), "%0*d=%0*d", PROFILE_NAME_SIZE - i, 1,
                 PROFILE_NAME_SIZE - 1 + i, 1);
        assert_int_equal(profile_sweep_add(&sweep, text), STATUS_USAGE);
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
    struct profile_sweep sweep = { 0 };
    char *thousand = make_numbers("a", 1000), *more = make_numbers("a", 1001);
    assert_int_equal(profile_sweep_add(&sweep, more), STATUS_USAGE);
    assert_int_equal(profile_sweep_add(&sweep, thousand), STATUS_OK);
    assert_int_equal(sweep.point_count, 1000);
    assert_int_equal(profile_sweep_add(&sweep, "b=1,2"), STATUS_USAGE);
    assert_int_equal(profile_sweep_add(&sweep, "a=1"), STATUS_USAGE); /* it is there */
    assert_int_equal(profile_sweep_add(&sweep, "b=1"), STATUS_OK);
    assert_int_equal(profile_sweep_add(&sweep, "c=1"), STATUS_OK);
    assert_int_equal(profile_sweep_add(&sweep, "d=1"), STATUS_OK);
    assert_int_equal(profile_sweep_add(&sweep, "e=1"), STATUS_USAGE);
    assert_string_equal(profile_sweep_value(&sweep, 999, 0), "999");
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

/* Of the first value of a parameter. */
static bool read_number(const char *text, double *number)
{
    struct profile_sweep sweep = { 0 };
    assert_int_equal(profile_sweep_add(&sweep, text), STATUS_OK);
    const bool is_number = profile_sweep_number(&sweep, 0, 0, number);
    profile_sweep_finish(&sweep);
    return is_number;
}

static void test_numbers(void **state)
{
    (void)state;
    static const char *const none[] = {
        "a=640x480", "a=0x10",   "a=inf",     "a=nan",      "a=1e999",        "a=on",
        "a=1 ",      "a=-",      "a=0x1",     "size=640",   "size=640x",      "size=640x-1",
        "size=x480", "size=1e3", "size=1x2 ", "size= 1x20", "size=640x480x2",
    };
    double number = 0;
    for (size_t i = 0; i < sizeof(none) / sizeof(none[0]); i++)
        if (read_number(none[i], &number))
            fail_msg("%s is a number", none[i]);
    assert_true(read_number("a=-1.5e3", &number));
    CHECK_NEAR(number, -1500, 0);
    assert_true(read_number("size=640x480", &number));
    CHECK_NEAR(number, 307200, 0);
}

/* The third pass costs n ^ 2, all else the same; at n = 0 the fourth pass has another name. */
static void make_sweep(struct profile_sweep *sweep, const char *text)
{
    *sweep = (struct profile_sweep){ 0 };
    assert_int_equal(profile_sweep_add(sweep, text), STATUS_OK);
    for (uint32_t i = 0; i < sweep->point_count; i++) {
        struct profile *p = &sweep->points[i];
        double n = 0;
        profile_sample(p, 1);
        if (!profile_sweep_number(sweep, i, 0, &n))
            n = 2;
        if (n <= 0)
            snprintf(p->rows[3].name, PROFILE_NAME_SIZE, "other.pass");
        for (uint32_t run = 0; run < p->run_count; run++) {
            p->frame[run] += p->rows[2].ms[run] * (n * n - 1);
            p->rows[2].ms[run] *= n * n;
        }
    }
}

static const struct profile_growth *find_growth(const struct profile_growth *growths,
                                                uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(growths[i].name, name) == 0)
            return &growths[i];
    return NULL;
}

static void test_growth(void **state)
{
    (void)state;
    struct profile_sweep sweep;
    struct profile_growth *growths = NULL;
    uint32_t count = 0;
    make_sweep(&sweep, "n=0,1,2,4");
    assert_int_equal(profile_sweep_fit(&sweep, &growths, &count), STATUS_OK);
    assert_string_equal(growths[0].name, "frame");
    const struct profile_growth *third = find_growth(growths, count, "refract_paper.color");
    const struct profile_growth *fourth = find_growth(growths, count, "wave.simulate");
    assert_non_null(third);
    assert_non_null(fourth);
    CHECK_NEAR(third->fit.exponent, 2, 1e-9);
    CHECK_NEAR(third->fit.factor, 8, 0.1);
    CHECK_NEAR(third->fit.r2, 1, 1e-9);
    assert_int_equal(third->fit.point_count, 3);
    CHECK_NEAR(fourth->fit.exponent, 0, 1e-9);
    assert_int_equal(fourth->fit.point_count, 3);
    assert_true(growths[0].fit.exponent > 1 && growths[0].fit.exponent < 2);
    assert_null(find_growth(growths, count, "other.pass")); /* at one point only */
    assert_null(find_growth(growths, count, "unattributed"));
    free(growths);
    profile_sweep_finish(&sweep);

    make_sweep(&sweep, "n=1,2");
    assert_int_equal(profile_sweep_fit(&sweep, &growths, &count), STATUS_OK);
    assert_non_null(find_growth(growths, count, "record"));
    assert_null(find_growth(growths, count, "submit")); /* less than 2 % of the frame */
    free(growths);
    profile_sweep_finish(&sweep);

    make_sweep(&sweep, "n=1,2,on");
    assert_int_equal(profile_sweep_fit(&sweep, &growths, &count), STATUS_OK);
    assert_null(growths);
    assert_int_equal(count, 0);
    profile_sweep_finish(&sweep);
}

static void test_sweep_table(void **state)
{
    (void)state;
    struct profile_sweep sweep;
    struct printed printed;
    make_sweep(&sweep, "cracks.a_name_that_is_much_too_long_for_a_column=0,1,20");
    memset(sweep.points[1].rows[2].name, 'n', PROFILE_NAME_SIZE - 1);
    assert_int_equal(profile_sweep_table(&sweep, captured_output_begin(&printed)), STATUS_OK);
    captured_output_end(&printed, PROFILE_COLUMNS);
    assert_non_null(strstr(captured_output_line(&printed, "20 "), " refract_paper.color 100 %"));
    assert_non_null(strstr(captured_output_line(&printed, "0 "), " other.pass  40 %"));
    (void)captured_output_line(&printed, "frame ");
    free(printed.text);
    profile_sweep_finish(&sweep);

    make_sweep(&sweep, "size=8x8,16x8");
    assert_int_equal(profile_sweep_table(&sweep, captured_output_begin(&printed)), STATUS_OK);
    captured_output_end(&printed, PROFILE_COLUMNS);
    assert_non_null(strstr(printed.text, "factor * pixels ^ exponent"));
    free(printed.text);
    profile_sweep_finish(&sweep);

    make_sweep(&sweep, "switch=on,off");
    assert_int_equal(profile_sweep_table(&sweep, captured_output_begin(&printed)), STATUS_OK);
    captured_output_end(&printed, PROFILE_COLUMNS);
    assert_null(strstr(printed.text, "exponent"));
    free(printed.text);
    profile_sweep_finish(&sweep);
}

static void test_sweep_json(void **state)
{
    (void)state;
    struct profile_sweep sweep;
    const char *type = NULL, *value = NULL, *fitted = NULL;
    char *text = NULL;
    size_t size = 0;
    double number = 0, median = 0, exponent = 0;
    make_sweep(&sweep, "size=8x8,16x8");
    assert_int_equal(profile_write_sweep_json(&sweep, &text, &size), STATUS_OK);
    json_t *root = json_loadb(text, size, 0, NULL);
    assert_non_null(root);
    assert_int_equal(json_unpack(root, "{s:s,s:[s],s:[{},{s:[s],s:[f],s:{s:{s:{s:f}}}}]}", "type",
                                 &type, "parameters", &value, "points", "values", &value, "numbers",
                                 &number, "profile", "frame", "summary", "median", &median),
                     0);
    assert_string_equal(type, "sweep");
    assert_string_equal(value, "16x8");
    CHECK_NEAR(number, 128, 0);
    const struct profile *second = &sweep.points[1];
    CHECK_NEAR(median, profile_quantile(second->frame, second->run_count, 0.5), 0);
    assert_int_equal(
        json_unpack(root, "{s:[{s:s,s:f}]}", "fits", "name", &fitted, "exponent", &exponent), 0);
    assert_string_equal(fitted, "frame");
    assert_true(exponent > 1.9 && exponent < 2);
    assert_null(strstr(text, "begin_ms"));
    json_decref(root);
    free(text);
    profile_sweep_finish(&sweep);
}

/* The second of two points takes twice as long, so that its frame rate is half; the third is like
 * the first. Each contrast has its own p, after Holm. */
static void test_contrasts(void **state)
{
    (void)state;
    struct profile_contrast contrasts[] = {
        { "figure 1", "twice the pixels", "half", 0, 1 },
        { "figure 1", "the same", "nothing", 0, 2 },
    };
    struct profile_sweep sweep;
    char *text = NULL;
    size_t size = 0;
    double rates[2], p[2];
    make_sweep(&sweep, "size=8x8,16x8,32x8");
    for (uint32_t i = 0; i < 3; i++) {
        for (uint32_t run = 0; run < sweep.points[i].run_count; run++)
            sweep.points[i].plain[run] = (i == 1 ? 2 : 1) * (1 + 0.001 * run);
    }
    sweep.contrasts = contrasts;
    sweep.contrast_count = 2;
    assert_int_equal(profile_contrast_all(&sweep), STATUS_OK);
    assert_int_equal(profile_write_sweep_json(&sweep, &text, &size), STATUS_OK);
    json_t *root = json_loadb(text, size, 0, NULL);
    assert_int_equal(json_unpack(root, "{s:[{s:f,s:f},{s:f,s:f}]}", "contrasts", "rate", &rates[0],
                                 "p", &p[0], "rate", &rates[1], "p", &p[1]),
                     0);
    CHECK_NEAR(rates[0], 0.5, 0.01);
    CHECK_NEAR(rates[1], 1, 0.01);
    const uint32_t runs = sweep.points[0].run_count;
    CHECK_NEAR(p[0], fmin(1, 2 * profile_mann_whitney_min(runs, runs)), 1e-9);
    CHECK_NEAR(p[1], 1, 1e-9);
    json_decref(root);
    free(text);
    profile_sweep_finish(&sweep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_wrong_words), cmocka_unit_test(test_limits),
        cmocka_unit_test(test_product),     cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_growth),      cmocka_unit_test(test_sweep_table),
        cmocka_unit_test(test_sweep_json),  cmocka_unit_test(test_contrasts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
