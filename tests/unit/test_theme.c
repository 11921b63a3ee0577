/* test_theme.c: what is written can be read. */
#include <math.h>
#include "src/app/app.h"
#include "src/view/panels/theme.h"
#include "tests/support/assertions.h"

static double linear(uint32_t channel)
{
    const double c = (double)channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double luminance(uint32_t color)
{
    return 0.2126 * linear(color >> 16 & 255) + 0.7152 * linear(color >> 8 & 255) +
           0.0722 * linear(color & 255);
}

/* As WCAG defines it, 1 to 21. */
static double contrast(uint32_t a, uint32_t b)
{
    const double x = luminance(a);
    const double y = luminance(b);
    return (fmax(x, y) + 0.05) / (fmin(x, y) + 0.05);
}

static void contrast_is_that_of_wcag(void **state)
{
    (void)state;
    CHECK_NEAR(contrast(0x000000, 0xffffff), 21, 1e-9);
    CHECK_NEAR(contrast(0x777777, 0xffffff), 4.48, 0.01);
    CHECK_NEAR(contrast(0x123456, 0x123456), 1, 1e-9);
}

static void text_and_marks_stand_out(void **state)
{
    (void)state;
    const struct theme *t;
    for (uint32_t i = 0; (t = theme_at(i)); i++) {
        const uint32_t surfaces[] = { t->panel, t->raised, t->hover, t->pressed };
        const uint32_t words[] = { t->dim, t->accent, t->changed, t->error };
        for (size_t s = 0; s < 4; s++)
            assert_true(contrast(t->text, surfaces[s]) >= 4.5);
        for (size_t w = 0; w < 4; w++) {
            assert_true(contrast(words[w], t->panel) >= 4.5);
            assert_true(contrast(words[w], t->raised) >= 4.5);
        }
        assert_true(contrast(t->accent, t->hover) >= 3);
        assert_true(contrast(t->border, t->panel) >= 3);
        assert_true(contrast(t->border, t->raised) >= 3);
    }
}

static void options_name_each(void **state)
{
    (void)state;
    uint32_t i = 0;
    for (; app_themes[i]; i++)
        assert_string_equal(theme_at(i)->name, app_themes[i]);
    assert_null(theme_at(i));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contrast_is_that_of_wcag),
        cmocka_unit_test(text_and_marks_stand_out),
        cmocka_unit_test(options_name_each),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
