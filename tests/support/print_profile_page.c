/*
 * print_profile_page.c: program that prints a profile as an HTML page, for tests in a browser.
 *
 * print-profile-page [PROFILE.json [NAME=VALUE,...]...]; default: the profile of profile_sample.c.
 * Parameters add a sweep whose points are copies of the profile, except that the third row takes
 * 0.1 ms times the square root of the last parameter (of 1 if that is smaller or no number).
 * Several parameters also add charts.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "src/lab/profile/html_page.h"
#include "src/lab/profile/json.h"
#include "tests/support/assertions.h"
#include "tests/support/profile_sample.h"

static void make_point(struct profile *p, const char *path, double number)
{
    assert_int_equal(profile_read_json(path, p), STATUS_OK);
    double *ms = p->rows[2].ms;
    for (uint32_t run = 0; run < p->run_count; run++) {
        p->frame[run] -= ms[run];
        ms[run] = 0.1 * sqrt(fmax(number, 1));
        p->frame[run] += ms[run];
    }
}

static void make_sweep(struct profile_sweep *sweep, const char *path, char **parameters)
{
    for (; *parameters; parameters++)
        assert_int_equal(profile_sweep_add(sweep, *parameters), STATUS_OK);
    for (uint32_t i = 0; i < sweep->point_count; i++) {
        double number = 0;
        profile_sweep_number(sweep, i, sweep->parameter_count - 1, &number);
        make_point(&sweep->points[i], path, number);
    }
}

static const struct profile_figure figures[] = {
    {
        .title = "Figure 6",
        .axis = "of the parameter",
        .columns = { "least", "next" },
        .series = { "plain", "full" },
        .points = { { 0, 1 }, { 1, 0 } },
        .column_count = 2,
    },
    {
        .title = "Figure 7",
        .axis = "of the parameter",
        .is_bars = true,
        .columns = { "least", "next" },
        .series = { "plain" },
        .points = { { 0, 1 } },
        .column_count = 2,
    },
};

int main(int argc, char **argv)
{
    struct profile_contrast contrast = { "figure 6", "full ice", "about -26 %", 0, 1 };
    struct profile profile = { 0 };
    struct profile_sweep sweep = { 0 };
    char *page = NULL;
    size_t size = 0;
    enum status status = STATUS_OK;
    if (argc > 1)
        status = profile_read_json(argv[1], &profile);
    else
        profile_sample(&profile, 1);
    if (argc > 2)
        make_sweep(&sweep, argv[1], argv + 2);
    if (argc > 3) { /* several parameters: charts, too */
        sweep.figures = figures;
        sweep.figure_count = sizeof(figures) / sizeof(figures[0]);
        sweep.contrasts = &contrast;
        sweep.contrast_count = 1;
        assert_int_equal(profile_contrast_all(&sweep), STATUS_OK);
    }
    if (status == STATUS_OK)
        status = profile_write_html(&profile, argc > 2 ? &sweep : NULL, &page, &size);
    if (status == STATUS_OK && fwrite(page, 1, size, stdout) != size)
        status = STATUS_WRITE;
    free(page);
    profile_sweep_finish(&sweep);
    profile_finish(&profile);
    return (int)status;
}
