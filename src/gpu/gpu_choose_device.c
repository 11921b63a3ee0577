/* gpu_choose_device.c: describes devices, checks whether firn can use them, and chooses one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "src/base/ascii.h"
#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

/* Device limits that firn requires: bytes of push constants, number of colour attachments. */
enum {
    PUSH_CONSTANTS_SIZE = 128,
    COLOR_ATTACHMENT_COUNT = 8,
};

/* Types of devices, best first. */
static const struct {
    VkPhysicalDeviceType type;
    const char *name;
} kinds[] = {
    { VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, "discrete GPU" },
    { VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, "integrated GPU" },
    { VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, "virtual GPU" },
    { VK_PHYSICAL_DEVICE_TYPE_CPU, "CPU" },
    { VK_PHYSICAL_DEVICE_TYPE_OTHER, "other" },
};

enum {
    KIND_COUNT = sizeof(kinds) / sizeof(kinds[0]),
};

static uint32_t type_rank(VkPhysicalDeviceType type)
{
    uint32_t i = 0;
    while (i < KIND_COUNT - 1 && kinds[i].type != type)
        i++;
    return i;
}

struct feature {
    const char *name;
    size_t offset; /* in struct gpu_features */
};

#define CORE(feature) #feature, offsetof(struct gpu_features, core.features.feature)
#define V12(feature)  #feature, offsetof(struct gpu_features, v12.feature)
#define V13(feature)  #feature, offsetof(struct gpu_features, v13.feature)

static const struct feature required[] = {
    { V13(dynamicRendering) },
    { V13(synchronization2) },
    { V13(maintenance4) },
    { V12(scalarBlockLayout) },
    { V12(separateDepthStencilLayouts) },
    { CORE(independentBlend) },
};

static const struct feature optional[] = {
    { CORE(samplerAnisotropy) },
    { CORE(pipelineStatisticsQuery) },
    { CORE(occlusionQueryPrecise) },
    { V12(hostQueryReset) },
    { V12(timelineSemaphore) },
    /* rays of shaders/refract/inclusion_march.glsl may access texels outside the image */
    { V13(robustImageAccess) },
};

/* Features enabled only on a device that has gpu_ray_extensions. */
static const struct feature ray_features[] = {
    { V12(bufferDeviceAddress) },
    { "accelerationStructure", offsetof(struct gpu_features, structures.accelerationStructure) },
    { "rayQuery", offsetof(struct gpu_features, queries.rayQuery) },
};

const char *const gpu_ray_extensions[GPU_RAY_EXTENSION_COUNT] = {
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
    VK_KHR_RAY_QUERY_EXTENSION_NAME,
};

static void chain(struct gpu_features *features, bool rays)
{
    *features = (struct gpu_features){
        .core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &features->v12 },
        .v12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                 .pNext = &features->v13 },
        .v13 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                 .pNext = rays ? &features->structures : NULL },
        .structures = { .sType =
                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR,
                        .pNext = &features->queries },
        .queries = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR },
        .rays = rays,
    };
}

/* Enables a feature if the device has it. Returns true if the feature was enabled. */
static bool enable(const struct feature *feature, const struct gpu_features *has,
                   struct gpu_features *requested)
{
    VkBool32 supported = VK_FALSE;
    memcpy(&supported, (const char *)has + feature->offset, sizeof(supported));
    memcpy((char *)requested + feature->offset, &supported, sizeof(supported));
    return supported;
}

const char *gpu_features_choose(VkPhysicalDevice physical, bool rays,
                                struct gpu_features *requested)
{
    struct gpu_features has;
    const char *missing = NULL;
    chain(&has, rays);
    chain(requested, rays);
    vkGetPhysicalDeviceFeatures2(physical, &has.core);
    for (size_t i = 0; i < sizeof(required) / sizeof(required[0]); i++) {
        if (!enable(&required[i], &has, requested) && !missing)
            missing = required[i].name;
    }
    for (size_t i = 0; i < sizeof(optional) / sizeof(optional[0]); i++)
        (void)enable(&optional[i], &has, requested);
    for (size_t i = 0; i < sizeof(ray_features) / sizeof(ray_features[0]) && rays; i++)
        requested->rays = enable(&ray_features[i], &has, requested) && requested->rays;
    if (!requested->rays) {
        requested->v12.bufferDeviceAddress = VK_FALSE;
        requested->v13.pNext = NULL;
    }
    return missing;
}

VkResult gpu_device_extensions_find(VkPhysicalDevice physical, struct gpu_device_extensions *offer)
{
    uint32_t count = 0;
    *offer = (struct gpu_device_extensions){ 0 };
    VkResult result = vkEnumerateDeviceExtensionProperties(physical, NULL, &count, NULL);
    if (result != VK_SUCCESS || count == 0)
        return result;
    VkExtensionProperties *list = calloc(count, sizeof(*list));
    if (!list)
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    result = vkEnumerateDeviceExtensionProperties(physical, NULL, &count, list);
    if (result == VK_INCOMPLETE)
        result = VK_SUCCESS;
    if (result == VK_SUCCESS) {
        offer->portability_subset = gpu_has_extension(list, count, "VK_KHR_portability_subset");
        offer->swapchain = gpu_has_extension(list, count, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
        offer->rays = true;
        for (int i = 0; i < GPU_RAY_EXTENSION_COUNT; i++)
            offer->rays = offer->rays && gpu_has_extension(list, count, gpu_ray_extensions[i]);
    }
    free(list);
    return result;
}

static bool has_swapchain(VkPhysicalDevice physical)
{
    struct gpu_device_extensions offer;
    return gpu_device_extensions_find(physical, &offer) == VK_SUCCESS && offer.swapchain;
}

uint32_t gpu_choose_queue_family(const struct gpu *gpu, VkPhysicalDevice physical)
{
    const struct gpu_window_system *windows = gpu->windows;
    VkQueueFamilyProperties families[32];
    const VkQueueFlags both = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    uint32_t count = sizeof(families) / sizeof(families[0]);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    for (uint32_t i = 0; i < count; i++) {
        if ((families[i].queueFlags & both) == both &&
            (!windows || windows->can_present(gpu->instance, physical, i)))
            return i;
    }
    return UINT32_MAX;
}

static void find_refusal(const struct gpu *gpu, VkPhysicalDevice physical,
                         const VkPhysicalDeviceProperties *properties, char *refused, size_t size)
{
    const VkPhysicalDeviceLimits *limits = &properties->limits;
    const uint32_t version = properties->apiVersion;
    struct gpu_features requested;
    const char *missing = NULL;

    refused[0] = '\0';
    if (version < VK_API_VERSION_1_3)
        snprintf(refused, size, "expected Vulkan 1.3, got %u.%u", VK_API_VERSION_MAJOR(version),
                 VK_API_VERSION_MINOR(version));
    else if ((missing = gpu_features_choose(physical, false, &requested)))
        snprintf(refused, size, "no %s", missing);
    else if (gpu->windows && !has_swapchain(physical))
        snprintf(refused, size, "no %s, which windows need", VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    else if (gpu_choose_queue_family(gpu, physical) == UINT32_MAX)
        snprintf(refused, size, "no queue with graphics and compute%s",
                 gpu->windows ? " that can present to windows" : "");
    else if (limits->maxPushConstantsSize < PUSH_CONSTANTS_SIZE)
        snprintf(refused, size, "maxPushConstantsSize is %u, expected at least %d",
                 limits->maxPushConstantsSize, PUSH_CONSTANTS_SIZE);
    else if (limits->maxColorAttachments < COLOR_ATTACHMENT_COUNT)
        snprintf(refused, size, "maxColorAttachments is %u, expected at least %d",
                 limits->maxColorAttachments, COLOR_ATTACHMENT_COUNT);
    else if (limits->maxFragmentOutputAttachments < COLOR_ATTACHMENT_COUNT)
        snprintf(refused, size, "maxFragmentOutputAttachments is %u, expected at least %d",
                 limits->maxFragmentOutputAttachments, COLOR_ATTACHMENT_COUNT);
}

void gpu_choose_describe(const struct gpu *gpu, VkPhysicalDevice physical,
                         struct gpu_device *device)
{
    VkPhysicalDeviceDriverProperties driver = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
    };
    VkPhysicalDeviceProperties2 all = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2 };
    const VkPhysicalDeviceProperties *properties = &all.properties;
    vkGetPhysicalDeviceProperties(physical, &all.properties);
    const uint32_t version = properties->apiVersion;
    if (version >= VK_API_VERSION_1_2) {
        all.pNext = &driver;
        vkGetPhysicalDeviceProperties2(physical, &all);
    }

    *device = (struct gpu_device){
        .type = properties->deviceType,
        .kind = kinds[type_rank(properties->deviceType)].name,
    };
    snprintf(device->name, sizeof(device->name), "%s", properties->deviceName);
    snprintf(device->version, sizeof(device->version), "%u.%u.%u%s%.40s",
             VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
             VK_API_VERSION_PATCH(version), driver.driverInfo[0] ? ", " : "", driver.driverInfo);
    find_refusal(gpu, physical, properties, device->refused, sizeof(device->refused));
}

/* Returns true if `name` contains `substring`, ignoring case. */
static bool contains(const char *name, const char *substring)
{
    const size_t length = strlen(substring);
    for (; *name; name++) {
        if (ascii_begins_equal(name, substring, length))
            return true;
    }
    return length == 0;
}

static bool matches(const struct gpu_device *device, uint32_t number, const char *requested)
{
    if (!requested)
        return true;
    if (requested[0] && strspn(requested, "0123456789") == strlen(requested))
        return strtoull(requested, NULL, 10) == number;
    return contains(device->name, requested);
}

/* Writes "0: NAME, 1: NAME (no synchronization2)" to `text`, truncated to `size` bytes. */
static void list_names(const struct gpu_device *devices, uint32_t count, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (uint32_t i = 0; i < count && used < size; i++) {
        const bool refused = devices[i].refused[0];
        const int length =
            snprintf(text + used, size - used, "%s%u: %s%s%s%s", i ? ", " : "", i, devices[i].name,
                     refused ? " (" : "", devices[i].refused, refused ? ")" : "");
        used += length > 0 ? (size_t)length : 0;
    }
}

enum status gpu_choose(const struct gpu_device *devices, uint32_t count, const char *requested,
                       uint32_t *index)
{
    const struct gpu_device *best = NULL;
    const struct gpu_device *refused = NULL;
    char names[1024];

    for (uint32_t i = 0; i < count; i++) {
        if (!matches(&devices[i], i, requested))
            continue;
        if (devices[i].refused[0])
            refused = refused ? refused : &devices[i];
        else if (!best || type_rank(devices[i].type) < type_rank(best->type))
            best = &devices[i];
    }
    if (best) {
        *index = (uint32_t)(best - devices);
        return STATUS_OK;
    }
    list_names(devices, count, names, sizeof(names));
    if (count == 0)
        log_error("no Vulkan device: %s", gpu_driver_advice());
    else if (requested && refused)
        log_error("%s: %s", refused->name, refused->refused);
    else if (requested)
        log_error("unknown Vulkan device '%s': available are %s", requested, names);
    else
        log_error("no usable Vulkan device: %s", names);
    return STATUS_NO_DEVICE;
}
