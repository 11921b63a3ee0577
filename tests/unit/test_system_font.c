/* test_system_font.c: which font of the system panels are written in. */
#include <stdlib.h>
#include <unistd.h>
#include "src/view/panels/system_font.h"
#include "tests/support/assertions.h"

/* No system has to have fonts; what is found can be read. */
static void what_is_found_is_a_file(void **state)
{
    (void)state;
    struct system_font font;
    if (system_font_find(&font, "sans"))
        assert_int_equal(access(font.path, R_OK), 0);
    else
        assert_string_equal(font.path, "");
#ifdef FONT_CONFIG
    static const char empty[] = "<?xml version=\"1.0\"?>\n<fontconfig></fontconfig>\n";
    char path[] = "/tmp/test_font.XXXXXX";
    const int file = mkstemp(path);
    assert_int_equal(write(file, empty, sizeof(empty) - 1), sizeof(empty) - 1);
    assert_int_equal(close(file), 0);
    assert_int_equal(setenv("FONTCONFIG_FILE", path, 1), 0);
    assert_false(system_font_find(&font, "sans"));
    assert_string_equal(font.path, "");
    assert_int_equal(unlink(path), 0);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_found_is_a_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
