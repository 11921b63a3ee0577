/*
 * gpu.h: one Vulkan 1.3 device: chosen, opened, and its memory.
 *
 * Correct on any device: queue families, memory types, coherence, alignment and formats are
 * queried, never assumed. Works with no window system.
 *
 * Ownership:     gpu_destroy() frees everything gpu_create() made; buffers and images made with
 *                gpu_buffer_create() and gpu_image_create() are the caller's to destroy before.
 * Errors:        logged once, with the failing call and the VkResult's name; the result is
 *                STATUS_NO_DEVICE (no loader, no device, or none good enough), STATUS_TRY_AGAIN
 *                (device lost or memory short) or STATUS_FAILED (anything else).
 * Thread-safety: one thread at a time per gpu.
 */
#ifndef FIRN_GPU_GPU_H
#define FIRN_GPU_GPU_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <volk.h>
#include "src/base/status.h"

/* What lets a device show pictures in windows. */
struct gpu_window_system {
    const char *const *instance_extensions;
    uint32_t instance_extension_count;
    bool (*can_present)(VkInstance instance, VkPhysicalDevice physical, uint32_t queue_family);
};

struct gpu_params {
    /* number as listed, from 0, or part of the name in any case; NULL: the best */
    const char *device;
    bool validate; /* validation and synchronization validation, if the layer is there */
    bool no_cache; /* neither reads nor leaves compiled pipelines for another run */
    const struct gpu_window_system *windows; /* outlives the gpu; NULL: no windows */
};

struct gpu {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    const struct gpu_window_system *windows; /* of the params */
    VkQueue queue; /* graphics, compute and transfer; with windows, presentation too */
    uint32_t queue_family;
    VkPhysicalDeviceProperties properties;
    VkPhysicalDeviceMemoryProperties memory;
    VkPipelineCache pipeline_cache;
    bool no_cache;           /* of the params: it begins empty and ends with the run */
    VkCommandPool pool;      /* for uploads */
    bool portability_subset; /* must be enabled */
    float max_anisotropy;    /* of samplers; 0: not to be had */
    bool has_statistics;     /* pipeline statistics and exact occlusion queries */
    bool validated;          /* the layer is really on */
    VkDebugUtilsMessengerEXT messenger;
    uint32_t message_count; /* warnings and errors of the validation layer so far */
};

/* Opens a device into *gpu, which must not move afterwards. On failure *gpu is {0}. */
MUST_USE enum status gpu_create(struct gpu *gpu, const struct gpu_params *params);

/*
 * Waits for the device, saves the pipeline cache, frees. A {0} or half-built gpu is fine. Leaves
 * {0} but for message_count, which then tells also of objects that were not destroyed.
 */
void gpu_destroy(struct gpu *gpu);

/* Waits for the device. True: it is lost, and nothing can be done with it but gpu_destroy(). */
bool gpu_is_lost(const struct gpu *gpu);

/* A second device of the same kind, with a queue and nothing else, for one other thread. */
struct gpu_twin {
    VkDevice device;
    VkQueue queue; /* of gpu->queue_family */
};

/* Logs nothing. */
MUST_USE bool gpu_twin_create(struct gpu_twin *twin, const struct gpu *gpu);
void gpu_twin_destroy(struct gpu_twin *twin); /* waits for it */

/* One line of gpu_list(). */
struct gpu_device {
    char name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE];
    VkPhysicalDeviceType type;
    const char *kind;  /* the type in words: "discrete GPU", "integrated GPU", "CPU", ... */
    char refused[128]; /* why firn cannot use it; "" if it can */
    char version[64];  /* of Vulkan and driver: "1.3.230, Mesa 22.3.6 (LLVM 15.0.6)" */
};

/* The device that is open, as gpu_list() would say it. */
void gpu_describe(const struct gpu *gpu, struct gpu_device *device);

/*
 * The devices there are, in the order of --device numbers, into *devices (malloc'd, the caller
 * frees it). No loader or no device is an empty list and STATUS_OK.
 */
MUST_USE enum status gpu_list(struct gpu_device **devices, uint32_t *count);

/* The VkResult's name, "VK_ERROR_DEVICE_LOST". */
const char *gpu_result_name(VkResult result);

/*
 * As above; STATUS_OK for VK_SUCCESS alone. VK_ERROR_UNKNOWN is STATUS_TRY_AGAIN where the memory
 * of this process is limited, since that is what drivers say when they reach the limit.
 */
enum status gpu_status(VkResult result);

/* Logs "<what>: <result's name>", and what to do about it, and gives the status for it. */
enum status gpu_failed(const char *what, VkResult result);

/* The same, "<call> of <name>: ...". The name may be NULL. */
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

/*
 * Makes a device-local buffer and fills it with `data` through a staging buffer, waiting until it
 * is done and visible to every later command of the queue. A size of 0 makes nothing: {0}.
 */
MUST_USE enum status gpu_buffer_create(struct gpu *gpu, struct gpu_buffer *buffer,
                                       VkBufferUsageFlags usage, const void *data,
                                       VkDeviceSize size, const char *name);

struct gpu_image_params {
    const char *name;
    VkFormat format;
    uint32_t width, height;
    uint32_t layers;         /* 0 means 1 */
    bool cube;               /* of six square layers */
    bool mipmaps;            /* makes the whole chain by halving; needs blit support, queried */
    bool levels;             /* instead: `texels` has it, level after level */
    const void *texels;      /* layers one after another, rows tight; of mip 0 only, or `levels` */
    size_t texels_size;      /* bytes; checked against the format */
    VkImageUsageFlags usage; /* besides SAMPLED and TRANSFER */
};

/*
 * Makes a device-local 2D (array) image, fills it and leaves it in SHADER_READ_ONLY_OPTIMAL,
 * visible to every later command of the queue. A device that cannot make, sample linearly or
 * (for mipmaps) blit the format is a logged STATUS_NO_DEVICE; an image of no size or over the
 * device's limits, or a wrong texels_size, is a logged STATUS_DATA.
 */
MUST_USE enum status gpu_image_create(struct gpu *gpu, struct gpu_image *image,
                                      const struct gpu_image_params *params);

void gpu_buffer_destroy(struct gpu *gpu, struct gpu_buffer *buffer);

/*
 * Says in advance that a picture is too large, before anything is allocated for it: for the
 * device's limits (STATUS_USAGE), or, with so many bytes on the device and in memory that the host
 * sees, for its heaps (STATUS_TRY_AGAIN).
 */
MUST_USE enum status gpu_fit_size(const struct gpu *gpu, uint32_t width, uint32_t height);
MUST_USE enum status gpu_fit_cube(const struct gpu *gpu, uint32_t side); /* of its faces */
MUST_USE enum status gpu_fit_memory(const struct gpu *gpu, VkExtent2D view,
                                    VkDeviceSize device_size, VkDeviceSize host_size);
void gpu_image_destroy(struct gpu *gpu, struct gpu_image *image);

#endif
