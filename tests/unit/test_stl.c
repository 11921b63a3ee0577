/*
 * test_stl.c: ASCII and binary STL files: facets, welding, normals, and errors of damaged files.
 */
#include <cglm/struct.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "src/scene/import/model.h"
#include "src/scene/refractive_object.h"
#include "tests/support/assertions.h"
#include "tests/support/temporary_folder.h"

enum {
    FACET_MAX = 16,
};

/* A binary file under construction. */
struct binary {
    char bytes[84 + 50 * FACET_MAX];
    uint32_t count;
};

static void add_facet(struct binary *binary, const float corners[9])
{
    char *facet = &binary->bytes[84 + 50 * (size_t)binary->count++];
    const float against[3] = { 0, 0, -1 }; /* a normal that does not count */
    memcpy(facet, against, sizeof(against));
    memcpy(facet + 12, corners, 9 * sizeof(*corners));
    binary->bytes[80] = (char)binary->count;
}

/* Adds the sides of a cube from 0 to 1, counter-clockwise seen from outside. */
static void add_cube(struct binary *binary)
{
    static const uint8_t sides[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                         { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    for (int side = 0; side < 6; side++) {
        for (int half = 0; half < 2; half++) {
            float corners[9];
            for (int i = 0; i < 3; i++) {
                const uint8_t corner = sides[side][i == 0 ? 0 : i + half];
                for (int k = 0; k < 3; k++)
                    corners[3 * i + k] = (corner >> k & 1) ? 1 : -0.0F;
            }
            add_facet(binary, corners);
        }
    }
}

/* Loads a file, whose log message must have `words`. */
static enum status load(struct model *model, const char *bytes, size_t size, const char *words)
{
    char line[512];
    FILE *file = fopen("a.stl", "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    FILE *caught = tmpfile();
    assert_true(kept >= 0 && caught);
    dup2(fileno(caught), STDERR_FILENO);
    const enum status status = model_load(model, "a.stl", MODEL_OBJECT);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(caught);
    line[fread(line, 1, sizeof(line) - 1, caught)] = '\0';
    fclose(caught);
    if (words[0] ? !strstr(line, words) : line[0])
        fail_msg("expected '%s', got: %s", words, line);
    return status;
}

/* One closed object, with the winding outside, a point at each corner, and creases. */
static void check_cube(const struct model *model)
{
    const struct mesh *mesh = &model->object;
    assert_int_equal(model->object_count, 1);
    assert_int_equal(mesh->index_count, 36);
    assert_int_equal(mesh->vertex_count, 24);
    assert_int_equal(model->objects[0].open_edge_count, 0);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const struct mesh_vertex *v = &mesh->vertices[mesh->indices[i]];
        CHECK_NEAR((double)glms_vec3_max(glms_vec3_abs(v->normal)), 1, 1e-6);
        assert_true(glms_vec3_dot(v->normal, glms_vec3_subs(v->position, 0.5F)) > 0.4F);
    }
}

static void binary_files(void **state)
{
    (void)state;
    struct binary binary = { .bytes = "solid is no mark of ASCII" };
    struct model model;
    add_cube(&binary);
    const size_t size = 84 + 50 * 12;
    assert_int_equal(load(&model, binary.bytes, size, ""), STATUS_OK);
    check_cube(&model);
    model_finish(&model);
    assert_int_equal(load(&model, binary.bytes, size - 1, "cut short"), STATUS_DATA);
    memcpy(&binary.bytes[84 + 50 * 6 + 12], "\0\0\xc0\x7f", 4); /* not a number */
    assert_int_equal(load(&model, binary.bytes, size, "a.stl: facet 7: "), STATUS_DATA);
}

static void colors_are_named(void **state)
{
    (void)state;
    struct binary binary = { .bytes = "COLOR=" };
    struct model model;
    add_cube(&binary);
    binary.bytes[84 + 48] = 1;
    assert_int_equal(load(&model, binary.bytes, 84 + 50 * 12, "not drawn: colours of facets"),
                     STATUS_OK);
    model_finish(&model);
}

/* Facets that meet at less than 40 degrees are smooth; those that meet at more are not. */
static void creases(void **state)
{
    (void)state;
    for (int is_sharp = 0; is_sharp < 2; is_sharp++) {
        struct binary binary = { .bytes = "" };
        struct model model;
        const float slope = is_sharp ? 1.0F : 0.5F; /* 45 and 26.6 degrees */
        add_facet(&binary, (float[]){ 0, 0, 0, 1, 0, 0, 0, 1, 0 });
        add_facet(&binary, (float[]){ 0, 0, 0, 0, 1, 0, -1, 0, -slope });
        assert_int_equal(load(&model, binary.bytes, 84 + 50 * 2, ""), STATUS_OK);
        assert_int_equal(model.object.vertex_count, is_sharp ? 6 : 4);
        model_finish(&model);
    }
}

#define FACET(corner) \
    "facet normal nan 0 0\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex " corner \
    "\n endloop\nendfacet\n"

static void text_files(void **state)
{
    static const struct {
        const char *text, *words;
    } refused[] = {
        { "solid a\n" FACET("0 1e9 0") "endsolid\n", "a.stl: line 6: expected coordinates" },
        { "solid a\n" FACET("0 nan 0") "endsolid\n", "a.stl: line 6: " },
        { "solid a\n" FACET("0 1") "endsolid\n", "a.stl: line 6: vertex: expected 3 numbers" },
        { "solid a\n" FACET("0 1 0\n vertex 1 1 0") "endsolid\n", "a.stl: line 7: expected 3" },
        { "solid a\n" FACET("0 1 0"), "a.stl: line 8: the file is cut short" },
        { "solid a\nfacet\nouter loop\nvertex 0 0 0\nendloop\n", "a.stl: line 5: expected 3" },
        { "solid a\npoint\n", "a.stl: line 2: expected facet or endsolid, got 'point'" },
        { "solid a\nendsolid a\n", "expected a model with triangles" },
    };

    const char *text =
        "\nSOLID two\r\n" FACET("0 1 0") "endsolid two\nsolid\n" FACET("0 0 1") "endsolid";
    struct model model;
    (void)state;
    assert_int_equal(load(&model, text, strlen(text), ""), STATUS_OK);
    assert_int_equal(model.object_count, 1);
    assert_int_equal(model.object.index_count, 6);
    CHECK_NEAR((double)model.object.vertices[2].position.y, 1, 0);
    CHECK_NEAR((double)model.object.vertices[2].normal.z, 1, 0);
    model_finish(&model);
    for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++)
        assert_int_equal(load(&model, refused[i].text, strlen(refused[i].text), refused[i].words),
                         STATUS_DATA);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(binary_files, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(colors_are_named, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(creases, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(text_files, temporary_folder_enter, temporary_folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
