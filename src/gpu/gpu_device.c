/* gpu_device.c: opens and closes a Vulkan device; lists the devices of the machine. */
#include <stdlib.h>

#include "graph/rg_exec.h"
#include "src/base/log.h"
#include "src/gpu/gpu_acceleration.h"
#include "src/gpu/gpu_fallback.h"
#include "src/gpu/gpu_internal.h"

/* Maximum number of devices; further ones are ignored. */
enum {
    DEVICES_MAX = 32,
};

static VkResult find_devices(VkInstance instance, VkPhysicalDevice *devices, uint32_t *count)
{
    *count = DEVICES_MAX;
    const VkResult result = vkEnumeratePhysicalDevices(instance, count, devices);
    if (result == VK_SUCCESS || result == VK_INCOMPLETE)
        return VK_SUCCESS;
    *count = 0;
    /* Some loaders return VK_ERROR_INITIALIZATION_FAILED if there is no device. */
    return result == VK_ERROR_INITIALIZATION_FAILED ? VK_SUCCESS : result;
}

static void destroy_instance(struct gpu *gpu)
{
    if (gpu->messenger)
        vkDestroyDebugUtilsMessengerEXT(gpu->instance, gpu->messenger, NULL);
    if (gpu->instance)
        vkDestroyInstance(gpu->instance, NULL);
    gpu->messenger = VK_NULL_HANDLE;
    gpu->instance = VK_NULL_HANDLE;
}

/* Returns true if firn can use one of the instance's devices. */
static bool has_usable_device(const struct gpu *gpu)
{
    VkPhysicalDevice physical[DEVICES_MAX];
    struct gpu_device device;
    uint32_t count = 0;
    bool found = false;
    if (find_devices(gpu->instance, physical, &count) != VK_SUCCESS)
        return false;
    for (uint32_t i = 0; i < count && !found; i++) {
        gpu_choose_describe(gpu, physical[i], &device);
        found = !device.refused[0];
    }
    return found;
}

/* Creates the instance. If it has no usable device, adds the bundled driver, if there is one. */
static VkResult create_instance(struct gpu *gpu, bool validate)
{
    const VkResult result = gpu_instance_create(gpu, validate);
    if (!gpu_fallback_is_ready() || (result != VK_ERROR_INCOMPATIBLE_DRIVER &&
                                     (result != VK_SUCCESS || has_usable_device(gpu))))
        return result;
    destroy_instance(gpu);
    gpu_fallback_use();
    return gpu_instance_create(gpu, validate);
}

static enum status open_instance(struct gpu *gpu, bool validate)
{
    if (volkInitialize() != VK_SUCCESS) {
        log_error("no Vulkan loader (libvulkan.so.1): install libvulkan1 and a driver");
        return STATUS_NO_DEVICE;
    }
    const VkResult result = create_instance(gpu, validate);
    if (result == VK_SUCCESS)
        return STATUS_OK;
    if (result != VK_ERROR_INCOMPATIBLE_DRIVER)
        return gpu_failed("vkCreateInstance", result);
    log_error("no Vulkan driver, or no Vulkan 1.3: %s", gpu_driver_advice());
    return STATUS_NO_DEVICE;
}

static enum status choose(struct gpu *gpu, const char *requested)
{
    VkPhysicalDevice physical[DEVICES_MAX];
    struct gpu_device devices[DEVICES_MAX];
    uint32_t count = 0;
    uint32_t index = 0;
    const VkResult result = find_devices(gpu->instance, physical, &count);
    if (result != VK_SUCCESS)
        return gpu_failed("vkEnumeratePhysicalDevices", result);
    for (uint32_t i = 0; i < count; i++)
        gpu_choose_describe(gpu, physical[i], &devices[i]);
    const enum status status = gpu_choose(devices, count, requested, &index);
    if (status != STATUS_OK)
        return status;
    gpu->physical = physical[index];
    vkGetPhysicalDeviceProperties(gpu->physical, &gpu->properties);
    vkGetPhysicalDeviceMemoryProperties(gpu->physical, &gpu->memory);
    gpu->queue_family = gpu_choose_queue_family(gpu, gpu->physical);
    return STATUS_OK;
}

/* Creates the device with the optional extensions that gpu->physical has and firn uses. */
static VkResult create_device(const struct gpu *gpu, const struct gpu_features *features,
                              VkDevice *device)
{
    const float priority = 1.0F;
    const char *extensions[2 + GPU_RAY_EXTENSION_COUNT];
    uint32_t extension_count = 0;
    if (gpu->portability_subset) /* if offered, it must be enabled */
        extensions[extension_count++] = "VK_KHR_portability_subset";
    if (gpu->windows)
        extensions[extension_count++] = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    for (int i = 0; i < GPU_RAY_EXTENSION_COUNT && features->rays; i++)
        extensions[extension_count++] = gpu_ray_extensions[i];
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = gpu->queue_family,
        .queueCount = 1,
        .pQueuePriorities = &priority,
    };
    const VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &features->core,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .enabledExtensionCount = extension_count,
        .ppEnabledExtensionNames = extensions,
    };
    return vkCreateDevice(gpu->physical, &info, NULL, device);
}

static enum status open_device(struct gpu *gpu)
{
    struct gpu_features features;
    struct gpu_device_extensions offer;

    VkResult result = gpu_device_extensions_find(gpu->physical, &offer);
    if (result != VK_SUCCESS)
        return gpu_failed("vkEnumerateDeviceExtensionProperties", result);
    /* required features were checked when the device was chosen */
    (void)gpu_features_choose(gpu->physical, offer.rays, &features);
    gpu->portability_subset = offer.portability_subset;
    result = create_device(gpu, &features, &gpu->device);
    if (result != VK_SUCCESS) {
        gpu->device = VK_NULL_HANDLE;
        return gpu_failed("vkCreateDevice", result);
    }
    vkGetDeviceQueue(gpu->device, gpu->queue_family, 0, &gpu->queue);
    gpu->pipelines = rg_pipelines_create();
    if (features.core.features.samplerAnisotropy)
        gpu->max_anisotropy = gpu->properties.limits.maxSamplerAnisotropy;
    gpu->has_rays = features.rays;
    gpu->has_statistics = features.core.features.pipelineStatisticsQuery &&
                          features.core.features.occlusionQueryPrecise;
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags =
            VK_COMMAND_POOL_CREATE_TRANSIENT_BIT | VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = gpu->queue_family,
    };
    result = vkCreateCommandPool(gpu->device, &pool, NULL, &gpu->pool);
    if (result != VK_SUCCESS) {
        gpu->pool = VK_NULL_HANDLE;
        return gpu_failed("vkCreateCommandPool", result);
    }
    return gpu_pipeline_cache_load(gpu);
}

enum status gpu_create(struct gpu *gpu, const struct gpu_params *params)
{
    *gpu = (struct gpu){ .windows = params->windows, .no_cache = params->no_cache };
    enum status status = open_instance(gpu, params->validate);
    if (status == STATUS_OK)
        status = choose(gpu, params->device);
    if (status == STATUS_OK)
        status = open_device(gpu);
    if (status != STATUS_OK) {
        gpu_destroy(gpu);
        *gpu = (struct gpu){ 0 };
    }
    return status;
}

void gpu_destroy(struct gpu *gpu)
{
    if (gpu->device) {
        (void)vkDeviceWaitIdle(gpu->device); /* the device is destroyed even if it is lost */
        if (gpu->pipeline_cache && !gpu->no_cache)
            gpu_pipeline_cache_save(gpu);
        gpu_acceleration_destroy(gpu, gpu->rays);
        rg_pipelines_destroy(gpu->pipelines);
        vkDestroyPipelineCache(gpu->device, gpu->pipeline_cache, NULL);
        vkDestroyCommandPool(gpu->device, gpu->pool, NULL);
        vkDestroyDevice(gpu->device, NULL);
    }
    destroy_instance(gpu);
    *gpu = (struct gpu){ .message_count = gpu->message_count };
}

bool gpu_is_lost(const struct gpu *gpu)
{
    return gpu->device && vkDeviceWaitIdle(gpu->device) == VK_ERROR_DEVICE_LOST;
}

void gpu_describe(const struct gpu *gpu, struct gpu_device *device)
{
    gpu_choose_describe(gpu, gpu->physical, device);
}

static bool has_rays(VkPhysicalDevice physical)
{
    struct gpu_features features;
    struct gpu_device_extensions offer;
    if (gpu_device_extensions_find(physical, &offer) != VK_SUCCESS)
        return false;
    (void)gpu_features_choose(physical, offer.rays, &features);
    return features.rays;
}

enum status gpu_list(struct gpu_device **devices, uint32_t *count)
{
    VkPhysicalDevice physical[DEVICES_MAX];
    struct gpu gpu = { 0 };
    enum status status = STATUS_OK;

    *devices = NULL;
    *count = 0;
    if (volkInitialize() != VK_SUCCESS)
        return STATUS_OK;
    VkResult result = create_instance(&gpu, false);
    if (result == VK_SUCCESS)
        result = find_devices(gpu.instance, physical, count);
    if (result == VK_SUCCESS && *count > 0) {
        *devices = calloc(*count, sizeof(**devices));
        if (!*devices)
            result = VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    if (result == VK_SUCCESS) {
        for (uint32_t i = 0; i < *count; i++) {
            gpu_choose_describe(&gpu, physical[i], &(*devices)[i]);
            (*devices)[i].has_rays = !(*devices)[i].refused[0] && has_rays(physical[i]);
        }
    } else {
        *count = 0;
        if (result != VK_ERROR_INCOMPATIBLE_DRIVER)
            status = gpu_failed("listing the Vulkan devices", result);
    }
    gpu_destroy(&gpu);
    return status;
}
