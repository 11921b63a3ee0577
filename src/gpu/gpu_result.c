/* gpu_result.c: Vulkan's results in words and as a status. */
#include "src/gpu/gpu.h"
#include "src/log.h"

#define ROW(result) result, #result

static const struct {
    VkResult result;
    const char *name;
} names[] = {
    { ROW(VK_SUCCESS) },
    { ROW(VK_NOT_READY) },
    { ROW(VK_TIMEOUT) },
    { ROW(VK_EVENT_SET) },
    { ROW(VK_EVENT_RESET) },
    { ROW(VK_INCOMPLETE) },
    { ROW(VK_SUBOPTIMAL_KHR) },
    { ROW(VK_PIPELINE_COMPILE_REQUIRED) },
    { ROW(VK_ERROR_OUT_OF_HOST_MEMORY) },
    { ROW(VK_ERROR_OUT_OF_DEVICE_MEMORY) },
    { ROW(VK_ERROR_INITIALIZATION_FAILED) },
    { ROW(VK_ERROR_DEVICE_LOST) },
    { ROW(VK_ERROR_MEMORY_MAP_FAILED) },
    { ROW(VK_ERROR_LAYER_NOT_PRESENT) },
    { ROW(VK_ERROR_EXTENSION_NOT_PRESENT) },
    { ROW(VK_ERROR_FEATURE_NOT_PRESENT) },
    { ROW(VK_ERROR_INCOMPATIBLE_DRIVER) },
    { ROW(VK_ERROR_TOO_MANY_OBJECTS) },
    { ROW(VK_ERROR_FORMAT_NOT_SUPPORTED) },
    { ROW(VK_ERROR_FRAGMENTED_POOL) },
    { ROW(VK_ERROR_OUT_OF_POOL_MEMORY) },
    { ROW(VK_ERROR_INVALID_EXTERNAL_HANDLE) },
    { ROW(VK_ERROR_FRAGMENTATION) },
    { ROW(VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS) },
    { ROW(VK_ERROR_SURFACE_LOST_KHR) },
    { ROW(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR) },
    { ROW(VK_ERROR_OUT_OF_DATE_KHR) },
    { ROW(VK_ERROR_INCOMPATIBLE_DISPLAY_KHR) },
    { ROW(VK_ERROR_VALIDATION_FAILED_EXT) },
    { ROW(VK_ERROR_INVALID_SHADER_NV) },
    { ROW(VK_ERROR_NOT_PERMITTED_KHR) },
    { ROW(VK_ERROR_UNKNOWN) },
};

const char *gpu_result_name(VkResult result)
{
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        if (names[i].result == result)
            return names[i].name;
    }
    return "a VkResult without a name";
}

enum status gpu_status(VkResult result)
{
    if (result == VK_SUCCESS)
        return STATUS_OK;
    if (result == VK_ERROR_DEVICE_LOST || result == VK_ERROR_OUT_OF_HOST_MEMORY ||
        result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        return STATUS_TRY_AGAIN;
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_INITIALIZATION_FAILED)
        return STATUS_NO_DEVICE;
    return STATUS_FAILED;
}

enum status gpu_failed(const char *what, VkResult result)
{
    log_error("%s: %s", what, gpu_result_name(result));
    return gpu_status(result);
}
