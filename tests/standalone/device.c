/*
 * device.c: implements lavapipe.h and the parts of gpu.h that tests of the executor use, without
 * firn: opens the first Vulkan device with all of its features. There is no validation layer; these
 * tests compare results.
 */
#include <stdlib.h>

#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"
#include "tests/support/all_features_device.h"
#include "tests/support/lavapipe.h"

/* ---- errors ---- */

void log_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vfprintf(stderr, format, arguments);
    va_end(arguments);
    (void)fputc('\n', stderr);
}

const char *gpu_result_name(VkResult result)
{
    return result == VK_SUCCESS ? "VK_SUCCESS" : "an error";
}

enum status gpu_status(VkResult result)
{
    return result == VK_SUCCESS ? STATUS_OK : STATUS_FAILED;
}

enum status gpu_failed(const char *what, VkResult result)
{
    print_error("%s: VkResult %d\n", what, (int)result);
    return gpu_status(result);
}

enum status gpu_failed_for(const char *call, const char *name, VkResult result)
{
    print_error("%s of %s: VkResult %d\n", call, name ? name : "?", (int)result);
    return gpu_status(result);
}

void gpu_debug_name(const struct gpu *gpu, VkObjectType type, uint64_t handle, const char *name)
{
    (void)gpu;
    (void)type;
    (void)handle;
    (void)name;
}

/* ---- the device ---- */

struct gpu_params lavapipe_params(void)
{
    return (struct gpu_params){ 0 };
}

void lavapipe_environment(void)
{
}

enum status gpu_create(struct gpu *gpu, const struct gpu_params *params)
{
    struct gpu found = { .validated = true, .windows = params->windows };
    uint32_t count = 1;
    const VkApplicationInfo application = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
        .apiVersion = VK_API_VERSION_1_3,
    };
    const VkInstanceCreateInfo instance = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pApplicationInfo = &application,
    };
    VkResult result = volkInitialize();
    if (result == VK_SUCCESS)
        result = vkCreateInstance(&instance, NULL, &found.instance);
    if (result != VK_SUCCESS)
        return gpu_failed("vkCreateInstance", result);
    volkLoadInstance(found.instance);
    result = vkEnumeratePhysicalDevices(found.instance, &count, &found.physical);
    if (result < 0 || !count)
        return gpu_failed("vkEnumeratePhysicalDevices", result);
    vkGetPhysicalDeviceProperties(found.physical, &found.properties);
    vkGetPhysicalDeviceMemoryProperties(found.physical, &found.memory);
    found.max_anisotropy = found.properties.limits.maxSamplerAnisotropy;
    found.has_statistics = true;
    found.has_rays = all_features_device_has_rays(&found);
    all_features_device_open(gpu, &found);
    return STATUS_OK;
}

void gpu_destroy(struct gpu *gpu)
{
    all_features_device_close(gpu);
    vkDestroyInstance(gpu->instance, NULL);
    *gpu = (struct gpu){ 0 };
}

int lavapipe_open(void **state)
{
    struct gpu *gpu = calloc(1, sizeof(*gpu));
    const struct gpu_params params = lavapipe_params();
    *state = gpu;
    return gpu && gpu_create(gpu, &params) == STATUS_OK ? 0 : -1;
}

int lavapipe_open_for_timelines(void **state)
{
    return lavapipe_open(state);
}

int lavapipe_close(void **state)
{
    gpu_destroy(*state);
    free(*state);
    return 0;
}

int lavapipe_run(const struct CMUnitTest *tests, size_t count)
{
    struct CMUnitTest on_device[16];
    assert_true(count <= sizeof(on_device) / sizeof(on_device[0]));
    for (size_t i = 0; i < count; i++) {
        on_device[i] = tests[i];
        on_device[i].setup = lavapipe_open;
        on_device[i].teardown = lavapipe_close;
    }
    return cmocka_run(on_device, count);
}
