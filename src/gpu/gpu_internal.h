/*
 * gpu_internal.h: what the files of src/gpu share with each other and with their test.
 *
 * Whatever returns an enum status has logged its own line.
 */
#ifndef FIRN_GPU_INTERNAL_H
#define FIRN_GPU_INTERNAL_H

#include "src/gpu/gpu.h"

/* Bytes of a staging buffer; larger data goes through it piece by piece. */
enum {
    GPU_STAGING_SIZE = 16 << 20,
};

/* Makes gpu->instance, for gpu->windows, and with validation gpu->messenger. Wants
 * volkInitialize() done; logs nothing but that there is no validation layer. */
MUST_USE VkResult gpu_instance_create(struct gpu *gpu, bool validate);

/* What to do where no driver is found: install one, or raise a limit in which none is loaded. */
const char *gpu_missing_driver(void);

bool gpu_has_extension(const VkExtensionProperties *list, uint32_t count, const char *name);

/* What a messenger is made from. It keeps the address of gpu. */
VkDebugUtilsMessengerCreateInfoEXT gpu_debug_messenger(struct gpu *gpu);

/* Names an object for captures and messages. Does nothing if `name` is NULL or debug utils are
 * missing. */
void gpu_debug_name(const struct gpu *gpu, VkObjectType type, uint64_t handle, const char *name);

/* Says what a device is and whether firn can use it. */
void gpu_choose_describe(const struct gpu *gpu, VkPhysicalDevice physical,
                         struct gpu_device *device);

/*
 * Picks from a list as --device says: the one with that number if `wanted` is all digits, else the
 * best with `wanted` in its name (NULL: of all). Best: discrete, integrated, virtual, CPU, then
 * the first.
 */
MUST_USE enum status gpu_choose(const struct gpu_device *devices, uint32_t count,
                                const char *wanted, uint32_t *index);

/* The first queue family with graphics and compute (and thereby transfer), that can also present
 * where there are windows; UINT32_MAX: none. */
uint32_t gpu_choose_queue_family(const struct gpu *gpu, VkPhysicalDevice physical);

/* Which of the extensions that firn may enable a device has. */
struct gpu_offer {
    bool portability_subset, swapchain;
};

MUST_USE VkResult gpu_offer_find(VkPhysicalDevice physical, struct gpu_offer *offer);

/* `core` is the head of the chain; must not move once chosen. */
struct gpu_features {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan12Features v12;
    VkPhysicalDeviceVulkan13Features v13;
};

/* Chains *wanted and sets what firn needs, and what it can use if the device has it. Returns the
 * name of the first needed feature that the device lacks; NULL: it has all. For Vulkan 1.3. */
const char *gpu_features_choose(VkPhysicalDevice physical, struct gpu_features *wanted);

/* Makes gpu->pipeline_cache, with the data of an earlier run. A damaged file is ignored with a
 * warning. */
MUST_USE enum status gpu_cache_load(struct gpu *gpu);

/* Saves it for a later run. Silent: nobody is worse off if it fails. */
void gpu_cache_save(const struct gpu *gpu);

/* Is this content of a cache file undamaged and of this very device and driver? */
bool gpu_cache_sound(const VkPhysicalDeviceProperties *device, const void *data, size_t size);

/* The first memory type among `bits` with all of `required`, if possible with all of `preferred`
 * too; UINT32_MAX: none. */
uint32_t gpu_memory_type(const VkPhysicalDeviceMemoryProperties *memory, uint32_t bits,
                         VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred);

/* Allocates what `needs` says, device-local or host-visible; too much is STATUS_TRY_AGAIN. */
MUST_USE enum status gpu_memory_allocate(struct gpu *gpu, const VkMemoryRequirements *needs,
                                         bool host, const char *name, VkDeviceMemory *memory);

/* Makes a buffer with memory of its own, content undefined. On failure *buffer is {0}. */
MUST_USE enum status gpu_memory_buffer(struct gpu *gpu, struct gpu_buffer *buffer,
                                       VkBufferUsageFlags usage, VkDeviceSize size, bool host,
                                       const char *name);

/* A mapped staging buffer, and the commands that copy from it. */
struct gpu_upload {
    struct gpu_buffer staging;
    void *mapped; /* staging.size bytes */
    VkCommandBuffer commands;
    VkFence fence;
    const char *name; /* of what is filled, for messages; may be NULL */
    bool submitted;   /* and not known to be done */
};

/* Staging for `size` bytes or GPU_STAGING_SIZE, whichever is less; `commands` records. */
MUST_USE enum status gpu_upload_begin(struct gpu *gpu, struct gpu_upload *upload, VkDeviceSize size,
                                      const char *name);

/* Submits, waits until it is done, and lets `commands` record again. */
MUST_USE enum status gpu_upload_flush(struct gpu *gpu, struct gpu_upload *upload);

/* A {0} or half-built upload is fine. */
void gpu_upload_finish(struct gpu *gpu, struct gpu_upload *upload);

#endif
