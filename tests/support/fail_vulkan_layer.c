/*
 * fail_vulkan_layer.c: VK_LAYER_FIRN_fail, a Vulkan layer for fault injection: it counts calls and
 * makes one fail, as if the device were lost or out of memory.
 *
 * FAIL_COUNT: file to which a line for each command, "vkCreateImage 34", is written when an
 * instance is destroyed. FAIL_CALL: the command that fails, "vkCreateImage". FAIL_AT: number of the
 * call that fails, from 1; each instance counts from 1. FAIL_RESULT: the VkResult that the failed
 * call returns, "-4".
 *
 * It prints the failed call to stderr: "fail_layer: vkCreateImage 3". A failed call does nothing
 * and writes invalid handles to its outputs, as Vulkan allows. A lost device stays lost: all later
 * calls that can report it do so. There can be only one instance and one device at a time.
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

/* clang-format off */

/* Device functions that create one handle: name, create-info type, handle type. */
#define CREATE_FUNCTIONS(row) \
    row(AllocateMemory, VkMemoryAllocateInfo, VkDeviceMemory) \
    row(CreateBuffer, VkBufferCreateInfo, VkBuffer) \
    row(CreateCommandPool, VkCommandPoolCreateInfo, VkCommandPool) \
    row(CreateDescriptorPool, VkDescriptorPoolCreateInfo, VkDescriptorPool) \
    row(CreateDescriptorSetLayout, VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout) \
    row(CreateFence, VkFenceCreateInfo, VkFence) \
    row(CreateFramebuffer, VkFramebufferCreateInfo, VkFramebuffer) \
    row(CreateImage, VkImageCreateInfo, VkImage) \
    row(CreateBufferView, VkBufferViewCreateInfo, VkBufferView) \
    row(CreateImageView, VkImageViewCreateInfo, VkImageView) \
    row(CreatePipelineCache, VkPipelineCacheCreateInfo, VkPipelineCache) \
    row(CreatePipelineLayout, VkPipelineLayoutCreateInfo, VkPipelineLayout) \
    row(CreateQueryPool, VkQueryPoolCreateInfo, VkQueryPool) \
    row(CreateRenderPass, VkRenderPassCreateInfo, VkRenderPass) \
    row(CreateSampler, VkSamplerCreateInfo, VkSampler) \
    row(CreateSemaphore, VkSemaphoreCreateInfo, VkSemaphore) \
    row(CreateShaderModule, VkShaderModuleCreateInfo, VkShaderModule) \
    row(CreateSwapchainKHR, VkSwapchainCreateInfoKHR, VkSwapchainKHR)

/* Other device functions: name, parameters, arguments, outputs to overwrite when the call fails. */
#define DEVICE_FUNCTIONS(row) \
    row(AcquireNextImageKHR, (VkDevice d, VkSwapchainKHR s, uint64_t t, VkSemaphore m, VkFence f, \
        uint32_t *out), (d, s, t, m, f, out), CLOBBER(out)) \
    row(AllocateCommandBuffers, (VkDevice d, const VkCommandBufferAllocateInfo *i, \
        VkCommandBuffer *out), (d, i, out), memset(out, 0, i->commandBufferCount * sizeof(*out))) \
    row(AllocateDescriptorSets, (VkDevice d, const VkDescriptorSetAllocateInfo *i, \
        VkDescriptorSet *out), (d, i, out), memset(out, 0, i->descriptorSetCount * sizeof(*out))) \
    row(BeginCommandBuffer, (VkCommandBuffer c, const VkCommandBufferBeginInfo *i), (c, i), ) \
    row(BindBufferMemory, (VkDevice d, VkBuffer b, VkDeviceMemory m, VkDeviceSize o), \
        (d, b, m, o), ) \
    row(BindImageMemory, (VkDevice d, VkImage b, VkDeviceMemory m, VkDeviceSize o), \
        (d, b, m, o), ) \
    row(CreateComputePipelines, (VkDevice d, VkPipelineCache c, uint32_t n, \
        const VkComputePipelineCreateInfo *i, const VkAllocationCallbacks *a, VkPipeline *out), \
        (d, c, n, i, a, out), memset(out, 0, n * sizeof(*out))) \
    row(CreateGraphicsPipelines, (VkDevice d, VkPipelineCache c, uint32_t n, \
        const VkGraphicsPipelineCreateInfo *i, const VkAllocationCallbacks *a, VkPipeline *out), \
        (d, c, n, i, a, out), memset(out, 0, n * sizeof(*out))) \
    row(DeviceWaitIdle, (VkDevice d), (d), ) \
    row(EndCommandBuffer, (VkCommandBuffer c), (c), ) \
    row(FlushMappedMemoryRanges, (VkDevice d, uint32_t n, const VkMappedMemoryRange *r), \
        (d, n, r), ) \
    row(GetPipelineCacheData, (VkDevice d, VkPipelineCache c, size_t *n, void *out), \
        (d, c, n, out), CLOBBER(n)) \
    row(GetQueryPoolResults, (VkDevice d, VkQueryPool p, uint32_t f, uint32_t n, size_t s, \
        void *out, VkDeviceSize t, VkQueryResultFlags w), (d, p, f, n, s, out, t, w), \
        memset(out, 0x5a, s)) \
    row(GetSwapchainImagesKHR, (VkDevice d, VkSwapchainKHR s, uint32_t *n, VkImage *out), \
        (d, s, n, out), CLOBBER(n)) \
    row(InvalidateMappedMemoryRanges, (VkDevice d, uint32_t n, const VkMappedMemoryRange *r), \
        (d, n, r), ) \
    row(MapMemory, (VkDevice d, VkDeviceMemory m, VkDeviceSize o, VkDeviceSize s, \
        VkMemoryMapFlags f, void **out), (d, m, o, s, f, out), CLOBBER(out)) \
    row(QueuePresentKHR, (VkQueue q, const VkPresentInfoKHR *i), (q, i), ) \
    row(QueueSubmit2, (VkQueue q, uint32_t n, const VkSubmitInfo2 *i, VkFence f), (q, n, i, f), ) \
    row(ResetFences, (VkDevice d, uint32_t n, const VkFence *f), (d, n, f), ) \
    row(SetDebugUtilsObjectNameEXT, (VkDevice d, const VkDebugUtilsObjectNameInfoEXT *i), \
        (d, i), ) \
    row(WaitForFences, (VkDevice d, uint32_t n, const VkFence *f, VkBool32 a, uint64_t t), \
        (d, n, f, a, t), )

/* Instance functions: name, parameters, arguments, outputs to overwrite when the call fails. */
#define INSTANCE_FUNCTIONS(row) \
    row(EnumerateDeviceExtensionProperties, (VkPhysicalDevice p, const char *l, uint32_t *n, \
        VkExtensionProperties *out), (p, l, n, out), CLOBBER(n)) \
    row(EnumeratePhysicalDevices, (VkInstance v, uint32_t *n, VkPhysicalDevice *out), \
        (v, n, out), CLOBBER(n)) \
    row(GetPhysicalDeviceImageFormatProperties, (VkPhysicalDevice p, VkFormat f, VkImageType t, \
        VkImageTiling l, VkImageUsageFlags u, VkImageCreateFlags g, \
        VkImageFormatProperties *out), (p, f, t, l, u, g, out), CLOBBER(out)) \
    row(GetPhysicalDeviceSurfaceCapabilitiesKHR, (VkPhysicalDevice p, VkSurfaceKHR s, \
        VkSurfaceCapabilitiesKHR *out), (p, s, out), CLOBBER(out)) \
    row(GetPhysicalDeviceSurfaceFormatsKHR, (VkPhysicalDevice p, VkSurfaceKHR s, uint32_t *n, \
        VkSurfaceFormatKHR *out), (p, s, n, out), CLOBBER(n)) \
    row(GetPhysicalDeviceSurfacePresentModesKHR, (VkPhysicalDevice p, VkSurfaceKHR s, \
        uint32_t *n, VkPresentModeKHR *out), (p, s, n, out), CLOBBER(n))

/* clang-format on */

#define CLOBBER(out) memset((out), 0x5a, sizeof(*(out)))

/* clang-format off */
enum call {
    CALL_CREATE_INSTANCE,
    CALL_CREATE_DEVICE,
#define ROW(name, ...) CALL_##name,
    CREATE_FUNCTIONS(ROW) DEVICE_FUNCTIONS(ROW) INSTANCE_FUNCTIONS(ROW)
#undef ROW
    CALL_COUNT
};

static const char *const names[] = {
    [CALL_CREATE_INSTANCE] = "vkCreateInstance",
    [CALL_CREATE_DEVICE] = "vkCreateDevice",
#define ROW(name, ...) [CALL_##name] = "vk" #name,
    CREATE_FUNCTIONS(ROW) DEVICE_FUNCTIONS(ROW) INSTANCE_FUNCTIONS(ROW)
#undef ROW
};
/* clang-format on */

static unsigned counts[CALL_COUNT];
static bool lost;
static VkInstance instance;
static VkDevice device;
static PFN_vkGetInstanceProcAddr next_instance;
static PFN_vkGetDeviceProcAddr next_device;

/* Functions of the next layer or the driver; NULL if missing. */
static struct {
#define ROW(name, ...) PFN_vk##name name;
    CREATE_FUNCTIONS(ROW)
    DEVICE_FUNCTIONS(ROW)
    INSTANCE_FUNCTIONS(ROW)
#undef ROW
    PFN_vkDestroyDevice destroy_device;
    PFN_vkDestroyInstance destroy_instance;
} next;

/* Returns true if the function may return VK_ERROR_DEVICE_LOST. */
static bool reports_lost(enum call call)
{
    return call == CALL_AcquireNextImageKHR || call == CALL_CreateSwapchainKHR ||
           call == CALL_DeviceWaitIdle || call == CALL_GetQueryPoolResults ||
           call == CALL_QueuePresentKHR || call == CALL_QueueSubmit2 || call == CALL_WaitForFences;
}

/* Counts a call. Returns the error that it must return, or VK_SUCCESS to call the next layer. */
static VkResult fails(enum call call)
{
    const char *wanted = getenv("FAIL_CALL");
    const char *at = getenv("FAIL_AT");
    const char *result = getenv("FAIL_RESULT");
    counts[call]++;
    if (lost && reports_lost(call))
        return VK_ERROR_DEVICE_LOST;
    if (!wanted || !at || !result || strcmp(wanted, names[call]) != 0 ||
        strtoul(at, NULL, 10) != counts[call])
        return VK_SUCCESS;
    dprintf(STDERR_FILENO, "fail_layer: %s %u\n", names[call], counts[call]);
    const VkResult failure = (VkResult)strtol(result, NULL, 10);
    if (failure == VK_ERROR_DEVICE_LOST && device) {
        lost = true;
        (void)next.DeviceWaitIdle(device); /* lost devices execute nothing further */
    }
    return failure;
}

/* NOLINTBEGIN(bugprone-macro-parentheses,readability-*): Vulkan's names, types as parameters */

#define MAKER(name, info, handle) \
    static VKAPI_ATTR VkResult VKAPI_CALL name(VkDevice d, const info *i, \
                                               const VkAllocationCallbacks *a, handle *out) \
    { \
        const VkResult failure = fails(CALL_##name); \
        if (failure == VK_SUCCESS) \
            return next.name(d, i, a, out); \
        CLOBBER(out); \
        return failure; \
    }
CREATE_FUNCTIONS(MAKER)

#define OTHER(name, parameters, arguments, clobber) \
    static VKAPI_ATTR VkResult VKAPI_CALL name parameters \
    { \
        const VkResult failure = fails(CALL_##name); \
        if (failure == VK_SUCCESS) \
            return next.name arguments; \
        clobber; \
        return failure; \
    }
DEVICE_FUNCTIONS(OTHER)
INSTANCE_FUNCTIONS(OTHER)

static void write_counts(void)
{
    const char *path = getenv("FAIL_COUNT");
    FILE *file = path ? fopen(path, "w") : NULL;
    for (int i = 0; file && i < CALL_COUNT; i++) {
        if (counts[i])
            fprintf(file, "%s %u\n", names[i], counts[i]);
    }
    if (file)
        fclose(file);
}

/* ---- layer chain: instance and device creation, function lookup ---- */

static VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance old, const VkAllocationCallbacks *a)
{
    write_counts();
    memset(counts, 0, sizeof(counts));
    next.destroy_instance(old, a);
}

static VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice old, const VkAllocationCallbacks *a)
{
    next.destroy_device(old, a);
    device = VK_NULL_HANDLE;
    lost = false; /* a new device is not lost */
}

/* Finds the loader's link to the next layer in a pNext chain; the union casts const away. */
#define FIND_LINK(link, info, info_type, create_type) \
    do { \
        union { \
            const void *as_given; \
            info_type *as_ours; \
        } chain = { (info)->pNext }; \
        while (chain.as_ours && !(chain.as_ours->sType == (create_type) && \
                                  chain.as_ours->function == VK_LAYER_LINK_INFO)) \
            chain.as_given = chain.as_ours->pNext; \
        (link) = chain.as_ours; \
    } while (0)

static VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo *info,
                                                      const VkAllocationCallbacks *a,
                                                      VkInstance *out)
{
    VkLayerInstanceCreateInfo *link;
    FIND_LINK(link, info, VkLayerInstanceCreateInfo, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    VkResult result = fails(CALL_CREATE_INSTANCE);
    if (!link)
        return VK_ERROR_INITIALIZATION_FAILED;
    if (result != VK_SUCCESS)
        return result;
    next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const PFN_vkCreateInstance create =
        (PFN_vkCreateInstance)next_instance(VK_NULL_HANDLE, "vkCreateInstance");
    result = create(info, a, out);
    if (result != VK_SUCCESS)
        return result;
    instance = *out;
#define ROW(name, ...) next.name = (PFN_vk##name)next_instance(instance, "vk" #name);
    INSTANCE_FUNCTIONS(ROW)
#undef ROW
    next.destroy_instance = (PFN_vkDestroyInstance)next_instance(instance, "vkDestroyInstance");
    return VK_SUCCESS;
}

static VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                                    const VkDeviceCreateInfo *info,
                                                    const VkAllocationCallbacks *a, VkDevice *out)
{
    VkLayerDeviceCreateInfo *link;
    FIND_LINK(link, info, VkLayerDeviceCreateInfo, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    VkResult result = fails(CALL_CREATE_DEVICE);
    if (device)
        return VK_ERROR_TOO_MANY_OBJECTS;
    if (!link)
        return VK_ERROR_INITIALIZATION_FAILED;
    if (result != VK_SUCCESS)
        return result;
    next_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    const PFN_vkCreateDevice create =
        (PFN_vkCreateDevice)link->u.pLayerInfo->pfnNextGetInstanceProcAddr(instance,
                                                                           "vkCreateDevice");
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    result = create(physical, info, a, out);
    if (result != VK_SUCCESS)
        return result;
    device = *out;
#define ROW(name, ...) next.name = (PFN_vk##name)next_device(device, "vk" #name);
    CREATE_FUNCTIONS(ROW)
    DEVICE_FUNCTIONS(ROW)
#undef ROW
    next.destroy_device = (PFN_vkDestroyDevice)next_device(device, "vkDestroyDevice");
    return VK_SUCCESS;
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL find_device(VkDevice of, const char *name)
{
#define ROW(known, ...) \
    if (next.known && strcmp(name, "vk" #known) == 0) \
        return (PFN_vkVoidFunction)known;
    CREATE_FUNCTIONS(ROW)
    DEVICE_FUNCTIONS(ROW)
#undef ROW
    if (strcmp(name, "vkGetDeviceProcAddr") == 0)
        return (PFN_vkVoidFunction)find_device;
    if (strcmp(name, "vkDestroyDevice") == 0)
        return (PFN_vkVoidFunction)destroy_device;
    return next_device(of, name);
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL find_instance(VkInstance of, const char *name)
{
#define ROW(known, ...) \
    if (next.known && strcmp(name, "vk" #known) == 0) \
        return (PFN_vkVoidFunction)known;
    INSTANCE_FUNCTIONS(ROW)
#undef ROW
    if (strcmp(name, "vkGetInstanceProcAddr") == 0)
        return (PFN_vkVoidFunction)find_instance;
    if (strcmp(name, "vkCreateInstance") == 0)
        return (PFN_vkVoidFunction)create_instance;
    if (strcmp(name, "vkDestroyInstance") == 0)
        return (PFN_vkVoidFunction)destroy_instance;
    if (strcmp(name, "vkCreateDevice") == 0)
        return (PFN_vkVoidFunction)create_device;
    if (strcmp(name, "vkGetDeviceProcAddr") == 0)
        return (PFN_vkVoidFunction)find_device;
    return next_instance ? next_instance(of, name) : NULL;
}

VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *with)
{
    with->loaderLayerInterfaceVersion = CURRENT_LOADER_LAYER_INTERFACE_VERSION;
    with->pfnGetInstanceProcAddr = find_instance;
    with->pfnGetDeviceProcAddr = find_device;
    with->pfnGetPhysicalDeviceProcAddr = NULL;
    return VK_SUCCESS;
}

/* NOLINTEND(bugprone-macro-parentheses,readability-*) */
