/* What a person typed is found, and what is nearest comes first. */
#include "src/view/panels/ui_fuzzy_match.h"
#include "tests/support/assertions.h"

static void test_distances(void **state)
{
    static const struct {
        const char *words, *text;
        uint32_t distance, misspelt;
    } rows[] = {
        { "", "save the picture", 0, 0 },
        { "SAVE", "save the picture", 0, 0 },
        { "pict", "save the picture", 1, 1 },
        { "picture save", "save the picture", 1, 1 },
        { "ave", "save the picture", 2, 2 },
        { "tonemap.exp", "tonemap.exposure", 0, 0 },
        { "crk", "cracks.count", 3 + 2, 3 + 2 },
        { "crk cnt", "cracks.count", 3 + 2 + 3 + 2, 3 + 2 + 3 + 2 },
        { "expsure", "tonemap.exposure", 3 + 1, 3 + 1 },
        { "expousre", "tonemap.exposure", UI_FUZZY_MATCH_NONE, 3 + 8 + 1 },
        { "bubblas", "bubbles.count", UI_FUZZY_MATCH_NONE, 3 + 8 + 1 },
        { "xposure", "tonemap.exposure", 2, 2 },
        { "racks", "tracks", 2, 2 },
        { "crazks", "cracks.count", UI_FUZZY_MATCH_NONE, 3 + 8 + 1 },
        { "ae", "save the picture", UI_FUZZY_MATCH_NONE, UI_FUZZY_MATCH_NONE }, /* too short */
        { "stre", "save the picture", UI_FUZZY_MATCH_NONE,
          UI_FUZZY_MATCH_NONE }, /* too far apart */
        { "avpict", "save the picture", UI_FUZZY_MATCH_NONE,
          UI_FUZZY_MATCH_NONE }, /* within a word */
        { "save pool", "save the picture", UI_FUZZY_MATCH_NONE, UI_FUZZY_MATCH_NONE },
    };

    (void)state;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        print_message("%s\n", rows[i].words);
        assert_int_equal(ui_fuzzy_match_distance(rows[i].words, rows[i].text, false),
                         rows[i].distance);
        assert_int_equal(ui_fuzzy_match_distance(rows[i].words, rows[i].text, true),
                         rows[i].misspelt);
    }
}

static void test_texts(void **state)
{
    static const char *const texts[] = { "cracks.count", "number of planes" };
    (void)state;
    assert_true(ui_fuzzy_match_contains("planes CRACKS", texts, 2));
    assert_true(ui_fuzzy_match_contains("", texts, 2));
    assert_false(ui_fuzzy_match_contains("cracks air", texts, 2));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distances),
        cmocka_unit_test(test_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
