/* test_materials.c: the table of material presets, the parser of their names, and the recognition
 * of thin walls. */
#include <cglm/struct.h>
#include <string.h>
#include "src/setup/setup_material.h"
#include "src/tech/refract/absorption.h"
#include "src/tech/refract/refract.h"
#include "tests/support/assertions.h"

static void test_every_preset_is_complete(void **state)
{
    uint32_t count = 0;
    enum material_kind kind = 0;
    (void)state;
    for (const struct material_preset *m = material_presets; m->name; m++, count++) {
        assert_true(m->help && m->help[0] && m->source && m->source[0]);
        assert_true(m->ior >= 1.0f && m->ior <= 3.0f);
        assert_true(!(m->abbe > 0.0f) || (m->abbe >= 12.0f && m->abbe <= 100.0f));
        assert_true(glms_vec3_min(m->absorption) >= 0.0f && glms_vec3_max(m->absorption) < 1e3f);
        assert_int_equal(m->optical_depth > 0.0f, m->inclusions >= MATERIAL_WHITE_CORE);
        assert_true(m->kind >= kind && m->kind < MATERIAL_KIND_COUNT);
        assert_null(strpbrk(m->name, ":=, "));
        for (const struct material_preset *other = material_presets; other != m; other++)
            assert_string_not_equal(other->name, m->name);
        kind = m->kind;
    }
    assert_true(count >= 36);
}

static bool parse(struct material_choice *choice, const char *name)
{
    return material_choice_parse(choice, name, strlen(name));
}

static void test_names_and_finishes(void **state)
{
    struct material_choice choice;
    (void)state;
    assert_true(parse(&choice, "glass") && !choice.finish);
    assert_true(material_choice_parse(&choice, "bk7:rough,ior=2", 9));
    assert_string_equal(choice.preset->name, "bk7");
    CHECK_NEAR(material_of_choice(&choice).roughness, 0.2f, 1e-6);
    assert_true(parse(&choice, "glass:frosted"));
    CHECK_NEAR(material_of_choice(&choice).roughness, 0.5f, 1e-6);
    assert_false(parse(&choice, "glass:"));
    assert_false(parse(&choice, "glass:frost"));
    assert_string_equal(choice.preset->name, "glass"); /* for the message */
    assert_false(parse(&choice, "glas:frosted"));
    assert_null(choice.preset);
}

static void test_absorption_is_that_of_the_table(void **state)
{
    struct material_choice choice;
    (void)state;
    assert_true(parse(&choice, "red-wine"));
    const struct material material = material_of_choice(&choice);
    for (int k = 0; k < 3; k++)
        CHECK_NEAR(material_absorption(&material).raw[k], choice.preset->absorption.raw[k], 0.01);
    CHECK_NEAR(material_preset_color(choice.preset).x, 0.3135f, 1e-3);
}

static void test_settings_of_each_preset_find_it(void **state)
{
    (void)state;
    for (const struct material_preset *m = material_presets; m->name; m++) {
        struct settings settings = settings_default();
        const struct material_choice choice = { m, &material_finishes[0] };
        setup_set_material(&settings, &choice, 0.014f);
        const struct material_preset *found = setup_find_material(&settings, 0.014f);
        const bool is_plastic = !strcmp(m->name, "plastic"); /* has the index of glass */
        assert_string_equal(found ? found->name : "", is_plastic ? "glass" : m->name);
    }
}

static void test_put_keeps_what_the_user_sets(void **state)
{
    struct settings settings = settings_default();
    struct material_choice choice;
    (void)state;
    assert_true(parse(&choice, "ruby:frosted"));
    assert_int_equal(settings_assign(&settings, "absorb.red=7", SETTING_USER, NULL), STATUS_OK);
    setup_put_material(&settings, &choice, 1.0f, SETTING_PRESET);
    const struct absorb_params *absorb = settings_of(&settings, &absorb_settings);
    const struct refract_params *refract = settings_of(&settings, &refract_settings);
    CHECK_NEAR(absorb->red, 7.0f, 1e-6);
    CHECK_NEAR(absorb->green, choice.preset->absorption.y, 1e-3);
    CHECK_NEAR(refract->roughness, 0.5f, 1e-6);
    CHECK_NEAR(refract->dispersion, 20.0f / choice.preset->abbe, 1e-6);
}

/* Writes the corners and triangles of a box of half width `half`, inside out if `is_inner`. */
static void add_box(struct mesh_vertex *vertices, uint32_t *indices, float half, uint32_t first,
                    bool is_inner)
{
    static const uint32_t faces[36] = { 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5 };

    for (uint32_t i = 0; i < 8; i++)
        vertices[i].position =
            (vec3s){ { i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half } };
    for (uint32_t i = 0; i < 36; i += 3) {
        indices[i] = first + faces[i];
        indices[i + 1] = first + faces[i + (is_inner ? 2 : 1)];
        indices[i + 2] = first + faces[i + (is_inner ? 1 : 2)];
    }
}

static void test_wall_thickness(void **state)
{
    struct mesh_vertex vertices[16] = { 0 };
    uint32_t indices[72];
    struct mesh mesh = { .vertices = vertices, .vertex_count = 16, .indices = indices };
    struct object object = { .index_count = 36 };
    struct scene scene = { .model = { .object = mesh, .objects = &object, .object_count = 1 } };
    (void)state;
    add_box(vertices, indices, 0.1f, 0, false);
    add_box(&vertices[8], &indices[36], 0.0986f, 8, true); /* walls of 1.4 mm */
    CHECK_NEAR(setup_wall_thickness(&mesh, 0, 36), 0.2f / 3.0f, 1e-5);
    CHECK_NEAR(setup_wall_thickness(&mesh, 0, 72), 0.0014f, 2e-5);
    assert_true(setup_wall_thickness(&mesh, 0, 0) <= 0.0f);
    scene.model.object.index_count = 36;
    assert_false(setup_has_thin_walls(&scene));
    scene.model.object.index_count = object.index_count = 72;
    assert_true(setup_has_thin_walls(&scene));
    object.open_edge_count = 3; /* its volume is unknown */
    assert_false(setup_has_thin_walls(&scene));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_preset_is_complete),
        cmocka_unit_test(test_names_and_finishes),
        cmocka_unit_test(test_absorption_is_that_of_the_table),
        cmocka_unit_test(test_settings_of_each_preset_find_it),
        cmocka_unit_test(test_put_keeps_what_the_user_sets),
        cmocka_unit_test(test_wall_thickness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
