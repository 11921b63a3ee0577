/* gpu_result.c: names of VkResult values, advice for the user, and conversion to enum status. */
#include <stdio.h>

#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/gpu/gpu_internal.h"

#define ROW(value) .result = (value), .name = #value

static const char lost[] = "the device was lost: retry; if a frame takes seconds, with --tiles";
static const char memory[] =
    "out of memory: end other programs, or use --size, --tiles or --interleaved to need less";

static const struct row {
    VkResult result;
    const char *name;
    const char *advice; /* advice for the user, or NULL */
} rows[] = {
    { ROW(VK_SUCCESS) },
    { ROW(VK_NOT_READY) },
    { ROW(VK_TIMEOUT), .advice = lost },
    { ROW(VK_EVENT_SET) },
    { ROW(VK_EVENT_RESET) },
    { ROW(VK_INCOMPLETE) },
    { ROW(VK_SUBOPTIMAL_KHR) },
    { ROW(VK_PIPELINE_COMPILE_REQUIRED) },
    { ROW(VK_ERROR_OUT_OF_HOST_MEMORY), .advice = memory },
    { ROW(VK_ERROR_OUT_OF_DEVICE_MEMORY), .advice = memory },
    { ROW(VK_ERROR_INITIALIZATION_FAILED) },
    { ROW(VK_ERROR_DEVICE_LOST), .advice = lost },
    { ROW(VK_ERROR_MEMORY_MAP_FAILED), .advice = memory },
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

static const struct row *find_row(VkResult result)
{
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        if (rows[i].result == result)
            return &rows[i];
    }
    return NULL;
}

const char *gpu_result_name(VkResult result)
{
    const struct row *row = find_row(result);
    return row ? row->name : "a VkResult without a name";
}

/* Returns the memory limit of this process, MiB; 0 if there is none. */
static unsigned memory_limit(void)
{
    return (unsigned)(machine_memory_limit() >> 20);
}

const char *gpu_driver_advice(void)
{
    return memory_limit() ? "install a driver, or raise the memory limit of this process (ulimit "
                            "-v), which may prevent drivers from loading"
                          : "install or update libvulkan1 and a driver (mesa-vulkan-drivers has "
                            "one for the CPU)";
}

/* Returns true if VK_ERROR_UNKNOWN probably means that the process hit its memory limit. */
static bool is_out_of_limit(VkResult result)
{
    return result == VK_ERROR_UNKNOWN && memory_limit() != 0;
}

enum status gpu_status(VkResult result)
{
    if (is_out_of_limit(result))
        return STATUS_TRY_AGAIN;

    switch ((int)result) {
    case VK_SUCCESS:
        return STATUS_OK;
    case VK_TIMEOUT: /* even if a wait is unlimited */
    case VK_ERROR_DEVICE_LOST:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_FRAGMENTATION:
    case VK_ERROR_MEMORY_MAP_FAILED:
    case VK_ERROR_TOO_MANY_OBJECTS:
    case VK_ERROR_SURFACE_LOST_KHR:
        return STATUS_TRY_AGAIN;
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_INITIALIZATION_FAILED:
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
        return STATUS_NO_DEVICE;
    default:
        return STATUS_FAILED;
    }
}

enum status gpu_failed(const char *what, VkResult result)
{
    const struct row *row = find_row(result);
    if (is_out_of_limit(result))
        log_error("%s: %s: probably out of memory: the limit of this process is %u MiB; raise it "
                  "(ulimit -v)",
                  what, row->name, memory_limit());
    else if (row && row->advice)
        log_error("%s: %s: %s", what, row->name, row->advice);
    else
        log_error("%s: %s", what, gpu_result_name(result));
    return gpu_status(result);
}

enum status gpu_failed_for(const char *call, const char *name, VkResult result)
{
    char what[256];
    snprintf(what, sizeof(what), "%s of %s", call, name ? name : "an object without a name");
    return gpu_failed(what, result);
}
