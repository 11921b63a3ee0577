/* test_model.c: model files written by the test and read back. */
#include <cglm/struct.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/scene/import/model.h"
#include "tests/support/assertions.h"

/* one texel wide, two high: red above green */
static const uint8_t red_over_green_png[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
    0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0x16,
    0xe3, 0x21, 0x70, 0x00, 0x00, 0x00, 0x0e, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8,
    0xcf, 0x00, 0x04, 0xff, 0x19, 0x00, 0x08, 0xff, 0x01, 0xff, 0x40, 0x21, 0x2c, 0x2e, 0x00,
    0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
};

/* A glTF buffer: a unit square in z = 0, seen from +Z, and a picture. */
struct square {
    float positions[4][3];
    float normals[4][3];
    float uvs[4][2]; /* the picture's top is at y = 1 */
    float colors[4][4];
    uint16_t indices[6];
    uint8_t picture[72];
};

static const struct square unit_square = {
    .positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    .normals = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } },
    .uvs = { { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } },
    .colors = { { 0.5F, 1, 1, 1 }, { 0.5F, 1, 1, 1 }, { 0.5F, 1, 1, 1 }, { 0.5F, 1, 1, 1 } },
    .indices = { 0, 1, 2, 0, 2, 3 },
};

/* JSON in this file has ' for ". Accessors: 0 position, 1 normal, 2 uv, 3 colour, 4 indices. */
static const char json_head[] =
    "{'asset':{'version':'2.0'},'scene':0,"
    "'buffers':[{'byteLength':276}],"
    "'bufferViews':[{'buffer':0,'byteLength':48},"
    "{'buffer':0,'byteOffset':48,'byteLength':48},"
    "{'buffer':0,'byteOffset':96,'byteLength':32},"
    "{'buffer':0,'byteOffset':128,'byteLength':64},"
    "{'buffer':0,'byteOffset':192,'byteLength':12},"
    "{'buffer':0,'byteOffset':204,'byteLength':71}],"
    "'accessors':[{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'},"
    "{'bufferView':1,'componentType':5126,'count':4,'type':'VEC3'},"
    "{'bufferView':2,'componentType':5126,'count':4,'type':'VEC2'},"
    "{'bufferView':3,'componentType':5126,'count':4,'type':'VEC4'},"
    "{'bufferView':4,'componentType':5123,'count':6,'type':'SCALAR'}],";

#define PLAIN "{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':4}]}"
#define WITH(material) \
    "{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1,'TEXCOORD_0':2},'indices':4," \
    "'material':" material "}]}"
#define PICTURE  "'textures':[{'source':0}],'images':[{'bufferView':5,'mimeType':'image/png'}]"
#define ONE_NODE "'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}]"

static char folder[] = "/tmp/firn-model-XXXXXX";
static char written[64][64];
static int written_count;

static const char *path_of(const char *name)
{
    for (int i = 0; i < written_count; i++) {
        if (strcmp(strrchr(written[i], '/') + 1, name) == 0)
            return written[i];
    }
    assert_true(written_count < 64);
    snprintf(written[written_count], sizeof(written[0]), "%s/%s", folder, name);
    return written[written_count++];
}

static const char *write_bytes(const char *name, const void *bytes, size_t size)
{
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return path;
}

static const char *write_text(const char *name, const char *text)
{
    return write_bytes(name, text, strlen(text));
}

/* JSON: json_head and `tail`; its binary part is `square`, with the picture if it has none. */
static const char *write_glb(const char *name, const char *tail, const struct square *square)
{
    static uint8_t bytes[8192];
    char json[4096];
    int length = snprintf(json, sizeof(json), "%s%s}", json_head, tail);
    assert_true(length < (int)sizeof(json) - 4);
    for (; length % 4 != 0; length++)
        json[length] = ' ';
    for (int i = 0; i < length; i++)
        json[i] = (char)(json[i] == '\'' ? '"' : json[i]);

    struct square data = *square;
    if (data.picture[0] == 0)
        memcpy(data.picture, red_over_green_png, sizeof(red_over_green_png));
    uint32_t json_size = (uint32_t)length, data_size = sizeof(data);
    uint32_t head[] = { 0x46546c67, 2, 28 + json_size + data_size, json_size, 0x4e4f534a };
    uint32_t data_head[] = { data_size, 0x004e4942 };
    memcpy(bytes, head, sizeof(head));
    memcpy(bytes + 20, json, json_size);
    memcpy(bytes + 20 + json_size, data_head, sizeof(data_head));
    memcpy(bytes + 28 + json_size, &data, data_size);
    return write_bytes(name, bytes, head[2]);
}

static struct model load(const char *path, enum model_role default_role)
{
    struct model model;
    assert_int_equal(model_load(&model, path, default_role), STATUS_OK);
    for (uint32_t i = 0; i < model.object.index_count; i++)
        assert_true(model.object.indices[i] < model.object.vertex_count);
    return model;
}

static struct model load_glb(const char *tail)
{
    return load(write_glb("m.glb", tail, &unit_square), MODEL_OBJECT);
}

/* Every triangle's winding must agree with its normals, and every normal be unit. */
static void check_outward(const struct mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const struct mesh_vertex *a = &mesh->vertices[mesh->indices[i]];
        const struct mesh_vertex *b = &mesh->vertices[mesh->indices[i + 1]];
        const struct mesh_vertex *c = &mesh->vertices[mesh->indices[i + 2]];
        const vec3s edge = glms_vec3_sub(b->position, a->position);
        const vec3s normal = glms_vec3_cross(edge, glms_vec3_sub(c->position, a->position));
        assert_true(glms_vec3_dot(normal, a->normal) > 0);
        CHECK_NEAR(glms_vec3_norm(a->normal), 1, 1e-6);
    }
}

static void check_vec3(vec3s actual, float x, float y, float z)
{
    CHECK_NEAR(actual.x, x, 1e-5);
    CHECK_NEAR(actual.y, y, 1e-5);
    CHECK_NEAR(actual.z, z, 1e-5);
}

static const struct mesh_vertex *vertex_at(const struct mesh *mesh, float x, float y, float z)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (glms_vec3_distance(mesh->vertices[i].position, (vec3s){ { x, y, z } }) < 1e-5F)
            return &mesh->vertices[i];
    }
    fail_msg("no vertex at %g %g %g", (double)x, (double)y, (double)z);
    return NULL;
}

static void plain_obj(void **state)
{
    (void)state;
    struct model model = load(write_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\n"
                                                  "vn 0 0 2\nf 1//1 2//1 3//1 4//1\nl 1 2\np 5\n"),
                              MODEL_OBJECT);
    assert_int_equal(model.object.vertex_count, 4);
    assert_int_equal(model.object.index_count, 6);
    assert_int_equal(model.surroundings.vertex_count, 0);
    assert_int_equal(model.textures.count, 0);
    assert_false(model.has_camera || model.has_ior);
    check_outward(&model.object);
    const struct mesh_vertex *vertex = vertex_at(&model.object, 1, 1, 0);
    check_vec3(vertex->normal, 0, 0, 1);
    check_vec3(vertex->color, 1, 1, 1);
    assert_int_equal(vertex->material, 0);
    model_finish(&model);
    assert_null(model.object.vertices);

    model = load(path_of("a.obj"), MODEL_SURROUNDINGS);
    assert_int_equal(model.object.vertex_count, 0);
    assert_int_equal(model.surroundings.index_count, 6);
    model_finish(&model);
}

static void made_normals_are_smooth(void **state)
{
    (void)state;
    /* an octahedron in two colours: the seam must not show */
    write_text("o.mtl", "newmtl a\nKd 0.5 0.5 0.5\nnewmtl b\nKd 1 1 1\n");
    struct model model =
        load(write_text("o.obj", "mtllib o.mtl\nv 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\n"
                                 "v 0 0 -1\nusemtl a\nf 3 5 1\nf 3 1 6\nf 3 6 2\nf 3 2 5\n"
                                 "usemtl b\nf 4 1 5\nf 4 6 1\nf 4 2 6\nf 4 5 2\n"),
             MODEL_OBJECT);
    assert_int_equal(model.object.index_count, 24);
    assert_int_equal(model.object.vertex_count, 10);
    for (uint32_t i = 0; i < model.object.vertex_count; i++) {
        const struct mesh_vertex *vertex = &model.object.vertices[i];
        check_vec3(vertex->normal, vertex->position.x, vertex->position.y, vertex->position.z);
    }
    check_outward(&model.object);
    model_finish(&model);

    /* given normals stay even where others are missing */
    model = load(write_text("h.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 1 0 0\n"
                                     "f 1 3 4\nf 1//1 2//1 3//1\n"),
                 MODEL_OBJECT);
    check_vec3(vertex_at(&model.object, 1, 0, 0)->normal, 1, 0, 0);
    check_vec3(vertex_at(&model.object, 0, 1, 0)->normal, 0, 0, 1);
    model_finish(&model);
}

static void gltf_without_normals_is_flat(void **state)
{
    (void)state;
    struct square roof = unit_square; /* folded by a right angle at the diagonal */
    roof.positions[3][1] = 0;
    roof.positions[3][2] = 1;
    const char *path = write_glb(
        "roof.glb",
        ONE_NODE ",'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':4}]}]", &roof);
    struct model model = load(path, MODEL_OBJECT);
    assert_int_equal(model.object.vertex_count, 6);
    check_outward(&model.object);
    for (uint32_t i = 0; i < 6; i++) {
        const bool is_floor = model.object.indices[0] == i || model.object.indices[1] == i ||
                              model.object.indices[2] == i;
        const float x = is_floor ? 0 : sqrtf(0.5F);
        check_vec3(model.object.vertices[i].normal, x, is_floor ? 0 : -x, !is_floor ? 0 : 1);
    }
    model_finish(&model);
}

static void transforms(void **state)
{
    (void)state;
    struct square slanted = unit_square; /* in the plane x + z = 1 */
    const float positions[4][3] = { { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } };
    memcpy(slanted.positions, positions, sizeof(positions));
    for (int i = 0; i < 4; i++) {
        slanted.normals[i][0] = sqrtf(0.5F);
        slanted.normals[i][2] = sqrtf(0.5F);
    }
    /* a quarter turn about +Y (x to -z, z to x) and a move; within it twice as long in x */
    const char *path = write_glb("t.glb",
                                 "'scenes':[{'nodes':[0,2]}],'nodes':["
                                 "{'translation':[10,20,30],'rotation':[0,0.70710678,0,0.70710678],"
                                 "'children':[1]},{'mesh':0,'scale':[2,1,1]},"
                                 "{'mesh':0,'scale':[-1,1,1]}],'meshes':[" PLAIN "]",
                                 &slanted);
    struct model model = load(path, MODEL_OBJECT);
    assert_int_equal(model.object.index_count, 12);
    check_outward(&model.object);
    /* (1 0 0): x doubled, turned, moved; its normal was (1/2 0 1) when stretched */
    check_vec3(vertex_at(&model.object, 10, 20, 28)->normal, 2 / sqrtf(5), 0, -1 / sqrtf(5));
    check_vec3(vertex_at(&model.object, -1, 1, 0)->normal, -sqrtf(0.5F), 0, sqrtf(0.5F));
    model_finish(&model);
}

#define GLASS(ior) "{'extensions':{'KHR_materials_transmission':{'transmissionFactor':0.5}" ior "}}"
#define IOR(value) ",'KHR_materials_ior':{'ior':" value "}"

static void transmission_splits(void **state)
{
    (void)state;
    const char *path = write_glb(
        "s.glb",
        "'extensionsUsed':['KHR_materials_transmission','KHR_materials_ior'],"
        "'scenes':[{'nodes':[0,1,2]}],'nodes':[{'mesh':0},{'mesh':1,'translation':[5,0,0]},"
        "{'mesh':0,'translation':[0,5,0]}],'meshes':[" WITH("0") "," WITH(
            "1") "],'materials':["
                 "{'extensions':{'KHR_materials_ior':{'ior':9}}}," GLASS(IOR("1.31")) "]",
        &unit_square);
    for (int part = MODEL_OBJECT; part <= MODEL_SURROUNDINGS; part++) {
        struct model model = load(path, (enum model_role)part);
        assert_int_equal(model.object.index_count, 6);
        assert_int_equal(model.surroundings.index_count, 12);
        CHECK_NEAR(mesh_box(&model.object).min.x, 5, 0);
        CHECK_NEAR(mesh_box(&model.surroundings).max.x, 1, 0);
        assert_true(model.has_ior);
        CHECK_NEAR(model.ior, 1.31, 1e-6);
        model_finish(&model);
    }
    struct model model = load_glb(ONE_NODE ",'meshes':[" WITH("0") "],'materials':[" GLASS("") "]");
    assert_int_equal(model.object.index_count, 6);
    assert_true(model.has_ior);
    CHECK_NEAR(model.ior, 1.5, 0);
    model_finish(&model);
}

static void gltf_materials(void **state)
{
    (void)state;
    struct model model =
        load_glb("'extensionsUsed':['KHR_materials_unlit']," ONE_NODE ",'meshes':[{'primitives':["
                 "{'attributes':{'POSITION':0,'NORMAL':1,'COLOR_0':3,'TEXCOORD_0':2},'indices':4,"
                 "'material':0}]}],'materials':[{'extensions':{'KHR_materials_unlit':{}},"
                 "'alphaMode':'MASK','pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,1],"
                 "'baseColorTexture':{'index':0}}}]," PICTURE);
    assert_int_equal(model.object.vertices[0].material,
                     1 | MESH_UNLIT | MESH_CUTOUT | 1u << MESH_SURFACE_SHIFT);
    check_vec3(model.object.vertices[0].color, 0.25F, 0.25F, 1);
    model_finish(&model);

    model = load_glb(ONE_NODE ",'meshes':[" WITH("0") "],'materials':[{'alphaMode':'MASK'}]");
    assert_int_equal(model.object.vertices[0].material, 1u << MESH_SURFACE_SHIFT);
    check_vec3(model.object.vertices[0].color, 1, 1, 1);
    model_finish(&model);
}

static void check_colors(const char *name, const char *text, float x, uint32_t material)
{
    struct model model = load(write_text(name, text), MODEL_OBJECT);
    const struct mesh_vertex *vertex = vertex_at(&model.object, 1, 0, 0);
    check_vec3(vertex->color, x, 0.5F * x, 0);
    assert_int_equal(vertex->material, material);
    model_finish(&model);
}

static void vertex_colors(void **state)
{
    (void)state;
#define COLORED "v 0 0 0 0 0 0\nv 1 0 0 0.5 0.25 0\nv 1 1 0 0 0 0\n"
    check_colors("c.obj", COLORED "f 1 2 3\n", 0.5F, MESH_UNLIT);
    check_colors("c.obj", COLORED "vn 0 0 1\nf 1//1 2//1 3//1\n", 0.5F, 0);
    write_text("c.mtl", "newmtl half\nKd 0.5 0.5 0.5\n");
    check_colors("c.obj", "mtllib c.mtl\n" COLORED "usemtl half\nf 1 2 3\n", 0.25F, 0);
    check_colors("c.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float red\nproperty float green\nproperty float blue\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0 0 0 0\n1 0 0 0.5 0.25 0\n1 1 0 0 0 0\n3 0 1 2\n",
                 0.5F, MESH_UNLIT);
}

#define TEXTURED(count) "'pbrMetallicRoughness':{'baseColorTexture':{'index':" count "}}"

#define PAINTED ONE_NODE ",'meshes':[" WITH("0") "],'materials':[{" TEXTURED("0") "}]," PICTURE

/* Whether the square's top shows red and its bottom green, in the vertex's own layer. */
static void check_orientation(const struct model *model, const struct mesh *mesh)
{
    for (int i = 0; i < 2; i++) {
        const struct mesh_vertex *vertex = vertex_at(mesh, 1, i == 0 ? 1.0F : 0.0F, 0);
        size_t size = model->textures.size, layer = (vertex->material & MESH_TEXTURE_MASK) - 1;
        assert_true(layer < model->textures.count);
        size_t row = (size_t)(vertex->uv.y * (float)(size - 1));
        const uint8_t *texel = &model->textures.texels[4 * size * (layer * size + row)];
        assert_int_equal(texel[0], i == 0 ? 255 : 0);
        assert_int_equal(texel[1], i == 0 ? 0 : 255);
        assert_int_equal(texel[3], 255);
    }
}

/* An uncompressed true-colour TGA, all of one colour, or red above green. */
static void write_tga(const char *name, uint8_t side, bool is_red_over_green)
{
    uint8_t bytes[18 + 3 * 64] = { [2] = 2, [12] = side, [14] = side, [16] = 24, [17] = 0x20 };
    for (int i = 0; i < side * side; i++)
        bytes[18 + 3 * i + (is_red_over_green && i < side * side / 2 ? 2 : 1)] = 255;
    write_bytes(name, bytes, 18 + 3 * (size_t)side * side);
}

static void textures(void **state)
{
    (void)state;
    struct model glb =
        load_glb("'scenes':[{'nodes':[0,1]}],'nodes':[{'mesh':0},{'mesh':1,'translation':[9,0,0]}],"
                 "'meshes':[" WITH("0") "," WITH("1") "],"
                                                      "'materials':[{" TEXTURED("0") "},{" TEXTURED(
                                                          "0") "}]," PICTURE);
    assert_int_equal(glb.textures.count, 1); /* though used twice */
    assert_int_equal(glb.textures.size, 2);
    check_orientation(&glb, &glb.object);

    write_tga("big picture.tga", 8, true);
    write_tga("small.tga", 3, false);
    write_text("x.mtl", "newmtl big\nmap_Kd big picture.tga\nnewmtl small\nmap_Kd .\\small.tga\n"
                        "newmtl unused\nmap_Kd nowhere.tga\n");
    struct model obj = load(
        write_text("x.obj", "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 9\nv 9 0 9\n"
                            "v 0 9 9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                            "usemtl small\nf 5/1 6/2 7/3\nusemtl big\nf 1/1 2/2 3/3 4/4\n"),
        MODEL_OBJECT);
    assert_int_equal(obj.textures.count, 2);
    assert_int_equal(obj.textures.size, 8);
    check_orientation(&obj, &obj.object);

    uint32_t index_count = glb.object.index_count + obj.object.index_count;
    assert_int_equal(model_add_surroundings(&obj, &glb), STATUS_OK);
    assert_true(!glb.object.vertices && !glb.textures.texels);
    assert_int_equal(obj.textures.count, 3);
    assert_int_equal(obj.textures.size, 8);
    assert_int_equal(obj.object.index_count + obj.surroundings.index_count, index_count);
    assert_int_equal(obj.surroundings.vertices[0].material, 3 | 2u << MESH_SURFACE_SHIFT);
    check_orientation(&obj, &obj.object);
    check_orientation(&obj, &obj.surroundings);
    model_finish(&obj);
}

static void smaller_joins_larger(void **state)
{
    (void)state;
    struct model small =
        load_glb(ONE_NODE ",'meshes':[" WITH("0") "],'materials':[{" TEXTURED("0") "}]," PICTURE);
    write_tga("big picture.tga", 8, true);
    /* a glTF file names it by a URI */
    struct model large =
        load(write_glb("u.glb",
                       ONE_NODE ",'meshes':[" WITH("0") "],'materials':[{" TEXTURED(
                           "0") "}],"
                                "'textures':[{'source':0}],'images':[{'uri':'big%20picture.tga'}]",
                       &unit_square),
             MODEL_OBJECT);
    assert_int_equal(model_add_surroundings(&small, &large), STATUS_OK);
    assert_int_equal(small.textures.size, 8);
    assert_int_equal(small.textures.count, 2);
    check_orientation(&small, &small.object);
    check_orientation(&small, &small.surroundings);
    model_finish(&small);
}

static void camera(void **state)
{
    (void)state;
    /* turned by a quarter about +Y: looks along -X instead of -Z */
    const char *tail = "'scenes':[{'nodes':[0,1]}],'nodes':[{'mesh':0,'translation':[-0.5,-0.5,0]},"
                       "{'translation':[3,0,0],'children':[2]},"
                       "{'camera':%d,'rotation':[0,0.70710678,0,0.70710678]%s}],'cameras':["
                       "{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1%s}},"
                       "{'type':'orthographic','orthographic':"
                       "{'xmag':1,'ymag':1,'znear':0.1,'zfar':9}}],'meshes':[" PLAIN "]";
    const char *aspects[] = { "", ",'aspectRatio':2.5" };
    char text[1024];
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof(text), tail, 0, ",'translation':[0,0,4]", aspects[i]);
        struct model model = load_glb(text);
        assert_true(model.has_camera);
        CHECK_NEAR(model.camera.fov_deg, 0.8 * 180 / 3.14159265, 1e-3);
        CHECK_NEAR(model.camera_aspect, i ? 2.5 : 0, 0);
        check_vec3(model.camera.eye, 3, 0, 4);
        check_vec3(model.camera.target, -2, 0, 4); /* as far as the square's centre, 5 */
        check_vec3(model.camera.up, 0, 1, 0);
        model_finish(&model);
    }
    snprintf(text, sizeof(text), tail, 1, "", "");
    struct model model = load_glb(text);
    assert_false(model.has_camera);
    model_finish(&model);
}

#define BOXED(extras) \
    "'scenes':[{'nodes':[0,1]}],'nodes':[{'mesh':0},{'name':'walls','extras':" extras \
    "}],'meshes':[" PLAIN "]"

/* Whole numbers, too; whatever else is in the extras. */
static void box(void **state)
{
    (void)state;
    struct model model =
        load_glb(BOXED("{'other':[1,{'a':2}],'firn':{'more':1,'box':[[-1.5,-2,0],[2,3.25,1e3]]}}"));
    assert_true(model.has_box);
    check_vec3(model.box.min, -1.5F, -2, 0);
    check_vec3(model.box.max, 2, 3.25F, 1000);
    model_finish(&model);
    model = load_glb(BOXED("{'firn':{'bax':3},'box':[1]}"));
    assert_false(model.has_box);
    model_finish(&model);
}

/* Loads a model and stores what is logged. */
static enum status load_and_catch(struct model *model, const char *path, char line[static 4096])
{
    fflush(stderr);
    int kept = dup(STDERR_FILENO);
    FILE *caught = tmpfile();
    assert_true(kept >= 0 && caught);
    dup2(fileno(caught), STDERR_FILENO);
    enum status status = model_load(model, path, MODEL_OBJECT);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(caught);
    line[fread(line, 1, 4095, caught)] = '\0';
    fclose(caught);
    return status;
}

/* Loading must fail so, with one line that has `words`, and leave nothing. */
static void check_error(const char *path, enum status expected, const char *words)
{
    const struct model nothing = { 0 };
    struct model model;
    char line[4096];
    memset(&model, 0xff, sizeof(model));
    enum status status = load_and_catch(&model, path, line);
    if (status != expected || !strstr(line, words) || strchr(line, '\n') != line + strlen(line) - 1)
        fail_msg("%s: status %d, not %d with \"%s\": %s", path, (int)status, (int)expected, words,
                 line);
    assert_memory_equal(&model, &nothing, sizeof(model));
}

static void bad_files(void **state)
{
    (void)state;
    uint8_t garbage[600];
    for (size_t i = 0; i < sizeof(garbage); i++)
        garbage[i] = (uint8_t)(i * 167 + 13);
    check_error("/tmp/firn-model-no/such.glb", STATUS_NO_INPUT, "such.glb");
    check_error(folder, STATUS_NO_INPUT, "not a regular file");
    check_error(write_text("e.glb", ""), STATUS_DATA, "empty");
    check_error(write_text("e.unknown", "?"), STATUS_DATA, ".gltf");
    check_error(write_bytes("g.glb", garbage, sizeof(garbage)), STATUS_DATA, "g.glb");
    const char *path = write_glb("whole.glb", ONE_NODE ",'meshes':[" PLAIN "]", &unit_square);
    uint8_t bytes[4096];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, sizeof(bytes), file);
    fclose(file);
    for (size_t cut = 4; cut < size; cut += 200)
        check_error(write_bytes("cut.glb", bytes, cut), STATUS_DATA, "cut.glb");
}

static void bad_numbers(void **state)
{
    (void)state;
    const char *tail = ONE_NODE ",'meshes':[" WITH("0") "],'materials':[{}]";
    struct square square = unit_square;
    square.positions[2][1] = NAN;
    check_error(write_glb("e.glb", tail, &square), STATUS_DATA, "vertex 2: the position");
    square = unit_square;
    square.normals[1][0] = NAN;
    check_error(write_glb("e.glb", tail, &square), STATUS_DATA, "vertex 1: the normal");
    square = unit_square;
    square.uvs[3][0] = INFINITY;
    check_error(write_glb("e.glb", PAINTED, &square), STATUS_DATA, "vertex 3: the texture");
    square = unit_square;
    square.positions[3][2] = -2e6F;
    check_error(write_glb("e.glb", tail, &square), STATUS_DATA, "vertex 3: the position");
    square = unit_square;
    square.indices[4] = 4;
    check_error(write_glb("e.glb", tail, &square), STATUS_DATA, "a vertex that does not exist");
    check_error(write_text("e.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n"), STATUS_DATA, "refers");
    check_error(write_text("e.obj", "v 0 0 0\nv nan 0 0\nv 1 1 0\nf 1 2 3\n"), STATUS_DATA,
                "vertex 1: the position");
    check_error(write_text("e.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), STATUS_DATA, "got none");
    check_error(write_text("e.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                    "property float y\nproperty float z\nelement face 1\n"
                                    "property list uchar int vertex_indices\nend_header\n"
                                    "0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n"),
                STATUS_DATA, "does not exist");
    check_error(
        write_glb("e.glb",
                  "'extensionsUsed':['KHR_materials_transmission','KHR_materials_ior']," ONE_NODE
                  ",'meshes':[" WITH("0") "],'materials':[" GLASS(IOR("4.5")) "]",
                  &unit_square),
        STATUS_DATA, "4.5");
}

static void bad_boxes(void **state)
{
    static const char boxes[] = "[]|7|'a'|{}|[[0,0,0]]|[[0,0,0],[1,1]]|[[0,0,0],[1,1,1,1]]|"
                                "[[0,0,0],[1,1,1],[2,2,2]]|[0,0,0,1,1,1]|[[0,0,0],[1,1,'1']]|"
                                "[[0,0,0],[1,1,true]]|[[0,0,0],[1,0,1]]|[[0,0,2],[1,1,1]]|"
                                "[[0,0,0],[1,1,1e7]]|[[0,0,0],[1,[1],1]]";
    (void)state;
    for (size_t at = 0, length; at < sizeof(boxes); at += length + 1) {
        char text[1024];
        length = strcspn(boxes + at, "|");
        (void)snprintf(text, sizeof(text), BOXED("{'firn':{'box':%.*s}}"), (int)length, boxes + at);
        check_error(write_glb("e.glb", text, &unit_square), STATUS_DATA, "firn.box");
    }
}

/* The model is drawn without them. */
static void bad_textures(void **state)
{
    (void)state;
    const char *tail = ONE_NODE ",'meshes':[" WITH("0") "],'materials':[{" TEXTURED(
        "0") "}],'textures':[{'source':0}],'images':[{%s}]";

    static const struct {
        const char *image, *words;
    } cases[] = {
        { "'uri':'../a.png'", "within" },
        { "'uri':'sub/%2E%2e/a.png'", "within" },
        { "'uri':'/tmp/a.png'", "within" },
        { "'uri':'http://localhost/a.png'", "within" },
        { "'uri':'nowhere.png'", "nowhere.png: file not found" },
        { "'uri':'garbage.png'", "garbage.png: not a supported image" },
        { "'bufferView':4,'mimeType':'image/png'", "images[0]: not a supported image" },
        { "'uri':'cut.png'", "cut.png" },
    };

    char text[1024], line[4096];
    struct model model;
    write_text("garbage.png", "This is not a picture.");
    write_bytes("cut.png", red_over_green_png, 44);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        snprintf(text, sizeof(text), tail, cases[i].image);
        assert_int_equal(load_and_catch(&model, write_glb("e.glb", text, &unit_square), line),
                         STATUS_OK);
        assert_non_null(strstr(line, "drawn without a texture: "));
        assert_non_null(strstr(line, cases[i].words));
        assert_non_null(strstr(model.undrawn_text, cases[i].words));
        for (uint32_t k = 0; k < 4 * model.textures.count; k++)
            assert_int_equal(model.textures.texels[k], 255);
        model_finish(&model);
    }
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    for (int i = 0; i < written_count; i++)
        unlink(written[i]);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_obj),
        cmocka_unit_test(made_normals_are_smooth),
        cmocka_unit_test(gltf_without_normals_is_flat),
        cmocka_unit_test(transforms),
        cmocka_unit_test(transmission_splits),
        cmocka_unit_test(gltf_materials),
        cmocka_unit_test(vertex_colors),
        cmocka_unit_test(textures),
        cmocka_unit_test(smaller_joins_larger),
        cmocka_unit_test(camera),
        cmocka_unit_test(box),
        cmocka_unit_test(bad_boxes),
        cmocka_unit_test(bad_files),
        cmocka_unit_test(bad_numbers),
        cmocka_unit_test(bad_textures),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
