/* all_features_device.c: creates a second device with all features, and a descriptor set on it. */
#include "tests/support/all_features_device.h"

#include <string.h>

#include "tests/support/assertions.h"

struct all_features {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan11Features v11;
    VkPhysicalDeviceVulkan12Features v12;
    VkPhysicalDeviceVulkan13Features v13;
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures;
    VkPhysicalDeviceRayQueryFeaturesKHR queries;
};

static const char *const ray_extensions[] = {
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
    VK_KHR_RAY_QUERY_EXTENSION_NAME,
};

enum {
    RAY_EXTENSION_COUNT = sizeof(ray_extensions) / sizeof(ray_extensions[0])
};

bool all_features_device_has_rays(const struct gpu *gpu)
{
    VkExtensionProperties list[512];
    uint32_t count = 512, found = 0;
    assert_true(vkEnumerateDeviceExtensionProperties(gpu->physical, NULL, &count, list) >= 0);
    for (uint32_t i = 0; i < count * RAY_EXTENSION_COUNT; i++)
        found += !strcmp(list[i / RAY_EXTENSION_COUNT].extensionName,
                         ray_extensions[i % RAY_EXTENSION_COUNT]);
    return found == RAY_EXTENSION_COUNT;
}

void all_features_device_open(struct gpu *own, const struct gpu *gpu)
{
    struct all_features f = {
        .core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &f.v11 },
        .v11 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, .pNext = &f.v12 },
        .v12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &f.v13 },
        .v13 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES },
        .structures = { .sType =
                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR,
                        .pNext = &f.queries },
        .queries = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR },
    };
    const bool rays = all_features_device_has_rays(gpu);
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = gpu->queue_family,
        .queueCount = 1,
        .pQueuePriorities = &(float){ 1 },
    };
    const VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &f.core,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .enabledExtensionCount = rays ? RAY_EXTENSION_COUNT : 0,
        .ppEnabledExtensionNames = ray_extensions,
    };
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = gpu->queue_family,
    };
    f.v13.pNext = rays ? &f.structures : NULL;
    vkGetPhysicalDeviceFeatures2(gpu->physical, &f.core);
    *own = *gpu;
    own->pipeline_cache = VK_NULL_HANDLE;
    assert_int_equal(vkCreateDevice(gpu->physical, &info, NULL, &own->device), VK_SUCCESS);
    assert_int_equal(vkCreateCommandPool(own->device, &pool, NULL, &own->pool), VK_SUCCESS);
    vkGetDeviceQueue(own->device, own->queue_family, 0, &own->queue);
}

void all_features_device_close(const struct gpu *own)
{
    vkDestroyCommandPool(own->device, own->pool, NULL);
    vkDestroyDevice(own->device, NULL);
}

void own_set_create(struct own_set *own, struct gpu *gpu, const uint32_t *words, size_t size)
{
    const VkDescriptorSetLayoutBinding binding = {
        .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        .descriptorCount = 1,
        .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
    };
    const VkDescriptorSetLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 1,
        .pBindings = &binding,
    };
    const VkDescriptorPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 1,
        .poolSizeCount = 1,
        .pPoolSizes = &(VkDescriptorPoolSize){ VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1 },
    };
    assert_int_equal(
        gpu_buffer_create(gpu, &own->words, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, words, size, "own"),
        STATUS_OK);
    assert_int_equal(vkCreateDescriptorSetLayout(gpu->device, &layout, NULL, &own->layout),
                     VK_SUCCESS);
    assert_int_equal(vkCreateDescriptorPool(gpu->device, &pool, NULL, &own->pool), VK_SUCCESS);
    assert_int_equal(
        vkAllocateDescriptorSets(gpu->device,
                                 &(VkDescriptorSetAllocateInfo){
                                     .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                     .descriptorPool = own->pool,
                                     .descriptorSetCount = 1,
                                     .pSetLayouts = &own->layout,
                                 },
                                 &own->set),
        VK_SUCCESS);
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = own->set,
        .descriptorCount = 1,
        .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        .pBufferInfo = &(VkDescriptorBufferInfo){ own->words.buffer, 0, VK_WHOLE_SIZE },
    };
    vkUpdateDescriptorSets(gpu->device, 1, &write, 0, NULL);
}

void own_set_destroy(struct own_set *own, struct gpu *gpu)
{
    vkDestroyDescriptorPool(gpu->device, own->pool, NULL);
    vkDestroyDescriptorSetLayout(gpu->device, own->layout, NULL);
    gpu_buffer_destroy(gpu, &own->words);
}
