/*
 * rg_exec.h: realises a plan on a VkDevice and runs it, frame after frame.
 *
 * Everything a plan needs (memory, images, views, samplers, descriptors, pipelines, command
 * buffers) is made once by rg_exec_create(); a frame allocates nothing. Needs Vulkan 1.3 with
 * dynamicRendering, synchronization2, maintenance4, scalarBlockLayout and
 * separateDepthStencilLayouts enabled, and independentBlend where the targets of a row blend
 * differently. Every function is found through the program's own vkGetInstanceProcAddr: nothing is
 * loaded or linked here, and each executor has its own table.
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
 * Errors:        VkResult; the log callback gets the failing call and the name of the pass, image
 *                or buffer that it was for. After a failure only rg_exec_destroy() may be called.
 * Thread-safety: one thread at a time per executor; the queue is used only inside submit.
 */
#ifndef RG_EXEC_H
#define RG_EXEC_H

#include "graph/rg.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The object behind each of the compile params' imports, in the same order. */
struct rg_exec_import {
    VkImage image;
    VkBuffer buffer;
    /* Instead of `image`: several, of which each frame uses one, as those of a swapchain. Imports
     * that come so have equally many, and the same choice counts for all of them. */
    const VkImage *images;
    uint32_t image_count;
};

/* What stands in for a shader that a table names: that shader, or one with the same interface. */
typedef const struct rg_shader *rg_replace_fn(void *user, const struct rg_shader *shader);

/* Gets where transient memory that the host could map lies, before anything is in it: on devices
 * that are the CPU, this process's own memory. */
typedef void rg_advise_fn(void *memory, size_t size);

/* Gets what failed ("vkCreateImage of depth") and how. */
typedef void rg_log_fn(void *user, const char *what, VkResult result);

struct rg_exec_params {
    const struct rg_plan *plan; /* without faults */
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* the loader's vkGetInstanceProcAddr, or volk's */
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue; /* graphics and compute */
    uint32_t queue_family;
    VkPipelineCache pipeline_cache;       /* may be VK_NULL_HANDLE */
    uint32_t frames_in_flight;            /* 0 means 2 */
    const struct rg_exec_import *imports; /* as many as the plan has; read by create alone */
    size_t import_count;
    float max_anisotropy; /* the enabled device limit; 0: samplerAnisotropy is off */
    /* Record through VkRenderPass objects: some releases of the synchronization validation do not
     * look into dynamic rendering. */
    bool render_passes;
    /* For rg_exec_warm_up() alone: imports are stood in for, `imports` do not count, nothing has
     * content. Without render_passes. */
    bool warm_up_only;
    bool measured;   /* rg_time.h */
    bool statistics; /* the same: pipelineStatisticsQuery and occlusionQueryPrecise are enabled */
    /* Specialization constants of all shaders; an id that a shader lacks is none of its business.
     * Read by create alone; NULL: each has its own defaults. */
    const VkSpecializationInfo *constants;
    rg_replace_fn *replace; /* called by create alone; NULL: nothing does */
    rg_advise_fn *advise;   /* the same */
    rg_log_fn *log;         /* NULL: silent */
    void *user;             /* of both */
};

struct rg_exec;

/* NULL on failure; *result says why and may be NULL. */
RG_API struct rg_exec *rg_exec_create(const struct rg_exec_params *params, VkResult *result);

/* Waits for all frames. May be NULL. */
RG_API void rg_exec_destroy(struct rg_exec *exec);

/*
 * Has a pass compiled, for drivers that leave that to its first draw, as those do that run on the
 * CPU: draws a triangle of each of its draws where nothing of it can be seen, and waits. A hollow
 * executor on a device of its own does so beside another one, in another thread, and leaves the
 * result in the driver's cache. Passes that would not run, or do not draw, are passed over.
 */
RG_API VkResult rg_exec_warm_up(struct rg_exec *exec, const struct rg_frame *frame, uint32_t pass);

/* Takes the next slot, 0..frames_in_flight - 1, waiting until its earlier frame is finished. */
RG_API VkResult rg_exec_begin(struct rg_exec *exec, uint32_t *slot);

/* Records the plan into the slot taken last and submits it. */
RG_API VkResult rg_exec_submit(struct rg_exec *exec, const struct rg_frame *frame);

/* What ties a frame to what is outside its queue; {0}: nothing. */
struct rg_exec_external_sync {
    uint32_t image_index;              /* which of the images of an import */
    VkSemaphore wait;                  /* binary; VK_NULL_HANDLE: none */
    VkPipelineStageFlags2 wait_stages; /* that wait for it; 0 means all */
    VkSemaphore signal;                /* binary, when all is done; VK_NULL_HANDLE: none */
};

/* The same with ties. */
RG_API VkResult rg_exec_submit_synced(struct rg_exec *exec, const struct rg_frame *frame,
                                      const struct rg_exec_external_sync *sync);

/*
 * Part of the view, for pictures that are too large to be drawn at once: from the next submit on
 * frames draw no more than that, with the bits that the whole picture has there, and leave
 * undefined what lies outside. It counts for images of the view's size, neither imported nor
 * persistent: rows that draw into them, and rows that only copy from them to buffers, which get
 * `region` alone, rows tight. What a row reads without rg_use.same_texel is drawn in `reach`, too.
 * Everything else is drawn whole. Fragments that take derivatives need even offsets.
 */
struct rg_exec_region {
    VkRect2D region; /* in the view; not empty, no more texels than rg_compile_params.max_region */
    VkRect2D reach;  /* in the view, of any size: where fragments read beside their own texel */
};

RG_API void rg_exec_set_region(struct rg_exec *exec, const struct rg_exec_region *region);

/* Waits for the frame submitted in a slot; readback buffers are then up to date. */
RG_API VkResult rg_exec_wait(struct rg_exec *exec, uint32_t slot);

/* Memory of an upload or readback buffer in a slot; NULL if the plan does not use the buffer. */
RG_API void *rg_exec_mapped(struct rg_exec *exec, const struct rg_buffer *buffer, uint32_t slot);

/* The image made for a declaration, to import elsewhere; VK_NULL_HANDLE if not in the plan. */
RG_API VkImage rg_exec_image(const struct rg_exec *exec, const struct rg_image *image);

/* What rg_compile() may ask of a device. `vulkan` is borrowed and outlives the result. */
struct rg_vulkan {
    VkInstance instance;
    PFN_vkGetInstanceProcAddr get_proc_addr; /* as of rg_exec_params */
    VkPhysicalDevice physical;
    VkDevice device;
};
RG_API struct rg_device rg_exec_device(const struct rg_vulkan *vulkan);

#ifdef __cplusplus
}
#endif

#endif
