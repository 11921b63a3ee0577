/*
 * print_profile_page.c: prints the page of a profile, for tests in a browser.
 *
 * print-profile-page [PROFILE.json [NAME=VALUE,...]...]; without a file, of the profile made by
 * hand. With parameters, of a sweep, too, whose points are that profile again, but the third row
 * takes 0.1 ms times the square root of the last parameter (of 1 where it is less or no number).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "src/profile/html.h"
#include "src/profile/json.h"
#include "tests/support/check.h"
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

int main(int argc, char **argv)
{
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
    if (status == STATUS_OK)
        status = profile_write_html(&profile, argc > 2 ? &sweep : NULL, &page, &size);
    if (status == STATUS_OK && fwrite(page, 1, size, stdout) != size)
        status = STATUS_WRITE;
    free(page);
    profile_sweep_finish(&sweep);
    profile_finish(&profile);
    return (int)status;
}
