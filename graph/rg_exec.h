/*
 * rg_exec.h: run a plan on a VkDevice, frame after frame.
 *
 * rg_exec_create() makes everything that a plan needs: memory, images, views, samplers,
 * descriptors, pipelines, command buffers. A frame allocates nothing. The device needs Vulkan 1.3
 * with dynamicRendering, synchronization2, maintenance4, scalarBlockLayout and
 * separateDepthStencilLayouts enabled, independentBlend where the targets of a row blend
 * differently, depthBiasClamp where a bias is limited, fragmentStoresAndAtomics or
 * vertexPipelineStoresAndAtomics where such shaders write, accelerationStructure and
 * bufferDeviceAddress where rows build or trace, and what shaders declare to need (OpCapability).
 * rg_exec_create() tells the log each feature that is missing. Functions are found through the
 * program's own vkGetInstanceProcAddr: no loader is linked, nothing is global, and executors of
 * several instances can exist side by side.
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
 * Errors:        VkResult. The log callback gets the call that failed and the name of the pass,
 *                image or buffer that it was for. After a failure only rg_exec_destroy() may be
 *                called.
 * Thread-safety: one thread at a time per executor, and for making and destroying those that have
 *                rg_exec_params.pipelines in common. The queue is used only by rg_exec_submit(),
 *                rg_exec_submit_synced() and rg_exec_warm_up().
 */
#ifndef RG_EXEC_H
#define RG_EXEC_H

#include "graph/rg.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The object behind an import. */
struct rg_exec_import {
    VkImage image;   /* of an imported image that is the same one in each frame */
    VkBuffer buffer; /* of an imported buffer */
    VkAccelerationStructureKHR acceleration; /* in that buffer, if rows trace or build it */
    /* Instead of `image`: several images, of which each frame uses one, as those of a swapchain.
     * All imports that have several have equally many, and a frame uses the same index of all. */
    const VkImage *images;
    uint32_t image_count;
};

/* The layout of a descriptor set of the program's own. */
struct rg_exec_set {
    const struct rg_set *set;     /* that rows name */
    VkDescriptorSetLayout layout; /* borrowed; it outlives executor and rg_exec_params.pipelines */
};

/*
 * Pipelines that executors of one device leave when they are destroyed. One that is made later
 * takes all of them over: what it draws alike is not compiled again. What neither it nor the next
 * one needs is freed. It outlives the executors, and is destroyed before the device.
 */
struct rg_pipelines;

/* Returns NULL if memory is short. */
RG_API struct rg_pipelines *rg_pipelines_create(void);

/* NULL is allowed. */
RG_API void rg_pipelines_destroy(struct rg_pipelines *pipelines);

/* Returns the shader to use in place of one that a table names: the same one, or one with the same
 * interface. What it returns is read until rg_exec_create() returns. */
typedef const struct rg_shader *rg_replace_shader_fn(void *user, const struct rg_shader *shader);

/* Receives what failed ("vkCreateImage of depth") and how. Called in the thread of the executor. */
typedef void rg_log_fn(void *user, const char *what, VkResult result);

/* What an executor is made of. */
struct rg_exec_params {
    const struct rg_plan *plan; /* without faults, compiled for this device */
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* the loader's vkGetInstanceProcAddr, or volk's */
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;                        /* for graphics and compute */
    uint32_t queue_family;                /* of the queue */
    VkPipelineCache pipeline_cache;       /* VK_NULL_HANDLE is allowed */
    struct rg_pipelines *pipelines;       /* of executors that have ended; NULL: none */
    uint32_t frames_in_flight;            /* frames that may be unfinished at once; 0 means 2 */
    const struct rg_exec_import *imports; /* in the order of the compile params' imports; only read
                                             by rg_exec_create() */
    size_t import_count;
    const struct rg_exec_set *sets; /* one for each that rows name; outlive the executor */
    size_t set_count;
    float max_anisotropy; /* limit of the device; 0: samplerAnisotropy is not enabled */
    bool render_passes;   /* records VkRenderPass objects instead of dynamic rendering, which some
                             releases of the synchronization validation do not check */
    bool warm_up_only;    /* for rg_exec_warm_up() alone: `imports` are not needed, nothing has
                             content; without render_passes */
    bool measured;        /* rg_time.h can be used */
    bool statistics;      /* rg_time.h can count work: pipelineStatisticsQuery and
                             occlusionQueryPrecise are enabled */
    /* Specialization constants for all shaders; a shader ignores ids that it lacks. Only read by
     * rg_exec_create(). NULL: every constant has its default. */
    const VkSpecializationInfo *constants;
    rg_replace_shader_fn
        *replace_shader; /* called by rg_exec_create(); NULL: no shader is replaced */
    /* What the device was created with, with VkPhysicalDeviceVulkan12Features and ...13Features in
     * pNext. NULL: all that it supports. Only read by rg_exec_create(). */
    const VkPhysicalDeviceFeatures2 *features;
    rg_log_fn *log; /* NULL: failures are not told */
    void *user;     /* passed to both functions */
};

struct rg_exec; /* an executor of one plan */

/* Makes an executor. Returns NULL on failure. *result gets the reason, or VK_SUCCESS; `result` may
 * be NULL. The caller destroys the executor. */
RG_API struct rg_exec *rg_exec_create(const struct rg_exec_params *params, VkResult *result);

/*
 * Puts another plan in the place of the executor's. What is the same in both stays: memory, images
 * with their content if they are persistent, descriptors, pipelines (by their content, not by their
 * address). So a change of the view, of a technique or of constants costs what has changed, and
 * with rg_compile_params.max_view a change of the view keeps all memory and pipelines. Pipelines
 * that the plan does not need stay for one more update, so that switching to and fro is cheap.
 *
 * Of `params` only plan, imports, max_anisotropy, constants, replace_shader and user count; all
 * else stays as it was created. Waits for all submitted frames; not to be called between
 * rg_exec_begin() and a submit. The former plan and its tables must exist until it returns. What
 * rg_exec_image(), rg_exec_block() and rg_exec_mapped() have returned becomes invalid, and no
 * region is set. Returns an error if a call fails.
 */
RG_API VkResult rg_exec_update(struct rg_exec *exec, const struct rg_exec_params *params);

/* Waits for all submitted frames and frees everything. NULL is allowed. */
RG_API void rg_exec_destroy(struct rg_exec *exec);

/* ---- a frame ---- */

/* Begins a frame in the next slot (0 to frames_in_flight - 1), and waits until the earlier frame of
 * that slot is finished. *slot gets the slot. */
RG_API VkResult rg_exec_begin(struct rg_exec *exec, uint32_t *slot);

/* Records the plan into the slot begun last, and submits it. `frame` is passed to the record and
 * when functions, which are called before this returns. */
RG_API VkResult rg_exec_submit(struct rg_exec *exec, const struct rg_frame *frame);

/* What connects a frame with work outside of its queue. {0}: nothing. */
struct rg_exec_external_sync {
    uint32_t image_index;              /* which of the images of rg_exec_import is used */
    VkSemaphore wait;                  /* binary, waited for; VK_NULL_HANDLE: none */
    VkPipelineStageFlags2 wait_stages; /* stages that wait for it; 0 means all */
    VkSemaphore signal; /* binary, signalled when all is done; VK_NULL_HANDLE: none */
};

/* Does what rg_exec_submit() does, with image index and semaphores. `sync` is only read by the
 * call; the semaphores belong to the caller. */
RG_API VkResult rg_exec_submit_synced(struct rg_exec *exec, const struct rg_frame *frame,
                                      const struct rg_exec_external_sync *sync);

/* Waits for the frame submitted in a slot; then its readback buffers may be read. */
RG_API VkResult rg_exec_wait(struct rg_exec *exec, uint32_t slot);

/* Returns the memory of an RG_MEMORY_UPLOAD or RG_MEMORY_READBACK buffer in a slot, which stays the
 * executor's; NULL if the plan does not use the buffer. Upload buffers are written between
 * rg_exec_begin() and rg_exec_submit(). */
RG_API void *rg_exec_mapped(struct rg_exec *exec, const struct rg_buffer *buffer, uint32_t slot);

/* A region of the view, for pictures that are too large to be drawn at once. */
struct rg_exec_region {
    VkRect2D region; /* in the view; not empty, no more texels than rg_compile_params.max_region */
    VkRect2D reach;  /* in the view, of any size: where fragments read beside their own texel */
};

/*
 * Limits the frames from the next submit on to a region of the view. They draw no more than that,
 * with the bits that the whole picture has there, and leave the rest undefined. This applies to
 * images of the view's size, neither imported nor persistent: to rows that draw into them, and to
 * rows that only copy from them to buffers, which get the texels of `region` alone, rows tight.
 * Images that a row samples without rg_use.same_texel are drawn in `reach` as well. Everything else
 * is drawn whole. Fragments that take derivatives need even offsets.
 */
RG_API void rg_exec_set_region(struct rg_exec *exec, const struct rg_exec_region *region);

/* ---- objects ---- */

/* Returns the image made for a declaration, to import it elsewhere; it stays the executor's.
 * VK_NULL_HANDLE if the plan does not use it. */
RG_API VkImage rg_exec_image(const struct rg_exec *exec, const struct rg_image *image);

/* Returns the memory of a block of the plan, below rg_plan.block_count, which stays the executor's.
 * Its content is undefined between frames. */
RG_API VkDeviceMemory rg_exec_block(const struct rg_exec *exec, uint32_t block);

/* ---- for drivers that compile a pipeline when something is first drawn with it ---- */

/*
 * Draws a pass of the plan where nothing of it can be seen, and waits, so that the driver compiles
 * it: a triangle for each draw that the record function records. Passes that do not draw, that
 * have a set of the program's own, or whose condition is false for `frame`, are skipped. An
 * executor made with `warm_up_only` on a device of its own does so in another thread, beside the
 * executor that draws; it pays off where the driver keeps what it has compiled in a cache that
 * both devices share.
 */
RG_API VkResult rg_exec_warm_up(struct rg_exec *exec, const struct rg_frame *frame, uint32_t pass);

/* ---- compiling for a device ---- */

/* The device to compile for. */
struct rg_vulkan {
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* as of rg_exec_params */
    VkPhysicalDevice physical;
    VkDevice device;
};

/* Returns what rg_compile() may ask of a device. `vulkan` is borrowed and outlives the result. */
RG_API struct rg_device rg_exec_device(const struct rg_vulkan *vulkan);

#ifdef __cplusplus
}
#endif

#endif
