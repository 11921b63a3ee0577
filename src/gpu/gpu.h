/*
 * gpu.h: chooses and opens one Vulkan 1.3 device; creates buffers and images in its memory.
 *
 * Queue families, memory types, coherence, alignment and formats are queried, never assumed. No
 * window system is needed.
 *
 * Ownership: gpu_destroy() frees everything that gpu_create() made; buffers and images made with
 * gpu_buffer_create() and gpu_image_create() must be destroyed before it.
 *
 * Errors: logged once, with the failing call and the VkResult's name. The result is
 * STATUS_NO_DEVICE (no loader, no device, or none that firn can use), STATUS_TRY_AGAIN (device lost
 * or out of memory) or STATUS_FAILED (anything else). Thread-safety: one thread at a time per gpu.
 */
#ifndef FIRN_GPU_GPU_H
#define FIRN_GPU_GPU_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <volk.h>
#include "src/base/status.h"

/* Instance extensions and a function that a window system needs to present images. */
struct gpu_window_system {
    const char *const *instance_extensions;
    uint32_t instance_extension_count;
    bool (*can_present)(VkInstance instance, VkPhysicalDevice physical, uint32_t queue_family);
};

struct gpu_params {
    const char *device; /* index or part of the name of a device; NULL selects the best one */
    bool validate;      /* validation layer with synchronization validation, if installed */
    bool no_cache;      /* disable the pipeline cache file */
    const struct gpu_window_system *windows; /* NULL: no windows; outlives the gpu */
};

struct gpu {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    const struct gpu_window_system *windows; /* from the params */
    VkQueue queue; /* graphics, compute, transfer; presentation with windows */
    uint32_t queue_family;
    VkPhysicalDeviceProperties properties;
    VkPhysicalDeviceMemoryProperties memory;
    VkPipelineCache pipeline_cache;
    /* pipelines for reuse by later executors; NULL if out of memory */
    struct rg_pipelines *pipelines;
    bool no_cache;           /* from the params */
    VkCommandPool pool;      /* for uploads */
    bool portability_subset; /* VK_KHR_portability_subset must be enabled */
    float max_anisotropy;    /* of samplers; 0 if not supported */
    bool has_rays;           /* supports acceleration structures and ray queries */
    bool has_statistics;     /* pipeline statistics, exact occlusion queries */
    bool validated;          /* the validation layer is enabled */
    /* acceleration structures of the previous pose, for reuse; may be NULL */
    struct gpu_acceleration *rays;
    VkDebugUtilsMessengerEXT messenger;
    uint32_t message_count; /* validation warnings and errors so far */
};

/* Initialisers of the members of struct rg_exec_params that describe the device. */
#define GPU_EXEC_PARAMS(gpu) \
    .instance = (gpu)->instance, .get_proc_addr = vkGetInstanceProcAddr, \
    .physical = (gpu)->physical, .device = (gpu)->device, .queue = (gpu)->queue, \
    .queue_family = (gpu)->queue_family, .pipeline_cache = (gpu)->pipeline_cache

/* Opens a device. *gpu must not be moved afterwards; on failure it is zeroed. */
MUST_USE enum status gpu_create(struct gpu *gpu, const struct gpu_params *params);

/* Waits for the device, saves the pipeline cache and frees everything. *gpu may be zeroed or partly
 * created. Zeroes *gpu except for message_count, which then includes messages about leaks. */
void gpu_destroy(struct gpu *gpu);

/* Waits for the device and returns true if it is lost; then only gpu_destroy() may be called. */
bool gpu_is_lost(const struct gpu *gpu);

/* One entry of gpu_list(). */
struct gpu_device {
    char name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE];
    VkPhysicalDeviceType type;
    const char *kind;  /* "discrete GPU", "integrated GPU", "CPU", ... */
    char refused[128]; /* why it is unusable, or "" */
    char version[64];  /* "1.3.230, Mesa 22.3.6 (LLVM 15.0.6)" */
    bool has_rays;     /* ray queries; only by gpu_list() */
};

/* Fills *device with a description of the open device, as gpu_list() does. */
void gpu_describe(const struct gpu *gpu, struct gpu_device *device);

/* Lists this machine's devices in *devices, in the order of --device numbers. The caller frees
 * *devices with free(). If there is no loader or device, returns STATUS_OK and an empty list. */
MUST_USE enum status gpu_list(struct gpu_device **devices, uint32_t *count);

/* Returns the VkResult's name, for example "VK_ERROR_DEVICE_LOST". */
const char *gpu_result_name(VkResult result);

/* Converts a VkResult to a status; only VK_SUCCESS is STATUS_OK. If the process has a memory limit,
 * VK_ERROR_UNKNOWN is STATUS_TRY_AGAIN, because drivers return it at the limit. */
enum status gpu_status(VkResult result);

/* Logs "WHAT: NAME OF THE RESULT" and advice for the user. Returns gpu_status(result). */
enum status gpu_failed(const char *what, VkResult result);

/* Logs a failure like gpu_failed(), with the text "CALL of NAME". `name` may be NULL. */
enum status gpu_failed_for(const char *call, const char *name, VkResult result);

struct gpu_buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    VkDeviceSize size;
};

struct gpu_image {
    VkImage image;
    VkDeviceMemory memory;
    VkExtent3D extent;
    VkFormat format;
    uint32_t mips, layers;
};

/* Creates a device-local buffer of `size` bytes and uploads `data` through a staging buffer. Waits
 * until later commands of the queue can read the data. If `size` is 0, zeroes *buffer. */
MUST_USE enum status gpu_buffer_create(struct gpu *gpu, struct gpu_buffer *buffer,
                                       VkBufferUsageFlags usage, const void *data,
                                       VkDeviceSize size, const char *name);

struct gpu_image_params {
    const char *name;
    VkFormat format;
    uint32_t width, height;
    uint32_t layers;         /* array layers; 0 means 1 */
    bool cube;               /* cube map with six layers */
    bool mipmaps;            /* generate mips from level 0 */
    bool levels;             /* `texels` has all mip levels */
    const void *texels;      /* layer after layer, rows packed */
    size_t texels_size;      /* size of `texels`, bytes */
    VkImageUsageFlags usage; /* besides SAMPLED and TRANSFER */
};

/* Creates a device-local 2D (array) image, fills it and leaves it in SHADER_READ_ONLY_OPTIMAL,
 * visible to every later command of the queue. Logs and returns STATUS_NO_DEVICE if the device
 * cannot create, sample linearly or (for mipmaps) blit the format, and STATUS_DATA if the width or
 * height is 0 or over the device's limits, or texels_size is wrong. */
MUST_USE enum status gpu_image_create(struct gpu *gpu, struct gpu_image *image,
                                      const struct gpu_image_params *params);

void gpu_buffer_destroy(struct gpu *gpu, struct gpu_buffer *buffer);

/* Checks that an image's size is within the device's limits. Call it before any allocation. If the
 * size is too large, logs an error and returns STATUS_USAGE. */
MUST_USE enum status gpu_check_size(const struct gpu *gpu, uint32_t width, uint32_t height);
/* Returns STATUS_DATA if a scene's texture is too large; size.depth is its number of layers. */
MUST_USE enum status gpu_check_texels(const struct gpu *gpu, const char *name, VkExtent3D size);
/* Checks that the heaps hold `device_size` bytes of device memory and `host_size` bytes of
 * host-visible memory. If they do not, logs an error and returns STATUS_TRY_AGAIN. */
MUST_USE enum status gpu_check_memory(const struct gpu *gpu, VkExtent2D view,
                                      VkDeviceSize device_size, VkDeviceSize host_size);
/* Checks that acceleration structures of `size` bytes fit in the device's memory heap. */
MUST_USE enum status gpu_check_acceleration_memory(const struct gpu *gpu, VkDeviceSize size);
void gpu_image_destroy(struct gpu *gpu, struct gpu_image *image);

#endif
