/* test_settings.c: order of the setting groups, and access to values by name. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "src/render/frame/output_layers.h"
#include "src/settings/quality.h"
#include "src/settings/settings.h"
#include "tests/support/assertions.h"

typedef void row_fn(const struct setting_group *group, const struct setting *row);

static void for_each_row(row_fn *check)
{
    const struct setting *row = settings_next(NULL);
    for (size_t g = 0; setting_groups[g]; g++) {
        for (size_t r = 0; r < setting_groups[g]->row_count; r++, row = settings_next(row)) {
            assert_ptr_equal(row, &setting_groups[g]->rows[r]);
            check(setting_groups[g], row);
        }
    }
    assert_null(row);
}

/* The first row of a type, from any group. */
static const struct setting *row_of(enum setting_type type)
{
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        if (row->type == type)
            return row;
    }
    fail_msg("no row of type %d", (int)type);
    return NULL;
}

/* ---- the tables ---- */

static void check_words(const struct setting_group *group, const struct setting *row)
{
    size_t prefix = strlen(group->name);
    assert_true(strlen(row->name) < 64); /* what settings_assign() takes */
    assert_memory_equal(row->name, group->name, prefix);
    assert_int_equal(row->name[prefix], '.');
    assert_true(row->name[prefix + 1] != '\0');
    assert_null(strpbrk(row->name, "= \n"));
    const char *help = row->help ? row->help : "";
    assert_true(strlen(help) > 3 && help[strlen(help) - 1] != '.');
    assert_true(row->label && strlen(row->label) > 3);
    assert_true(!row->renamed_from || !settings_find(row->renamed_from));
    assert_null(strchr(help, '\n'));
    assert_ptr_equal(settings_find(row->name), row); /* so there is no other of that name */
}

static void check_range(const struct setting_group *group, const struct setting *row)
{
    assert_true(row->min < row->max);
    const bool is_auto = setting_is_auto(row, row->initial);
    assert_true(!is_auto || row->initial == setting_auto(row));
    assert_true(!row->has_auto || setting_is_auto(row, setting_auto(row)));
    assert_true(!row->has_auto || row->type == SETTING_FLOAT || row->type == SETTING_COUNT);
    assert_true((row->min <= row->initial || is_auto) && row->initial <= row->max);
    assert_int_equal(row->offset % 4, 0);
    assert_true(row->offset + 4 <= group->params_size);
    for (size_t r = 0; r < group->row_count; r++)
        assert_true(&group->rows[r] == row || group->rows[r].offset != row->offset);
    if (row->type == SETTING_FLOAT) {
        assert_true(row->max <= (double)FLT_MAX && row->min >= -(double)FLT_MAX);
        return;
    }
    assert_true(row->min >= 0.0 && row->max <= (double)UINT32_MAX);
    assert_true(floor(row->initial) >= row->initial);
    if (row->type == SETTING_SWITCH)
        assert_true(row->min <= 0.0 && row->max >= 1.0 && row->max <= 1.0);
    if (row->type == SETTING_CHOICE) {
        size_t count = 0;
        while (row->choices[count])
            count++;
        assert_true(row->min <= 0.0);
        assert_int_equal(row->max, count - 1);
    }
}

static void test_every_row(void **state)
{
    (void)state;
    for_each_row(check_words);
    for_each_row(check_range);
}

static void test_groups(void **state)
{
    (void)state;
    const struct settings settings = settings_default();
    for (size_t g = 0; setting_groups[g]; g++) {
        assert_int_equal(setting_groups[g]->index, g);
        assert_int_equal((uintptr_t)settings_of(&settings, setting_groups[g]) % 16, 0);
    }
    for (const struct technique *const *t = techniques; *t; t++)
        assert_true(!(*t)->settings || setting_groups[(*t)->settings->index] == (*t)->settings);
}

/* What can be switched off is off where the first of its settings is 0. */
static void test_techniques_are_switched_off(void **state)
{
    (void)state;
    uint32_t count = 0;
    for (const struct technique *const *t = techniques; *t; t++) {
        struct settings settings = settings_default();
        if (!(*t)->is_on)
            continue;
        techniques_switch_off(&settings, *t);
        assert_false((*t)->is_on(&settings));
        count++;
    }
    assert_true(count > 0);
}

/* ---- values ---- */

static void check_default(const struct setting_group *group, const struct setting *row)
{
    const struct settings settings = settings_default();
    const unsigned char *params = settings_of(&settings, group);
    CHECK_NEAR(settings_get(&settings, row), row->initial, 1e-6 * fabs(row->initial));
    float number;
    uint32_t count;
    memcpy(&number, params + row->offset, 4);
    memcpy(&count, params + row->offset, 4);
    double field = row->type == SETTING_FLOAT ? (double)number : count;
    assert_true(field == settings_get(&settings, row));
}

static void test_defaults(void **state)
{
    (void)state;
    for_each_row(check_default);
}

static void print(const struct settings *settings, const struct setting *row, char *text,
                  size_t size)
{
    FILE *file = fmemopen(text, size, "w");
    assert_non_null(file);
    settings_print(settings, row, file);
    assert_int_equal(fclose(file), 0);
    assert_true(strlen(text) > 0 && strlen(text) < size - 1);
}

/* What is printed sets the same value again, to the last bit. */
static void check_round_trip(const struct setting *row, double value)
{
    char text[32], assignment[128];
    struct settings before = settings_default();
    struct settings after = settings_default();
    settings_set_value(&before, row, value);
    print(&before, row, text, sizeof(text));
    settings_set_value(&after, row, value > row->min ? row->min : row->max);
    snprintf(assignment, sizeof(assignment), "%s=%s", row->name, text);
    assert_int_equal(settings_assign(&after, assignment, SETTING_USER, NULL), STATUS_OK);
    assert_true(settings_equal(&before, &after)); /* and no other value has changed */
}

static void check_round_trips(const struct setting_group *group, const struct setting *row)
{
    (void)group;
    check_round_trip(row, row->initial);
    check_round_trip(row, row->min);
    check_round_trip(row, row->max);
    for (int i = 1; i < 20; i++) {
        double value = row->min + (row->max - row->min) * (i / 20.0);
        check_round_trip(row, row->type == SETTING_FLOAT ? value : floor(value));
    }
    if (row->type != SETTING_FLOAT)
        return;
    float third = (float)(row->min + (row->max - row->min) / 3.0);
    check_round_trip(row, (double)third);
    check_round_trip(row, (double)nextafterf(third, FLT_MAX));
    check_round_trip(row, (double)nextafterf((float)row->min, FLT_MAX));
}

static void test_round_trips(void **state)
{
    (void)state;
    for_each_row(check_round_trips);
}

static void check_printed(const char *name, const char *value)
{
    char assignment[64], text[32];
    struct settings settings = settings_default();
    snprintf(assignment, sizeof(assignment), "%s=%s", name, value);
    assert_int_equal(settings_assign(&settings, assignment, SETTING_USER, NULL), STATUS_OK);
    print(&settings, settings_find(name), text, sizeof(text));
    assert_string_equal(text, value);
}

static void test_prints_as_people_write(void **state)
{
    (void)state;
    check_printed("refract_paper.back_weight", "0.33");
    check_printed("refract_paper.back_weight", "0.1");
    check_printed("refract.ior", "1.3091");
    check_printed("tonemap.exposure", "-2.5");
    check_printed("tonemap.exposure", "0");
    check_printed("sky.sun_azimuth", "-360");
    check_printed("object.triangles", "123456");
    check_printed("env_cube.dynamic", "off");
    check_printed("tonemap.curve", "clip");
}

/* ---- what is said about mistakes ---- */

/* Sets with stderr caught in `said`; returns the status. */
static enum status set(struct settings *settings, const char *assignment, char *said, size_t size)
{
    FILE *file = tmpfile();
    assert_non_null(file);
    fflush(stderr);
    int kept = dup(STDERR_FILENO);
    assert_true(kept >= 0 && dup2(fileno(file), STDERR_FILENO) >= 0);
    enum status status = settings_assign(settings, assignment, SETTING_USER, NULL);
    fflush(stderr);
    assert_true(dup2(kept, STDERR_FILENO) >= 0);
    close(kept);
    rewind(file);
    said[fread(said, 1, size - 1, file)] = '\0';
    fclose(file);
    return status;
}

/* Refused, in one line that has these words (NULL: any), and nothing has changed. */
static void check_refused(const char *assignment, const char *words)
{
    char said[4096];
    struct settings settings = settings_default();
    const struct settings before = settings;
    assert_int_equal(set(&settings, assignment, said, sizeof(said)), STATUS_USAGE);
    assert_memory_equal(&settings, &before, sizeof(before));
    if (!strstr(said, words))
        print_error("--set %s: \"%s\" lacks \"%s\"\n", assignment, said, words);
    assert_non_null(strstr(said, words));
    assert_int_equal(strcspn(said, "\n"), strlen(said) - 1);
}

static void test_unknown_names(void **state)
{
    (void)state;
    check_refused("refract.iro=1.5", "did you mean 'refract.ior'?");
    check_refused("refact_paper.back_weight=0.5", "did you mean 'refract_paper.back_weight'?");
    check_refused("sky.sun_elevatoin=10", "did you mean 'sky.sun_elevation'?");
    check_refused(" refract.ior=1.5", "did you mean 'refract.ior'?");
    check_refused("refract.ior =1.5", "did you mean 'refract.ior'?");
    check_refused("cracks.number=3", "'cracks.number': did you mean 'cracks.");
    check_refused("REFRACT.IOR=1.5", "unknown setting 'REFRACT.IOR' (firn list settings)");
    check_refused("nosuch=1", "unknown setting 'nosuch' (firn list settings)");
    check_refused("ab=1", "unknown setting 'ab' (firn list settings)");
    check_refused("", "expected NAME=VALUE, got");
    check_refused("refract.ior", "expected NAME=VALUE, got");
    check_refused("=1.5", "expected NAME=VALUE, got");
}

/* Names as long as the longest that is looked up, and much longer. */
/* Each former name sets its setting, with one note that names both. */
static void check_former_name(const struct setting_group *group, const struct setting *row)
{
    char assignment[128], said[4096];
    struct settings settings = settings_default();
    (void)group;
    if (!row->renamed_from)
        return;
    const char *value = row->type == SETTING_CHOICE   ? row->choices[(size_t)row->max]
                        : row->type == SETTING_SWITCH ? "on"
                                                      : "1";
    snprintf(assignment, sizeof(assignment), "%s=%s", row->renamed_from, value);
    assert_int_equal(set(&settings, assignment, said, sizeof(said)), STATUS_OK);
    assert_non_null(strstr(said, row->renamed_from));
    assert_non_null(strstr(said, row->name));
    assert_int_equal(strcspn(said, "\n"), strlen(said) - 1);
    CHECK_NEAR(settings_get(&settings, row), row->type == SETTING_CHOICE ? row->max : 1.0, 0);
}

static void test_former_names(void **state)
{
    (void)state;
    for_each_row(check_former_name);
}

static void test_long_names(void **state)
{
    (void)state;
    static const size_t lengths[] = { 62, 63, 64, 65, 127, 128, 3000 };
    char assignment[4096];
    for (size_t i = 0; i < sizeof(lengths) / sizeof(lengths[0]); i++) {
        memset(assignment, 'x', lengths[i]);
        memcpy(assignment, "refract.ior", 11);
        memcpy(&assignment[lengths[i]], "=1.5", sizeof("=1.5"));
        check_refused(assignment, "unknown setting");
    }
    /* as a value */
    memset(assignment, '1', sizeof(assignment));
    assignment[sizeof(assignment) - 1] = '\0';
    memcpy(assignment, "refract.ior=", 12);
    check_refused(assignment, "refract.ior");
}

static void test_values_that_are_none(void **state)
{
    (void)state;
    static const char *const numbers[] = {
        "",    " ",    " 1.5",    "1.5 ", "1.5x",     "1,5",      "nan",
        "NAN", "-nan", "inf",     "-inf", "infinity", "1e999",    "-1e999",
        "on",  "--1",  "1.5=1.5", "ior",  "0.999999", "4.000001", "-1.5",
    };
    static const char *const counts[] = { "", "1.5", "-1", "1e99", "many", "4294967296" };
    static const char *const words[] = { "", "1", "0", "ON", "on ", "yes", "neutral ", "2" };
    char assignment[128];
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
        snprintf(assignment, sizeof(assignment), "refract.ior=%s", numbers[i]);
        check_refused(assignment, "expected a number from 1 to 4, got '");
    }
    for (size_t i = 0; i < sizeof(counts) / sizeof(counts[0]); i++) {
        snprintf(assignment, sizeof(assignment), "%s=%s", row_of(SETTING_COUNT)->name, counts[i]);
        check_refused(assignment, "a whole number from 0 to");
    }
    for (size_t i = 0; i < sizeof(words) / sizeof(words[0]); i++) {
        snprintf(assignment, sizeof(assignment), "%s=%s", row_of(SETTING_SWITCH)->name, words[i]);
        check_refused(assignment, "expected on or off, got '");
        snprintf(assignment, sizeof(assignment), "tonemap.curve=%s", words[i]);
        check_refused(assignment, "expected one of neutral, clip, agx, aces, hable, got '");
    }
}

/* Numbers are those of C: with exponent, sign, or in hexadecimal. */
static void test_unusual_numbers(void **state)
{
    (void)state;

    static const struct {
        const char *assignment;
        const char *name;
        double value;
    } cases[] = {
        { "object.triangles=1e3", "object.triangles", 1000.0 },
        { "object.triangles=0x10", "object.triangles", 16.0 },
        { "object.triangles=-0", "object.triangles", 0.0 },
        { "object.triangles=20.0", "object.triangles", 20.0 },
        { "refract.ior=+2", "refract.ior", 2.0 },
        { "refract.ior=0x1.8p0", "refract.ior", 1.5 },
        { "refract.ior=15e-1", "refract.ior", 1.5 },
        { "refract.ior=1", "refract.ior", 1.0 },
        { "refract.ior=4", "refract.ior", 4.0 },
        { "refract_paper.back_weight=1e-999", "refract_paper.back_weight", 0.0 },
        { "refract_paper.back_weight=.5", "refract_paper.back_weight", 0.5 },
        { "tonemap.exposure=-16", "tonemap.exposure", -16.0 },
    };

    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct settings settings = settings_default();
        assert_int_equal(settings_assign(&settings, cases[i].assignment, SETTING_USER, NULL),
                         STATUS_OK);
        double value = settings_get(&settings, settings_find(cases[i].name));
        CHECK_NEAR(value, cases[i].value, 0.0);
    }
}

/* A later value of a setting counts; the same text twice is the same. */
static void test_setting_again(void **state)
{
    (void)state;
    struct settings settings = settings_default();
    const struct setting *row = settings_find("refract.ior");
    assert_int_equal(settings_assign(&settings, "refract.ior=1.5", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&settings, "tonemap.exposure=1", SETTING_USER, NULL),
                     STATUS_OK);
    assert_int_equal(settings_assign(&settings, "refract.ior=2", SETTING_USER, NULL), STATUS_OK);
    CHECK_NEAR(settings_get(&settings, row), 2.0, 0.0);
    CHECK_NEAR(settings_get(&settings, settings_find("tonemap.exposure")), 1.0, 0.0);
    assert_null(settings_find("refract.io"));
    assert_null(settings_find(""));
}

/* A value never replaces one of a stronger source, whatever the order in which they come. */
static void test_precedence(void **state)
{
    static const enum setting_source sources[] = { SETTING_USER, SETTING_PRESET, SETTING_QUALITY,
                                                   SETTING_SCENE, SETTING_DEFAULT };
    const struct setting *row = settings_find("refract.ior");
    (void)state;
    for (size_t strongest = 0; strongest < 5; strongest++) {
        struct settings up = settings_default(), down = up;
        for (size_t i = strongest; i < 5; i++) {
            const size_t from_weakest = 4 + strongest - i;
            settings_put(&down, row, 1.0 + 0.1 * (double)i, sources[i]);
            settings_put(&up, row, 1.0 + 0.1 * (double)from_weakest, sources[from_weakest]);
        }
        CHECK_NEAR(settings_get(&down, row), 1.0 + 0.1 * (double)strongest, 1e-6);
        CHECK_NEAR(settings_get(&up, row), 1.0 + 0.1 * (double)strongest, 1e-6);
        assert_int_equal(settings_source(&down, row), sources[strongest]);
        assert_true(settings_equal(&up, &down));
    }
}

static void test_levels_of_quality(void **state)
{
    (void)state;
    for (uint32_t level = 0; level < QUALITY_COUNT; level++) {
        struct settings settings = settings_default();
        assert_int_equal(settings_assign(&settings, "refract.ior=1.5", SETTING_USER, NULL),
                         STATUS_OK);
        quality_apply(&settings, level, SETTING_QUALITY);
        assert_int_equal(quality_find(&settings), level);
        assert_int_equal(settings_assign(&settings, "trace.min_branch=0.123", SETTING_USER, NULL),
                         STATUS_OK);
        assert_int_equal(quality_find(&settings), QUALITY_COUNT);
    }
    const struct settings defaults = settings_default();
    assert_string_equal(qualities[quality_find(&defaults)].name, "normal");
    /* A level states only values that differ from the default. */
    for (const struct quality_row *row = quality_rows; row->setting; row++) {
        for (uint32_t i = 0; i < QUALITY_COUNT; i++) {
            const double more = quality_value(row, i) - quality_value(row, 1);
            assert_true(!row->values[i] || fabs(more) > 0);
        }
    }
}

static void test_values_of_levels(void **state)
{
    (void)state;

    static const struct {
        uint32_t level;
        const char *assignment;
    } rows[] = { { 0, "env_cube.size=256" },   { 0, "trace.min_branch=0.1" },
                 { 2, "refract.steps=12" },    { 2, "trace.footprint=on" },
                 { 2, "ground.light=traced" }, { 2, "tonemap.resolve=filtered" } };

    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct settings settings = settings_default();
        quality_apply(&settings, rows[i].level, SETTING_QUALITY);
        const struct settings found = settings;
        assert_int_equal(settings_assign(&settings, rows[i].assignment, SETTING_QUALITY, NULL),
                         STATUS_OK);
        assert_true(settings_equal(&settings, &found));
    }
    assert_int_equal(qualities[2].samples, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_precedence),
        cmocka_unit_test(test_every_row),
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_techniques_are_switched_off),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_round_trips),
        cmocka_unit_test(test_prints_as_people_write),
        cmocka_unit_test(test_unknown_names),
        cmocka_unit_test(test_former_names),
        cmocka_unit_test(test_long_names),
        cmocka_unit_test(test_values_that_are_none),
        cmocka_unit_test(test_unusual_numbers),
        cmocka_unit_test(test_setting_again),
        cmocka_unit_test(test_levels_of_quality),
        cmocka_unit_test(test_values_of_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
