/*
 * test_gltf.c: features of glTF, each compared with values computed by hand or with an equivalent
 * plain file.
 */
#include <cglm/struct.h>
#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/model_avif.h"
#include "tests/support/assertions.h"
#include "tests/support/draco_file.h"
#include "tests/support/gltf_file.h"
#include "tests/support/temporary_folder.h"

/* An octahedron, stretched along x. */
static const float positions[18] = { 2, 0, 0, -2, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1 };
static const uint16_t corners[24] = { 2, 4, 0, 2, 0, 5, 2, 5, 1, 2, 1, 4,
                                      3, 0, 4, 3, 5, 0, 3, 1, 5, 3, 4, 1 };

#define ONE_MESH "'nodes':[{'mesh':0}],'meshes':[{'primitives':["
#define SOLID    "{'attributes':{'POSITION':0},'indices':1}"

/* Loads a file that must be accepted without a word. */
static struct model load(void)
{
    char said[GLTF_FILE_SAID];
    struct model model;
    if (gltf_file_load(&model, said) != STATUS_OK || said[0])
        fail_msg("%s", said);
    return model;
}

static struct model load_plain(void)
{
    gltf_file_begin();
    gltf_file_floats(positions, 6, "VEC3");
    gltf_file_add(corners, sizeof(corners), GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR");
    gltf_file_write(ONE_MESH SOLID "]}]");
    return load();
}

/* The same triangles in the same order, to a tolerance. */
static void check_same(const struct mesh *actual, const struct mesh *wanted, double tolerance)
{
    assert_int_equal(actual->index_count, wanted->index_count);
    for (uint32_t i = 0; i < wanted->index_count; i++) {
        const struct mesh_vertex *a = &actual->vertices[actual->indices[i]];
        const struct mesh_vertex *b = &wanted->vertices[wanted->indices[i]];
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(a->position.raw[k], b->position.raw[k], tolerance);
            CHECK_NEAR(a->normal.raw[k], b->normal.raw[k], tolerance);
        }
    }
}

static void check_like_plain(double tolerance)
{
    struct model model = load();
    struct model plain = load_plain();
    check_same(&model.surroundings, &plain.surroundings, tolerance);
    model_finish(&model);
    model_finish(&plain);
}

static void check_refused(const char *words)
{
    char said[GLTF_FILE_SAID];
    struct model model;
    const enum status status = gltf_file_load(&model, said);
    const size_t length = strlen(said);
    if (status != STATUS_DATA || !strstr(said, words) || strchr(said, '\n') != said + length - 1)
        fail_msg("status %d, not \"%s\": %s", (int)status, words, said);
}

static void quantized(void **state)
{
    (void)state;
    /* 16 bits: 2 of position is 32767, and the node scales by 2 */
    int16_t shorts[6][4] = { { 0 } };
    for (int i = 0; i < 18; i++)
        shorts[i / 3][i % 3] = (int16_t)(positions[i] / 2 * 32767);
    gltf_file_begin();
    gltf_file_accessor(gltf_file_view(shorts, sizeof(shorts), ",'byteStride':8"), GLTF_FILE_SHORT,
                       6, "VEC3", ",'normalized':true");
    gltf_file_add(corners, sizeof(corners), GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR");
    gltf_file_write("'extensionsUsed':['KHR_mesh_quantization'],"
                    "'extensionsRequired':['KHR_mesh_quantization'],"
                    "'nodes':[{'mesh':0,'scale':[2,2,2]}],'meshes':[{'primitives':[" SOLID "]}]");
    check_like_plain(1e-4);
    /* bytes as they are */
    int8_t bytes[6][4] = { { 0 } };
    for (int i = 0; i < 18; i++)
        bytes[i / 3][i % 3] = (int8_t)positions[i];
    gltf_file_begin();
    gltf_file_accessor(gltf_file_view(bytes, sizeof(bytes), ",'byteStride':4"), GLTF_FILE_BYTE, 6,
                       "VEC3", "");
    gltf_file_add(corners, sizeof(corners), GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR");
    gltf_file_write("'extensionsUsed':['KHR_mesh_quantization']," ONE_MESH SOLID "]}]");
    check_like_plain(0);
}

static void sparse(void **state)
{
    (void)state;
    /* an accessor without a view: zeros, all of which are replaced */
    const uint8_t places[6] = { 0, 1, 2, 3, 4, 5 };
    const char *format = ",'sparse':{'count':%d,'indices':{'bufferView':0,'componentType':5121},"
                         "'values':{'bufferView':1}}";
    char text[256];
    gltf_file_begin();
    gltf_file_view(places, sizeof(places), "");
    gltf_file_view(positions, sizeof(positions), "");
    (void)snprintf(text, sizeof(text), format, 6);
    gltf_file_accessor(UINT32_MAX, GLTF_FILE_FLOAT, 6, "VEC3", text);
    gltf_file_add(corners, sizeof(corners), GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR");
    gltf_file_write(ONE_MESH SOLID "]}]");
    check_like_plain(0);
    const uint8_t beyond[6] = { 0, 1, 2, 3, 4, 6 };
    gltf_file_begin();
    gltf_file_view(beyond, sizeof(beyond), "");
    gltf_file_view(positions, sizeof(positions), "");
    gltf_file_accessor(UINT32_MAX, GLTF_FILE_FLOAT, 6, "VEC3", text);
    gltf_file_add(corners, sizeof(corners), GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR");
    gltf_file_write(ONE_MESH SOLID "]}]");
    check_refused("accessors[0].sparse.indices: element 6 is out of range");
}

static void whole_numbers_with_a_point(void **state)
{
    (void)state;
    static const char *const indices[] = { "1.0", "1.5" };
    for (size_t i = 0; i < 2; i++) {
        gltf_file_begin();
        gltf_file_floats(positions, 6, "VEC3");
        gltf_file_add(corners, sizeof(corners), GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR");
        gltf_file_write(ONE_MESH "{'attributes':{'POSITION':0},'indices':%s}]}]", indices[i]);
        if (i == 0)
            check_like_plain(0);
        else
            check_refused("indices: expected an index");
    }
}

/* Compresses both views of the octahedron; `cut` bytes are missing at the end of the first. */
static void write_meshopt(size_t cut, const char *vendor)
{
    unsigned char packed[512];
    uint32_t wide[24];
    for (int i = 0; i < 24; i++)
        wide[i] = corners[i];
    gltf_file_begin();
    size_t size = meshopt_encodeVertexBuffer(packed, sizeof(packed), positions, 6, 12);
    const uint32_t first = gltf_file_view(packed, size - cut, "");
    char text[512];
    (void)snprintf(text, sizeof(text),
                   ",'extensions':{'%s_meshopt_compression':{'buffer':0,'byteOffset':0,"
                   "'byteLength':%zu,'byteStride':12,'count':6,'mode':'ATTRIBUTES'}}",
                   vendor, size - cut);
    const uint32_t at = (uint32_t)((size - cut + 3) & ~(size_t)3);
    size = meshopt_encodeIndexBuffer(packed, sizeof(packed), wide, 24);
    gltf_file_accessor(gltf_file_view(packed, 72, text), GLTF_FILE_FLOAT, 6, "VEC3", "");
    assert_int_equal(first, 0);
    const uint32_t after = at + 72;
    (void)snprintf(text, sizeof(text),
                   ",'extensions':{'%s_meshopt_compression':{'buffer':0,'byteOffset':%u,"
                   "'byteLength':%zu,'byteStride':4,'count':24,'mode':'TRIANGLES'}}",
                   vendor, after, size);
    gltf_file_accessor(gltf_file_view(packed, size, text), GLTF_FILE_UNSIGNED_INT, 24, "SCALAR",
                       "");
    gltf_file_write("'extensionsUsed':['%s_meshopt_compression'],"
                    "'extensionsRequired':['%s_meshopt_compression']," ONE_MESH SOLID "]}]",
                    vendor, vendor);
}

static int compare(const float *a, const float *b, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (a[i] < b[i] || a[i] > b[i])
            return a[i] < b[i] ? -1 : 1;
    }
    return 0;
}

static int compare_triangles(const void *a, const void *b)
{
    return compare(a, b, 9);
}

/* Fills in the corners of the triangles, which are in any order and begin anywhere. */
static void list_triangles(const struct mesh *mesh, float (*triangles)[9])
{
    for (size_t i = 0; i < mesh->index_count / 3; i++) {
        const float *corner[3];
        size_t first = 0; /* the greatest */
        for (size_t k = 0; k < 3; k++) {
            corner[k] = mesh->vertices[mesh->indices[3 * i + k]].position.raw;
            if (compare(corner[k], corner[first], 3) > 0)
                first = k;
        }
        for (size_t k = 0; k < 3; k++)
            memcpy(&triangles[i][3 * k], corner[(first + k) % 3], 3 * sizeof(float));
    }
    qsort(triangles, mesh->index_count / 3, sizeof(*triangles), compare_triangles);
}

static void check_same_triangles(void)
{
    float actual[8][9], wanted[8][9];
    struct model model = load();
    struct model plain = load_plain();
    assert_int_equal(model.surroundings.index_count, 24);
    list_triangles(&model.surroundings, actual);
    list_triangles(&plain.surroundings, wanted);
    assert_int_equal(compare(actual[0], wanted[0], sizeof(wanted) / sizeof(float)), 0);
    model_finish(&model);
    model_finish(&plain);
}

static void meshopt(void **state)
{
    (void)state;
    write_meshopt(0, "EXT");
    check_same_triangles();
    write_meshopt(0, "KHR");
    check_same_triangles();
    write_meshopt(9, "EXT");
    check_refused("EXT_meshopt_compression: the compressed data is damaged");
}

static void write_draco(size_t cut)
{
    uint8_t packed[1024];
    const size_t size = draco_file_encode(positions, 6, corners, 24, packed, sizeof(packed));
    gltf_file_begin();
    gltf_file_view(packed, size - cut, "");
    gltf_file_accessor(UINT32_MAX, GLTF_FILE_FLOAT, 6, "VEC3", "");
    gltf_file_accessor(UINT32_MAX, GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR", "");
    gltf_file_write(
        "'extensionsUsed':['KHR_draco_mesh_compression'],"
        "'extensionsRequired':['KHR_draco_mesh_compression']," ONE_MESH
        "{'attributes':{'POSITION':0},'indices':1,'extensions':{"
        "'KHR_draco_mesh_compression':{'bufferView':0,'attributes':{'POSITION':0}}}}]}]");
}

static void draco(void **state)
{
    (void)state;
    write_draco(0);
    check_same_triangles();
    write_draco(20);
    check_refused("KHR_draco_mesh_compression: the compressed data is damaged");
}

static void instances(void **state)
{
    (void)state;
    const float moves[6] = { 10, 0, 0, 0, 20, 0 };
    const float turns[8] = { 0, 0, 0, 1, 0, 0, sqrtf(0.5F), sqrtf(0.5F) }; /* a quarter about +Z */
    const float scales[6] = { 1, 1, 1, 2, 2, 2 };
    gltf_file_begin();
    gltf_file_floats(positions, 6, "VEC3");
    gltf_file_add(corners, sizeof(corners), GLTF_FILE_UNSIGNED_SHORT, 24, "SCALAR");
    gltf_file_floats(moves, 2, "VEC3");
    gltf_file_floats(turns, 2, "VEC4");
    gltf_file_floats(scales, 2, "VEC3");
    gltf_file_write("'extensionsUsed':['EXT_mesh_gpu_instancing'],"
                    "'nodes':[{'mesh':0,'translation':[0,0,100],'extensions':{"
                    "'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':2,'ROTATION':3,"
                    "'SCALE':4}}}}],'meshes':[{'primitives':[" SOLID "]}]");
    struct model model = load();
    assert_int_equal(model.surroundings.index_count, 48);
    const struct mesh_vertex *v = model.surroundings.vertices;
    const uint32_t *i = model.surroundings.indices;
    /* corner 2 is (2 0 0): moved; and scaled, turned to +Y, moved */
    CHECK_NEAR(v[i[2]].position.x, 12, 1e-5);
    CHECK_NEAR(v[i[2]].position.z, 100, 1e-5);
    CHECK_NEAR(v[i[26]].position.x, 0, 1e-5);
    CHECK_NEAR(v[i[26]].position.y, 24, 1e-5);
    model_finish(&model);
}

static void strips_and_fans(void **state)
{
    (void)state;
    /* a unit square, seen from +Z, as a strip and as a fan */
    const float strip[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 };
    const uint8_t fan[4] = { 0, 1, 3, 2 };
    gltf_file_begin();
    gltf_file_floats(strip, 4, "VEC3");
    gltf_file_add(fan, sizeof(fan), GLTF_FILE_UNSIGNED_BYTE, 4, "SCALAR");
    gltf_file_write(ONE_MESH "{'attributes':{'POSITION':0},'mode':5},"
                             "{'attributes':{'POSITION':0},'indices':1,'mode':6}]}]");
    struct model model = load();
    assert_int_equal(model.surroundings.index_count, 12);
    for (uint32_t i = 0; i < 12; i += 3) {
        const struct mesh_vertex *v = model.surroundings.vertices;
        const uint32_t *c = &model.surroundings.indices[i];
        const vec3s normal = glms_vec3_cross(glms_vec3_sub(v[c[1]].position, v[c[0]].position),
                                             glms_vec3_sub(v[c[2]].position, v[c[0]].position));
        CHECK_NEAR(normal.z, 1, 1e-6);
    }
    model_finish(&model);
}

static void materials(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    const char *material =
        "'name':'paint','alphaMode':'MASK','alphaCutoff':0.25,'doubleSided':true,"
        "'emissiveFactor':[1,0.5,0],'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,0.75],"
        "'metallicFactor':0.125,'roughnessFactor':0.375},'extras':{'priority':-7,'film':true},"
        "'extensions':{"
        "'KHR_materials_emissive_strength':{'emissiveStrength':8},"
        "'KHR_materials_specular':{'specularFactor':0.5,'specularColorFactor':[1,2,3]},"
        "'KHR_materials_clearcoat':{'clearcoatFactor':0.75,'clearcoatRoughnessFactor':0.25},"
        "'KHR_materials_ior':{'ior':1.25},'KHR_materials_dispersion':{'dispersion':0.5},"
        "'KHR_materials_volume':{'thicknessFactor':2,'attenuationDistance':4,"
        "'attenuationColor':[0.5,0.25,0.125]}}";
    assert_int_equal(gltf_file_material(&model, material, "", said), STATUS_OK);
    const struct material *m = &model.materials[0];
    assert_string_equal(m->name, "paint");
    assert_int_equal(m->flags, MATERIAL_IS_CUTOUT | MATERIAL_IS_TWO_SIDED | MATERIAL_HAS_IOR |
                                   MATERIAL_HAS_PRIORITY | MATERIAL_IS_WATER_LAYER);
    assert_int_equal(m->priority, -7);
    const float numbers[][2] = {
        { m->base_color.x, 0.5F },
        { m->base_color.y, 0.25F },
        { m->base_color.z, 1 },
        { m->alpha, 0.75F },
        { m->alpha_cutoff, 0.25F },
        { m->metallic, 0.125F },
        { m->roughness, 0.375F },
        { m->emission.x, 8 },
        { m->emission.y, 4 },
        { m->emission.z, 0 },
        { m->specular, 0.5F },
        { m->specular_color.y, 2 },
        { m->ior, 1.25F },
        { m->dispersion, 0.5F },
        { m->thickness, 2 },
        { m->transmission, 0 },
        { m->attenuation_distance, 4 },
        { m->attenuation_color.z, 0.125F },
        { m->normal_scale, 1 },
        { m->occlusion_strength, 1 },
        { m->coat, 0.75F },
        { m->coat_roughness, 0.25F },
    };
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++)
        CHECK_NEAR((double)numbers[i][0], (double)numbers[i][1], 0);
    for (uint32_t i = 0; i < model.surroundings.vertex_count; i++)
        assert_int_equal(model.surroundings.vertices[i].material >> MESH_SURFACE_SHIFT, 1);
    model_finish(&model);
    assert_string_equal(said, "");
}

static void material_defaults(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    assert_int_equal(gltf_file_material(&model, "", "", said), STATUS_OK);
    const struct material *m = &model.materials[0];
    assert_int_equal(m->flags, 0);
    const float numbers[][2] = {
        { m->ior, 1.5F },          { m->metallic, 1 },   { m->roughness, 1 },
        { m->transmission, 0 },    { m->alpha, 1 },      { m->attenuation_distance, 0 },
        { m->thickness, 0 },       { m->emission.x, 0 }, { m->specular, 1 },
        { m->alpha_cutoff, 0.5F },
    };
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++)
        CHECK_NEAR((double)numbers[i][0], (double)numbers[i][1], 0);
    model_finish(&model);
    assert_string_equal(said, "");
    assert_int_equal(gltf_file_material(&model,
                                        "'extensions':{'KHR_materials_ior':{'ior':0}},"
                                        "'alphaMode':'BLEND'",
                                        "", said),
                     STATUS_OK);
    assert_int_equal(model.materials[0].flags, MATERIAL_IS_LEGACY | MATERIAL_IS_BLENDED);
    CHECK_NEAR(model.materials[0].ior, 1.5, 0);
    model_finish(&model);
}

/* A TGA of one texel, 188 of 255 in each channel. */
#define PIXEL "data:image/x-tga;base64,AAACAAAAAAAAAAAAAQABABggvLy8"
#define TEXTURES \
    ",'samplers':[{'wrapS':33071,'wrapT':33648}],'textures':[{'source':0},{'source':0," \
    "'sampler':0}],'images':[{'uri':'" PIXEL "'}]"

static void textures_of_materials(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    /* the base colour: twice as large, a quarter turned, moved; the normal: as it is */
    const char *material =
        "'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':1,'extensions':{"
        "'KHR_texture_transform':{'offset':[10,20],'scale':[2,2],'rotation':1.57079633}}}},"
        "'normalTexture':{'index':1,'texCoord':1,'scale':0.5},'emissiveTexture':{'index':0,"
        "'texCoord':1},'occlusionTexture':{'index':0},'extensions':{'KHR_materials_specular':{"
        "'specularTexture':{'index':0,'texCoord':2}}}";
    assert_int_equal(gltf_file_material(&model, material, TEXTURES, said), STATUS_OK);
    const struct material *m = &model.materials[0];
    assert_int_equal(model.textures.count, 1);
    assert_int_equal(model.numbers.count, 1);
    assert_int_equal(m->textures[MATERIAL_BASE_COLOR].layer, 1);
    assert_int_equal(m->textures[MATERIAL_NORMAL].layer, 1);
    assert_int_equal(m->textures[MATERIAL_EMISSION].layer, 1);
    assert_int_equal(m->textures[MATERIAL_OCCLUSION].layer, 1);
    assert_int_equal(m->textures[MATERIAL_OCCLUSION].uv_set, 1); /* another set of coordinates */
    assert_int_equal(m->textures[MATERIAL_EMISSION].uv_set, 0);
    assert_int_equal(m->textures[MATERIAL_SPECULAR].layer, 0); /* a third one */
    assert_int_equal(m->textures[MATERIAL_NORMAL].wrap_u, MATERIAL_CLAMP);
    assert_int_equal(m->textures[MATERIAL_NORMAL].wrap_v, MATERIAL_MIRROR);
    CHECK_NEAR(m->normal_scale, 0.5, 0);
    const struct mesh *mesh = &model.surroundings;
    static const float wanted[3][2] = { { 10, 20 }, { 10, 18 }, { 12, 20 } };
    for (int i = 0; i < 3; i++) { /* of corners whose coordinates are (0 0), (1 0), (0 1) */
        const vec2s uv = mesh->vertices[mesh->indices[i]].uv;
        const vec3s in = { { uv.x, uv.y, 1 } };
        CHECK_NEAR(uv.x, wanted[i][0], 1e-5);
        CHECK_NEAR(uv.y, wanted[i][1], 1e-5);
        CHECK_NEAR(mesh->extras[mesh->indices[i]].uv.x, i == 1, 0);
        CHECK_NEAR(glms_vec3_dot(m->textures[MATERIAL_NORMAL].u_row, in), i == 1, 1e-5);
        CHECK_NEAR(glms_vec3_dot(m->textures[MATERIAL_NORMAL].v_row, in), i == 2, 1e-5);
    }
    model_finish(&model);
    assert_string_equal(said, "firn: warning: m.gltf: not drawn: textures with a third texture "
                              "coordinate set\n");
}

/* A texture without `source`; the image has a red and a half transparent blue texel. */
static void webp_textures(void **state)
{
    (void)state;
    static const uint8_t texels[2][4] = { { 255, 0, 0, 255 }, { 0, 0, 255, 128 } };
    char said[GLTF_FILE_SAID];
    struct model model;
    assert_int_equal(
        gltf_file_material(
            &model, "'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}",
            ",'extensionsRequired':['EXT_texture_webp','KHR_texture_basisu'],'textures':[{"
            "'extensions':{'EXT_texture_webp':{'source':0}}}],'images':[{'uri':'data:image/webp;"
            "base64,UklGRiAAAABXRUJQVlA4TBMAAAAvAQAAEA8Q+z//D/yPChWI6H8AAA=='}]",
            said),
        STATUS_OK);
    assert_int_equal(model.textures.size, 2);
    assert_memory_equal(model.textures.texels, texels[0], 4);
    assert_memory_equal(&model.textures.texels[4], texels[1], 4);
    model_finish(&model);
    assert_string_equal(said, "firn: warning: m.gltf: the extension KHR_texture_basisu is not "
                              "supported and is ignored\n");
}

/* The same with an image of one colour, which is preferred over that of EXT_texture_webp. */
static void avif_textures(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    if (!model_avif_is_built())
        skip();
    assert_int_equal(
        gltf_file_material(
            &model, "'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}",
            ",'extensionsRequired':['EXT_texture_avif'],'textures':[{'extensions':{"
            "'EXT_texture_webp':{'source':1},'EXT_texture_avif':{'source':0}}}],'images':[{'uri':"
            "'data:image/avif;base64,"
            "AAAAIGZ0eXBhdmlmAAAAAGF2aWZtaWYxbWlhZk1BMUEAAADybWV0YQAAAAAAAAAoaGRscg"
            "AAAAAAAAAAcGljdAAAAAAAAAAAAAAAAGxpYmF2aWYAAAAADnBpdG0AAAAAAAEAAAAeaWxv"
            "YwAAAABEAAABAAEAAAABAAABGgAAACAAAAAoaWluZgAAAAAAAQAAABppbmZlAgAAAAABAA"
            "BhdjAxQ29sb3IAAAAAamlwcnAAAABLaXBjbwAAABRpc3BlAAAAAAAAAAQAAAAEAAAAEHBp"
            "eGkAAAAAAwgICAAAAAxhdjFDgSAAAAAAABNjb2xybmNseAABAA0ABoAAAAAXaXBtYQAAAA"
            "AAAAABAAEEAQKDBAAAAChtZGF0EgAKCDgEf5QENBpAMhIRQAAAQAAAV7LtHAxKkTFA5YQ="
            "'},{'uri':'none.webp'}]",
            said),
        STATUS_OK);
    assert_int_equal(model.textures.size, 4);
    for (size_t i = 0; i < 16; i++) {
        const uint8_t *texel = &model.textures.texels[4 * i];
        assert_in_range(texel[0], 198, 202);
        assert_in_range(texel[1], 28, 32);
        assert_in_range(texel[2], 58, 62);
        assert_int_equal(texel[3], 255);
    }
    model_finish(&model);
    assert_string_equal(said, "");
}

static void attenuation_without_distance(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    assert_int_equal(gltf_file_material(&model,
                                        "'extensions':{'KHR_materials_transmission':{"
                                        "'transmissionFactor':1},'KHR_materials_volume':{"
                                        "'attenuationDistance':0,'attenuationColor':[0,0,0]}}",
                                        "", said),
                     STATUS_OK);
    CHECK_NEAR(material_absorption(&model.materials[0]).x, 0, 0);
    model_finish(&model);
    assert_string_equal(said,
                        "firn: warning: m.gltf: not drawn: attenuation with a distance of 0\n");
}

static void unread_pictures(void **state)
{
    (void)state;
    static const char ktx[] = "\xabKTX 20\xbb\r\n\x1a\n";
    char said[GLTF_FILE_SAID];
    struct model model;
    FILE *file = fopen("a.ktx2", "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(ktx, 1, sizeof(ktx), file), sizeof(ktx));
    assert_int_equal(fclose(file), 0);
    assert_int_equal(gltf_file_material(&model,
                                        "'pbrMetallicRoughness':{'roughnessFactor':0.5,"
                                        "'metallicRoughnessTexture':{'index':0}}",
                                        ",'textures':[{'source':0}],'images':[{'uri':'a.ktx2'}]",
                                        said),
                     STATUS_OK);
    assert_int_equal(model.materials[0].textures[MATERIAL_METALLIC_ROUGHNESS].layer, 0);
    assert_int_equal(model.numbers.count, 0);
    CHECK_NEAR(model.materials[0].roughness, 0.5, 0);
    model_finish(&model);
    assert_string_equal(said, "firn: warning: m.gltf: not drawn: textures without an image in a "
                              "supported format\n");
}

/* Files that need an extension may have buffers without bytes, which nothing else may read. */
static void buffers_without_bytes(void **state)
{
    (void)state;
    static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    char said[GLTF_FILE_SAID];
    struct model model;
    for (int i = 0; i < 2; i++) {
        gltf_file_begin();
        gltf_file_floats(triangle, 3, "VEC3");
        gltf_file_write("'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}"
                        "}]}],'buffers':[{'uri':'m.bin','byteLength':36},{'byteLength':36}],"
                        "'bufferViews':[{'buffer':%d,'byteLength':36}]",
                        i);
        assert_int_equal(gltf_file_load(&model, said), i ? STATUS_DATA : STATUS_OK);
        model_finish(&model);
    }
    assert_non_null(strstr(said, "within buffers[1] of 0 bytes"));
}

/* A file without materials becomes ice, which has no colours. */
static void colors_of_ice(void **state)
{
    (void)state;
    static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    struct model model;
    gltf_file_begin();
    gltf_file_floats(triangle, 3, "VEC3");
    gltf_file_write("'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0,"
                    "'COLOR_0':0}}]}]");
    for (int is_asked_for = 0; is_asked_for < 2; is_asked_for++) {
        const enum model_role part = is_asked_for ? MODEL_OBJECT : MODEL_BY_MATERIALS;
        assert_int_equal(model_load(&model, "m.gltf", part), STATUS_OK);
        assert_int_equal(model.undrawn == 0, is_asked_for);
        model_finish(&model);
    }
}

static void extensions_are_named(void **state)
{
    (void)state;
    char said[GLTF_FILE_SAID];
    struct model model;
    assert_int_equal(gltf_file_material(&model, "",
                                        ",'extensionsUsed':['KHR_a','KHR_materials_ior','KHR_b']",
                                        said),
                     STATUS_OK);
    model_finish(&model);
    assert_string_equal(said, "firn: warning: m.gltf: the extension KHR_a is not supported and "
                              "is ignored\nfirn: warning: m.gltf: the extension KHR_b is not "
                              "supported and is ignored\n");
    assert_int_equal(gltf_file_material(&model, "",
                                        ",'extensionsUsed':['KHR_a'],"
                                        "'extensionsRequired':['KHR_materials_ior','KHR_a']",
                                        said),
                     STATUS_DATA);
    assert_string_equal(said, "firn: m.gltf: requires the extension KHR_a, which is not supported; "
                              "export the file without it\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(quantized, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(sparse, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(whole_numbers_with_a_point, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(meshopt, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(draco, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(instances, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(strips_and_fans, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(materials, temporary_folder_enter, temporary_folder_leave),
        cmocka_unit_test_setup_teardown(material_defaults, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(textures_of_materials, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(avif_textures, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(webp_textures, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(attenuation_without_distance, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(unread_pictures, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(buffers_without_bytes, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(colors_of_ice, temporary_folder_enter,
                                        temporary_folder_leave),
        cmocka_unit_test_setup_teardown(extensions_are_named, temporary_folder_enter,
                                        temporary_folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
