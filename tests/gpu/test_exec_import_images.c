/* test_exec_import_images.c: an import that is several images, and semaphores around a frame. */
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    IMAGE_COUNT = 2,
    FRAME_COUNT = 6,
};

/* Layouts of shown images need the extension, but no window. */
static bool can_present(VkInstance instance, VkPhysicalDevice physical, uint32_t queue_family)
{
    (void)instance;
    (void)physical;
    (void)queue_family;
    return true;
}

static const char *const surface_extension[] = { VK_KHR_SURFACE_EXTENSION_NAME };
static const struct gpu_window_system windows = { surface_extension, 1, can_present };

static void open_device(struct gpu *gpu)
{
    struct gpu_params params = lavapipe_params();
    params.windows = &windows;
    lavapipe_environment();
    assert_int_equal(gpu_create(gpu, &params), STATUS_OK);
    assert_true(gpu->validated);
}

static void close_device(struct gpu *gpu)
{
    gpu_destroy(gpu);
    assert_int_equal(gpu->message_count, 0);
}

static void make_images(struct gpu *gpu, struct gpu_image images[static IMAGE_COUNT])
{
    static const vec4s texels[FEATURE_TEXELS];
    for (int i = 0; i < IMAGE_COUNT; i++) {
        const struct gpu_image_params params = {
            .name = "one of several",
            .format = VK_FORMAT_R32G32B32A32_SFLOAT,
            .width = FEATURE_SIZE,
            .height = FEATURE_SIZE,
            .texels = texels,
            .texels_size = sizeof(texels),
            .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
        };
        assert_int_equal(gpu_image_create(gpu, &images[i], &params), STATUS_OK);
    }
}

static vec4s color_of(uint32_t frame)
{
    return painted_color((float)frame + 1, (float)(frame % IMAGE_COUNT), 0.5F, 1);
}

/* ---- frames that use one image after another, each after the one before ---- */

static VkSemaphore make_semaphore(const struct gpu *gpu)
{
    VkSemaphore semaphore;
    const VkSemaphoreCreateInfo info = { .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO };
    assert_int_equal(vkCreateSemaphore(gpu->device, &info, NULL, &semaphore), VK_SUCCESS);
    return semaphore;
}

static void check_frame(struct run *run, uint32_t number)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    painted_check_all(run, outputs[PRESENT_PICTURE_OUT], FEATURE_TEXELS, color_of(number));
    painted_check_all(run, outputs[PRESENT_SEEN_OUT], FEATURE_TEXELS, color_of(number));
}

/* One semaphore: each frame waits for the one before and lets the next one begin. To signal what is
 * signalled already, or to wait for what nothing signals, is a message. */
static void draw_frames(struct run *run)
{
    VkSemaphore semaphore = make_semaphore(run->gpu);
    for (uint32_t number = 0; number < FRAME_COUNT; number++) {
        const struct paint_push paints[PRESENT_PAINT_COUNT] = {
            [PRESENT_PAINT] = { .color = color_of(number), ALL },
            [PRESENT_LOOK] = { ALL },
        };
        const struct rg_frame frame = { .rows = run->params.technique.passes, .paints = paints };
        assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
        if (number >= 2)
            check_frame(run, number - 2); /* of the same slot */
        const VkSemaphoreSubmitInfo info = {
            .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
            .semaphore = semaphore,
            .stageMask = number % 2 ? VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT
                                    : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        };
        const struct rg_exec_external_sync sync = {
            .image_index = number % IMAGE_COUNT,
            .wait_count = number > 0,
            .waits = &info,
            .signal_count = number + 1 < FRAME_COUNT,
            .signals = &info,
        };
        assert_int_equal(rg_exec_submit_synced(run->exec, &frame, &sync), VK_SUCCESS);
    }
    for (uint32_t slot = 0; slot < 2; slot++)
        assert_int_equal(rg_exec_wait(run->exec, slot), VK_SUCCESS);
    vkDestroySemaphore(run->gpu->device, semaphore, NULL);
}

/* ---- what they have left, seen by another plan ---- */

static const struct rg_buffer left_out = COLOR_BUFFER("left out");
static const struct rg_pass left_rows[] = {
    RUN_READ("read", feature_present_picture, left_out),
};
static const struct rg_import left_import = {
    .image = &feature_present_picture,
    .access = RG_PRESENT,
};

static void check_left(struct gpu *gpu, const struct gpu_image images[static IMAGE_COUNT],
                       const struct run_params *way)
{
    for (uint32_t i = 0; i < IMAGE_COUNT; i++) {
        const struct rg_exec_import object = { .image = images[i].image };
        const struct run_params params = {
            .technique = RG_TECHNIQUE("left", left_rows),
            .outputs = { &left_out },
            .imports = &left_import,
            .objects = &object,
            .import_count = 1,
            .render_passes = way->render_passes,
        };
        struct run run;
        run_open(&run, gpu, &params);
        run_frame(&run, NULL);
        painted_check_all(&run, &left_out, FEATURE_TEXELS, color_of(FRAME_COUNT - IMAGE_COUNT + i));
        run_close(&run);
    }
}

static void frames_choose_their_image(void **state)
{
    (void)state;
    struct gpu gpu;
    open_device(&gpu);
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        struct gpu_image images[IMAGE_COUNT];
        struct run run;
        make_images(&gpu, images);
        const VkImage handles[IMAGE_COUNT] = { images[0].image, images[1].image };
        const struct rg_exec_import object = { .images = handles, .image_count = IMAGE_COUNT };
        struct run_params params = run_variant(&feature_present.params, way);
        params.objects = &object;
        run_open(&run, &gpu, &params);
        draw_frames(&run);
        run_close(&run);
        check_left(&gpu, images, &params);
        for (int i = 0; i < IMAGE_COUNT; i++)
            gpu_image_destroy(&gpu, &images[i]);
    }
    close_device(&gpu);
}

/* ---- imports that do not go together ---- */

static const struct rg_image other = COLOR_IMAGE("other");
static const struct rg_pass two_rows[] = {
    PAINTED_FETCH("one to the other", feature_present_picture, other),
    RUN_READ("read", other, left_out),
};
static const struct rg_import two_imports[] = {
    { .image = &feature_present_picture, .access = RG_SAMPLED },
    { .image = &other },
};

static void imports_have_equally_many_images(void **state)
{
    struct gpu_image images[IMAGE_COUNT];
    struct run run;
    make_images(*state, images);
    const VkImage handles[3] = { images[0].image, images[1].image, images[0].image };
    const struct rg_exec_import objects[] = {
        { .images = handles, .image_count = 2 },
        { .images = handles, .image_count = 3 },
    };
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", two_rows),
        .outputs = { &left_out },
        .imports = two_imports,
        .objects = objects,
        .import_count = 2,
    };
    run_compile(&run, *state, &params);
    assert_int_equal(run_create(&run, run.plan), VK_ERROR_INITIALIZATION_FAILED);
    assert_int_equal(run.line_count, 1);
    assert_non_null(strstr(run.line, "imports, which differs between them"));
    run_close(&run);
    for (int i = 0; i < IMAGE_COUNT; i++)
        gpu_image_destroy(*state, &images[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_choose_their_image),
        ON_DEVICE(imports_have_equally_many_images),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
