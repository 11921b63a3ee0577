/* test_frame_range.c: frame lists: parsing, and rejection of invalid ones. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/app/options/frame_range.h"
#include "tests/support/assertions.h"

/* "1 2 3", as the text says. */
static void check_frames(const char *text, const char *expected)
{
    struct frame_range range;
    char found[256] = "";
    size_t length = 0;

    assert_int_equal(frame_range_parse(&range, text), STATUS_OK);
    for (uint32_t i = 0; i < range.count && length < sizeof(found) - 16; i++)
        length += (size_t)snprintf(found + length, 16, "%s%d", i ? " " : "", (int)range.frames[i]);
    assert_string_equal(found, expected);
    frame_range_finish(&range);
    assert_null(range.frames);
    assert_int_equal(range.count, 0);
}

static void test_single_frames(void **state)
{
    (void)state;
    check_frames("0", "0");
    check_frames("7", "7");
    check_frames("0012", "12");
    check_frames("-3", "-3");
    check_frames("-0", "0");
    check_frames("9999999", "9999999");
    check_frames("-9999999", "-9999999");
}

static void test_ranges(void **state)
{
    (void)state;
    check_frames("1-5", "1 2 3 4 5");
    check_frames("5-1", "5 4 3 2 1");
    check_frames("4-4", "4");
    check_frames("-2-2", "-2 -1 0 1 2");
    check_frames("2--2", "2 1 0 -1 -2");
    check_frames("-4--2", "-4 -3 -2");
    check_frames("-2--4", "-2 -3 -4");
    check_frames("9999998-9999999", "9999998 9999999");
    check_frames("-9999998--9999999", "-9999998 -9999999");
}

static void test_steps(void **state)
{
    (void)state;
    check_frames("1-10x3", "1 4 7 10");
    check_frames("1-9x3", "1 4 7");
    check_frames("10-1x3", "10 7 4 1");
    check_frames("10-2x3", "10 7 4");
    check_frames("1-3x1", "1 2 3");
    check_frames("-5-5x5", "-5 0 5");
    check_frames("5--5x4", "5 1 -3");
    check_frames("1-10x9999999", "1");
    check_frames("3-3x7", "3");
    check_frames("-9999999-9999999x9999999", "-9999999 0 9999999");
    check_frames("9999999--9999999x9999999", "9999999 0 -9999999");
}

static void test_lists(void **state)
{
    (void)state;
    check_frames("3,1,2", "3 1 2");
    check_frames("1-3,10,20-18", "1 2 3 10 20 19 18");
    check_frames("-1,-3--2", "-1 -3 -2");
}

static void test_again_is_dropped(void **state)
{
    (void)state;
    check_frames("1,1", "1");
    check_frames("5,1-6,2", "5 1 2 3 4 6");
    check_frames("1-9x4,1-5", "1 5 9 2 3 4");
    check_frames("3-1,1-4", "3 2 1 4");
    check_frames("0,-0,00", "0");
    check_frames("-1,1,-1", "-1 1");
}

static void test_many(void **state)
{
    struct frame_range range;

    (void)state;
    assert_int_equal(frame_range_parse(&range, "1-100000,50000-1,99999"), STATUS_OK);
    assert_int_equal(range.count, FRAME_RANGE_COUNT_MAX);
    for (uint32_t i = 0; i < range.count; i++)
        assert_int_equal(range.frames[i], i + 1);
    frame_range_finish(&range);
}

/* What goes to stderr meanwhile. */
static enum status parse_aloud(const char *text, char *words, size_t size)
{
    struct frame_range range = { .count = 5 };
    int pipes[2];
    int before = dup(STDERR_FILENO);

    assert_true(before >= 0);
    assert_int_equal(pipe(pipes), 0);
    assert_true(dup2(pipes[1], STDERR_FILENO) >= 0);
    const enum status status = frame_range_parse(&range, text);
    assert_true(dup2(before, STDERR_FILENO) >= 0);
    close(before);
    close(pipes[1]);
    const ssize_t count = read(pipes[0], words, size - 1);
    close(pipes[0]);
    words[count > 0 ? count : 0] = '\0';
    if (status != STATUS_OK) {
        assert_null(range.frames);
        assert_int_equal(range.count, 0);
    }
    return status;
}

/* One line, that holds the text and these words. */
static void check_refused(const char *text, const char *first, const char *second)
{
    char words[512];
    static const char begin[] = "firn: --frames: expected ";
    char end[128];

    assert_int_equal(parse_aloud(text, words, sizeof(words)), STATUS_USAGE);
    snprintf(end, sizeof(end), ", got '%s'\n", text);
    if (strncmp(words, begin, strlen(begin)) != 0 || !strstr(words, end) || !strstr(words, first) ||
        !strstr(words, second) || strchr(words, '\n') != words + strlen(words) - 1)
        fail_msg("\"%s\" is refused with: %s", text, words);
}

static void test_wrong_form(void **state)
{
    static const char *const texts[] = {
        "",     "-",    "--1",  "a",      "1-",   "1--",  "-1-",    "1-2-3", "1,",   ",1",
        "1,,2", "1 ",   " 1",   "1 -2",   "1, 2", "1..5", "1.5",    "+1",    "1-+5", "1x2",
        "1-5x", "1-5y", "1-5X", "1-5x2x", "1e3",  "0x10", "1-5x2-", "1;2",   "#",    "1-5,x2",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        check_refused(texts[i], "A-BxN", "commas");
}

/* All parts, one after another, are the list. */
static void test_chunks(void **state)
{
    static const uint32_t counts[] = { 1, 2, 3, 7, 10, 1000000 };
    (void)state;
    for (size_t c = 0; c < sizeof(counts) / sizeof(counts[0]); c++) {
        int32_t next = 1;
        uint32_t least = UINT32_MAX, most = 0;
        const uint32_t step = counts[c] > 10 ? 99999 : 1; /* of many only some, which have 0 or 1 */
        for (uint32_t k = 1; k <= counts[c]; k += step) {
            struct frame_range range;
            assert_int_equal(frame_range_parse(&range, "1-7"), STATUS_OK);
            frame_range_chunk(&range, k, counts[c]);
            least = range.count < least ? range.count : least;
            most = range.count > most ? range.count : most;
            for (uint32_t i = 0; i < range.count && step == 1; i++)
                assert_int_equal(range.frames[i], next++);
            frame_range_finish(&range);
        }
        assert_true(most - least <= 1);
        assert_true(step > 1 || next == 8);
    }
}

static void test_out_of_range(void **state)
{
    static const char *const texts[] = {
        "10000000",
        "-10000000",
        "1-10000000",
        "1--10000000",
        "4294967297",
        "99999999999999999999999",
        "1,2,18446744073709551616",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        check_refused(texts[i], "-9999999", " 9999999");
}

static void test_wrong_step(void **state)
{
    static const char *const texts[] = {
        "1-5x0", "1-5x-1", "5-1x-1", "1-5x10000000", "1-5x4294967297", "1-5x00",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        check_refused(texts[i], "step", " 1 to 9999999");
}

static void test_too_many(void **state)
{
    static const char *const texts[] = {
        "1-100001", "0--100000", "-9999999-9999999", "1-60000,60001-100001", "1-100000,0",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        check_refused(texts[i], "100000", "frames");
}

static void test_colon(void **state)
{
    static const char *const texts[] = { "1:5", "1-10:2", ":", "1,2:3", "1-9999999:2" };
    (void)state;
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        check_refused(texts[i], "A-BxN", "no ':'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single_frames),
        cmocka_unit_test(test_ranges),
        cmocka_unit_test(test_steps),
        cmocka_unit_test(test_lists),
        cmocka_unit_test(test_again_is_dropped),
        cmocka_unit_test(test_many),
        cmocka_unit_test(test_wrong_form),
        cmocka_unit_test(test_chunks),
        cmocka_unit_test(test_out_of_range),
        cmocka_unit_test(test_wrong_step),
        cmocka_unit_test(test_too_many),
        cmocka_unit_test(test_colon),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
