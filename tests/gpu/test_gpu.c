/* test_gpu.c: device selection, validation and the pipeline cache. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/assertions.h"

#include "src/gpu/gpu_internal.h"
#include "tests/support/lavapipe.h"

/*
 * In a child, because the loader reads the environment of its process, or for what leaks on
 * purpose. Zero is success.
 */
static int run_in_child(int (*run)(void))
{
    int ended = -1;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        _exit(run());
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &ended, 0), child);
    return ended;
}

static void device_is_found_by_number_and_name(void **state)
{
    (void)state;
    struct gpu_device *devices = NULL;
    uint32_t count = 0;
    uint32_t found = 0;
    if (getenv("FIRN_TEST_DEVICE")) /* it is about lavapipe */
        skip();
    assert_int_equal(gpu_list(&devices, &count), STATUS_OK);
    for (uint32_t i = 0; i < count; i++) {
        struct gpu gpu;
        char number[16];
        if (!strstr(devices[i].name, "llvmpipe"))
            continue;
        found++;
        assert_string_equal(devices[i].kind, "CPU");
        assert_string_equal(devices[i].refused, "");
        assert_memory_equal(devices[i].version, "1.", 2);
        snprintf(number, sizeof(number), "%u", i);
        assert_int_equal(gpu_create(&gpu, &(struct gpu_params){ .device = number }), STATUS_OK);
        assert_string_equal(gpu.properties.deviceName, devices[i].name);
        assert_false(gpu.validated);
        gpu_destroy(&gpu);
        assert_int_equal(gpu_create(&gpu, &(struct gpu_params){ .device = "LLVMPipe" }), STATUS_OK);
        gpu_destroy(&gpu);
    }
    assert_int_equal(found, 1);
    free(devices);
}

static void unknown_device_is_refused(void **state)
{
    (void)state;
    static const char *const wanted[] = { "no such device", "99", "99999999999999999999999" };
    for (size_t i = 0; i < sizeof(wanted) / sizeof(wanted[0]); i++) {
        struct gpu gpu;
        const struct gpu empty = { 0 };
        const struct gpu_params params = { .device = wanted[i], .validate = true };
        assert_int_equal(gpu_create(&gpu, &params), STATUS_NO_DEVICE);
        assert_memory_equal(&gpu, &empty, sizeof(gpu));
    }
}

static void best_device_is_chosen(void **state)
{
    (void)state;
    static const struct gpu_device devices[] = {
        { .name = "Pixels 300 (old)",
          .type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU,
          .refused = "no synchronization2" },
        { .name = "llvmpipe", .type = VK_PHYSICAL_DEVICE_TYPE_CPU },
        { .name = "Virtual", .type = VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU },
        { .name = "Graphics 1", .type = VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU },
        { .name = "Pixels 500", .type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU },
        { .name = "Pixels 700", .type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU },
    };

    static const struct {
        const char *wanted;
        uint32_t count; /* of devices[] that are there */
        uint32_t index; /* UINT32_MAX: none */
    } rows[] = {
        { NULL, 6, 4 },           { NULL, 4, 3 },           { NULL, 3, 2 },
        { NULL, 2, 1 },           { NULL, 1, UINT32_MAX },  { NULL, 0, UINT32_MAX },
        { "pixels", 6, 4 },       { "700", 6, UINT32_MAX }, { "Pixels 7", 6, 5 },
        { "old", 6, UINT32_MAX }, { "0", 6, UINT32_MAX },   { "2", 6, 2 },
        { "6", 6, UINT32_MAX },   { "PIPE", 6, 1 },         { "pipes", 6, UINT32_MAX },
    };

    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        uint32_t index = UINT32_MAX;
        const enum status status = gpu_choose(devices, rows[i].count, rows[i].wanted, &index);
        assert_int_equal(status, rows[i].index == UINT32_MAX ? STATUS_NO_DEVICE : STATUS_OK);
        assert_int_equal(index, rows[i].index);
    }
}

/* --- the loader --- */

static int open_without_driver(void)
{
    struct gpu gpu;
    struct gpu_device *devices = NULL;
    uint32_t count = 1;
    setenv("VK_DRIVER_FILES", "/nonexistent/x.json", 1);
    if (gpu_create(&gpu, &(struct gpu_params){ 0 }) != STATUS_NO_DEVICE || gpu.instance)
        return 1;
    if (gpu_list(&devices, &count) != STATUS_OK || devices || count)
        return 2;
    return 0;
}

static void no_driver_is_no_device(void **state)
{
    (void)state;
    assert_int_equal(run_in_child(open_without_driver), 0);
}

static int open_without_layer(void)
{
    const struct gpu_params params = lavapipe_params();
    struct gpu gpu;
    setenv("VK_LAYER_PATH", "/nonexistent", 1);
    if (gpu_create(&gpu, &params) != STATUS_OK || gpu.validated)
        return 1;
    gpu_destroy(&gpu);
    return 0;
}

static void no_layer_is_no_hindrance(void **state)
{
    (void)state;
    assert_int_equal(run_in_child(open_without_layer), 0);
}

/* The loader complains of a driver that will not load, through the messenger too. */
static int open_beside_broken_driver(void)
{
    static const char manifest[] = "{\"file_format_version\": \"1.0.0\", \"ICD\": "
                                   "{\"library_path\": \"/nonexistent/driver.so\", "
                                   "\"api_version\": \"1.3.0\"}}";
    const struct gpu_params params = lavapipe_params();
    struct gpu gpu;
    char folder[] = "/tmp/firn-test-XXXXXX";
    char path[64];
    if (!mkdtemp(folder))
        return 1;
    snprintf(path, sizeof(path), "%s/driver.json", folder);
    FILE *file = fopen(path, "wx");
    if (!file)
        return 1;
    fputs(manifest, file);
    fclose(file);
    setenv("VK_ADD_DRIVER_FILES", path, 1);
    const enum status status = gpu_create(&gpu, &params);
    remove(path);
    remove(folder);
    if (status != STATUS_OK || gpu.message_count != 0)
        return 2;
    gpu_destroy(&gpu);
    return gpu.message_count == 0 ? 0 : 3;
}

static void broken_driver_is_passed_over(void **state)
{
    (void)state;
    assert_int_equal(run_in_child(open_beside_broken_driver), 0);
}

/* The layer's view of a buffer that outlives its device. */
static int forget_buffer(void)
{
    const struct gpu_params params = lavapipe_params();
    struct gpu gpu;
    struct gpu_buffer buffer;
    if (gpu_create(&gpu, &params) != STATUS_OK ||
        gpu_memory_buffer(&gpu, &buffer, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, 256, true,
                          "forgotten") != STATUS_OK)
        return 1;
    if (gpu.message_count != 0)
        return 2;
    gpu_destroy(&gpu);
    return gpu.message_count == 0 ? 3 : 0;
}

static void forgotten_buffer_is_seen(void **state)
{
    (void)state;
    assert_int_equal(run_in_child(forget_buffer), 0);
}

/* --- validation --- */

static const VkBufferUsageFlags both_ways =
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

static void missing_barrier_is_seen(void **state)
{
    struct gpu *gpu = *state;
    struct gpu_buffer buffer;
    struct gpu_upload upload;
    assert_int_equal(gpu_memory_buffer(gpu, &buffer, both_ways, 256, true, "victim"), STATUS_OK);
    assert_int_equal(gpu_upload_begin(gpu, &upload, 4, "test"), STATUS_OK);
    vkCmdFillBuffer(upload.commands, buffer.buffer, 0, 256, 1);
    assert_int_equal(gpu->message_count, 0);
    vkCmdFillBuffer(upload.commands, buffer.buffer, 0, 256, 2);
    assert_int_not_equal(gpu->message_count, 0);
    gpu_upload_finish(gpu, &upload);
    gpu_buffer_destroy(gpu, &buffer);
    gpu->message_count = 0;
}

/* The same, but in two submissions with nothing between. */
static void missing_barrier_between_submissions_is_seen(void **state)
{
    struct gpu *gpu = *state;
    struct gpu_buffer buffer;
    struct gpu_upload uploads[2];
    assert_int_equal(gpu_memory_buffer(gpu, &buffer, both_ways, 256, true, "victim"), STATUS_OK);
    for (uint32_t i = 0; i < 2; i++) {
        assert_int_equal(gpu_upload_begin(gpu, &uploads[i], 4, "test"), STATUS_OK);
        vkCmdFillBuffer(uploads[i].commands, buffer.buffer, 0, 256, i);
        assert_int_equal(vkEndCommandBuffer(uploads[i].commands), VK_SUCCESS);
    }
    for (uint32_t i = 0; i < 2; i++) {
        const VkCommandBufferSubmitInfo commands = {
            .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
            .commandBuffer = uploads[i].commands,
        };
        const VkSubmitInfo2 info = {
            .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
            .commandBufferInfoCount = 1,
            .pCommandBufferInfos = &commands,
        };
        assert_int_equal(gpu->message_count, 0);
        (void)vkQueueSubmit2(gpu->queue, 1, &info, VK_NULL_HANDLE);
    }
    assert_int_not_equal(gpu->message_count, 0);
    (void)vkQueueWaitIdle(gpu->queue);
    gpu_upload_finish(gpu, &uploads[0]);
    gpu_upload_finish(gpu, &uploads[1]);
    gpu_buffer_destroy(gpu, &buffer);
    gpu->message_count = 0;
}

/* --- results and cache --- */

static void results_have_names_and_statuses(void **state)
{
    (void)state;
    assert_string_equal(gpu_result_name(VK_ERROR_DEVICE_LOST), "VK_ERROR_DEVICE_LOST");
    assert_non_null(gpu_result_name((VkResult)-12345));
    assert_int_equal(gpu_failed("test", VK_ERROR_DEVICE_LOST), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_failed("test", VK_ERROR_OUT_OF_HOST_MEMORY), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_failed("test", VK_ERROR_OUT_OF_DEVICE_MEMORY), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_failed("test", VK_ERROR_INCOMPATIBLE_DRIVER), STATUS_NO_DEVICE);
    assert_int_equal(gpu_failed("test", VK_ERROR_INITIALIZATION_FAILED), STATUS_NO_DEVICE);
    assert_int_equal(gpu_failed("test", VK_TIMEOUT), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_failed("test", VK_ERROR_FRAGMENTED_POOL), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_failed("test", VK_ERROR_FORMAT_NOT_SUPPORTED), STATUS_NO_DEVICE);
    struct rlimit memory; /* an unknown error under a limit of memory comes from that */
    assert_int_equal(getrlimit(RLIMIT_AS, &memory), 0);
    assert_int_equal(gpu_failed("test", VK_ERROR_UNKNOWN),
                     memory.rlim_cur == RLIM_INFINITY ? STATUS_FAILED : STATUS_TRY_AGAIN);
}

/* The cache file that a device leaves behind, or 0. */
static size_t read_cache(const struct gpu *gpu, const char *folder, char *data, size_t size)
{
    char path[512];
    int length = snprintf(path, sizeof(path), "%s/firn/pipelines-%04x-%04x-", folder,
                          gpu->properties.vendorID, gpu->properties.deviceID);
    for (size_t i = 0; i < VK_UUID_SIZE; i++)
        length += snprintf(path + length, sizeof(path) - (size_t)length, "%02x",
                           gpu->properties.pipelineCacheUUID[i]);
    FILE *file = fopen(path, "rb");
    if (!file)
        return 0;
    const size_t got = fread(data, 1, size, file);
    fclose(file);
    assert_int_equal(remove(path), 0);
    return got;
}

static void only_a_sound_cache_is_used(void **state)
{
    struct gpu *gpu = *state;
    char folder[] = "/tmp/firn-test-XXXXXX";
    char inner[64];
    char data[4096];
    VkPhysicalDeviceProperties other = gpu->properties;
    assert_non_null(mkdtemp(folder));
    snprintf(inner, sizeof(inner), "%s/firn", folder);
    assert_int_equal(setenv("XDG_CACHE_HOME", folder, 1), 0);
    gpu_pipeline_cache_save(gpu);
    vkDestroyPipelineCache(gpu->device, gpu->pipeline_cache, NULL);
    assert_int_equal(gpu_pipeline_cache_load(gpu), STATUS_OK);
    unsetenv("XDG_CACHE_HOME");
    const size_t size = read_cache(gpu, folder, data, sizeof(data));
    assert_int_equal(rmdir(inner), 0); /* nothing else was left */
    assert_int_equal(rmdir(folder), 0);

    assert_in_range(size, sizeof(VkPipelineCacheHeaderVersionOne) + 8, sizeof(data) - 1);
    assert_true(gpu_pipeline_cache_is_valid(&gpu->properties, data, size));
    assert_false(gpu_pipeline_cache_is_valid(&gpu->properties, data, size - 1));
    assert_false(gpu_pipeline_cache_is_valid(&gpu->properties, data, 3));
    assert_false(gpu_pipeline_cache_is_valid(&gpu->properties, data, 0));
    other.pipelineCacheUUID[15] ^= 1;
    assert_false(gpu_pipeline_cache_is_valid(&other, data, size));
    for (size_t i = 0; i < size; i++) {
        data[i] ^= 0x10;
        assert_false(gpu_pipeline_cache_is_valid(&gpu->properties, data, size));
        data[i] ^= 0x10;
    }
}

/* Neither a cache from nowhere nor one that cannot be written is worth a word. */
static void cache_may_be_missing(void **state)
{
    struct gpu *gpu = *state;
    static const char *const folders[] = { "relative", "/proc", "/dev/null" };
    for (size_t i = 0; i < sizeof(folders) / sizeof(folders[0]); i++) {
        assert_int_equal(setenv("XDG_CACHE_HOME", folders[i], 1), 0);
        gpu_pipeline_cache_save(gpu);
        vkDestroyPipelineCache(gpu->device, gpu->pipeline_cache, NULL);
        assert_int_equal(gpu_pipeline_cache_load(gpu), STATUS_OK);
    }
    unsetenv("XDG_CACHE_HOME");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        /* those with a child come before there is a device with threads */
        cmocka_unit_test(no_driver_is_no_device),
        cmocka_unit_test(no_layer_is_no_hindrance),
        cmocka_unit_test(broken_driver_is_passed_over),
        cmocka_unit_test(forgotten_buffer_is_seen),
        cmocka_unit_test(device_is_found_by_number_and_name),
        cmocka_unit_test(unknown_device_is_refused),
        cmocka_unit_test(best_device_is_chosen),
        cmocka_unit_test(results_have_names_and_statuses),
        ON_DEVICE(missing_barrier_is_seen),
        ON_DEVICE(missing_barrier_between_submissions_is_seen),
        ON_DEVICE(only_a_sound_cache_is_used),
        ON_DEVICE(cache_may_be_missing),
    };
    lavapipe_environment();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
