/* test_profile_table.c: text tables of one profile and of a comparison of two. */
#include <stdlib.h>
#include <string.h>
#include "src/lab/profile/profile_reports.h"
#include "src/lab/profile/statistics.h"
#include "tests/support/assertions.h"
#include "tests/support/captured_output.h"
#include "tests/support/profile_sample.h"

enum {
    COLUMNS = 100
};

static struct printed print_table(struct profile *p)
{
    struct printed printed;
    const struct profile_sweep sweep = { .points = p, .point_count = 1 };
    assert_int_equal(profile_table(&sweep, captured_output_begin(&printed)), STATUS_OK);
    captured_output_end(&printed, COLUMNS);
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
    struct printed printed = print_table(&p);
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
    assert_non_null(strstr(printed.text, "measurement overhead: +2.0 %"));
    (void)captured_output_line(&printed, "clock: timestamps");
    (void)captured_output_line(&printed, "BVH: 14400 triangles, 31.000 ms, 3.0 MiB");
    (void)captured_output_line(&printed, "acceleration structures: 4.250 ms, 2.0 MiB");
    free(printed.text);
    profile_finish(&p);
}

static struct printed compare(const struct profile *base, const struct profile *now, bool slower)
{
    struct printed printed;
    bool is_slower = !slower;
    assert_int_equal(profile_compare(base, now, 0.05, captured_output_begin(&printed), &is_slower),
                     STATUS_OK);
    captured_output_end(&printed, COLUMNS);
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
    struct printed printed = compare(&base, &now, false);
    assert_null(strstr(printed.text, "warning"));
    check_verdict(&printed, "refract_paper.color ", "within noise");
    check_verdict(&printed, "frame ", "within noise");
    free(printed.text);

    scale_row(&now, 3, 1.2);
    scale_row(&now, 2, 0.5);
    snprintf(now.rows[4].name, PROFILE_NAME_SIZE, "other.copy");
    printed = compare(&base, &now, true);
    check_verdict(&printed, "env_cube.objects ", "within noise");
    check_verdict(&printed, "refract_paper.color ", "faster");
    check_verdict(&printed, "wave.simulate ", "slower");
    check_verdict(&printed, "other.copy ", "new");
    check_verdict(&printed, "copy \"quoted\" <b> ", "gone");
    check_verdict(&printed, "frame ", "faster");
    assert_non_null(strstr(captured_output_line(&printed, "wave.simulate "), "    1.200 "));
    assert_non_null(strstr(printed.text, "number of tests, 7;"));
    free(printed.text);

    /* what is slower one way is faster the other */
    printed = compare(&now, &base, true);
    check_verdict(&printed, "refract_paper.color ", "slower");
    check_verdict(&printed, "wave.simulate ", "faster");
    free(printed.text);
    profile_finish(&base);
    profile_finish(&now);
}

/* A significant change below the threshold is no verdict. */
static void test_threshold(void **state)
{
    (void)state;
    struct profile base, now;
    profile_sample(&base, 1);
    profile_sample(&now, 1);
    for (uint32_t run = 0; run < now.run_count; run++) {
        base.rows[3].ms[run] = 2 + 1e-3 * run;
        now.rows[3].ms[run] = 2.06 + 1e-3 * run;
    }
    struct printed printed = compare(&base, &now, false);
    check_verdict(&printed, "wave.simulate ", "below threshold");
    free(printed.text);
    scale_row(&now, 3, 1.05);
    printed = compare(&base, &now, true);
    check_verdict(&printed, "wave.simulate ", "slower");
    assert_non_null(strstr(printed.text, "Slower rows: 1."));
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
    struct printed printed = compare(&base, &now, true);
    check_verdict(&printed, "unattributed ", "slower");
    assert_non_null(strstr(captured_output_line(&printed, "unattributed "),
                           "     -0.100      0.100        - "));
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
    base.run_count = now.run_count = 6;
    bool is_slower = true;
    struct printed printed;
    now.width = 640;
    snprintf(now.device, sizeof(now.device), "another device");
    snprintf(now.clock, sizeof(now.clock), "submits");
    snprintf(now.settings[0].value, PROFILE_NAME_SIZE, "1.5");
    snprintf(now.settings[1].name, PROFILE_NAME_SIZE, "cracks.count");
    /* three times as slow, but too few runs to say so of that many passes */
    assert_int_equal(profile_compare(&base, &now, 0, captured_output_begin(&printed), &is_slower),
                     STATUS_USAGE);
    captured_output_end(&printed, COLUMNS);
    assert_false(is_slower);
    (void)captured_output_line(&printed, "warning: different width: 1024 in the baseline, 640 now");
    (void)captured_output_line(&printed, "warning: different device: llvmpipe (LLVM");
    (void)captured_output_line(&printed,
                               "warning: different clock: timestamps in the baseline, subm");
    (void)captured_output_line(&printed,
                               "warning: different refract.ior: 1.3091 in the baseline, 1.5");
    (void)captured_output_line(&printed,
                               "warning: different cracks.count: none in the baseline, neut");
    free(printed.text);
    profile_finish(&base);
    profile_finish(&now);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),      cmocka_unit_test(test_comparison),
        cmocka_unit_test(test_threshold),  cmocka_unit_test(test_comparison_below_0),
        cmocka_unit_test(test_conditions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
