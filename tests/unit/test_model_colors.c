/* test_model_colors.c: out-of-range colours of model files, and materials of MTL files. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "src/scene/import/model.h"
#include "tests/support/assertions.h"
#include "tests/support/temporary_folder.h"

static const char obj[] = "colors.obj", mtl[] = "colors.mtl";

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* Loads a triangle with a colour of each vertex and of its material; either may be "". Returns its
 * first vertex, and in *line what was said. */
static struct mesh_vertex load(const char *vertex_color, const char *factor, char line[static 512])
{
    char text[512];
    snprintf(text, sizeof(text), "%sv 0 0 0 %s\nv 1 0 0 %s\nv 0 1 0 %s\nf 1 2 3\n",
             factor[0] ? "mtllib colors.mtl\nusemtl a\n" : "", vertex_color, vertex_color,
             vertex_color);
    write_text(obj, text);
    snprintf(text, sizeof(text), "newmtl a\nKd %s\n", factor);
    write_text(mtl, text);
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    FILE *caught = tmpfile();
    assert_true(kept >= 0 && caught);
    dup2(fileno(caught), STDERR_FILENO);
    struct model model;
    const enum status status = model_load(&model, obj, MODEL_OBJECT);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(caught);
    line[fread(line, 1, 511, caught)] = '\0';
    fclose(caught);
    assert_int_equal(status, STATUS_OK);
    const struct mesh_vertex vertex = model.object.vertices[0];
    model_finish(&model);
    return vertex;
}

static void check(const char *vertex_color, const char *factor, vec3s wanted, const char *warning)
{
    char line[512];
    const struct mesh_vertex vertex = load(vertex_color, factor, line);
    for (int k = 0; k < 3; k++)
        CHECK_NEAR(vertex.color.raw[k], wanted.raw[k], 1e-6);
    const size_t length = strlen(line);
    if (warning[0])
        assert_true(length > 0 && strstr(line, warning) && strchr(line, '\n') == line + length - 1);
    else
        assert_string_equal(line, "");
}

static void factors_are_shares(void **state)
{
    (void)state;
    check("", "0.5 1 0", (vec3s){ { 0.5F, 1, 0 } }, "");
    check("", "3e38 1.5 -2", (vec3s){ { 1, 1, 0 } }, "in 1 materials and 0 vertices");
    check("0.5 0.5 0.5", "3e38 1 1", (vec3s){ { 0.5F, 0.5F, 0.5F } }, "in 1 materials");
    check("3e38 -1 0.25", "0.5 0.5 0.5", (vec3s){ { 1, 0, 0.125F } },
          "in 0 materials and 3 vertices");
    check("2 0 0", "0.5 1 1", (vec3s){ { 1, 0, 0 } }, "");
}

static void unlit_colors_are_radiances(void **state)
{
    (void)state;
    check("4 0.5 65504", "", (vec3s){ { 4, 0.5F, 65504 } }, "");
    check("3e38 65505 -1", "", (vec3s){ { 65504, 65504, 0 } }, "in 0 materials and 3 vertices");
}

/* A box's side of the material beside one that is opaque; *found is the material. Returns whether
 * it is an object of its own. */
static bool load_material(const char *lines, struct material *found)
{
    char text[512];
    struct model model;
    write_text(obj, "mtllib colors.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\n"
                    "usemtl b\nf 1 2 4\nf 2 3 4\n");
    snprintf(text, sizeof(text), "newmtl a\nKd .5 .25 1\n%s\nnewmtl b\nKd .5 .5 .5\nNs 98\n",
             lines);
    write_text(mtl, text);
    assert_int_equal(model_load(&model, obj, MODEL_OBJECT), STATUS_OK);
    const bool is_split = model.surroundings.index_count > 0;
    assert_int_equal(model.object_count, 1);
    assert_int_equal(model.object.index_count, is_split ? 3 : 9);
    *found = model.materials[model.objects[0].material];
    if (is_split) {
        const uint32_t surface = model.surroundings.vertices[0].material >> MESH_SURFACE_SHIFT;
        assert_true(surface > 0);
        assert_string_equal(model.materials[surface - 1].name, "b");
        CHECK_NEAR(model.materials[surface - 1].roughness, 0.376060, 1e-5);
        assert_true(model.has_ior);
        CHECK_NEAR(model.ior, found->ior, 0);
    }
    model_finish(&model);
    return is_split;
}

static void transmissive_materials_are_objects(void **state)
{
    (void)state;

    static const struct {
        const char *lines;
        float transmission, thickness, ior, roughness, green;
    } rows[] = {
        { "illum 4", 1, 0, 1.5F, 0, 1 },
        { "illum 7\nNi 1.33\nNs 98", 1, 1, 1.33F, 0.376060F, 1 },
        { "illum 9\nNi 1.45\nTf 1 .5 1", 1, 1, 1.45F, 0, 0.5F },
        { "d 0.25\nNi 1.5", 0.75F, 1, 1.5F, 0, 1 },
        { "Tf .5 .5 .5\nNi 2", 1, 1, 2, 0, 0.5F },
        { "illum 6\nNi 99", 1, 1, 4, 0, 1 },
    };
    struct material found;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        if (!load_material(rows[i].lines, &found))
            fail_msg("%s: not transmissive", rows[i].lines);
        assert_string_equal(found.name, "a");
        CHECK_NEAR(found.transmission, rows[i].transmission, 1e-6);
        CHECK_NEAR(found.thickness, rows[i].thickness, 0);
        CHECK_NEAR(found.ior, rows[i].ior, 1e-6);
        CHECK_NEAR(found.roughness, rows[i].roughness, 1e-5);
        CHECK_NEAR(found.base_color.y, rows[i].green, 1e-6);
    }
    static const char *const opaque[] = { "illum 2", "Ni 1.5", "Tf .5 .5 .5", "d 1\nillum 5" };
    for (size_t i = 0; i < sizeof(opaque) / sizeof(opaque[0]); i++) {
        assert_false(load_material(opaque[i], &found));
        assert_true(found.flags & MATERIAL_FROM_SETTINGS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(factors_are_shares, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(transmissive_materials_are_objects, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(unlit_colors_are_radiances, temporary_folder_enter,
                                        temporary_folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
