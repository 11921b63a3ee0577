/* gpu_debug.c: messages of the validation layer, and names of objects for captures. */
#include <string.h>

#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

static VKAPI_ATTR VkBool32 VKAPI_CALL count_message(
    VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
    const VkDebugUtilsMessengerCallbackDataEXT *data, void *user)
{
    (void)types;
    struct gpu *gpu = user;
    const char *id = data->pMessageIdName ? data->pMessageIdName : "";
    /* The Vulkan loader warns of drivers that find no device; that is not an error. Writes to
     * colour targets that rg_compile() has left out are discarded as intended. To ignore this hides
     * no mistake, because rg_compile() compares shader outputs with the declared targets. */
    if (strcmp(id, "Loader Message") == 0 || strstr(id, "OutputNotConsumed"))
        return VK_FALSE;
    gpu->message_count++;
    if (severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT)
        log_error("%.600s", data->pMessage);
    else
        log_warning("%.600s", data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT gpu_debug_messenger(struct gpu *gpu)
{
    return (VkDebugUtilsMessengerCreateInfoEXT){
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        /* PERFORMANCE messages are left out, because they may concern other hardware */
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = count_message,
        .pUserData = gpu,
    };
}

void gpu_debug_name(const struct gpu *gpu, VkObjectType type, uint64_t handle, const char *name)
{
    if (!name || !vkSetDebugUtilsObjectNameEXT)
        return;
    const VkDebugUtilsObjectNameInfoEXT info = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name,
    };
    (void)vkSetDebugUtilsObjectNameEXT(gpu->device, &info);
}
