/* test_obj_ply.c: statements of OBJ files and properties of PLY files. */
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/scene/import/model.h"
#include "tests/support/assertions.h"
#include "tests/support/temporary_folder.h"

static void write_bytes(const char *path, const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static struct model load_bytes(const char *path, const char *bytes, size_t size)
{
    struct model model;
    write_bytes(path, bytes, size);
    assert_int_equal(model_load(&model, path, MODEL_OBJECT), STATUS_OK);
    return model;
}

static struct model load(const char *path, const char *text)
{
    return load_bytes(path, text, strlen(text));
}

/* Expects one line with some words from loading a file. */
static void check_said(const char *path, const char *text, enum status expected, const char *words)
{
    char line[2048];
    struct model model;
    write_bytes(path, text, strlen(text));
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    FILE *caught = tmpfile();
    assert_true(kept >= 0 && caught);
    dup2(fileno(caught), STDERR_FILENO);
    const enum status status = model_load(&model, path, MODEL_BY_MATERIALS);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(caught);
    line[fread(line, 1, sizeof(line) - 1, caught)] = '\0';
    fclose(caught);
    model_finish(&model);
    assert_int_equal(status, expected);
    if (!strstr(line, words))
        fail_msg("expected '%s', got: %s", words, line);
    assert_ptr_equal(strchr(line, '\n'), line + strlen(line) - 1);
}

static void check_refused(const char *path, const char *text, const char *words)
{
    check_said(path, text, STATUS_DATA, words);
}

static vec3s corner(const struct model *model, uint32_t index)
{
    return model->object.vertices[model->object.indices[index]].position;
}

static float area_of(const struct model *model, vec3s *direction)
{
    float area = 0;
    *direction = glms_vec3_zero();
    for (uint32_t i = 0; i < model->object.index_count; i += 3) {
        const vec3s a = corner(model, i);
        const vec3s cross = glms_vec3_cross(glms_vec3_sub(corner(model, i + 1), a),
                                            glms_vec3_sub(corner(model, i + 2), a));
        area += glms_vec3_norm(cross) / 2;
        *direction = glms_vec3_add(*direction, cross);
    }
    return area;
}

/* The triangles cover a flat polygon that faces +Z once: no area is counted twice or outside. */
static void check_area(struct model model, uint32_t triangles, float area)
{
    vec3s direction;
    assert_int_equal(model.object.index_count, 3 * triangles);
    CHECK_NEAR(area_of(&model, &direction), area, 1e-5);
    CHECK_NEAR(direction.z, 2 * area, 1e-5);
    model_finish(&model);
}

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

/* Each is the unit square. */
static void obj_forms(void **state)
{
    static const char *const texts[] = {
        SQUARE "f 1 2 3 4\n",
        SQUARE "f 1 2 3 4",
        SQUARE "f -4 -3 -2 -1\n",
        SQUARE "f 1 2 \\\n3 4\n",
        SQUARE "f 1 2 \\\r\n3 4\r\n",
        "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n",
        "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r",
        "  v\t0 0 0 \nv 1.0e0 +0 -0.\nv 100e-2 .1E1 0\nv 0 2 0 2\n\n# f 9\nf 1 2 3\ng x y\nf 1 3 "
        "4\n",
        SQUARE "vt .5 .5\nvt 0\nvn 0 0 1\nf 1/1 2/2/1 3//1 4/1/\n",
        SQUARE "vt 0 0\nvn 0 0 1\nvn 0 0 2\nf -4/-1/-2 -3/-1 -2//-1 -1\n",
        "f 1 2 3 4\n" SQUARE,
        SQUARE "p 1\nl 1 2 3\nf 1\nf 1 2\ns off\nvp 1 2\ncstype bezier\nf 1 2 3 4\n",
        "o a\n" SQUARE "usemtl none\ns 1\nf 1 2 3\no b\nf 1 3 4\no a\n",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        check_area(load("a.obj", texts[i]), 2, 1);
}

static void obj_polygons(void **state)
{
    (void)state;
    /* an arrow whose fan from the first corner would leave it, an L, and a comb */
    check_area(load("a.obj", "v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nf 2 4 1\n"), 1, 2);
    check_area(load("a.obj", "v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nf 2 3 4 1\n"), 2, 1);
    check_area(
        load("a.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 5 6 1 2 3 4\n"), 4,
        3);
    check_area(load("a.obj", "v 0 0 0\nv 5 0 0\nv 5 2 0\nv 4 2 0\nv 4 1 0\nv 3 1 0\nv 3 2 0\n"
                             "v 2 2 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                             "f 1 2 3 4 5 6 7 8 9 10 11 12\n"),
               10, 8);
}

static void obj_numbers(void **state)
{
    (void)state;
    struct model model =
        load("a.obj", "v 123456.789e-3 -0.000000000000000000012 1e-45\n"
                      "v 167772.17 3.402823466e+5 00000000000000000000000000000000000000000001\n"
                      "v 0.00000000000000000000000000000000000000000000000001e50 "
                      "0.30000001192092896 9.99999940395355224609375e-1\nf 1 2 3\n");
    static const float wanted[3][3] = {
        { 123.456789F, -1.2e-20F, 1e-45F },
        { 167772.17F, 340282.3466F, 1 },
        { 1, 0.3F, 0.99999994F },
    };
    for (uint32_t i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            assert_true(corner(&model, i).raw[k] == wanted[i][k]);
    }
    model_finish(&model);
}

static void obj_parts(void **state)
{
    (void)state;
    static const char glass[] = "newmtl clear glass\nd .2\nNi 1.4\n";
    write_bytes("my glass.mtl", glass, strlen(glass));
    write_bytes("b.mtl", glass, strlen(glass));
    static const char *const libraries[] = { "my glass.mtl", "none.mtl b.mtl", "b.mtl" };
    for (size_t i = 0; i < 3; i++) {
        char text[512];
        (void)snprintf(text, sizeof(text),
                       "mtllib %s\n" SQUARE
                       "v 0 0 1\ng left\nusemtl clear glass\nf 1 2 3\ng right\n"
                       "f 1 3 4\ng left\nf 1 2 5\nusemtl other\nf 2 3 5\n",
                       libraries[i]);
        struct model model = load("a.obj", text);
        assert_int_equal(model.object_count, 2);
        assert_string_equal(model.objects[0].name, "left");
        assert_int_equal(model.objects[0].index_count, 6);
        assert_string_equal(model.objects[1].name, "right");
        assert_int_equal(model.surroundings.index_count, 3);
        assert_string_equal(model.materials[model.objects[0].material].name, "clear glass");
        model_finish(&model);
    }
}

static void obj_colors(void **state)
{
    (void)state;
    struct model model = load("a.obj", "v 0 0 0 .5 .25 1\nv 1 0 0\nv 0 1 0 1 0 1 0\nf 1 2 3\n");
    const vec3s wanted[3] = { { { 0.5F, 0.25F, 1 } }, { { 1, 1, 1 } }, { { 0, 1, 0 } } };
    for (uint32_t i = 0; i < 3; i++)
        assert_true(glms_vec3_eqv(model.object.vertices[model.object.indices[i]].color, wanted[i]));
    model_finish(&model);
}

static void obj_refusals(void **state)
{
    (void)state;
    check_refused("a.obj", "v 0 0\n", "line 1: expected three coordinates, got '0 0'");
    check_refused("a.obj", SQUARE "f 1 2 x\n", "line 5: expected indices of existing vertices");
    check_refused("a.obj", SQUARE "f 1 2 0\n", "got '0'");
    check_refused("a.obj", SQUARE "f 1 2 -5\n", "got '-5'");
    check_refused("a.obj", SQUARE "f 1/2 2/2 3/2\n",
                  "to a texture coordinate that does not exist: 2 of 0");
    check_refused("a.obj", SQUARE "f 1//1 2//1 3//1\n", "to a normal that does not exist: 1 of 0");
    check_refused("a.obj", SQUARE "vn 1 2\n", "three components of a normal");
    check_refused("a.obj", SQUARE "f 1 2 3/1/1/1\n", "got '3/1/1/1'");
    check_refused("a.obj", "mtllib ../a.mtl\n" SQUARE "f 1 2 3\n", "within the model's folder");
}

#define HEAD(form) "ply\nformat " form " 1.0\ncomment x\n"
#define POINTS     "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
#define FACES      "element face 1\nproperty list uchar int vertex_indices\n"
#define STRIPS     "element tristrips 1\nproperty list int int vertex_indices\n"

static void ply_text(void **state)
{
    (void)state;
    check_area(load("a.ply", HEAD("ascii") POINTS FACES "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                                        "4 0 1 2 3\n"),
               2, 1);
    check_area(load("a.ply",
                    HEAD("ascii") FACES POINTS "end_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n"
                                               "0 1 0"),
               2, 1);
    /* two strips, one with a corner twice, as joined strips have them */
    check_area(load("a.ply", HEAD("ascii") POINTS STRIPS "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                                         "9 0 1 3 -1 1 2 2 3 -1\n"),
               1, 0.5F);
    check_area(load("a.ply", HEAD("ascii") POINTS STRIPS "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                                         "4 0 1 3 2\n"),
               2, 1);
    check_area(load("a.ply", HEAD("ascii") POINTS STRIPS "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                                         "7 0 1 3 -1 3 1 2\n"),
               2, 1);
}

static void ply_names_what_it_leaves_out(void **state)
{
    (void)state;
    char text[32 * 256];
    check_said("a.ply",
               HEAD("ascii") POINTS
               "property float quality\nproperty list uchar int ids\nproperty uchar alpha\n"
               "element face 1\nproperty uchar blue\nproperty list uchar int vertex_indices\n"
               "property int flags\nproperty uchar red\nelement range 1\nproperty int a\n"
               "element none 0\nproperty int b\nend_header\n"
               "0 0 0 7 0 9\n1 0 0 7 1 2 9\n1 1 0 7 0 9\n0 1 0 7 0 9\n1 4 0 1 2 3 2 3\n8\n",
               STATUS_OK,
               "a.ply: not drawn: quality of vertices, ids of vertices, alpha of vertices, "
               "colours of faces, flags of faces, elements 'range'\n");
    check_said("b.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", STATUS_OK,
               "b.obj: not drawn: vertex colours\n");
    size_t size = (size_t)snprintf(text, sizeof(text), HEAD("ascii") POINTS);
    for (int i = 0; i < 200; i++)
        size += (size_t)snprintf(&text[size], sizeof(text) - size, "property int p%d\n", i);
    size += (size_t)snprintf(&text[size], sizeof(text) - size, FACES "end_header\n");
    for (int i = 0; i < 4; i++) {
        size += (size_t)snprintf(&text[size], sizeof(text) - size, "%d %d 0", i & 1, i / 2);
        for (int k = 0; k < 200; k++)
            size += (size_t)snprintf(&text[size], sizeof(text) - size, " 1");
        text[size++] = '\n';
    }
    (void)snprintf(&text[size], sizeof(text) - size, "4 0 1 3 2\n");
    check_said("a.ply", text, STATUS_OK, "of vertices, ...\n");
}

static void mtl_names_unread_pictures(void **state)
{
    (void)state;
    static const char mtl[] = "newmtl a\nNs 30\nmap_Kd a.dds\nmap_Ks a.dds\nnorm a.dds\n";
    static const char obj[] = "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                              "f 1/1 2/1 3/1\n";
    write_bytes("a.mtl", mtl, strlen(mtl));
    write_bytes("a.dds", "DDS \174\0\0\0\7\20\0\0", 12);
    check_said("a.obj", obj, STATUS_OK,
               "a.obj: not drawn of its materials: textures in the format DDS\n");
    struct model model;
    assert_int_equal(model_load(&model, "a.obj", MODEL_SURROUNDINGS), STATUS_OK);
    assert_int_equal(model.textures.count + model.numbers.count, 0);
    CHECK_NEAR(model.materials[0].roughness, 0.5, 1e-6);
    CHECK_NEAR(model.materials[0].metallic, 0, 0);
    model_finish(&model);
}

static void put(char *to, size_t *size, const void *value, size_t value_size, bool is_big)
{
    const char *bytes = value; /* of a little-endian machine, as all are that firn supports */
    for (size_t i = 0; i < value_size; i++)
        to[(*size)++] = bytes[is_big ? value_size - 1 - i : i];
}

/* Positions as doubles, normals, colours as bytes or floats; a face after something unknown. */
static void check_binary(bool is_big, bool is_float)
{
    static const float points[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    char text[2048];
    const int head = snprintf(
        text, sizeof(text),
        "ply\r\nformat binary_%s_endian 1.0\r\nelement vertex 4\r\nproperty double x\r\n"
        "property double y\r\nproperty double z\r\nproperty float nx\r\nproperty float ny\r\n"
        "property float nz\r\nproperty %s red\r\nproperty %s green\r\nproperty %s blue\r\n"
        "element odd 2\r\nproperty list ushort short a\r\nelement face 1\r\n"
        "property list uchar uint vertex_index\r\nend_header\r\n",
        is_big ? "big" : "little", is_float ? "float" : "uchar", is_float ? "float" : "uint8",
        is_float ? "float32" : "uchar");
    size_t size = (size_t)head;
    for (int i = 0; i < 4; i++) {
        const double position[3] = { (double)points[i][0], (double)points[i][1], 0 };
        const float normal[3] = { 0, 0.6F, 0.8F }, color[3] = { 1, 0.2F, 0 };
        const uint8_t bytes[3] = { 255, 51, 0 };
        for (int k = 0; k < 3; k++)
            put(text, &size, &position[k], sizeof(double), is_big);
        for (int k = 0; k < 3; k++)
            put(text, &size, &normal[k], sizeof(float), is_big);
        for (int k = 0; k < 3; k++)
            put(text, &size, is_float ? (const void *)&color[k] : &bytes[k], is_float ? 4 : 1,
                is_big);
    }
    for (uint16_t count = 0; count < 2; count++) {
        const int16_t number = -7;
        put(text, &size, &count, sizeof(count), is_big);
        if (count > 0)
            put(text, &size, &number, sizeof(number), is_big);
    }
    const uint8_t corners = 4;
    put(text, &size, &corners, 1, is_big);
    for (uint32_t i = 0; i < 4; i++)
        put(text, &size, &i, sizeof(i), is_big);
    struct model model = load_bytes("a.ply", text, size);
    const struct mesh_vertex vertex = model.object.vertices[0];
    CHECK_NEAR(vertex.normal.y, 0.6, 1e-6);
    CHECK_NEAR(vertex.color.x, 1, 0);
    CHECK_NEAR(vertex.color.y, 0.2, 1e-6);
    CHECK_NEAR(vertex.color.z, 0, 0);
    check_area(model, 2, 1);
}

static void ply_binary(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++)
        check_binary(i & 1, i & 2);
}

static void ply_refusals(void **state)
{
    (void)state;
    static const char points[] = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

    static const struct {
        const char *header, *body, *words;
    } cases[] = {
        { POINTS, "", "got none" },
        { POINTS FACES, "3 0 1 4\n", "does not exist" },
        { POINTS FACES, "3 0 1 -1\n", "face 0: a face refers to a vertex" },
        { POINTS FACES, "3 0 1\n", "face 0: the file ends" },
        { POINTS FACES, "-3 0 1 2\n", "face 0: the file ends early, or a list" },
        { POINTS POINTS FACES, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "only one element with vertices" },
        { "element vertex 4\nproperty float x\n", "", "x, y and z" },
        { "element vertex\n", "", "its count" },
        { "element vertex 4\nproperty string x\n", "", "the type of the property" },
        { "element vertex 400000000\nproperty float x\n", "", "too short" },
    };

    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[1024];
        (void)snprintf(text, sizeof(text), HEAD("ascii") "%send_header\n%s%s", cases[i].header,
                       points, cases[i].body);
        check_refused("a.ply", text, cases[i].words);
    }
    check_refused("a.ply", HEAD("middle") POINTS FACES "end_header\n", "binary_big_endian");
    check_refused("a.ply", HEAD("ascii") POINTS FACES, "expected end_header");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(obj_forms, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(obj_polygons, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(obj_numbers, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(obj_parts, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(obj_colors, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(obj_refusals, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(ply_text, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(ply_names_what_it_leaves_out, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(mtl_names_unread_pictures, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(ply_binary, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(ply_refusals, temporary_folder_enter,
                                        temporary_folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
