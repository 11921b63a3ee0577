/*
 * rg_exec.h: executor of a plan on a VkDevice: creates Vulkan objects, records and submits frames.
 *
 * rg_exec_create() creates everything that a plan needs; a frame allocates nothing. It
 * requires Vulkan 1.3 with dynamicRendering, synchronization2, maintenance4, scalarBlockLayout and
 * separateDepthStencilLayouts enabled. Tables may also require independentBlend, depthBiasClamp,
 * fragmentStoresAndAtomics, vertexPipelineStoresAndAtomics, samplerFilterMinmax,
 * accelerationStructure, timelineSemaphore and the features of the shaders' OpCapabilities.
 * rg_exec_create() logs each missing feature. Functions are loaded through the application's
 * vkGetInstanceProcAddr, without a linked loader, so that executors of several instances can exist
 * side by side.
 *
 *     while (...) {
 *         rg_exec_begin(exec, &slot);                    waits until the slot is free
 *         memcpy(rg_exec_mapped(exec, &uniforms, slot), ...);
 *         rg_exec_submit(exec, frame);                   records and submits
 *         rg_exec_wait(exec, slot);                      only to read results back now
 *         ... rg_exec_mapped(exec, &readback, slot) ...
 *     }
 *
 * Ownership:     the plan, its tables, the device and imported objects outlive the executor; after
 *                rg_plan_destroy(), frames are rejected, and the tables must still last.
 * Errors:        VkResult. The log callback receives the failed call and the name of its object.
 *                VK_ERROR_VALIDATION_FAILED_EXT means invalid usage: the call had no effect. A
 *                rejected frame is not submitted, its semaphores are untouched, and
 *                rg_exec_begin() may begin another one. After any other error, only
 *                rg_exec_destroy() may be called.
 * Thread-safety: one thread at a time per executor, and for creating and destroying executors that
 *                share rg_exec_params.pipelines. The queues are used only by rg_exec_submit() and
 *                rg_exec_submit_synced().
 */
#ifndef RG_EXEC_H
#define RG_EXEC_H

#include "graph/rg.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Vulkan object that the program provides for an imported resource. */
struct rg_exec_import {
    VkImage image;                           /* same image in every frame */
    VkBuffer buffer;                         /* of an imported buffer */
    VkAccelerationStructureKHR acceleration; /* in `buffer`; for tracing */
    /* several images instead of `image`, such as a swapchain's. All imports with several images
     * have equally many, and a frame uses one index for all of them */
    const VkImage *images;
    uint32_t image_count;
    /* how the object was created; if given, it must suit the plan, else rg_exec_create() and
     * rg_exec_update() fail and log the member that does not. Read only during these calls. If
     * NULL, an image is not checked, and a buffer only against its memory requirements */
    const VkImageCreateInfo *image_info; /* of `image` or of each of `images` */
    const VkBufferCreateInfo *buffer_info;
};

/* Layout of a descriptor set that the program owns (set 1 in shaders). */
struct rg_exec_set {
    const struct rg_set *set;     /* as referenced by passes */
    VkDescriptorSetLayout layout; /* outlives executor and rg_exec_params.pipelines */
};

/* Sampler that the program owns. The graph relies on the members of `sampler` for its checks. */
struct rg_exec_sampler {
    const struct rg_sampler *sampler; /* as referenced by uses */
    VkSampler handle;                 /* outlives executor */
};

/* Cache of pipelines that outlives executors, so a later executor of the same device need not
 * compile them again. If two consecutive executors do not use a pipeline, it is freed. The cache
 * must be destroyed before the device. */
struct rg_pipelines;

/* Creates an empty cache. Returns NULL if out of memory. */
RG_API struct rg_pipelines *rg_pipelines_create(void);

/* Frees a cache and its pipelines. NULL is allowed. */
RG_API void rg_pipelines_destroy(struct rg_pipelines *pipelines);

/* Returns the shader to use for `shader`: `shader` itself, or a shader with an equal interface. The
 * code is read until rg_exec_create() or rg_exec_update() returns. */
typedef const struct rg_shader *rg_replace_shader_fn(void *user, const struct rg_shader *shader);

/* Receives a failed call with its object, such as "vkCreateImage of depth", and its result. */
typedef void rg_log_fn(void *user, const char *what, VkResult result);

/* A queue besides the main one. */
struct rg_exec_queue {
    VkQueue queue;   /* may equal another one of the parameters */
    uint32_t family; /* of the queue */
};

/* Parameters of rg_exec_create(). */
struct rg_exec_params {
    const struct rg_plan *plan; /* without faults, compiled for this device */
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* the loader's vkGetInstanceProcAddr, or volk's */
    VkPhysicalDevice physical;
    VkDevice device;
    /* must support graphics and compute; VK_NULL_HANDLE if only rg_exec_record() is used */
    VkQueue queue;
    uint32_t queue_family;                  /* of the queue */
    struct rg_exec_queue compute, transfer; /* those of rg_compile_params.queues; otherwise {0} */
    VkPipelineCache pipeline_cache;         /* VK_NULL_HANDLE is allowed */
    struct rg_pipelines *pipelines;         /* cache to reuse, or NULL */
    uint32_t frames_in_flight;              /* maximum unfinished frames; 0 means 2 */
    const struct rg_exec_import *imports;   /* parallel to rg_compile_params.imports; not kept */
    size_t import_count;
    const struct rg_exec_set *sets; /* one per rg_set; outlives executor */
    size_t set_count;
    const struct rg_exec_sampler *samplers; /* replace rg_sampler structs; outlives executor */
    size_t sampler_count;
    float max_anisotropy; /* device limit; 0 without samplerAnisotropy */
    bool measured;        /* enables rg_profile.h */
    bool statistics;      /* needs pipelineStatisticsQuery and occlusionQueryPrecise */
    /* values of specialization constants, read only during the call; NULL means the defaults */
    const VkSpecializationInfo *constants;
    rg_replace_shader_fn *replace_shader; /* called by rg_exec_create(); NULL: no replacement */
    /* enabled features (Vulkan 1.2 and 1.3 ones in pNext); NULL means all supported features */
    const VkPhysicalDeviceFeatures2 *features;
    rg_log_fn *log; /* NULL: failures are not logged */
    void *user;     /* passed to both callbacks */
};

struct rg_exec; /* an executor of one plan */

/* Creates an executor, which the caller destroys. Returns NULL on failure; `result` may be NULL. */
RG_API struct rg_exec *rg_exec_create(const struct rg_exec_params *params, VkResult *result);

/*
 * Replaces the executor's plan. Objects common to both plans are kept: memory, images (with their
 * content if persistent), descriptors, and pipelines (compared by content). The cost is that of the
 * difference; with rg_compile_params.max_view, a change of the view keeps all memory and pipelines.
 * Pipelines that the plan does not need are kept for one more update, so that switching back is
 * cheap.
 *
 * Of `params` only plan, imports, max_anisotropy, constants, replace_shader and user are used.
 * Must not be called between rg_exec_begin() and a submit. The previous plan and its tables must
 * exist until it returns. Results of rg_exec_image(), rg_exec_block() and rg_exec_mapped() become
 * invalid. Returns an error if a Vulkan call fails.
 *
 * Does not wait: frames that are in flight continue with the previous plan's objects, which are
 * destroyed once the last of these frames has been waited for, and the first frame of the new plan
 * begins after them on the device. Imported objects that only the previous plan uses must exist
 * until then, and so must objects bound by rg_cmd_bind_set() (rg_exec_wait_all()). Times of these
 * frames are lost (rg_profile.h). A readback buffer keeps their results if both plans have it with
 * equal name and size.
 */
RG_API VkResult rg_exec_update(struct rg_exec *exec, const struct rg_exec_params *params);

/* Waits for all submitted frames, and until all queues of a plan with several are idle, and frees
 * everything. NULL is allowed. */
RG_API void rg_exec_destroy(struct rg_exec *exec);

/* ---- a frame ---- */

/* Begins a frame in the next slot, after waiting for the slot's previous frame. Sets *slot. A frame
 * that was begun and not submitted is dropped. */
RG_API VkResult rg_exec_begin(struct rg_exec *exec, uint32_t *slot);

/* Records the plan into the slot begun last, calling the callbacks with `frame`, and submits it. */
RG_API VkResult rg_exec_submit(struct rg_exec *exec, const struct rg_frame *frame);

/* Synchronisation of a frame with work outside its queue. A zeroed struct means none. The arrays,
 * as in VkSubmitInfo2, are read during the call; the caller owns the semaphores, which are binary
 * or timeline semaphores (with `value`). */
struct rg_exec_external_sync {
    uint32_t image_index;               /* index into rg_exec_import.images */
    uint32_t wait_count, signal_count;  /* of the arrays */
    const VkSemaphoreSubmitInfo *waits; /* stageMask: stages of the frame that wait */
    const VkSemaphoreSubmitInfo *signals;
};

/* Submits as rg_exec_submit() does, with an image index, and waits for and signals semaphores. */
RG_API VkResult rg_exec_submit_synced(struct rg_exec *exec, const struct rg_frame *frame,
                                      const struct rg_exec_external_sync *sync);

/* Where rg_exec_record() records a frame. */
struct rg_exec_recording {
    VkCommandBuffer commands; /* primary, in the recording state, outside of rendering */
    uint32_t slot;            /* frame number modulo frames_in_flight, counted by the application */
    uint32_t image_index;     /* index into rg_exec_import.images */
};

/*
 * Records a frame into a command buffer of the application. The application may record other
 * commands before and after it, and submits the command buffer with its own semaphores and fence.
 * Bindings and dynamic state are undefined afterwards. The command buffer is submitted once, to a
 * queue of queue_family, and frames of an executor in the order in which they were recorded;
 * rg_exec_params.queue is not used.
 *
 * The previous frame of the slot must have finished, as its buffers and descriptors are reused: the
 * program waits for its own fence or timeline value, and then writes rg_exec_mapped() of the slot.
 * rg_exec_wait() cannot wait for such a frame: call it after that wait, to read readback buffers
 * and times of the slot. All frames must have finished when rg_exec_destroy() is called. Objects
 * that rg_exec_update() replaces are destroyed when rg_exec_wait() or rg_exec_record() has been
 * called for the slots of all frames that use them. RG_CLOCK_SUBMITS measures nothing. The plan
 * must use only the main queue.
 */
RG_API VkResult rg_exec_record(struct rg_exec *exec, const struct rg_exec_recording *recording,
                               const struct rg_frame *frame);

/* Waits until the frame submitted in a slot is finished; then its readback buffers may be read. For
 * a frame of rg_exec_record(), whose end the application awaits, it only makes them readable. */
RG_API VkResult rg_exec_wait(struct rg_exec *exec, uint32_t slot);

/* Waits for all submitted frames, as rg_exec_wait() does for each slot. */
RG_API VkResult rg_exec_wait_all(struct rg_exec *exec);

/* Returns the mapped memory of a slot's upload or readback buffer, or NULL if the plan does not use
 * the buffer. The executor owns it. Write it while the slot is free: before submit or record. */
RG_API void *rg_exec_mapped(struct rg_exec *exec, const struct rg_buffer *buffer, uint32_t slot);

/* ---- objects ---- */

/* Returns the VkImage of a declared image; VK_NULL_HANDLE if the plan does not use it. */
RG_API VkImage rg_exec_image(const struct rg_exec *exec, const struct rg_image *image);

/* Returns a view of an image that is not imported, for example for the application's bindless set.
 * The type is that of a sampled use: 3D, cube (6 layers of a cube), 2D array or 2D; NULL as `range`
 * means all, `each` is ignored. A view to be sampled has one aspect; that of an image with a
 * rg_use.view_format is only sampled. During a pass that declares
 * the image, its layout is rg_access_info(access)->layout of the use, or that of RG_DEPTH_READ if
 * it is also the read-only depth. The view is created on the first call, also before any frame, and
 * is valid until rg_exec_update() or rg_exec_destroy(). VK_NULL_HANDLE if the plan does not use the
 * image, on an import, or if Vulkan fails. */
RG_API VkImageView rg_exec_view(struct rg_exec *exec, const struct rg_image *image,
                                const struct rg_range *range);

/* Return the layouts of a row, for the application's pipelines (rg_cmd_bind_pipeline()). They are
 * valid until rg_exec_update() or rg_exec_destroy(); an update with an equal row keeps their
 * content. VK_NULL_HANDLE for transfer rows and for rows that the plan does not have.
 * Set 0 has a binding for each binding of the row's uses, with the type rg_use_descriptor(), for
 * the use's `stages`, or, if these are 0, for vertex and fragment or for compute shaders. Set 1 is
 * the row's `set`, if any. Push constants are push_size bytes from 0 on, for vertex and fragment or
 * for compute shaders. */
RG_API VkPipelineLayout rg_exec_layout(const struct rg_exec *exec, const struct rg_pass *row);
RG_API VkDescriptorSetLayout rg_exec_set_layout(const struct rg_exec *exec,
                                                const struct rg_pass *row);

/* Returns the VkDeviceMemory of a block of the plan. Between frames, its content is undefined. */
RG_API VkDeviceMemory rg_exec_block(const struct rg_exec *exec, uint32_t block);

/* ---- compiling for a device ---- */

/* Handles of the device to compile for. */
struct rg_vulkan {
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* as in rg_exec_params */
    VkPhysicalDevice physical;
    VkDevice device;
};

/* Returns a device's properties for rg_compile(), or {0} if a member of `vulkan` is NULL. `vulkan`
 * must outlive the returned struct. */
RG_API struct rg_device rg_exec_device(const struct rg_vulkan *vulkan);

#ifdef __cplusplus
}
#endif

#endif
