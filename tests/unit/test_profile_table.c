/* Tables for people: of a profile, and of two. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/profile/baseline_comparison.h"
#include "src/lab/profile/row_aggregation.h"
#include "src/lab/profile/table.h"
#include "src/lab/profile/utf8_text.h"
#include "tests/support/assertions.h"
#include "tests/support/captured_output.h"
#include "tests/support/profile_sample.h"

static struct printed print_table(const struct profile *p, bool each)
{
    struct printed printed;
    assert_int_equal(profile_table(p, each, captured_output_begin(&printed)), STATUS_OK);
    captured_output_end(&printed, PROFILE_COLUMNS);
    return printed;
}

/* The numbers of a line after its name: median, mean, sigma, min, p95, max, share */
struct times {
    double of[7];
};

static struct times read_times(const struct printed *printed, const char *name)
{
    struct times t;
    const char *line = captured_output_line(printed, name) + strlen(name);
    assert_int_equal(sscanf(line, "%lf %lf ± %lf %lf %lf %lf %lf %%", &t.of[0], &t.of[1], &t.of[2],
                            &t.of[3], &t.of[4], &t.of[5], &t.of[6]),
                     7);
    return t;
}

static void test_table(void **state)
{
    (void)state;
    static const char *const names[] = {
        "env_cube.objects x2 ",
        "refract_paper.color ",
        "wave.simulate ",
        "copy \"quoted\" <b> ",
        "record ",
        "submit ",
        "unattributed ",
    };
    struct profile p;
    double sum = 0, shares = 0;
    profile_sample(&p, 1);
    struct printed printed = print_table(&p, false);
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        sum += read_times(&printed, names[i]).of[1];
        shares += read_times(&printed, names[i]).of[6];
    }
    const struct times frame = read_times(&printed, "frame ");
    CHECK_NEAR(sum, frame.of[1], 0.005); /* each is rounded */
    CHECK_NEAR(shares, 100, 0.5);
    CHECK_NEAR(frame.of[6], 100, 0);
    const struct times third = read_times(&printed, names[1]);
    const struct profile_summary summary = profile_summarize(p.rows[2].ms, p.run_count);
    CHECK_NEAR(third.of[0], summary.median, 0.0006);
    CHECK_NEAR(third.of[2], summary.sigma, 0.0006);
    CHECK_NEAR(third.of[3], summary.min, 0.0006);
    CHECK_NEAR(third.of[4], summary.p95, 0.0006);
    CHECK_NEAR(third.of[5], summary.max, 0.0006);
    assert_non_null(strstr(printed.text, "run 7: refract_paper.color 24.131 ms, 3.0x its median"));
    assert_non_null(strstr(printed.text, "measurement overhead: +2.0 %"));
    (void)captured_output_line(&printed, "clock: timestamps");
    (void)captured_output_line(&printed, "BVH: 14400 triangles, 31.000 ms, 3.0 MiB");
    (void)captured_output_line(&printed, "acceleration structures: 4.2500 ms, 2.0 MiB");
    free(printed.text);
    profile_finish(&p);
}

static void test_each(void **state)
{
    (void)state;
    struct profile p;
    profile_sample(&p, 1);
    struct printed printed = print_table(&p, true);
    (void)captured_output_line(&printed, "env_cube.objects [0] ");
    (void)captured_output_line(&printed, "env_cube.objects [1] ");
    assert_null(strstr(printed.text, "x2"));
    free(printed.text);
    profile_finish(&p);
}

/* Long names, odd bytes, large and small numbers: a table stays in its columns. */
static void test_columns(void **state)
{
    (void)state;
    struct profile p;
    for (int exponent = -7; exponent < 7; exponent++) {
        profile_sample(&p, pow(10, exponent));
        memset(p.rows[2].name, 'n', PROFILE_NAME_SIZE - 1);
        memset(p.rows[3].name, '\xff', PROFILE_NAME_SIZE - 1);
        memcpy(p.rows[4].name, "\x1b[2J\xc2\x9b", 7);
        memset(p.device, ' ', sizeof(p.device) - 1);
        p.rows[2].covered = p.rows[2].target_bytes = p.rows[2].vertices = UINT64_MAX;
        p.rows[1].triangles = 9999999 - p.rows[0].triangles;
        p.rows[2].fragments = 10000000;
        struct printed printed = print_table(&p, false);
        assert_non_null(strstr(printed.text, " 9999999 "));
        assert_non_null(strstr(printed.text, " 10.00 M\n"));
        free(printed.text);
        profile_finish(&p);
    }
}

static void test_no_runs_stand_out(void **state)
{
    (void)state;
    struct profile p;
    profile_sample(&p, 1);
    p.run_count = 7; /* the outlier is in the eighth */
    struct printed printed = print_table(&p, false);
    (void)captured_output_line(&printed, "outliers (runs count from 0): none");
    free(printed.text);
    p.run_count = 1;
    printed = print_table(&p, false);
    (void)captured_output_line(&printed, "1 run after 3 warm-up runs");
    free(printed.text);
    p.run_count = SAMPLE_RUN_COUNT;
    for (uint32_t i = 0; i < p.row_count; i++)
        p.rows[i].ms[3] = p.rows[i].ms[4] = 30 + i;
    printed = print_table(&p, true);
    const char *worst = captured_output_line(&printed, "run 3: unattributed 37.000 ms, 3");
    assert_memory_equal(strchr(worst, '\n') + 1, "run 4: unattributed 37.000", 20);
    (void)captured_output_line(&printed, "and 9 smaller ones");
    free(printed.text);
    profile_finish(&p);
}

static void test_words(void **state)
{
    (void)state;
    struct printed printed;
    char text[260];
    memset(text, 'a', sizeof(text));
    text[60] = text[61] = ' ';
    text[259] = '\0';
    profile_print_wrapped(text, 4, captured_output_begin(&printed));
    captured_output_end(&printed, PROFILE_COLUMNS);
    assert_memory_equal(printed.text + 59, "a\n    a", 7);
    assert_int_equal(printed.size, 259 - 2 + 3 * 5 + 1);
    free(printed.text);

    profile_print_name("env_cube.objects", 9, captured_output_begin(&printed));
    profile_print_name("ö", 3, printed.out);
    fputc('\n', printed.out);
    captured_output_end(&printed, PROFILE_COLUMNS);
    assert_string_equal(printed.text, "env_…ectsö  \n");
    free(printed.text);

    profile_print_name("\x1b\x7f\xc2\x9b\xc2\xa0\xff", 6, captured_output_begin(&printed));
    fputc('\n', printed.out);
    captured_output_end(&printed, PROFILE_COLUMNS);
    assert_string_equal(printed.text, "???\xc2\xa0? \n");
    free(printed.text);

    char bytes[] = "\xc3\xb6 \xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xf0\x9f\x98\x80 \xe2\x82";
    profile_clean_text(bytes);
    assert_string_equal(bytes, "\xc3\xb6 ?? ??? ???? \xf0\x9f\x98\x80 ??");
}

static struct printed compare(const struct profile *base, const struct profile *now, bool each,
                              bool slower)
{
    struct printed printed;
    bool is_slower = !slower;
    assert_int_equal(profile_compare(base, now, each, captured_output_begin(&printed), &is_slower),
                     STATUS_OK);
    captured_output_end(&printed, PROFILE_COLUMNS);
    assert_int_equal(is_slower, slower);
    return printed;
}

static void check_verdict(const struct printed *printed, const char *name, const char *verdict)
{
    const char *line = captured_output_line(printed, name), *end = strchr(line, '\n');
    const size_t size = strlen(verdict);
    assert_true((size_t)(end - line) > size);
    if (memcmp(end - size, verdict, size) != 0)
        fail_msg("not \"%s\": %.*s", verdict, (int)(end - line), line);
}

static void scale_row(struct profile *p, uint32_t row, double factor)
{
    for (uint32_t run = 0; run < p->run_count; run++) {
        p->frame[run] += p->rows[row].ms[run] * (factor - 1);
        p->rows[row].ms[run] *= factor;
    }
}

static void test_comparison(void **state)
{
    (void)state;
    struct profile base, now;
    profile_sample(&base, 1);
    profile_sample(&now, 1);
    scale_row(&base, 1, 2); /* repetitions differ */
    scale_row(&now, 1, 2);
    struct printed printed = compare(&base, &now, false, false);
    assert_null(strstr(printed.text, "warning"));
    check_verdict(&printed, "refract_paper.color ", "within noise");
    check_verdict(&printed, "frame ", "within noise");
    free(printed.text);

    scale_row(&now, 3, 1.2);
    scale_row(&now, 2, 0.5);
    snprintf(now.rows[4].name, PROFILE_NAME_SIZE, "other.copy");
    printed = compare(&base, &now, true, true);
    check_verdict(&printed, "env_cube.objects [1] ", "within noise");
    check_verdict(&printed, "refract_paper.color ", "faster");
    check_verdict(&printed, "wave.simulate ", "slower");
    check_verdict(&printed, "other.copy ", "new");
    check_verdict(&printed, "copy \"quoted\" <b> ", "gone");
    check_verdict(&printed, "frame ", "faster");
    assert_non_null(strstr(captured_output_line(&printed, "wave.simulate "), " 1.200 ["));
    assert_non_null(strstr(printed.text, "correction for 8 tests"));
    free(printed.text);

    /* what is slower one way is faster the other */
    printed = compare(&now, &base, false, true);
    check_verdict(&printed, "refract_paper.color ", "slower");
    check_verdict(&printed, "wave.simulate ", "faster");
    free(printed.text);
    profile_finish(&base);
    profile_finish(&now);
}

/* `unattributed` has no ratio where it is below 0. */
static void test_comparison_below_0(void **state)
{
    (void)state;
    struct profile base, now;
    profile_sample(&base, 1);
    profile_sample(&now, 1);
    scale_row(&base, 7, -1);
    struct printed printed = compare(&base, &now, false, true);
    check_verdict(&printed, "unattributed ", "slower");
    assert_non_null(
        strstr(captured_output_line(&printed, "unattributed "), "   -0.100    0.100      - "));
    free(printed.text);
    profile_finish(&base);
    profile_finish(&now);
}

static void test_conditions(void **state)
{
    (void)state;
    struct profile base, now;
    profile_sample(&base, 1);
    profile_sample(&now, 3);
    base.run_count = now.run_count = 5;
    now.width = 640;
    memset(now.device, 'd', sizeof(now.device) - 1);
    snprintf(now.clock, sizeof(now.clock), "submits");
    snprintf(now.settings[0].value, PROFILE_NAME_SIZE, "1.5");
    snprintf(now.settings[1].name, PROFILE_NAME_SIZE, "cracks.count");
    /* three times as slow, but too few runs to say so of that many passes */
    struct printed printed = compare(&base, &now, true, false);
    (void)captured_output_line(&printed, "warning: different width: 1024 in the baseline, 640 now");
    (void)captured_output_line(&printed, "warning: different device: llvmpipe (LLVM");
    (void)captured_output_line(&printed,
                               "warning: different clock: timestamps in the baseline, subm");
    (void)captured_output_line(&printed,
                               "warning: different refract.ior: 1.3091 in the baseline, 1.5");
    (void)captured_output_line(&printed,
                               "warning: different tonemap.curve: neutral in the baseline, n");
    (void)captured_output_line(&printed,
                               "warning: different cracks.count: none in the baseline, neut");
    (void)captured_output_line(&printed, "With 5 and 5 runs no difference can be significant in");
    free(printed.text);
    profile_finish(&base);
    profile_finish(&now);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_each),
        cmocka_unit_test(test_columns),
        cmocka_unit_test(test_no_runs_stand_out),
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_comparison),
        cmocka_unit_test(test_comparison_below_0),
        cmocka_unit_test(test_conditions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
