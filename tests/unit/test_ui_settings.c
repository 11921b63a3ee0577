/* Every row gets a widget that can show it. */
#include <string.h>
#include "src/view/panels/ui_settings.h"
#include "tests/support/assertions.h"

static enum ui_widget widget_of(const char *name)
{
    const struct setting *row = settings_find(name);
    assert_non_null(row);
    return ui_settings_widget(row);
}

static void test_widgets(void **state)
{
    (void)state;
    assert_int_equal(widget_of("cracks.debug"), UI_CHECKBOX);
    assert_int_equal(widget_of("cracks.clip"), UI_LIST);
    assert_int_equal(widget_of("cracks.count"), UI_SLIDER);
    assert_int_equal(widget_of("bubbles.count"), UI_LOGARITHMIC);
    assert_int_equal(widget_of("cracks.seed"), UI_NUMBER);
    assert_int_equal(widget_of("object.triangles"), UI_NUMBER);
    assert_int_equal(widget_of("cracks.shininess"), UI_LOGARITHMIC);
    assert_int_equal(widget_of("light.distance"), UI_LOGARITHMIC);
    assert_int_equal(widget_of("sky.sun_azimuth"), UI_SLIDER);
    assert_int_equal(widget_of("refract.ior"), UI_SLIDER);
}

/* Units become part of printf formats; sliders need two ends. */
static void test_rows_fit(void **state)
{
    (void)state;
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        assert_true(!row->unit || (!strchr(row->unit, '%') && strlen(row->unit) < 40));
        if (row->type == SETTING_FLOAT)
            assert_true(row->min < row->max);
    }
}

static void test_search(void **state)
{
    (void)state;
    const struct setting *row = settings_find("cracks.count");
    assert_true(ui_settings_match(row, ""));
    assert_true(ui_settings_match(row, "cracks.count"));
    assert_true(ui_settings_match(row, "  COUNT  crack "));
    assert_true(ui_settings_match(row, "inside number")); /* group and help */
    assert_false(ui_settings_match(row, "cracks bubbles"));
    assert_true(ui_settings_contain(&row->name, 1, "COUNT cr", true));
    assert_true(ui_settings_contain(&row->name, 1, "ount", false));
    assert_false(ui_settings_contain(&row->name, 1, "ount", true));
}

/* Returns true if a setting has an effect in a scene at these settings. */
static bool has_effect(const char *name, const struct settings *settings, const struct scene *scene)
{
    return !ui_setting_no_effect(settings_find(name), settings, scene);
}

static void test_effects(void **state)
{
    (void)state;
    struct settings settings = settings_default();
    struct scene scene = { .background.kind = SCENE_SKY };
    assert_true(has_effect("sky.strength", &settings, &scene));
    assert_false(has_effect("env.sun", &settings, &scene));
    assert_false(has_effect("water.height", &settings, &scene));
    scene.background.kind = SCENE_ENVIRONMENT;
    scene.has_pool = true;
    assert_false(has_effect("sky.strength", &settings, &scene));
    assert_true(has_effect("env.sun", &settings, &scene));
    assert_false(has_effect("env.sun_azimuth", &settings, &scene));
    assert_true(has_effect("water.height", &settings, &scene));
    assert_true(has_effect("cracks.size", &settings, &scene));
    settings_set_value(&settings, settings_find("cracks.count"), 0);
    assert_false(has_effect("cracks.size", &settings, &scene));
    assert_true(has_effect("cracks.count", &settings, &scene));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_effects),
        cmocka_unit_test(test_widgets),
        cmocka_unit_test(test_rows_fit),
        cmocka_unit_test(test_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
