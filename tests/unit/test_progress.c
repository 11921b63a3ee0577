/* test_progress.c: text of the progress bar. */
#include <string.h>
#include "src/app/progress.h"
#include "tests/support/assertions.h"

static void check_line(const struct progress *p, uint32_t done, uint32_t all, double seconds,
                       const char *wanted)
{
    char line[PROGRESS_COLUMNS + 1];
    progress_print(line, p, done, all, seconds);
    assert_string_equal(line, wanted);
}

static void the_time_that_is_left(void **state)
{
    const struct progress one = { .frames = 1, .frame_name = "frame", .step_name = "samples" };
    const struct progress many = { 10, 4, "frame", "samples", 0, false };

    (void)state;
    check_line(&one, 0, 4, 9, "[                              ] 0/4 samples");
    check_line(&one, 1, 4, 1.9, "[#######                       ] 1/4 samples");
    check_line(&one, 1, 4, 3, "[#######                       ] 1/4 samples, 0:09 left");
    check_line(&one, 4, 4, 3, "[##############################] 4/4 samples, 0:00 left");
    check_line(&many, 0, 1, 40, "[############                  ] frame 5/10, 1:00 left");
    check_line(&many, 1, 2, 4500,
               "[#############                 ] frame 5/10, 1/2 samples, 1:31:40 left");
}

static void lines_fit(void **state)
{
    const struct progress p = { 100000, 99999, "frame", "samples", 0, false };
    char line[PROGRESS_COLUMNS + 1];

    (void)state;
    progress_print(line, &p, 32768, 65536, 1e8);
    assert_true(strlen(line) <= PROGRESS_COLUMNS);
    assert_non_null(strstr(line, "frame 100000/100000, 32768/65536 samples"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_time_that_is_left),
        cmocka_unit_test(lines_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
