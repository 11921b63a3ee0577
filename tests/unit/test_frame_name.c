/* test_frame_name.c: frame-number fields in file names. */
#include <stdlib.h>
#include "src/app/frame_name.h"
#include "tests/support/assertions.h"

static void check_name(const char *path, int32_t frame, const char *expected)
{
    struct frame_name name;
    assert_int_equal(frame_name_parse(&name, path), STATUS_OK);
    char *made = frame_name_make(&name, frame);
    assert_non_null(made);
    assert_string_equal(made, expected);
    free(made);
}

static void test_hashes(void **state)
{
    (void)state;
    check_name("a.####.exr", 12, "a.0012.exr");
    check_name("a.####.exr", 0, "a.0000.exr");
    check_name("a.####.exr", 12345, "a.12345.exr");
    check_name("a.####.exr", -12, "a.-0012.exr");
    check_name("a.####.exr", -9999999, "a.-9999999.exr");
    check_name("#.png", 7, "7.png");
    check_name("#.png", -7, "-7.png");
    check_name("a b ##", 7, "a b 07");
    check_name("################################", 1, "00000000000000000000000000000001");
}

static void test_printf(void **state)
{
    (void)state;
    check_name("a.%04d.exr", 12, "a.0012.exr");
    check_name("a.%04d.exr", 12345, "a.12345.exr");
    check_name("a.%04d.exr", -12, "a.-012.exr");
    check_name("%d.png", 7, "7.png");
    check_name("%d.png", -7, "-7.png");
    check_name("%01d.png", 7, "7.png");
    check_name("x%010dy", 7, "x0000000007y");
}

static void test_no_field(void **state)
{
    struct frame_name name;
    (void)state;
    assert_int_equal(frame_name_parse(&name, "a.exr"), STATUS_OK);
    assert_int_equal(name.length, 0);
    check_name("a.exr", 12, "a.exr");
    check_name("", 12, "");
    check_name("-", 12, "-");
}

/* Folders are taken as they are. */
static void test_folders(void **state)
{
    (void)state;
    check_name("/50% ##/%s/a.##.exr", 3, "/50% ##/%s/a.03.exr");
    check_name("##/a.exr", 3, "##/a.exr");
    check_name("./##", 3, "./03");
}

static void test_refused(void **state)
{
    static const char *const paths[] = {
        "a%",
        "a%%.exr",
        "a%s.exr",
        "a%4d.exr",
        "a%-4d.exr",
        "a%+d.exr",
        "a%i.exr",
        "a%ld.exr",
        "a%0d.exr",
        "a%00d.exr",
        "a%04.exr",
        "a%04x.exr",
        "a%033d.exr",
        "a%099999999999d.exr",
        "a%n%04d.exr",
        "a%04d%n.exr",
        "a%1$d.exr",
        "a%*d.exr",
        "##.##.exr",
        "#a#",
        "##%d",
        "%d##",
        "%04d%04d",
        "a%#.exr",
        "#################################",
    };
    struct frame_name name;
    (void)state;
    for (size_t i = 0; i < sizeof(paths) / sizeof(paths[0]); i++) {
        if (frame_name_parse(&name, paths[i]) != STATUS_USAGE)
            fail_msg("%s is not refused", paths[i]);
    }
}

static void test_is_pattern(void **state)
{
    (void)state;
    assert_true(frame_name_is_pattern("a.##.exr"));
    assert_true(frame_name_is_pattern("b/a.####.exr"));
    assert_true(frame_name_is_pattern("a%04d"));
    assert_true(frame_name_is_pattern("5% %d"));
    assert_false(frame_name_is_pattern("a.exr"));
    assert_false(frame_name_is_pattern("take#a #b.exr"));
    assert_false(frame_name_is_pattern("50%.png"));
    assert_false(frame_name_is_pattern("##/%d/a.png"));
    assert_false(frame_name_is_pattern("%4d.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hashes),   cmocka_unit_test(test_printf),
        cmocka_unit_test(test_no_field), cmocka_unit_test(test_folders),
        cmocka_unit_test(test_refused),  cmocka_unit_test(test_is_pattern),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
