/* test_library.c: the C interface: images equal those of firn render, and errors leave the caller's
 * process and data as they are. */
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include "tests/support/assertions.h"

#include "src/file/exr.h"
#include "src/file/half_float.h"
#include "src/file/png.h"
#include "src/lib/firn.h"

enum {
    WIDTH = 48,
    HEIGHT = 36,
    PIXELS = WIDTH * HEIGHT,
};

static firn *device;
static const char *program; /* firn */
static char folder[] = "/tmp/firn-library-XXXXXX";
static uint32_t message_count;
static bool validates; /* the layer's memory grows */

static void count_message(void *user, int level, const char *text)
{
    (void)user;
    assert_true(level <= FIRN_LOG_NOTE && !strchr(text, '\n'));
    assert_null(strstr(text, "VUID")); /* message of the validation layer */
    message_count++;
}

#define OK(call)                   check(call, FIRN_OK, "", #call, __LINE__)
#define FAILS(call, status, words) check(call, status, words, #call, __LINE__)

static void check(firn_status status, firn_status expected, const char *words, const char *call,
                  int line)
{
    const char *message = status == FIRN_OK ? "" : firn_error(device);
    if (status != FIRN_OK && !strstr(message, words))
        message = firn_error(NULL); /* the call has no handle */
    if (status == expected && strstr(message, words))
        return;
    print_error("line %d: %s: %s: %s\n", line, call, firn_status_name(status), message);
    fail();
}

static int open_all(void **state)
{
    const struct firn_options options = {
        .size = sizeof(options),
        .log = count_message,
        .flags = validates ? FIRN_VALIDATE : 0,
    };
    (void)state;
    if (!mkdtemp(folder) || firn_open(&options, &device) != FIRN_OK) {
        print_error("%s\n", firn_error(NULL));
        return 1;
    }
    return 0;
}

static int close_all(void **state)
{
    char command[100];
    (void)state;
    firn_close(device);
    snprintf(command, sizeof(command), "rm -r %s", folder);
    return system(command);
}

static firn_scene *load(const char *name, const char *const *options)
{
    firn_scene *scene = NULL;
    OK(firn_scene_load(device, name, options, &scene));
    return scene;
}

static firn_renderer *create(firn_scene *scene, const char *const *layers, size_t count)
{
    const struct firn_renderer_options options = {
        sizeof(options), WIDTH, HEIGHT, 0, layers, count,
    };
    firn_renderer *renderer = NULL;
    OK(firn_renderer_create(scene, &options, &renderer));
    return renderer;
}

static struct firn_buffer buffer_of(const char *layer, void *data, uint32_t type)
{
    return (struct firn_buffer){
        .size = sizeof(struct firn_buffer), .layer = layer, .data = data, .type = type
    };
}

static const char *const glass[] = { "material", "glass", "samples", "2", NULL };
static const char *const beauty[] = { "beauty" };

/* ---- images ---- */

/* Renders with the program, and returns the image of `file`. */
static struct image render_by_program(const char *arguments, const char *file)
{
    struct image image = { 0 };
    struct image_header head;
    char text[500], path[100];
    snprintf(path, sizeof(path), "%s/%s", folder, file);
    snprintf(text, sizeof(text), "%s render %s -q --size %dx%d -o %s", program, arguments, WIDTH,
             HEIGHT, path);
    assert_int_equal(system(text), 0);
    if (strstr(file, ".exr")) {
        assert_int_equal(exr_read(path, &image, &head), 0);
        image_header_finish(&head);
    }
    return image;
}

/* Files store colours as half floats. */
static void check_plane(const struct image *image, const char *name, const float *values,
                        size_t step)
{
    const bool is_half = strlen(name) == 1 && name[0] != 'Z';
    const float *plane = image_find(image, name);
    assert_non_null(plane);
    for (size_t i = 0; i < PIXELS; i++) {
        float value = values[i * step];
        if (is_half)
            value = half_to_float(half_from_float(value));
        if (!(plane[i] <= value && plane[i] >= value)) {
            print_error("%s: pixel %zu is %g and %g\n", name, i, (double)plane[i], (double)value);
            fail();
        }
    }
}

static void images_equal_those_of_the_program(void **state)
{
    static const char *const layers[] = { "beauty", "N", "Z", "object" };
    static float rgba[PIXELS][4], normals[PIXELS][3], z[PIXELS];
    static uint16_t objects[PIXELS];
    (void)state;
    struct image image =
        render_by_program("teapot --material glass --samples 2 --aov N,Z,object", "a.exr");
    firn_scene *scene = load("teapot", glass);
    firn_renderer *renderer = create(scene, layers, 4);
    const struct firn_buffer buffers[] = {
        buffer_of("beauty", rgba, FIRN_FLOAT32),
        buffer_of("N", normals, FIRN_FLOAT32),
        buffer_of("Z", z, FIRN_FLOAT32),
        buffer_of("object", objects, FIRN_UINT16),
    };
    for (int turn = 0; turn < 2; turn++) {
        memset(rgba, 0, sizeof(rgba));
        OK(firn_render(renderer, NULL, buffers, 4, NULL, NULL));
        check_plane(&image, "R", &rgba[0][0], 4);
        check_plane(&image, "A", &rgba[0][3], 4);
        check_plane(&image, "N.Y", &normals[0][1], 3);
        check_plane(&image, "Z", z, 1);
    }
    const float *numbers = image_find(&image, "object.Z");
    for (size_t i = 0; i < PIXELS; i++)
        assert_int_equal(objects[i], (int)numbers[i]);
    image_finish(&image);
    firn_scene_close(scene); /* the renderer keeps the scene */
    OK(firn_render(renderer, NULL, buffers, 4, NULL, NULL));
    firn_renderer_close(renderer);
}

/* The default quality level has several samples, dithered. */
static void display_equals_the_png_file(void **state)
{
    static const char *const layers[] = { "display" };
    static const char *const options[] = { "material", "glass", NULL };
    static uint8_t rgba[PIXELS][4];
    struct image image = { 0 };
    char path[100];
    (void)state;
    (void)render_by_program("teapot --material glass", "a.png");
    snprintf(path, sizeof(path), "%s/a.png", folder);
    assert_int_equal(png_read(path, &image, NULL, NULL), 0);
    firn_scene *scene = load("teapot", options);
    firn_renderer *renderer = create(scene, layers, 1);
    struct firn_buffer buffer = buffer_of("display", rgba[PIXELS - WIDTH], FIRN_UINT8);
    buffer.row_stride = -(ptrdiff_t)(WIDTH * sizeof(rgba[0])); /* bottom row first */
    const struct firn_camera other = {
        .size = sizeof(other), .kind = FIRN_CAMERA_LOOK_AT, .eye = { 4, 2, 5 }, .fov_deg = 60
    };
    OK(firn_render(renderer, &other, &buffer, 1, NULL, NULL)); /* its memory is reused */
    OK(firn_render(renderer, NULL, &buffer, 1, NULL, NULL));
    const float *green = image_find(&image, "G");
    for (size_t i = 0; i < PIXELS; i++) {
        const size_t row = HEIGHT - 1 - i / WIDTH;
        const float encoded = (float)rgba[row * WIDTH + i % WIDTH][1] / 255.0f;
        const float linear =
            encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
        CHECK_NEAR(green[i], linear, 1e-5);
    }
    image_finish(&image);
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

static double difference_of(const void *a, const void *b)
{
    struct firn_image images[2] = {
        { .size = sizeof(images[0]), WIDTH, HEIGHT, a, FIRN_FLOAT32, 4 },
        { .size = sizeof(images[0]), WIDTH, HEIGHT, b, FIRN_FLOAT32, 4 }
    };
    struct firn_difference difference = { .size = sizeof(difference) };
    OK(firn_diff(&images[0], &images[1], &difference, NULL));
    return difference.mae;
}

static void settings_change_the_next_image(void **state)
{
    static float first[PIXELS][4], second[PIXELS][4];
    char text[20];
    (void)state;
    firn_scene *scene = load("teapot", glass);
    firn_renderer *renderer = create(scene, beauty, 1);
    const struct firn_buffer to_first = buffer_of("beauty", first, FIRN_FLOAT32);
    const struct firn_buffer to_second = buffer_of("beauty", second, FIRN_FLOAT32);
    static const char *const changes[][3] = {
        { "refract.ior", "1.2", "1.518" },       /* per frame */
        { "refraction", "paper", "bounce" },     /* compiles the frame */
        { "object.triangles", "2000", "14400" }, /* generates the object */
    };
    OK(firn_scene_get(scene, "refract.ior", text, sizeof(text)));
    OK(firn_render(renderer, NULL, &to_first, 1, NULL, NULL));
    for (size_t i = 0; i < sizeof(changes) / sizeof(changes[0]); i++) {
        const char *const *change = changes[i];
        OK(firn_scene_set(scene, change[0], change[1]));
        OK(firn_render(renderer, NULL, &to_second, 1, NULL, NULL));
        assert_true(difference_of(first, second) > 1e-4);
        OK(firn_scene_set(scene, change[0], i ? change[2] : text));
        OK(firn_render(renderer, NULL, &to_second, 1, NULL, NULL));
        assert_memory_equal(first, second, sizeof(first));
    }
    FAILS(firn_scene_set(scene, "refract.oir", "1.2"), FIRN_USAGE, "did you mean 'refract.ior'");
    FAILS(firn_scene_set(scene, "refract.ior", "9"), FIRN_USAGE, "expected");
    FAILS(firn_scene_set(scene, "output", "a.exr"), FIRN_USAGE, "--output");
    OK(firn_render(renderer, NULL, &to_second, 1, NULL, NULL));
    assert_memory_equal(first, second, sizeof(first));
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

/* ---- cameras and arrays ---- */

/* A plane of 10 m at z = 0 that faces +Z, and a glass tetrahedron before it. */
static firn_scene *make_scene(void)
{
    static const float corners[][5] = {
        { -5, -5, 0, 0, 0 }, { 5, -5, 0, 0, 0 }, { 5, 5, 0, 0, 0 }, { -5, 5, 0, 0, 0 }
    };
    static const float points[][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    static const uint32_t quad[] = { 0, 1, 2, 0, 2, 3 };
    static const uint32_t faces[] = { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };
    static const char *const options[] = { "samples", "1", "background", "1,1,1", NULL };
    const struct firn_mesh meshes[] = {
        { .size = sizeof(meshes[0]),
          .vertex_count = 4,
          .index_count = 6,
          .positions = corners[0],
          .indices = quad,
          .position_stride = sizeof(corners[0]) },
        { .size = sizeof(meshes[0]),
          .vertex_count = 4,
          .index_count = 12,
          .positions = points[0],
          .indices = faces },
    };
    static const char *const names[] = { "", "glass,ior=1.4" };
    static const char *const objects[] = { "wall", "tetrahedron" };
    firn_scene *scene = NULL;
    OK(firn_scene_create(device, options, &scene));
    for (uint32_t i = 0; i < 2; i++) {
        struct firn_material material = { .size = sizeof(material) };
        uint32_t mesh, number;
        OK(firn_material_init(&material, names[i]));
        if (i == 0)
            material.base_color[0] = 0.2f;
        OK(firn_scene_add_mesh(scene, &meshes[i], &mesh));
        OK(firn_scene_add_material(scene, &material, &number));
        const struct firn_instance instance = {
            .size = sizeof(instance),
            .mesh = mesh,
            .material = number,
            .name = objects[i],
            .world = { 1, 0, 0, i ? 2.0f : 0, 0, 1, 0, 0, 0, 0, 1, i ? 0.5f : 0 },
        };
        OK(firn_scene_add_instance(scene, &instance));
    }
    return scene;
}

static float positions[PIXELS][3], z[PIXELS]; /* layers P and Z */

/* Checks that an OpenCV camera projects the positions to their pixels. */
static void check_projections(const struct firn_camera *camera)
{
    const double *m = camera->world_from_camera;
    for (size_t i = 0; i < PIXELS; i++) {
        double d[3], p[3];
        for (int k = 0; k < 3; k++)
            d[k] = (double)positions[i][k] - m[4 * k + 3];
        for (int k = 0; k < 3; k++)
            p[k] = d[0] * m[k] + d[1] * m[4 + k] + d[2] * m[8 + k];
        if (z[i] < 1e9f) { /* else there is nothing */
            CHECK_NEAR(camera->fx * p[0] / p[2] + camera->cx, (double)(i % WIDTH), 1e-3);
            const size_t row = i / WIDTH;
            CHECK_NEAR(camera->fy * p[1] / p[2] + camera->cy, (double)row, 1e-3);
            CHECK_NEAR((double)z[i] / p[2], 1, 1e-5);
        }
    }
}

static void a_position_is_where_its_camera_projects_it(void **state)
{
    static const char *const layers[] = { "P", "Z" };
    (void)state;
    firn_scene *scene = make_scene();
    firn_renderer *renderer = create(scene, layers, 2);
    const struct firn_buffer buffers[] = { buffer_of("P", positions, FIRN_FLOAT32),
                                           buffer_of("Z", z, FIRN_FLOAT32) };
    /* off-centre, with pixels that are not square; the camera looks along -Z, tilted */
    const double c = cos(0.1), s = sin(0.1);
    const struct firn_camera camera = {
        .size = sizeof(camera),
        .kind = FIRN_CAMERA_OPENCV,
        .fx = 60,
        .fy = 45,
        .cx = 14,
        .cy = 21,
        .world_from_camera = { c, 0, -s, 0.3, 0, -1, 0, 0.2, -s, 0, -c, 4 },
    };
    const struct firn_camera look_at = { .size = sizeof(look_at),
                                         .kind = FIRN_CAMERA_LOOK_AT,
                                         .eye = { 1, 2, 6 },
                                         .target = { 0.5, 0.5, 0 },
                                         .up = { 0.1, 1, 0 },
                                         .fov_deg = 35 };
    struct firn_camera converted = { .size = sizeof(converted), .kind = FIRN_CAMERA_OPENCV };
    OK(firn_render(renderer, &look_at, buffers, 2, NULL, NULL));
    OK(firn_camera_convert(renderer, &look_at, &converted));
    check_projections(&converted);
    OK(firn_render(renderer, &camera, buffers, 2, NULL, NULL));
    check_projections(&camera);
    CHECK_NEAR(positions[10 * WIDTH + 5][2], 0, 1e-4); /* the wall, where no glass is */
    struct firn_camera gl = { .size = sizeof(gl), .kind = FIRN_CAMERA_OPENGL };
    OK(firn_camera_convert(renderer, &camera, &gl));
    CHECK_NEAR(gl.cx, 14.5, 1e-12);
    static float again[PIXELS][3];
    const struct firn_buffer buffer = buffer_of("P", again, FIRN_FLOAT32);
    OK(firn_render(renderer, &gl, &buffer, 1, NULL, NULL));
    assert_memory_equal(positions, again, sizeof(again));
    gl.world_from_camera[0] = -gl.world_from_camera[0];
    FAILS(firn_render(renderer, &gl, &buffer, 1, NULL, NULL), FIRN_USAGE, "a rotation");
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

static void objects_have_names_bounds_and_materials(void **state)
{
    static float before[PIXELS][4], after[PIXELS][4];
    struct firn_object object = { .size = sizeof(object) };
    struct firn_material material = { .size = sizeof(material) };
    uint32_t count;
    (void)state;
    firn_scene *scene = make_scene();
    OK(firn_scene_object_count(scene, &count));
    assert_int_equal(count, 2);
    OK(firn_scene_object(scene, 0, &object));
    assert_string_equal(object.name, "tetrahedron");
    assert_true(object.refracts && object.id == 1 && object.triangle_count == 4);
    CHECK_NEAR(object.box_max[0], 3, 1e-6);
    OK(firn_scene_object(scene, 1, &object));
    assert_string_equal(object.name, "wall");
    FAILS(firn_scene_object(scene, 2, &object), FIRN_USAGE, "2 objects");
    firn_renderer *renderer = create(scene, beauty, 1);
    const struct firn_buffer to_before = buffer_of("beauty", before, FIRN_FLOAT32);
    const struct firn_buffer to_after = buffer_of("beauty", after, FIRN_FLOAT32);
    OK(firn_render(renderer, NULL, &to_before, 1, NULL, NULL));
    OK(firn_scene_material(scene, 0, &material));
    CHECK_NEAR(material.ior, 1.4, 1e-6);
    material.ior = 1.9f;
    OK(firn_scene_set_material(scene, 0, &material));
    OK(firn_render(renderer, NULL, &to_after, 1, NULL, NULL));
    assert_true(difference_of(before, after) > 1e-4);
    OK(firn_scene_material(scene, 0, &material));
    CHECK_NEAR(material.ior, 1.9, 1e-6);
    /* a second change of the material keeps the scene; the image is that of a new scene */
    material.ior = 1.6f;
    material.roughness = 0.2f;
    OK(firn_scene_set_material(scene, 0, &material));
    OK(firn_render(renderer, NULL, &to_before, 1, NULL, NULL));
    firn_scene *other = make_scene();
    OK(firn_scene_set_material(other, 0, &material));
    firn_renderer *other_renderer = create(other, beauty, 1);
    OK(firn_render(other_renderer, NULL, &to_after, 1, NULL, NULL));
    assert_memory_equal(before, after, sizeof(before));
    firn_renderer_close(other_renderer);
    firn_scene_close(other);
    material.ior = 5;
    FAILS(firn_scene_set_material(scene, 0, &material), FIRN_USAGE, "ior 1 to 4");
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

/* ---- views in flight ---- */

static int cancel(void *user, uint32_t done, uint32_t all)
{
    int *calls = user;
    assert_true(done <= all);
    return ++*calls == 2;
}

static void views_in_flight_come_in_order(void **state)
{
    static float expected[2][PIXELS][4], found[PIXELS][4];
    uint64_t tickets[3];
    (void)state;
    firn_scene *scene = load("teapot", glass);
    firn_renderer *renderer = create(scene, beauty, 1);
    struct firn_camera cameras[2];
    struct firn_buffer buffer = buffer_of("beauty", found, FIRN_FLOAT32);
    for (int i = 0; i < 2; i++) {
        cameras[i] = (struct firn_camera){ .size = sizeof(cameras[i]),
                                           .kind = FIRN_CAMERA_LOOK_AT,
                                           .eye = { 4, 2 + i, 5 },
                                           .fov_deg = 30 };
        buffer.data = expected[i];
        OK(firn_render(renderer, &cameras[i], &buffer, 1, NULL, NULL));
        OK(firn_submit(renderer, &cameras[i], &tickets[i]));
        if (i == 0) {
            OK(firn_fetch(renderer, tickets[0], &buffer, 1));
            OK(firn_submit(renderer, &cameras[0], &tickets[0]));
            buffer.data = found;
            OK(firn_fetch(renderer, tickets[0], &buffer, 1));
        } else {
            OK(firn_fetch(renderer, tickets[1], &buffer, 1));
        }
    }
    for (int i = 0; i < 2; i++)
        OK(firn_submit(renderer, &cameras[i], &tickets[i]));
    FAILS(firn_submit(renderer, &cameras[0], &tickets[2]), FIRN_USAGE, "fetch one first");
    FAILS(firn_fetch(renderer, tickets[1], &buffer, 1), FIRN_USAGE, "oldest");
    buffer.data = found;
    for (int i = 0; i < 2; i++) {
        OK(firn_fetch(renderer, tickets[i], &buffer, 1));
        assert_memory_equal(found, expected[i], sizeof(found));
    }
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

static void a_cancelled_view_leaves_the_buffers(void **state)
{
    static const char *const options[] = { "material", "glass", "samples", "64", NULL };
    static float found[PIXELS][4];
    uint64_t ticket;
    int calls = 0;
    (void)state;
    firn_scene *scene = load("teapot", options);
    firn_renderer *renderer = create(scene, beauty, 1);
    const struct firn_buffer buffer = buffer_of("beauty", found, FIRN_FLOAT32);
    FAILS(firn_render(renderer, NULL, &buffer, 1, cancel, &calls), FIRN_CANCELLED, "cancelled");
    assert_int_equal(calls, 2);
    OK(firn_submit(renderer, NULL, &ticket));
    firn_cancel(renderer);
    FAILS(firn_fetch(renderer, ticket, &buffer, 1), FIRN_CANCELLED, "cancelled");
    for (size_t i = 0; i < PIXELS; i++)
        assert_true(found[i][3] == 0);
    OK(firn_render(renderer, NULL, &buffer, 1, NULL, NULL));
    assert_true(found[0][3] > 0);
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

/* Draws with a device of its own. */
static void *draw_alone(void *user)
{
    const struct firn_options options = { .size = sizeof(options) };
    const struct firn_buffer buffer = buffer_of("beauty", user, FIRN_FLOAT32);
    const struct firn_renderer_options image = { sizeof(image), WIDTH, HEIGHT, 0, beauty, 1 };
    firn *own = NULL;
    firn_scene *scene = NULL;
    firn_renderer *renderer = NULL;
    const bool is_drawn = firn_open(&options, &own) == FIRN_OK &&
                          firn_scene_load(own, "teapot", glass, &scene) == FIRN_OK &&
                          firn_renderer_create(scene, &image, &renderer) == FIRN_OK &&
                          firn_render(renderer, NULL, &buffer, 1, NULL, NULL) == FIRN_OK &&
                          firn_scene_set(scene, "a.b", "1") == FIRN_USAGE &&
                          strstr(firn_error(own), "a.b");
    firn_close(own);
    firn_scene_close(scene);
    firn_renderer_close(renderer);
    return is_drawn ? user : NULL;
}

static void devices_draw_at_the_same_time(void **state)
{
    static float images[3][PIXELS * 4];
    pthread_t threads[2];
    (void)state;
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, draw_alone, images[i]), 0);
    firn_scene *scene = load("teapot", glass);
    firn_renderer *renderer = create(scene, beauty, 1);
    const struct firn_buffer buffer = buffer_of("beauty", images[2], FIRN_FLOAT32);
    OK(firn_render(renderer, NULL, &buffer, 1, NULL, NULL));
    for (int i = 0; i < 2; i++) {
        void *result;
        assert_int_equal(pthread_join(threads[i], &result), 0);
        assert_non_null(result);
        assert_memory_equal(images[i], images[2], sizeof(images[2]));
    }
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

/* ---- errors ---- */

static void wrong_arguments_are_refused(void **state)
{
    static float data[PIXELS * 4];
    static const char *const unknown[] = { "Y" };
    static const char *const no_value[] = { "env", NULL };
    struct firn_renderer_options options = { sizeof(options), WIDTH, HEIGHT, 1, beauty, 1 };
    struct firn_options device_options = { .size = 1 };
    firn_renderer *renderer = NULL;
    firn_scene *scene = NULL;
    firn *other = NULL;
    (void)state;
    FAILS(firn_open(&device_options, &other), FIRN_USAGE, "options.size");
    FAILS(firn_scene_load(NULL, "teapot", NULL, &scene), FIRN_USAGE, "");
    FAILS(firn_scene_load(device, NULL, NULL, &scene), FIRN_USAGE, "path");
    FAILS(firn_scene_load(device, "no-such-file.glb", NULL, &scene), FIRN_NO_INPUT, "no-such-file");
    FAILS(firn_scene_load(device, "teapot", no_value, &scene), FIRN_USAGE, "env");
    assert_null(scene);
    scene = load("teapot", glass);
    options.layers = unknown;
    FAILS(firn_renderer_create(scene, &options, &renderer), FIRN_USAGE, "layer 'Y'");
    options.layers = beauty;
    options.width = 0;
    FAILS(firn_renderer_create(scene, &options, &renderer), FIRN_USAGE, "0x36");
    assert_null(renderer);
    renderer = create(scene, beauty, 1);
    struct firn_buffer buffer = buffer_of("Z", data, FIRN_FLOAT32);
    FAILS(firn_render(renderer, NULL, &buffer, 1, NULL, NULL), FIRN_USAGE, "'Z'");
    buffer = buffer_of("beauty", data, 7);
    FAILS(firn_render(renderer, NULL, &buffer, 1, NULL, NULL), FIRN_USAGE, "type 7");
    FAILS(firn_render(renderer, NULL, NULL, 1, NULL, NULL), FIRN_USAGE, "buffers");
    FAILS(firn_fetch(renderer, 1, NULL, 0), FIRN_USAGE, "ticket 1");
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

/* Returns its argument if the process stays dumpable until the argument is true. */
static void *watch_process(void *user)
{
    const atomic_bool *ends = user;
    bool stays = true;
    while (!atomic_load(ends))
        stays = stays && prctl(PR_GET_DUMPABLE) == 1;
    return stays ? user : NULL;
}

static void a_damaged_file_harms_nobody(void **state)
{
    static atomic_bool ends;
    pthread_t watcher;
    void *stays;
    firn_scene *scene = NULL;
    char path[100];
    (void)state;
    snprintf(path, sizeof(path), "%s/damaged.glb", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("glTF\2\0\0\0 this is no model", file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(pthread_create(&watcher, NULL, watch_process, &ends), 0);
    FAILS(firn_scene_load(device, path, NULL, &scene), FIRN_DATA, "damaged.glb");
    atomic_store(&ends, true);
    assert_int_equal(pthread_join(watcher, &stays), 0);
    assert_non_null(stays);
    assert_null(scene);
}

/* ---- the process ---- */

static void a_child_gets_errors(void **state)
{
    static float data[PIXELS * 4];
    int status;
    (void)state;
    firn_scene *scene = load("teapot", glass);
    firn_renderer *renderer = create(scene, beauty, 1);
    const struct firn_buffer buffer = buffer_of("beauty", data, FIRN_FLOAT32);
    uint64_t ticket;
    OK(firn_submit(renderer, NULL, &ticket));
    const pid_t child = fork();
    if (child == 0) {
        firn *other;
        alarm(20); /* kills a child that waits */
        const bool fails = firn_render(renderer, NULL, &buffer, 1, NULL, NULL) == FIRN_FAILED &&
                           strstr(firn_error(device), "fork()") &&
                           firn_fetch(renderer, ticket, &buffer, 1) == FIRN_FAILED &&
                           firn_scene_set(scene, "refract.ior", "1.2") == FIRN_FAILED &&
                           firn_open(NULL, &other) == FIRN_FAILED;
        firn_renderer_close(renderer);
        firn_scene_close(scene);
        firn_close(device);
        _exit(fails ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    OK(firn_fetch(renderer, ticket, &buffer, 1));
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

static void nothing_is_written_to_stderr(void **state)
{
    static const char *const options[] = { "env", "no-such.exr", NULL };
    struct sigaction before, after;
    struct stat info;
    firn_scene *scene = NULL;
    const uint32_t count = message_count;
    (void)state;
    fflush(stderr);
    FILE *file = tmpfile();
    const int kept = dup(STDERR_FILENO);
    assert_non_null(file);
    assert_int_equal(sigaction(SIGPIPE, NULL, &before), 0);
    dup2(fileno(file), STDERR_FILENO);
    FAILS(firn_scene_load(device, "teapot", options, &scene), FIRN_NO_INPUT, "no-such.exr");
    dup2(kept, STDERR_FILENO);
    close(kept);
    assert_int_equal(fstat(fileno(file), &info), 0);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(info.st_size, 0);
    assert_int_equal(message_count, count + 1);
    assert_int_equal(sigaction(SIGPIPE, NULL, &after), 0);
    assert_ptr_equal(before.sa_handler, after.sa_handler);
}

static void lists_are_complete(void **state)
{
    struct firn_setting setting = { .size = sizeof(setting) };
    struct firn_layer layer = { .size = sizeof(layer) };
    uint32_t settings = 0, layers = 0, found = 0;
    (void)state;
    for (; firn_setting_get(settings, &setting) == FIRN_OK; settings++) {
        found += !strcmp(setting.name, "refract.ior") && setting.min < setting.max;
        assert_true(setting.help && setting.label);
        assert_true((setting.type == FIRN_SETTING_CHOICE) == (setting.choices != NULL));
    }
    for (; firn_layer_get(layers, &layer) == FIRN_OK; layers++)
        found += layer.channels == 4 && layers < 2;
    assert_true(settings > 100 && layers > 20 && found == 3);
    assert_string_equal(firn_status_name(FIRN_NO_DEVICE), "FIRN_NO_DEVICE");
}

/* ---- memory ---- */

static long resident_kib(void)
{
    char line[200];
    long kib = 0;
    FILE *file = fopen("/proc/self/status", "r");
    while (file && fgets(line, sizeof(line), file)) {
        if (!strncmp(line, "VmRSS:", 6))
            kib = strtol(line + 6, NULL, 10);
    }
    if (file)
        fclose(file);
    return kib;
}

/* Loads, draws and frees scenes from arrays. */
static void draw_scenes(uint32_t count)
{
    static float data[PIXELS * 4];
    const struct firn_buffer buffer = buffer_of("beauty", data, FIRN_FLOAT32);
    for (uint32_t i = 0; i < count; i++) {
        firn_scene *scene = make_scene();
        firn_renderer *renderer = create(scene, beauty, 1);
        OK(firn_render(renderer, NULL, &buffer, 1, NULL, NULL));
        firn_renderer_close(renderer);
        firn_scene_close(scene);
    }
}

static void memory_of_scenes_is_freed(void **state)
{
    (void)state;
    draw_scenes(100);
    const long before = resident_kib();
    draw_scenes(1000);
    CHECK_NEAR(resident_kib(), before, 4096.0);
}

static void the_last_of_many_frames_equals_the_first(void **state)
{
    enum {
        SIDE = 8,
        FRAMES = 20000,
    };

    static float first[SIDE * SIDE * 4], last[SIDE * SIDE * 4];
    const struct firn_renderer_options options = { sizeof(options), SIDE, SIDE, 1, beauty, 1 };
    struct firn_buffer buffer = buffer_of("beauty", first, FIRN_FLOAT32);
    firn_renderer *renderer = NULL;
    long before = 0;
    (void)state;
    firn_scene *scene = make_scene();
    OK(firn_renderer_create(scene, &options, &renderer));
    for (uint32_t i = 0; i < FRAMES; i++) {
        OK(firn_render(renderer, NULL, &buffer, 1, NULL, NULL));
        buffer.data = last;
        if (i == FRAMES / 2)
            before = resident_kib();
    }
    assert_memory_equal(first, last, sizeof(first));
    CHECK_NEAR(resident_kib(), before, 1024.0);
    firn_renderer_close(renderer);
    firn_scene_close(scene);
}

/* Arguments: the program firn; "memory" for the long test. */
int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(images_equal_those_of_the_program),
        cmocka_unit_test(display_equals_the_png_file),
        cmocka_unit_test(settings_change_the_next_image),
        cmocka_unit_test(a_position_is_where_its_camera_projects_it),
        cmocka_unit_test(objects_have_names_bounds_and_materials),
        cmocka_unit_test(views_in_flight_come_in_order),
        cmocka_unit_test(a_cancelled_view_leaves_the_buffers),
        cmocka_unit_test(devices_draw_at_the_same_time),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(a_damaged_file_harms_nobody),
        cmocka_unit_test(a_child_gets_errors),
        cmocka_unit_test(nothing_is_written_to_stderr),
        cmocka_unit_test(lists_are_complete),
    };
    const struct CMUnitTest memory[] = {
        cmocka_unit_test(memory_of_scenes_is_freed),
        cmocka_unit_test(the_last_of_many_frames_equals_the_first),
    };
    program = argc > 1 ? argv[1] : "firn";
    validates = argc == 2;
    return argc > 2 ? cmocka_run_group_tests(memory, open_all, close_all)
                    : cmocka_run_group_tests(tests, open_all, close_all);
}
