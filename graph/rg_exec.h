/*
 * rg_exec.h: executor of a plan on a VkDevice: creates Vulkan objects, records and submits frames.
 *
 * rg_exec_create() creates everything that a plan needs: memory, images, views, samplers,
 * descriptors, pipelines, command buffers. A frame allocates nothing. The device needs Vulkan 1.3
 * with dynamicRendering, synchronization2, maintenance4, scalarBlockLayout and
 * separateDepthStencilLayouts enabled, independentBlend where the targets of a row blend
 * differently, depthBiasClamp where a bias is clamped, fragmentStoresAndAtomics or
 * vertexPipelineStoresAndAtomics where such shaders write, accelerationStructure and
 * bufferDeviceAddress where rows build or trace, and those of the shaders' OpCapabilities.
 * rg_exec_create() logs each missing feature. Functions are loaded through the program's own
 * vkGetInstanceProcAddr: no loader is linked, nothing is global, and executors of several instances
 * can exist side by side.
 *
 *     while (...) {
 *         rg_exec_begin(exec, &slot);                    waits until the slot is free
 *         memcpy(rg_exec_mapped(exec, &uniforms, slot), ...);
 *         rg_exec_submit(exec, frame);                   records and submits
 *         rg_exec_wait(exec, slot);                      only to read results back now
 *         ... rg_exec_mapped(exec, &readback, slot) ...
 *     }
 *
 * Ownership:     the plan, its tables, the device and imported objects outlive the executor.
 * Errors:        VkResult. The log callback receives the failed call and the name of the pass,
 *                image or buffer that it concerns. After a failure only rg_exec_destroy() may be
 *                called.
 * Thread-safety: one thread at a time per executor, and for creating and destroying executors that
 *                share rg_exec_params.pipelines. The queue is used only by rg_exec_submit(),
 *                rg_exec_submit_synced() and rg_exec_warm_up().
 */
#ifndef RG_EXEC_H
#define RG_EXEC_H

#include "graph/rg.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The program's Vulkan object for an imported resource. */
struct rg_exec_import {
    VkImage image;                           /* same image in every frame */
    VkBuffer buffer;                         /* of an imported buffer */
    VkAccelerationStructureKHR acceleration; /* held by `buffer`, if rows trace or build it */
    /* Instead of `image`: several images of which each frame uses one, such as those of a
     * swapchain. All such imports have the same number of images, and a frame uses the same index
     * in all of them. */
    const VkImage *images;
    uint32_t image_count;
};

/* Layout of a descriptor set that the program owns (set 1 in shaders). */
struct rg_exec_set {
    const struct rg_set *set;     /* as referenced by rows */
    VkDescriptorSetLayout layout; /* borrowed; must outlive executor and rg_exec_params.pipelines */
};

/*
 * Cache of pipelines from destroyed executors of one device. The next executor created with it
 * takes all of them, and does not recompile equal ones. Pipelines that neither this nor the
 * following executor needs are freed. The cache outlives the executors, and is destroyed before the
 * device.
 */
struct rg_pipelines;

/* Creates an empty cache. Returns NULL if out of memory. */
RG_API struct rg_pipelines *rg_pipelines_create(void);

/* Frees a cache and its pipelines. NULL is allowed. */
RG_API void rg_pipelines_destroy(struct rg_pipelines *pipelines);

/* Returns the shader to use in place of one that a table refers to: that shader itself, or one with
 * the same interface. The returned shader is read until rg_exec_create() returns. */
typedef const struct rg_shader *rg_replace_shader_fn(void *user, const struct rg_shader *shader);

/* Receives the failed call and object ("vkCreateImage of depth"), in the executor's thread. */
typedef void rg_log_fn(void *user, const char *what, VkResult result);

/* Parameters of rg_exec_create(). */
struct rg_exec_params {
    const struct rg_plan *plan; /* without faults, compiled for this device */
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* the loader's vkGetInstanceProcAddr, or volk's */
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;                  /* must support graphics and compute */
    uint32_t queue_family;          /* of the queue */
    VkPipelineCache pipeline_cache; /* VK_NULL_HANDLE is allowed */
    struct rg_pipelines *pipelines; /* pipelines of destroyed executors to reuse; NULL: none */
    uint32_t frames_in_flight;      /* maximum number of unfinished frames; 0 means 2 */
    /* in the order of the compile params' imports; only read by rg_exec_create() */
    const struct rg_exec_import *imports;
    size_t import_count;
    /* one for each set that rows refer to; must outlive the executor */
    const struct rg_exec_set *sets;
    size_t set_count;
    float max_anisotropy; /* the device's limit; 0: samplerAnisotropy is not enabled */
    /* uses VkRenderPass objects instead of dynamic rendering, which some releases of the
     * synchronization validation do not check */
    bool render_passes;
    /* only for rg_exec_warm_up(): ignores `imports`, has no content; excludes render_passes */
    bool warm_up_only;
    bool measured; /* enables rg_time.h */
    /* rg_time.h can count work; needs pipelineStatisticsQuery and occlusionQueryPrecise */
    bool statistics;
    /* Specialization constants for all shaders; a shader ignores ids that it does not declare. Only
     * read by rg_exec_create(). NULL: default values. */
    const VkSpecializationInfo *constants;
    rg_replace_shader_fn *replace_shader; /* called by rg_exec_create(); NULL: no replacement */
    /* Features enabled on the device, with VkPhysicalDeviceVulkan12Features and ...13Features in
     * pNext. NULL: all that it supports. Only read by rg_exec_create(). */
    const VkPhysicalDeviceFeatures2 *features;
    rg_log_fn *log; /* NULL: failures are not logged */
    void *user;     /* passed to both callbacks */
};

struct rg_exec; /* an executor of one plan */

/* Creates an executor, which the caller destroys. Returns NULL on failure. *result gets the reason,
 * or VK_SUCCESS; `result` may be NULL. */
RG_API struct rg_exec *rg_exec_create(const struct rg_exec_params *params, VkResult *result);

/*
 * Replaces the executor's plan. What both plans have in common is kept: memory, images (with their
 * content if persistent), descriptors, and pipelines (compared by content, not by address). So the
 * cost of changing the view, a technique or constants is that of the difference, and with
 * rg_compile_params.max_view a change of the view keeps all memory and pipelines. Pipelines that
 * the plan does not need are kept for one more update, so that switching back is cheap.
 *
 * Of `params` only plan, imports, max_anisotropy, constants, replace_shader and user are used; the
 * rest remains as created. Waits for all submitted frames; must not be called between
 * rg_exec_begin() and a submit. The previous plan and its tables must exist until it returns. The
 * results of rg_exec_image(), rg_exec_block() and rg_exec_mapped() become invalid, and the region
 * is reset. Returns an error if a Vulkan call fails.
 */
RG_API VkResult rg_exec_update(struct rg_exec *exec, const struct rg_exec_params *params);

/* Waits for all submitted frames and frees everything. NULL is allowed. */
RG_API void rg_exec_destroy(struct rg_exec *exec);

/* ---- a frame ---- */

/* Begins a frame in the next slot (0 to frames_in_flight - 1), after waiting until that slot's
 * previous frame is finished. *slot gets the slot. */
RG_API VkResult rg_exec_begin(struct rg_exec *exec, uint32_t *slot);

/* Records the plan into the slot begun last, and submits it. `frame` is passed to the rows'
 * callbacks, which are called before this returns. */
RG_API VkResult rg_exec_submit(struct rg_exec *exec, const struct rg_frame *frame);

/* Synchronisation of a frame with work outside its queue. {0}: none. */
struct rg_exec_external_sync {
    uint32_t image_index;              /* index into rg_exec_import.images that this frame uses */
    VkSemaphore wait;                  /* binary semaphore to wait for, or VK_NULL_HANDLE */
    VkPipelineStageFlags2 wait_stages; /* pipeline stages that wait for `wait`; 0 means all */
    VkSemaphore signal; /* binary semaphore to signal after all commands, or VK_NULL_HANDLE */
};

/* Like rg_exec_submit(), with an image index and semaphores. `sync` is only read by the call; the
 * semaphores belong to the caller. */
RG_API VkResult rg_exec_submit_synced(struct rg_exec *exec, const struct rg_frame *frame,
                                      const struct rg_exec_external_sync *sync);

/* Waits until the frame submitted in a slot is finished; then its readback buffers may be read. */
RG_API VkResult rg_exec_wait(struct rg_exec *exec, uint32_t slot);

/* Returns the mapped memory of an RG_MEMORY_UPLOAD or RG_MEMORY_READBACK buffer in a slot, owned by
 * the executor; NULL if the plan does not use the buffer. Write upload buffers between
 * rg_exec_begin() and rg_exec_submit(). */
RG_API void *rg_exec_mapped(struct rg_exec *exec, const struct rg_buffer *buffer, uint32_t slot);

/* A region of the view, for tiled rendering of images that are too large to draw at once. */
struct rg_exec_region {
    /* in the view; not empty, at most as many texels as rg_compile_params.max_region */
    VkRect2D region;
    /* in the view, of any size: area that fragments sample besides their own texel */
    VkRect2D reach;
};

/*
 * Restricts frames from the next submit on to a region of the view. They draw only the region, with
 * values bit-identical to those of the whole image, and leave the rest undefined. This applies to
 * images of the view's size that are neither imported nor persistent: to rows that draw into them,
 * and to rows that only copy from them to buffers, which receive only the texels of `region`, rows
 * tightly packed. Images that a row samples without rg_use.same_texel are also drawn in `reach`.
 * Everything else is drawn whole. Even offsets are required where fragments take derivatives.
 */
RG_API void rg_exec_set_region(struct rg_exec *exec, const struct rg_exec_region *region);

/* ---- objects ---- */

/* Returns the image of a declaration, for example to import it elsewhere; owned by the executor.
 * VK_NULL_HANDLE if the plan does not use it. */
RG_API VkImage rg_exec_image(const struct rg_exec *exec, const struct rg_image *image);

/* Returns the device memory of a block of the plan (below rg_plan.block_count), owned by the
 * executor. Its content is undefined between frames. */
RG_API VkDeviceMemory rg_exec_block(const struct rg_exec *exec, uint32_t block);

/* ---- for drivers that compile a pipeline only at its first draw ---- */

/*
 * Draws a pass without visible effect, and waits, to make the driver compile its pipeline: one
 * triangle for each draw that the record function issues. Skips passes that do not draw, that have
 * a descriptor set of the program's own, or whose condition is false for `frame`. Typically called
 * in another thread, on an executor created with `warm_up_only` on its own device; that pays off if
 * the driver keeps compiled code in a cache common to both devices.
 */
RG_API VkResult rg_exec_warm_up(struct rg_exec *exec, const struct rg_frame *frame, uint32_t pass);

/* ---- compiling for a device ---- */

/* Handles of the device to compile for. */
struct rg_vulkan {
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* as in rg_exec_params */
    VkPhysicalDevice physical;
    VkDevice device;
};

/* Returns a device's properties for rg_compile(). `vulkan` is borrowed and outlives the result. */
RG_API struct rg_device rg_exec_device(const struct rg_vulkan *vulkan);

#ifdef __cplusplus
}
#endif

#endif
