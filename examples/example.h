/* example.h: framework of the examples (C17 and C++20): creates a device, renders frames, writes an
 * image file. A real program has its own device; see docs/how-to/use-the-render-graph.md. */
#ifndef EXAMPLE_H
#define EXAMPLE_H

#include <stdio.h>
#include <vulkan/vulkan.h>
#include "graph/rg_cmd.h"
#include "graph/rg_exec.h"

#ifdef __cplusplus
#define EXAMPLE_ZERO \
    { \
    }
#else
#define EXAMPLE_ZERO \
    { \
        0 \
    }
#endif

/* Initialises an rg_shader from `code`, an array in a header that glslangValidator --vn wrote. */
#define EXAMPLE_SHADER(title, code) \
    { \
        .name = title, .words = code, .word_count = sizeof(code) / 4 \
    }

/* Creates a device with one queue, of queue family 0, on the first physical device. */
static inline bool example_open(struct rg_vulkan *vulkan)
{
    VkPhysicalDeviceVulkan12Features v12 = EXAMPLE_ZERO;
    VkPhysicalDeviceVulkan13Features v13 = EXAMPLE_ZERO;
    VkPhysicalDeviceFeatures2 features = EXAMPLE_ZERO;
    VkApplicationInfo application = EXAMPLE_ZERO;
    VkInstanceCreateInfo instance = EXAMPLE_ZERO;
    VkDeviceQueueCreateInfo queue = EXAMPLE_ZERO;
    VkDeviceCreateInfo device = EXAMPLE_ZERO;
    const float priority = 1.0f;
    uint32_t count = 1;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v12.scalarBlockLayout = v12.separateDepthStencilLayouts = VK_TRUE;
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    v13.pNext = &v12;
    v13.synchronization2 = v13.dynamicRendering = v13.maintenance4 = VK_TRUE;
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &v13;
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_3;
    instance.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    instance.pApplicationInfo = &application;
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device.pNext = &features;
    device.queueCreateInfoCount = 1;
    device.pQueueCreateInfos = &queue;
    vulkan->get_proc_addr = vkGetInstanceProcAddr;
    return vkCreateInstance(&instance, NULL, &vulkan->instance) == VK_SUCCESS &&
           vkEnumeratePhysicalDevices(vulkan->instance, &count, &vulkan->physical) >= 0 && count &&
           vkCreateDevice(vulkan->physical, &device, NULL, &vulkan->device) == VK_SUCCESS;
}

static inline void example_log(void *user, const char *what, VkResult result)
{
    (void)user;
    fprintf(stderr, "%s: VkResult %d\n", what, (int)result);
}

/* Writes RGBA texels as a PPM file. */
static inline bool example_write(const char *path, const unsigned char *rgba, VkExtent2D size)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return false;
    fprintf(file, "P6\n%u %u\n255\n", size.width, size.height);
    for (size_t i = 0; i < (size_t)size.width * size.height; i++)
        fwrite(&rgba[4 * i], 1, 3, file);
    return fclose(file) == 0;
}

/* Image and graph of an example. */
struct example {
    const struct rg_technique *technique;
    const struct rg_buffer *pixels; /* the last frame's are written to the image file */
    VkExtent2D view;
    struct rg_frame *frame;
    uint32_t frame_count;
    /* called before each submit; may be NULL */
    void (*advance)(struct rg_exec *exec, uint32_t slot, struct rg_frame *frame);
    /* create and destroy objects of the program; may be NULL */
    bool (*prepare)(VkDevice device, const struct rg_exec *exec);
    void (*finish)(VkDevice device);
};

static inline bool example_draw(struct rg_exec *exec, const struct example *example,
                                const char *path)
{
    uint32_t slot = 0;
    for (uint32_t i = 0; i < example->frame_count; i++) {
        if (rg_exec_begin(exec, &slot) != VK_SUCCESS)
            return false;
        if (example->advance)
            example->advance(exec, slot, example->frame);
        if (rg_exec_submit(exec, example->frame) != VK_SUCCESS)
            return false;
    }
    return rg_exec_wait(exec, slot) == VK_SUCCESS &&
           example_write(path, (const unsigned char *)rg_exec_mapped(exec, example->pixels, slot),
                         example->view);
}

/* Compiles a technique, renders it, and frees everything. Returns the exit status of main(). */
static inline int example_run(const struct example *example, const char *path)
{
    struct rg_vulkan vulkan = EXAMPLE_ZERO;
    struct rg_compile_params compile = EXAMPLE_ZERO;
    struct rg_exec_params params = EXAMPLE_ZERO;
    struct rg_exec *exec = NULL;
    bool good = example_open(&vulkan);
    if (!good)
        return 1;
    const struct rg_device device = rg_exec_device(&vulkan);
    const struct rg_output output = { .buffer = example->pixels, .access = RG_HOST_READ };
    compile.techniques = &example->technique;
    compile.technique_count = 1;
    compile.view = example->view;
    compile.outputs = &output;
    compile.output_count = 1;
    compile.device = &device;
    struct rg_plan *plan = rg_compile(&compile);
    if (plan && plan->fault_count)
        rg_dump(plan, stderr); /* lists all faults */
    params.plan = plan;
    params.instance = vulkan.instance;
    params.get_proc_addr = vulkan.get_proc_addr;
    params.physical = vulkan.physical;
    params.device = vulkan.device;
    params.log = example_log;
    vkGetDeviceQueue(vulkan.device, 0, 0, &params.queue);
    if (plan && !plan->fault_count)
        exec = rg_exec_create(&params, NULL);
    good = exec && (!example->prepare || example->prepare(vulkan.device, exec)) &&
           example_draw(exec, example, path);
    rg_exec_destroy(exec);
    if (example->finish)
        example->finish(vulkan.device);
    rg_plan_destroy(plan);
    vkDestroyDevice(vulkan.device, NULL);
    vkDestroyInstance(vulkan.instance, NULL);
    return good ? 0 : 1;
}

#endif
