/* gpu_internal.h: declarations shared within src/gpu. Functions that return a status log errors. */
#ifndef FIRN_GPU_INTERNAL_H
#define FIRN_GPU_INTERNAL_H

#include "src/gpu/gpu.h"

/* Maximum size of a staging buffer, bytes; larger data is copied piece by piece. */
enum {
    GPU_STAGING_SIZE = 16 << 20,
};

/* Creates gpu->instance with the extensions of gpu->windows. If `validate` is true, also creates
 * gpu->messenger; a missing validation layer is only a warning. Call volkInitialize() first. */
MUST_USE VkResult gpu_instance_create(struct gpu *gpu, bool validate);

/* Returns advice to install a driver. If the process has a memory limit, the text also advises
 * raising it, because the limit may keep drivers from loading. */
const char *gpu_driver_advice(void);

bool gpu_has_extension(const VkExtensionProperties *list, uint32_t count, const char *name);

/* Returns the parameters of a debug messenger; `gpu` must outlive the messenger. */
VkDebugUtilsMessengerCreateInfoEXT gpu_debug_messenger(struct gpu *gpu);

/* Names an object for captures and messages, if `name` is given and debug utils are available. */
void gpu_debug_name(const struct gpu *gpu, VkObjectType type, uint64_t handle, const char *name);

/* Fills in a device's name, type, versions and, if firn cannot use the device, the reason. */
void gpu_choose_describe(const struct gpu *gpu, VkPhysicalDevice physical,
                         struct gpu_device *device);

/* Chooses the best usable device whose number is `requested` or whose name contains `requested`. If
 * `requested` is NULL, any device matches. Device types from best to worst are discrete,
 * integrated, virtual and CPU. Of several devices of one type, the first is chosen. */
MUST_USE enum status gpu_choose(const struct gpu_device *devices, uint32_t count,
                                const char *requested, uint32_t *index);

/* Returns the first queue family with graphics and compute, or UINT32_MAX if there is none. If
 * gpu->windows is set, the family must also be able to present. */
uint32_t gpu_choose_queue_family(const struct gpu *gpu, VkPhysicalDevice physical);

/* Extensions that firn uses if a device has them. */
struct gpu_device_extensions {
    bool portability_subset, swapchain;
    bool rays; /* all of gpu_ray_extensions */
};

/* Extensions needed for acceleration structures and ray queries. */
enum {
    GPU_RAY_EXTENSION_COUNT = 3,
};

extern const char *const gpu_ray_extensions[GPU_RAY_EXTENSION_COUNT];

MUST_USE VkResult gpu_device_extensions_find(VkPhysicalDevice physical,
                                             struct gpu_device_extensions *offer);

/* Device features to enable. `core` heads a pNext chain that points into this struct, so do not
 * move the struct after gpu_features_choose(). */
struct gpu_features {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan12Features v12;
    VkPhysicalDeviceVulkan13Features v13;
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures; /* chained if `rays` */
    VkPhysicalDeviceRayQueryFeaturesKHR queries;
    bool rays; /* ray features are enabled */
};

/* Sets *requested to all features that firn requires and the optional ones that the device has. If
 * `rays` is true, adds ray features; the device must have gpu_ray_extensions. Returns the name of
 * the first missing required feature, or NULL. The device must support Vulkan 1.3. */
const char *gpu_features_choose(VkPhysicalDevice physical, bool rays,
                                struct gpu_features *requested);

/* Creates gpu->pipeline_cache from an earlier run's file. Warns of a damaged file. */
MUST_USE enum status gpu_pipeline_cache_load(struct gpu *gpu);

/* Saves gpu->pipeline_cache for a later run. Failures are not logged, as they only cost speed. */
void gpu_pipeline_cache_save(const struct gpu *gpu);

/* Returns true if the content of a cache file is undamaged and from this device and driver. */
bool gpu_pipeline_cache_is_valid(const VkPhysicalDeviceProperties *device, const void *data,
                                 size_t size);

/* Returns the first memory type of the mask `bits` that has all `required` flags and, if possible,
 * all `preferred` flags. Returns UINT32_MAX if no type has the required flags. */
uint32_t gpu_memory_type(const VkPhysicalDeviceMemoryProperties *memory, uint32_t bits,
                         VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred);

/* Kinds of device memory to allocate. */
enum gpu_memory_kind {
    GPU_MEMORY_DEVICE,  /* device-local */
    GPU_MEMORY_HOST,    /* host-visible */
    GPU_MEMORY_ADDRESS, /* device-local, with a buffer address */
};

/* Allocates memory for `needs`. Returns STATUS_TRY_AGAIN if the device has too little memory. */
MUST_USE enum status gpu_memory_allocate(struct gpu *gpu, const VkMemoryRequirements *needs,
                                         enum gpu_memory_kind kind, const char *name,
                                         VkDeviceMemory *memory);

/* Creates a buffer with undefined content and its own memory. `host` makes the memory host-visible.
 * SHADER_DEVICE_ADDRESS in `usage` gives the buffer an address. On failure zeroes *buffer. */
MUST_USE enum status gpu_memory_buffer(struct gpu *gpu, struct gpu_buffer *buffer,
                                       VkBufferUsageFlags usage, VkDeviceSize size, bool host,
                                       const char *name);

/* A mapped staging buffer, and the commands that copy from it. */
struct gpu_upload {
    struct gpu_buffer staging;
    void *mapped; /* staging.size bytes */
    VkCommandBuffer commands;
    VkFence fence;
    const char *name; /* for messages; may be NULL */
    bool submitted;   /* `commands` may still be executing */
};

/* Creates a staging buffer of at most GPU_STAGING_SIZE bytes, and begins to record `commands`. */
MUST_USE enum status gpu_upload_begin(struct gpu *gpu, struct gpu_upload *upload, VkDeviceSize size,
                                      const char *name);

/* Submits `commands`, waits until they are done, and begins to record again. */
MUST_USE enum status gpu_upload_flush(struct gpu *gpu, struct gpu_upload *upload);

/* Frees an upload's staging buffer and commands. *upload may be zeroed or partly created. */
void gpu_upload_finish(struct gpu *gpu, struct gpu_upload *upload);

/* Records a barrier that makes all previous accesses at a stage visible to all later commands. */
void gpu_record_visible(VkCommandBuffer commands, VkPipelineStageFlags2 stage,
                        VkAccessFlags2 access);

#endif
