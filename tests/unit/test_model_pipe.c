/*
 * test_model_pipe.c: models through the reader's pipe: round trip, and rejection of invalid data.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/model_pipe.h"
#include "tests/support/assertions.h"
#include "tests/support/memory_pipe.h"

enum {
    /* where things are in the stream of make_model() */
    OBJECT_COUNT_AT = 4 + offsetof(struct model, object_count),
    MATERIAL_COUNT_AT = 4 + offsetof(struct model, material_count),
    TEXTURE_SIZE_AT = 4 + offsetof(struct model, textures.size),
    TEXTURE_COUNT_AT = 4 + offsetof(struct model, textures.count),
    NUMBER_SIZE_AT = 4 + offsetof(struct model, numbers.size),
    NUMBER_COUNT_AT = 4 + offsetof(struct model, numbers.count),
    CAMERA_COUNT_AT = 4 + offsetof(struct model, camera_count),
    LIGHT_COUNT_AT = 4 + offsetof(struct model, light_count),
    EXTENSION_COUNT_AT = 4 + offsetof(struct model, extension_count),
    UNDRAWN_AT = 4 + offsetof(struct model, undrawn),
    WORDS_AT = 4 + offsetof(struct model, undrawn_text),
    ANIMATION_COUNT_AT = 4 + offsetof(struct model, animation_count),
    ANIMATION_AT = 4 + offsetof(struct model, animation),
    CAMERA_AT = 4 + offsetof(struct model, camera),
    IOR_AT = 4 + offsetof(struct model, ior),
    BOX_AT = 4 + offsetof(struct model, box),
    OPAQUE_COUNT_AT = 4 + offsetof(struct model, surroundings_object_count),
    ORIGIN_AT = 4 + offsetof(struct model, origin),
    VERTICES_AT = 4 + sizeof(struct model),
    VERTEX_SIZE = 48,
    INDICES_AT = VERTICES_AT + 4 * VERTEX_SIZE,
    MESH_SIZE = 4 * VERTEX_SIZE + 6 * 4,
    EXTRAS_AT = VERTICES_AT + 2 * MESH_SIZE, /* of the surroundings */
    EXTRA_SIZE = 24,
    MATERIALS_AT = EXTRAS_AT + 4 * EXTRA_SIZE,
    OBJECTS_AT = MATERIALS_AT + 2 * (int)sizeof(struct material),
    CAMERAS_AT = OBJECTS_AT + 2 * (int)sizeof(struct object),
    LIGHTS_AT = CAMERAS_AT + 2 * (int)sizeof(struct model_camera),
    EXTENSIONS_AT = LIGHTS_AT + 2 * (int)sizeof(struct light),
    ANIMATIONS_AT = EXTENSIONS_AT + (int)sizeof(struct model_extension),
    STARTS_AT = ANIMATIONS_AT + 2 * (int)sizeof(struct model_animation),
};

static struct mesh make_square(uint32_t material)
{
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    struct mesh mesh;
    assert_true(mesh_init(&mesh, 4, 6));
    memcpy(mesh.indices, corners, sizeof(corners));
    for (uint32_t i = 0; i < 4; i++) {
        mesh.vertices[i] = (struct mesh_vertex){
            .position = { { (float)(i % 2), (float)(i > 1), 0 } },
            .normal = { { 0, 0, 1 } },
            .color = { { 0.25F, 0.5F, material & MESH_UNLIT ? 4 : 1 } },
            .uv = { { 3, -1 } },
            .material = material,
        };
    }
    return mesh;
}

static void add_objects(struct model *model)
{
    model->objects = calloc(2, sizeof(*model->objects));
    model->materials = calloc(2, sizeof(*model->materials));
    assert_true(model->objects && model->materials);
    model->object_count = 2;
    model->material_count = 2;
    for (uint32_t i = 0; i < 2; i++) {
        model->objects[i] = (struct object){ "half", 3 * i, 3, .material = 1 - i };
        model->materials[i] = material_make("glass");
    }
}

/* A perspective and an orthographic one. */
static void add_cameras(struct model *model)
{
    const struct camera camera = { .eye = { { 1, 2, 3 } }, .up = { { 0, 1, 0 } }, .fov_deg = 40 };
    model->cameras = calloc(2, sizeof(*model->cameras));
    assert_non_null(model->cameras);
    model->camera_count = 2;
    model->cameras[0] = (struct model_camera){ .name = "left", .camera = camera };
    model->cameras[1] = (struct model_camera){
        .name = "flat", .kind = MODEL_ORTHOGRAPHIC, .height = 2, .camera = camera
    };
}

/* A point, and a spot. */
static void add_lights(struct model *model)
{
    model->lights = calloc(2, sizeof(*model->lights));
    assert_non_null(model->lights);
    model->light_count = 2;
    for (uint32_t i = 0; i < 2; i++)
        model->lights[i] = (struct light){ .name = "lamp",
                                           .kind = LIGHT_POINT + i,
                                           .direction = { { 0, 1, 0 } },
                                           .intensity = 7,
                                           .outer_cone = (float)i };
}

static void add_extension(struct model *model)
{
    model->extensions = calloc(1, sizeof(*model->extensions));
    assert_non_null(model->extensions);
    model->extension_count = 1;
    model->extensions[0] = (struct model_extension){ "EXT_any", MODEL_IGNORED };
    model->undrawn = 5;
    strcpy(model->undrawn_text, "disp\nedges\n");
}

static void add_extras(struct mesh *mesh)
{
    assert_true(mesh_add_extras(mesh));
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        mesh->extras[i] = (struct mesh_extra){ { { 1, 0, 0 } }, -1, { { 7, (float)i } } };
}

static void add_animations(struct model *model)
{
    model->animations = calloc(2, sizeof(*model->animations));
    assert_non_null(model->animations);
    model->animation_count = 2;
    model->animation = 2;
    model->animations[1] = (struct model_animation){ "walk", 1.5F };
}

static const uint8_t texel_numbers[4] = { 9, 8, 7, 6 };

static struct model make_model(void)
{
    struct model model = {
        .object = make_square(MESH_UNLIT),
        .surroundings = make_square(MESH_CUTOUT | 2),
        .textures = { .texels = malloc(32), .size = 2, .count = 2 },
        .numbers = { .texels = malloc(4), .size = 1, .count = 1 },
        .camera = { .eye = { { 1, 2, 3 } }, .up = { { 0, 1, 0 } }, .fov_deg = 40 },
        .ior = 1.5F,
        .box = { .max = { { 1, 2, 3 } } },
        .has_camera = true,
        .has_box = true,
        .has_ior = true,
    };
    add_extras(&model.surroundings);
    add_objects(&model);
    add_cameras(&model);
    add_lights(&model);
    add_extension(&model);
    add_animations(&model);
    assert_true(model_surroundings_add_object(&model, "floor", 0) &&
                model_surroundings_add_object(&model, "wall", 3));
    assert_true(model.textures.texels && model.numbers.texels);
    memcpy(model.numbers.texels, texel_numbers, sizeof(texel_numbers));
    for (uint8_t i = 0; i < 32; i++)
        model.textures.texels[i] = i;
    return model;
}

static struct memory_pipe make_stream(void)
{
    struct memory_pipe stream = { .size = 0 };
    struct model model = make_model();
    assert_true(model_pipe_write_model(&(struct pipe_sink){ memory_pipe_write, &stream }, &model));
    model_finish(&model);
    return stream;
}

static enum pipe_fault read_model(struct memory_pipe *stream, struct model *model)
{
    const struct pipe_source source = { memory_pipe_read, stream, MEMORY_PIPE_SIZE };
    return model_pipe_read_model(&source, model);
}

static void check_mesh(const struct mesh *mesh, const struct mesh *wanted)
{
    assert_int_equal(mesh->vertex_count, wanted->vertex_count);
    assert_int_equal(mesh->index_count, wanted->index_count);
    assert_memory_equal(mesh->vertices, wanted->vertices,
                        mesh->vertex_count * sizeof(*mesh->vertices));
    assert_memory_equal(mesh->indices, wanted->indices, mesh->index_count * sizeof(uint32_t));
    assert_int_equal(!mesh->extras, !wanted->extras);
    if (mesh->extras)
        assert_memory_equal(mesh->extras, wanted->extras,
                            mesh->vertex_count * sizeof(*mesh->extras));
}

static void model_comes_through(void **state)
{
    (void)state;
    struct memory_pipe stream = make_stream();
    struct model wanted = make_model(), model;
    assert_int_equal(read_model(&stream, &model), PIPE_OK);
    assert_int_equal(stream.at, stream.size);
    check_mesh(&model.object, &wanted.object);
    check_mesh(&model.surroundings, &wanted.surroundings);
    assert_int_equal(model.textures.size, 2);
    assert_int_equal(model.textures.count, 2);
    assert_memory_equal(model.textures.texels, wanted.textures.texels, 32);
    assert_int_equal(model.numbers.size, 1);
    assert_int_equal(model.numbers.count, 1);
    assert_memory_equal(model.numbers.texels, texel_numbers, sizeof(texel_numbers));
    assert_int_equal(model.object_count, 2);
    assert_int_equal(model.material_count, 2);
    assert_memory_equal(model.objects, wanted.objects, 2 * sizeof(struct object));
    assert_memory_equal(model.materials, wanted.materials, 2 * sizeof(struct material));
    assert_int_equal(model.camera_count, 2);
    assert_memory_equal(model.cameras, wanted.cameras, 2 * sizeof(struct model_camera));
    assert_int_equal(model.light_count, 2);
    assert_memory_equal(model.lights, wanted.lights, 2 * sizeof(struct light));
    assert_int_equal(model.extension_count, 1);
    assert_memory_equal(model.extensions, wanted.extensions, sizeof(struct model_extension));
    assert_int_equal(model.undrawn, 5);
    assert_string_equal(model.undrawn_text, "disp\nedges\n");
    assert_int_equal(model.animation_count, 2);
    assert_int_equal(model.animation, 2);
    assert_memory_equal(model.animations, wanted.animations, 2 * sizeof(struct model_animation));
    assert_int_equal(model.surroundings_object_count, 2);
    assert_memory_equal(model.surroundings_starts, wanted.surroundings_starts,
                        MODEL_SURROUNDINGS_ROW * sizeof(*model.surroundings_starts));
    assert_string_equal(model.surroundings_names[1], "wall");
    assert_memory_equal(&model.camera, &wanted.camera, sizeof(wanted.camera));
    CHECK_NEAR(model.ior, 1.5, 1e-6);
    assert_memory_equal(&model.box, &wanted.box, sizeof(wanted.box));
    assert_true(model.has_camera && model.has_ior && model.has_box);
    model_finish(&model);
    model_finish(&wanted);
}

/* A copy owns its arrays. Its message in the pipe is bit-identical except for pointers. */
static void models_are_copied(void **state)
{
    (void)state;
    struct memory_pipe stream = { .size = 0 };
    struct model from = make_model(), copy;
    assert_true(model_copy(&copy, &from));
    assert_ptr_not_equal(copy.surroundings_names, from.surroundings_names);
    model_finish(&from);
    assert_true(model_pipe_write_model(&(struct pipe_sink){ memory_pipe_write, &stream }, &copy));
    const struct memory_pipe wanted = make_stream();
    assert_int_equal(stream.size, wanted.size);
    assert_memory_equal(&stream.bytes[VERTICES_AT], &wanted.bytes[VERTICES_AT],
                        stream.size - VERTICES_AT);
    model_finish(&copy);
}

/* With `size` bytes at `at` replaced it is refused so, and nothing is left of it. */
static void refuse(size_t at, const void *bytes, size_t size, enum pipe_fault wanted)
{
    const struct model nothing = { 0 };
    struct memory_pipe stream = make_stream();
    struct model model;
    memset(&model, 0xff, sizeof(model));
    memcpy(stream.bytes + at, bytes, size);
    const enum pipe_fault fault = read_model(&stream, &model);
    if (fault != wanted)
        fail_msg("at %zu: %s, not %s", at, pipe_fault_text(fault), pipe_fault_text(wanted));
    assert_memory_equal(&model, &nothing, sizeof(model));
}

static void refuse_word(size_t at, uint32_t word, enum pipe_fault wanted)
{
    refuse(at, &word, sizeof(word), wanted);
}

static void refuse_number(size_t at, float number, enum pipe_fault wanted)
{
    refuse(at, &number, sizeof(number), wanted);
}

static void heads_are_checked(void **state)
{
    static const size_t counts[] = {
        4 + offsetof(struct model, object.vertex_count),
        4 + offsetof(struct model, object.index_count),
        4 + offsetof(struct model, surroundings.vertex_count),
        4 + offsetof(struct model, surroundings.index_count),
    };
    static const size_t flags[] = {
        4 + offsetof(struct model, has_camera),
        4 + offsetof(struct model, has_box),
        4 + offsetof(struct model, has_ior),
    };
    (void)state;
    refuse_word(0, 0x464c457f, PIPE_HEAD);
    for (size_t i = 0; i < sizeof(flags) / sizeof(flags[0]); i++)
        refuse(flags[i], &(unsigned char){ 2 }, 1, PIPE_CAMERA);
    for (size_t i = 0; i < sizeof(counts) / sizeof(counts[0]); i++) {
        refuse_word(counts[i], UINT32_MAX, PIPE_SIZE);
        refuse_word(counts[i], 0, PIPE_SIZE);
        refuse_word(counts[i], 1u << 28, PIPE_SIZE);
    }
    refuse_word(counts[1], 5, PIPE_SIZE);
    refuse_word(TEXTURE_SIZE_AT, 3, PIPE_SIZE);
    refuse_word(TEXTURE_SIZE_AT, 0, PIPE_SIZE);
    refuse_word(TEXTURE_SIZE_AT, 4096, PIPE_SIZE);
    refuse_word(TEXTURE_SIZE_AT, 2048, PIPE_SIZE);
    refuse_word(TEXTURE_COUNT_AT, 0, PIPE_SIZE);
    refuse_word(TEXTURE_COUNT_AT, 4097, PIPE_SIZE);
    refuse_word(NUMBER_SIZE_AT, 3, PIPE_SIZE);
    refuse_word(NUMBER_SIZE_AT, 2048, PIPE_SIZE);
    refuse_word(NUMBER_COUNT_AT, 0, PIPE_SIZE);
}

static void cameras_are_checked(void **state)
{
    (void)state;
    for (size_t i = 0; i < 12; i++) {
        refuse_number(CAMERA_AT + 4 * i, NAN, PIPE_CAMERA);
        refuse_number(CAMERA_AT + 4 * i, INFINITY, PIPE_CAMERA);
    }
    refuse_number(CAMERA_AT + 36, 180, PIPE_CAMERA);
    refuse_number(CAMERA_AT + 36, 0, PIPE_CAMERA);
    refuse_number(CAMERA_AT + 40, 1, PIPE_CAMERA);
    refuse_number(CAMERA_AT + 44, 1, PIPE_CAMERA);
    refuse(CAMERA_AT, &(vec3s){ { 0, 0, 0 } }, sizeof(vec3s), PIPE_CAMERA);
    refuse_number(IOR_AT, NAN, PIPE_CAMERA);
    refuse_number(IOR_AT, 0.9F, PIPE_CAMERA);
    for (size_t i = 0; i < 6; i++)
        refuse_number(BOX_AT + 4 * i, NAN, PIPE_CAMERA);
    refuse_number(BOX_AT, 1, PIPE_CAMERA); /* no wider than nothing */
    refuse_number(BOX_AT + 12, 2e6F, PIPE_CAMERA);
    for (size_t i = 0; i < 3; i++) {
        refuse_word(ORIGIN_AT + 8 * i + 4, 0x7ff80000, PIPE_CAMERA); /* NaN */
        refuse_word(ORIGIN_AT + 8 * i + 4, 0x42000000, PIPE_CAMERA); /* 8.6e9 */
    }
}

static void listed_cameras_are_checked(void **state)
{
    const size_t second = CAMERAS_AT + sizeof(struct model_camera);
    const size_t camera = CAMERAS_AT + offsetof(struct model_camera, camera);
    char endless[MATERIAL_NAME_SIZE];
    (void)state;
    memset(endless, 'x', sizeof(endless));
    refuse_word(CAMERA_COUNT_AT, 4097, PIPE_SIZE);
    refuse_word(CAMERA_COUNT_AT, UINT32_MAX, PIPE_SIZE);
    refuse(CAMERAS_AT, endless, sizeof(endless), PIPE_CAMERA);
    refuse_word(CAMERAS_AT + offsetof(struct model_camera, kind), 2, PIPE_CAMERA);
    refuse_number(CAMERAS_AT + offsetof(struct model_camera, height), 1, PIPE_CAMERA);
    for (size_t i = 0; i < 12; i++)
        refuse_number(camera + 4 * i, NAN, PIPE_CAMERA);
    refuse(camera, &(vec3s){ { 0, 0, 0 } }, sizeof(vec3s), PIPE_CAMERA);
    refuse_number(second + offsetof(struct model_camera, height), 0, PIPE_CAMERA);
    refuse_number(second + offsetof(struct model_camera, height), NAN, PIPE_CAMERA);
}

static void lights_are_checked(void **state)
{
    const size_t spot = LIGHTS_AT + sizeof(struct light);
    static const size_t numbers[] = {
        offsetof(struct light, position),  offsetof(struct light, direction),
        offsetof(struct light, color) + 8, offsetof(struct light, intensity),
        offsetof(struct light, range),     offsetof(struct light, inner_cone),
        offsetof(struct light, outer_cone)
    };
    char endless[MATERIAL_NAME_SIZE];
    (void)state;
    memset(endless, 'x', sizeof(endless));
    refuse_word(LIGHT_COUNT_AT, 4097, PIPE_SIZE);
    refuse(LIGHTS_AT, endless, sizeof(endless), PIPE_NUMBER);
    refuse_word(LIGHTS_AT + offsetof(struct light, kind), LIGHT_KIND_COUNT, PIPE_NUMBER);
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
        refuse_number(spot + numbers[i], NAN, PIPE_NUMBER);
        refuse_number(spot + numbers[i], INFINITY, PIPE_NUMBER);
    }
    refuse_number(spot + offsetof(struct light, color), -1, PIPE_NUMBER);
    refuse_number(spot + offsetof(struct light, intensity), -1, PIPE_NUMBER);
    refuse_number(spot + offsetof(struct light, direction), 1, PIPE_NUMBER); /* not unit */
    refuse_number(spot + offsetof(struct light, inner_cone), 1, PIPE_NUMBER);
    refuse_number(spot + offsetof(struct light, outer_cone), 1.6F, PIPE_NUMBER);
    refuse_number(LIGHTS_AT + offsetof(struct light, outer_cone), 1, PIPE_NUMBER); /* no spot */
}

static void extensions_are_checked(void **state)
{
    char endless[MATERIAL_NAME_SIZE], words[MODEL_UNDRAWN_SIZE];
    (void)state;
    memset(endless, 'x', sizeof(endless));
    refuse_word(EXTENSION_COUNT_AT, 257, PIPE_SIZE);
    refuse_word(UNDRAWN_AT, 1u << 31, PIPE_NUMBER);
    refuse(EXTENSIONS_AT, endless, sizeof(endless), PIPE_NUMBER);
    refuse_word(EXTENSIONS_AT + offsetof(struct model_extension, support), MODEL_SUPPORT_COUNT,
                PIPE_NUMBER);
    memset(words, 'x', sizeof(words));
    refuse(WORDS_AT, words, sizeof(words), PIPE_NUMBER);
}

static void animations_are_checked(void **state)
{
    const size_t seconds = ANIMATIONS_AT + offsetof(struct model_animation, seconds);
    char endless[MATERIAL_NAME_SIZE];
    (void)state;
    memset(endless, 'x', sizeof(endless));
    refuse_word(ANIMATION_COUNT_AT, 4097, PIPE_SIZE);
    refuse_word(ANIMATION_COUNT_AT, 1, PIPE_SIZE); /* the second one poses the model */
    refuse_word(ANIMATION_AT, 3, PIPE_SIZE);
    refuse(ANIMATIONS_AT, endless, sizeof(endless), PIPE_NUMBER);
    refuse_number(seconds, NAN, PIPE_NUMBER);
    refuse_number(seconds, -1, PIPE_NUMBER);
    refuse_number(seconds, 2e9F, PIPE_NUMBER);
}

static void opaque_objects_are_checked(void **state)
{
    char endless[MATERIAL_NAME_SIZE];
    (void)state;
    memset(endless, 'x', sizeof(endless));
    refuse_word(OPAQUE_COUNT_AT, 5, PIPE_SIZE); /* of four vertices */
    refuse_word(STARTS_AT, 3, PIPE_INDEX);      /* as the second */
    refuse_word(STARTS_AT + 4, 4, PIPE_INDEX);
    refuse(STARTS_AT + 8, endless, sizeof(endless), PIPE_MATERIAL);
}

static void vertices_are_checked(void **state)
{
    (void)state;
    for (size_t i = 0; i < 11; i++) { /* all but the material */
        refuse_number(VERTICES_AT + 3 * VERTEX_SIZE + 4 * i, NAN, PIPE_NUMBER);
        refuse_number(VERTICES_AT + 3 * VERTEX_SIZE + 4 * i, -INFINITY, PIPE_NUMBER);
    }
    for (size_t i = 0; i < EXTRA_SIZE / 4; i++)
        refuse_number(EXTRAS_AT + 3 * EXTRA_SIZE + 4 * i, NAN, PIPE_NUMBER);
    refuse_number(EXTRAS_AT, 3, PIPE_NUMBER);
    refuse_number(EXTRAS_AT + 12, 2, PIPE_NUMBER);
    refuse_word(MATERIALS_AT + offsetof(struct material, textures[MATERIAL_NORMAL].uv_set), 2,
                PIPE_MATERIAL);
    refuse_number(VERTICES_AT, 1.1e6F, PIPE_NUMBER);
    refuse_number(VERTICES_AT + 12, 3, PIPE_NUMBER);
    refuse_word(VERTICES_AT + 44, MESH_UNLIT | 3, PIPE_MATERIAL); /* of two textures */
    refuse_word(VERTICES_AT + 44, MESH_UNLIT | MESH_ORBITS, PIPE_MATERIAL);
    refuse_word(VERTICES_AT + 44, MESH_UNLIT | 3u << MESH_SURFACE_SHIFT, PIPE_MATERIAL); /* 2 */
    /* not as its triangle's others */
    refuse_word(VERTICES_AT + 44, MESH_UNLIT | MESH_CUTOUT, PIPE_MATERIAL);
    refuse_word(VERTICES_AT + 44, 0, PIPE_NUMBER); /* lit, but its colour is 4 */
    refuse_number(VERTICES_AT + 24, 65505, PIPE_NUMBER);
    refuse_number(VERTICES_AT + 24, -1e-3F, PIPE_NUMBER);
    for (size_t i = 0; i < 6; i++) {
        refuse_word(INDICES_AT + 4 * i, 4, PIPE_INDEX);
        refuse_word(INDICES_AT + 4 * i, UINT32_MAX, PIPE_INDEX);
    }
}

static void objects_are_checked(void **state)
{
    const size_t size = sizeof(struct object);
    char endless[MATERIAL_NAME_SIZE];
    (void)state;
    memset(endless, 'x', sizeof(endless));
    refuse_word(OBJECT_COUNT_AT, UINT32_MAX, PIPE_SIZE);
    refuse_word(OBJECT_COUNT_AT, 3, PIPE_SIZE); /* of two triangles */
    refuse_word(OBJECT_COUNT_AT, 1, PIPE_INDEX);
    refuse_word(OBJECT_COUNT_AT, 0, PIPE_INDEX);
    refuse_word(MATERIAL_COUNT_AT, UINT32_MAX, PIPE_SIZE);
    refuse(OBJECTS_AT, endless, sizeof(endless), PIPE_MATERIAL);
    refuse_word(OBJECTS_AT + offsetof(struct object, material), 2, PIPE_MATERIAL);
    refuse_word(OBJECTS_AT + offsetof(struct object, rank), 1, PIPE_MATERIAL);
    refuse_word(OBJECTS_AT + offsetof(struct object, container_rank), 1, PIPE_MATERIAL);
    refuse_word(OBJECTS_AT + offsetof(struct object, enclosing_object), 1, PIPE_MATERIAL);
    refuse_word(OBJECTS_AT + offsetof(struct object, open_edge_count), 7, PIPE_MATERIAL);
    refuse_word(OBJECTS_AT + offsetof(struct object, solid_count), 7, PIPE_MATERIAL);
    refuse_word(OBJECTS_AT + offsetof(struct object, first_index), 3, PIPE_INDEX);
    refuse_word(OBJECTS_AT + offsetof(struct object, index_count), 6, PIPE_INDEX);
    refuse_word(OBJECTS_AT + offsetof(struct object, index_count), 0, PIPE_INDEX);
    refuse_word(OBJECTS_AT + size + offsetof(struct object, index_count), 6, PIPE_INDEX);
}

static void materials_are_checked(void **state)
{
    static const size_t numbers[] = {
        offsetof(struct material, base_color),
        offsetof(struct material, roughness),
        offsetof(struct material, transmission),
        offsetof(struct material, thickness),
        offsetof(struct material, ior),
        offsetof(struct material, dispersion),
        offsetof(struct material, scattering_optical_depth),
        offsetof(struct material, attenuation_color),
        offsetof(struct material, attenuation_distance),
        offsetof(struct material, metallic),
        offsetof(struct material, alpha),
        offsetof(struct material, alpha_cutoff),
        offsetof(struct material, emission) + 4,
        offsetof(struct material, occlusion_strength),
        offsetof(struct material, specular),
        offsetof(struct material, specular_color) + 8,
    };
    const size_t textures = MATERIALS_AT + offsetof(struct material, textures);
    const size_t texture = textures + MATERIAL_OCCLUSION * sizeof(struct material_texture);
    const size_t layer = offsetof(struct material_texture, layer);
    static const float bad[] = { NAN, INFINITY, -1 };
    (void)state;
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
        for (size_t k = 0; k < sizeof(bad) / sizeof(bad[0]); k++)
            refuse_number(MATERIALS_AT + numbers[i], bad[k], PIPE_MATERIAL);
    }
    refuse_word(MATERIALS_AT + offsetof(struct material, flags), MATERIAL_FLAGS + 1, PIPE_MATERIAL);
    refuse_number(MATERIALS_AT + offsetof(struct material, ior), 4.1F, PIPE_MATERIAL);
    refuse_number(MATERIALS_AT + offsetof(struct material, normal_scale), NAN, PIPE_MATERIAL);
    refuse_word(textures + layer, 3, PIPE_MATERIAL); /* of two colours */
    refuse_word(texture + layer, 2, PIPE_MATERIAL);  /* of one number */
    refuse_word(texture + offsetof(struct material_texture, wrap_u), 3, PIPE_MATERIAL);
    refuse_word(texture + offsetof(struct material_texture, wrap_v), 3, PIPE_MATERIAL);
    refuse_number(texture + offsetof(struct material_texture, u_row), NAN, PIPE_MATERIAL);
    refuse_number(texture + offsetof(struct material_texture, v_row) + 8, INFINITY, PIPE_MATERIAL);
}

static void every_length_but_one_is_short(void **state)
{
    (void)state;
    struct memory_pipe stream = make_stream();
    const size_t size = stream.size;
    struct model model;
    for (stream.size = 0; stream.size < size; stream.size++) {
        stream.at = 0;
        assert_int_equal(read_model(&stream, &model), PIPE_SHORT);
    }
    refuse_word(size - 4, 0, PIPE_END);
}

static void environments(void **state)
{
    (void)state;
    uint16_t texels[8] = { 0, 0x7bff, 1, 0x3c00, 0x3800, 0, 0, 0x3c00 };
    static const uint16_t bad[] = { 0x7c00, 0x7e00, 0x8000, 0xbc00 }; /* infinity, NaN, -0, -1 */
    struct environment environment = { .texels = texels, .width = 2, .height = 1 }, found;
    environment.sun = (struct environment_sun){ { { 0, 0.6F, 0.8F } }, { { 3, 2, 1 } } };
    struct memory_pipe stream = { .size = 0 };
    const struct pipe_source source = { memory_pipe_read, &stream, 16 };
    const struct pipe_sink sink = { memory_pipe_write, &stream };
    assert_true(model_pipe_write_environment(&sink, &environment));
    assert_int_equal(model_pipe_read_environment(&source, &found), PIPE_OK);
    assert_int_equal(found.width, 2);
    assert_int_equal(found.height, 1);
    assert_memory_equal(found.texels, texels, sizeof(texels));
    assert_memory_equal(&found.sun, &environment.sun, sizeof(found.sun));
    environment_finish(&found);
    for (size_t i = 0; i < 6; i++) { /* light may not be below 0, nor a direction too long */
        struct memory_pipe copy = stream;
        const struct pipe_source other = { memory_pipe_read, &copy, 16 };
        const float wrong = i < 3 ? 2.0F : -1.0F;
        copy.at = 0;
        memcpy(copy.bytes + 12 + 4 * i, &wrong, sizeof(wrong));
        assert_int_equal(model_pipe_read_environment(&other, &found), PIPE_HEAD);
    }
    for (size_t i = 0; i < 8 * sizeof(bad) / sizeof(bad[0]); i++) {
        struct memory_pipe copy = stream;
        const struct pipe_source other = { memory_pipe_read, &copy, 16 };
        const size_t at = i % 8;
        copy.at = 0;
        memcpy(copy.bytes + 36 + 2 * at, &bad[i / 8], sizeof(bad[0]));
        assert_int_equal(model_pipe_read_environment(&other, &found), PIPE_TEXEL);
        assert_null(found.texels);
    }
    stream.at = 0;
    const struct pipe_source narrow = { memory_pipe_read, &stream, 15 };
    assert_int_equal(model_pipe_read_environment(&narrow, &found), PIPE_SIZE);
    stream = make_stream();
    assert_int_equal(model_pipe_read_environment(&source, &found), PIPE_HEAD);
}

/* Six faces, one below the other: alpha is a distance, and no other height will do. */
static void cubes(void **state)
{
    (void)state;
    uint16_t texels[24] = { 0x3c00, 0x3c00, 0x3c00, 0x1234, 0, 0, 0, 0 };
    struct environment environment = { .texels = texels, .width = 1, .height = 6 }, found;
    struct memory_pipe stream = { .size = 0 };
    const struct pipe_source source = { memory_pipe_read, &stream, sizeof(texels) };
    const struct pipe_sink sink = { memory_pipe_write, &stream };
    assert_true(model_pipe_write_environment(&sink, &environment));
    assert_int_equal(model_pipe_read_environment(&source, &found), PIPE_OK);
    assert_true(found.is_cube);
    assert_memory_equal(found.texels, texels, sizeof(texels));
    environment_finish(&found);
    stream = (struct memory_pipe){ .size = 0 };
    environment.height = 5;
    assert_true(model_pipe_write_environment(&sink, &environment));
    assert_int_equal(model_pipe_read_environment(&source, &found), PIPE_SIZE);
    assert_null(found.texels);
    assert_int_equal(found.height, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(model_comes_through),
        cmocka_unit_test(models_are_copied),
        cmocka_unit_test(heads_are_checked),
        cmocka_unit_test(cameras_are_checked),
        cmocka_unit_test(listed_cameras_are_checked),
        cmocka_unit_test(lights_are_checked),
        cmocka_unit_test(extensions_are_checked),
        cmocka_unit_test(animations_are_checked),
        cmocka_unit_test(opaque_objects_are_checked),
        cmocka_unit_test(vertices_are_checked),
        cmocka_unit_test(objects_are_checked),
        cmocka_unit_test(materials_are_checked),
        cmocka_unit_test(environments),
        cmocka_unit_test(cubes),
        cmocka_unit_test(every_length_but_one_is_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
