/* cmd_selftest.c: command firn selftest: prints the devices and the sandbox, draws five images and
 * compares them with reference images. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "src/app/app.h"
#include "src/app/input_image.h"
#include "src/base/log.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer.h"
#include "src/scene/bundled_assets.h"
#include "src/version.h"

#define FLIP_LIMIT 0.003 /* mean FLIP error; two drivers round differently */

enum {
    CHANGE_COUNT = 4
};

/* Images of 160 x 120 pixels, with one sample per pixel. */
static const struct {
    const char *name, *scene, *expected;  /* `expected` is a file of the assets */
    const char *changes[CHANGE_COUNT][2]; /* names and values for app_set_option() */
} images[] = {
    { "paper", "valley", "selftest/ice-cube.exr", { { "refraction", "paper" } } },
    { "sphere", "sphere", "selftest/sphere.exr", { { "refraction", "paper" } } },
    { "teapot", "teapot", "selftest/teapot.exr", { { "refraction", "paper" } } },
    { "pool", "pool", "selftest/pool.exr", { { NULL, NULL } } },
    { "bounce",
      "valley",
      "selftest/ice-cube-bounce.exr",
      { { "refraction", "bounce" },
        { "refract.lookup", "distance" },
        { "refract.fresnel", "exact" } } },
};

enum {
    IMAGE_COUNT = sizeof(images) / sizeof(images[0])
};

/* Sets the options of self-test image `i`. `scene` must outlive them. */
static enum status set_options(struct app_options *image, size_t i, char scene[static 16])
{
    char option[] = "--samples=1", quiet[] = "--quiet";
    char *words[] = { scene, option, quiet };
    bool done;
    snprintf(scene, 16, "%s", images[i].scene);
    enum status status = app_parse(image, APP_RENDER, 3, words, &done);
    if (status == STATUS_OK)
        status = app_set_option(&image->image, "size", "160x120");
    if (status == STATUS_OK)
        status = app_set_option(&image->image, "env_cube.size", "512");
    if (status == STATUS_OK) /* anisotropic filtering differs between drivers */
        status = app_set_option(&image->image, "texture.anisotropy", "1");
    for (size_t c = 0; c < CHANGE_COUNT && images[i].changes[c][0] && status == STATUS_OK; c++)
        status = app_set_option(&image->image, images[i].changes[c][0], images[i].changes[c][1]);
    return status;
}

static enum status draw(struct gpu *gpu, size_t i, struct render_result *result)
{
    struct app_options o;
    struct scene scene = { 0 };
    struct renderer *renderer = NULL;
    struct renderer_shot shot = { 0 };
    char name[16];
    enum status status = set_options(&o, i, name);
    if (status == STATUS_OK)
        status = setup_load_exposed(&scene, &shot.camera, &o.image);
    if (status == STATUS_OK) {
        setup_choose_refraction(&o.image, &scene, &shot.camera);
        struct renderer_params params = setup_renderer_params(&o.image, gpu, &scene);
        params.samples = o.image.samples;
        params.linear = true;
        renderer_set_camera(&params, &shot.camera);
        status = renderer_create(&renderer, &params);
    }
    if (status == STATUS_OK)
        status = renderer_render(renderer, &shot, result, NULL, NULL);
    renderer_destroy(renderer);
    scene_finish(&scene);
    return status;
}

static enum status read_expected(size_t i, struct image *expected)
{
    const struct asset asset = { .name = images[i].name, .file = images[i].expected };
    const struct reader_params reader = { .program = "/proc/self/exe" };
    char *path = NULL;
    enum status status = asset_locate(&asset, &path);
    if (status == STATUS_OK)
        status = input_image_read(path, &reader, expected);
    free(path);
    return status;
}

/* Sets *flip to the mean FLIP error of an image; NaN if the sizes or channels differ. */
static enum status compare(const struct image *expected, const struct image *drawn, double *flip)
{
    struct comparison comparison;
    const struct comparison_params params = { .reference = expected,
                                              .test = drawn,
                                              .ppd = FLIP_PPD };
    *flip = (double)NAN;
    if (expected->width != drawn->width || expected->height != drawn->height)
        return STATUS_OK;
    if (!comparison_init(&comparison, &params))
        return log_out_of_memory(NULL);
    if (comparison.has_beauty)
        *flip = comparison.flip;
    comparison_finish(&comparison);
    return STATUS_OK;
}

/* Draws self-test image `i`, and prints whether it matches the reference image. */
static enum status test(struct gpu *gpu, size_t i)
{
    struct image expected = { 0 };
    struct render_result result = { 0 };
    double flip = (double)NAN;
    enum status status = read_expected(i, &expected);
    if (status == STATUS_OK)
        status = draw(gpu, i, &result);
    if (status == STATUS_OK)
        status = compare(&expected, &result.image, &flip);
    render_result_finish(&result);
    image_finish(&expected);
    const bool passes = status == STATUS_OK && flip <= FLIP_LIMIT;
    printf("  %-8s %s", images[i].name, passes ? "ok" : "FAILED");
    if (status == STATUS_OK)
        printf(", FLIP error %.2g, limit %g", flip, FLIP_LIMIT);
    printf("\n");
    (void)fflush(stdout);
    return status == STATUS_OK && !passes ? STATUS_FAILED : status;
}

/* Prints the lists of devices and of the sandbox. */
static enum status print_machine(void)
{
    static const char *const topics[] = { "devices", "sandbox" };
    enum status status = STATUS_OK;
    printf("firn %s\n", FIRN_VERSION);
    for (size_t i = 0; i < sizeof(topics) / sizeof(topics[0]) && status == STATUS_OK; i++) {
        const struct app_options list = { .positionals = { topics[i] } };
        status = app_list(&list);
    }
    return status;
}

enum status app_selftest(const struct app_options *options)
{
    struct gpu gpu = { 0 };
    uint32_t passed = 0;
    enum status status = print_machine();
    (void)fflush(stdout);
    if (status == STATUS_OK)
        status = gpu_create(&gpu, &options->run.gpu);
    if (status != STATUS_OK)
        return status;
    printf("images, drawn by %s:\n", gpu.properties.deviceName);
    (void)fflush(stdout);
    for (size_t i = 0; i < IMAGE_COUNT; i++) {
        const enum status result = test(&gpu, i);
        passed += result == STATUS_OK;
        if (status == STATUS_OK)
            status = result;
    }
    printf("%u passed, %u failed\n", passed, (uint32_t)IMAGE_COUNT - passed);
    gpu_destroy(&gpu);
    return status == STATUS_OK && gpu.message_count ? STATUS_FAILED : status;
}
