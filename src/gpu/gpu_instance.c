/* gpu_instance.c: creates the Vulkan instance with the available layers and extensions. */
#include <stdlib.h>
#include <string.h>

#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

static const char layer[] = "VK_LAYER_KHRONOS_validation";

/* Maximum numbers of extensions that firn and a window system enable. */
enum {
    OWN_EXTENSION_COUNT = 3,
    WINDOW_EXTENSION_COUNT = 8,
};

/* Availability of the optional layers and extensions. */
struct offer {
    bool layer, validation_features, debug_utils, portability;
};

bool gpu_has_extension(const VkExtensionProperties *list, uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(list[i].extensionName, name) == 0)
            return true;
    }
    return false;
}

/* Lists the extensions of layer `of`. NULL means loader and drivers. The caller frees *list. */
static VkResult list_extensions(const char *of, VkExtensionProperties **list, uint32_t *count)
{
    *list = NULL;
    VkResult result = vkEnumerateInstanceExtensionProperties(of, count, NULL);
    if (result != VK_SUCCESS || *count == 0)
        return result;
    *list = calloc(*count, sizeof(**list));
    if (!*list)
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    result = vkEnumerateInstanceExtensionProperties(of, count, *list);
    return result == VK_INCOMPLETE ? VK_SUCCESS : result;
}

static VkResult find_offer(bool validate, struct offer *offer)
{
    VkExtensionProperties *list = NULL;
    uint32_t count = 0;
    VkResult result = list_extensions(NULL, &list, &count);
    if (result == VK_SUCCESS) {
        offer->debug_utils = gpu_has_extension(list, count, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        offer->portability =
            gpu_has_extension(list, count, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    }
    free(list);
    if (result != VK_SUCCESS || !validate)
        return result;

    list = NULL;
    result = list_extensions(layer, &list, &count);
    if (result == VK_SUCCESS) {
        offer->layer = true;
        offer->validation_features =
            gpu_has_extension(list, count, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    free(list);
    return result == VK_ERROR_LAYER_NOT_PRESENT ? VK_SUCCESS : result;
}

static VkResult create(struct gpu *gpu, const struct offer *offer)
{
    const VkValidationFeatureEnableEXT sync =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    /* This messenger reports messages while the instance is created and destroyed. */
    VkDebugUtilsMessengerCreateInfoEXT messenger = gpu_debug_messenger(gpu);
    VkValidationFeaturesEXT features = {
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .pNext = &messenger,
        .enabledValidationFeatureCount = 1,
        .pEnabledValidationFeatures = &sync,
    };
    const VkApplicationInfo application = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
        .pApplicationName = "firn",
        .apiVersion = VK_API_VERSION_1_3,
    };
    const char *const layers[] = { layer };
    const uint32_t window_count = gpu->windows ? gpu->windows->instance_extension_count : 0;
    const char *extensions[OWN_EXTENSION_COUNT + WINDOW_EXTENSION_COUNT];
    VkInstanceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pApplicationInfo = &application,
        .ppEnabledLayerNames = layers,
        .enabledLayerCount = offer->layer ? 1 : 0,
        .ppEnabledExtensionNames = extensions,
    };
    for (uint32_t i = 0; i < window_count && i < WINDOW_EXTENSION_COUNT; i++)
        extensions[info.enabledExtensionCount++] = gpu->windows->instance_extensions[i];
    if (offer->debug_utils)
        extensions[info.enabledExtensionCount++] = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    if (offer->portability) {
        extensions[info.enabledExtensionCount++] = VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME;
        info.flags = VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    }
    if (offer->layer && offer->debug_utils)
        info.pNext = &messenger;
    if (offer->layer && offer->debug_utils && offer->validation_features) {
        extensions[info.enabledExtensionCount++] = VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME;
        info.pNext = &features;
    }
    const VkResult result = vkCreateInstance(&info, NULL, &gpu->instance);
    if (result != VK_SUCCESS)
        gpu->instance = VK_NULL_HANDLE;
    return result;
}

VkResult gpu_instance_create(struct gpu *gpu, bool validate)
{
    if (volkGetInstanceVersion() < VK_API_VERSION_1_3)
        return VK_ERROR_INCOMPATIBLE_DRIVER;
    struct offer offer = { 0 };
    VkResult result = find_offer(validate, &offer);
    if (result == VK_SUCCESS)
        result = create(gpu, &offer);
    if (result != VK_SUCCESS)
        return result;

    /* not volkLoadDevice(), whose functions work with one device only: a program may open more */
    volkLoadInstance(gpu->instance);
    gpu->validated = offer.layer && offer.debug_utils;
    if (gpu->validated) {
        const VkDebugUtilsMessengerCreateInfoEXT info = gpu_debug_messenger(gpu);
        return vkCreateDebugUtilsMessengerEXT(gpu->instance, &info, NULL, &gpu->messenger);
    }
    if (validate)
        log_warning(
            "--validate: expected the layer %s, which is not installed: nothing is validated; "
            "install vulkan-validationlayers",
            layer);
    return VK_SUCCESS;
}
