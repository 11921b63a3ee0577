/* rg_plan.h: struct rg_plan, the immutable result of rg_compile(). Included by rg.h. */
#ifndef RG_PLAN_H
#define RG_PLAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RG_NONE UINT32_MAX /* an index that refers to nothing */

/* Queue that executes a pass. */
enum rg_queue {
    RG_QUEUE_MAIN,     /* graphics and compute */
    RG_QUEUE_COMPUTE,  /* asynchronous compute, for RG_COMPUTE and RG_TRANSFER rows */
    RG_QUEUE_TRANSFER, /* for RG_TRANSFER rows that only copy whole subresources or fill buffers */
    RG_QUEUE_COUNT,
};

/* An image that passes of the plan access. */
struct rg_plan_image {
    const struct rg_image *image; /* the declaration */
    VkExtent2D extent;            /* texels of mip 0 */
    uint32_t depth;               /* texels along z; 1 unless 3D */
    uint32_t layers, mips;
    VkImageAspectFlags aspects; /* of the format */
    VkImageUsageFlags usage;    /* for all accesses */
    VkImageCreateFlags flags;
    uint32_t samples;          /* per texel */
    bool imported, persistent; /* neither: transient */
    uint32_t import;           /* index into rg_compile_params.imports, or RG_NONE */
    uint32_t partner; /* resource that it is swapped with after a frame (`previous`), or RG_NONE */
    uint32_t queues;  /* mask of 1 << enum rg_queue; several: concurrent sharing mode */
    uint32_t first, last;      /* lifetime; `last` is pass_count for outputs */
    uint32_t block;            /* index into blocks; RG_NONE: dedicated memory, or an import */
    VkDeviceSize offset, size; /* bytes; `offset` is within the block */
};

/* A buffer that passes of the plan access. */
struct rg_plan_buffer {
    const struct rg_buffer *buffer;   /* the declaration */
    VkDeviceSize size;                /* bytes, without alignment */
    VkDeviceSize max_size;            /* bytes allocated in host memory (max_view) */
    VkBufferUsageFlags usage;         /* for all accesses */
    bool imported, persistent;        /* neither: transient */
    uint32_t import;                  /* index into rg_compile_params.imports, or RG_NONE */
    uint32_t queues;                  /* as in rg_plan_image */
    uint32_t first, last;             /* lifetime; `last` is pass_count for outputs */
    uint32_t block;                   /* as in rg_plan_image; RG_NONE in host memory */
    VkDeviceSize offset, memory_size; /* bytes; 0 in host memory */
};

/* A memory allocation shared by transient images, or by transient buffers. */
struct rg_block {
    VkDeviceSize size, alignment; /* bytes */
    uint32_t type_bits;           /* mask of allowed memory types */
    bool buffers;                 /* holds buffers; otherwise images */
};

/* One VkImageMemoryBarrier2 or VkBufferMemoryBarrier2. */
struct rg_barrier {
    uint32_t image;  /* index into images, or RG_NONE */
    uint32_t buffer; /* index into buffers, or RG_NONE */
    VkPipelineStageFlags2 src_stages, dst_stages;
    VkAccessFlags2 src_access, dst_access;
    VkImageLayout old_layout, new_layout; /* of an image */
    VkImageSubresourceRange range;        /* of an image */
};

/* An attachment of a pass. Its resolve target is in COLOR_ATTACHMENT_OPTIMAL layout. */
struct rg_plan_target {
    uint32_t image; /* index into images */
    uint32_t mip, layer;
    VkAttachmentLoadOp load;
    VkAttachmentStoreOp store; /* STORE only if needed later */
    VkImageLayout layout;
    uint32_t resolve; /* index into images, or RG_NONE */
    uint32_t resolve_mip, resolve_layer;
};

/* A resource use of a pass, with its subresource range resolved. It may have no descriptor. */
struct rg_plan_use {
    const struct rg_use *use;      /* the declaration */
    uint32_t image, buffer;        /* index; the other is RG_NONE */
    VkImageSubresourceRange range; /* of an image */
    VkImageLayout layout;          /* of an image, during the pass */
};

/* One pass to record: a declared pass, or one repetition of it. */
struct rg_plan_pass {
    const struct rg_pass *pass; /* the row */
    const struct rg_technique *technique;
    uint32_t row;                          /* index into the technique's passes */
    uint32_t repetition;                   /* from 0 */
    VkExtent2D extent;                     /* target size, or the view's */
    uint32_t first_barrier, barrier_count; /* one batch, recorded before the pass */
    uint32_t first_use, use_count;
    uint32_t first_fallback, fallback_count;
    const struct rg_plan_target *color; /* `color_count` elements of rg_plan.colors */
    uint32_t color_count;
    struct rg_plan_target depth; /* image may be RG_NONE */
};

/* Consecutive passes that are submitted together to one queue. */
struct rg_submission {
    enum rg_queue queue;
    uint32_t first_pass, pass_count;
    /* per queue: 1 plus the index of the submission to wait for; 0 if there is none */
    uint32_t waits[RG_QUEUE_COUNT];
};

/* A pass removed because no output needs it. */
struct rg_culled {
    const struct rg_pass *pass;
    uint32_t repetition;
};

/* The result of rg_compile(). If fault_count is not 0, only the faults may be read. */
struct rg_plan {
    const struct rg_fault *faults;
    uint32_t fault_count;
    VkExtent2D view; /* from rg_compile_params */
    uint32_t pass_count, image_count, buffer_count, barrier_count, use_count, block_count;
    uint32_t culled_count, color_count, fallback_count;
    /* in order; 0: the frame is one submission to the main queue. Otherwise the first and the last
     * one are on the main queue and have no passes: the first precedes all others of the frame, the
     * last has the final barriers and waits for all queues */
    uint32_t submission_count;
    const struct rg_submission *submissions;
    uint32_t batch_count;               /* barrier batches, including the final one */
    const struct rg_plan_pass *passes;  /* in execution order */
    const struct rg_plan_image *images; /* in the order of first access */
    const struct rg_plan_buffer *buffers;
    const struct rg_barrier *barriers;                 /* per frame, followed by initial ones */
    uint32_t first_final_barrier, final_barrier_count; /* one batch, after the last pass */
    /* Barriers to record once, after zero-filling persistent resources (images in
     * TRANSFER_DST_OPTIMAL layout) and before the first frame. Not counted in batch_count. */
    uint32_t first_initial_barrier, initial_barrier_count;
    const struct rg_plan_use *uses;        /* contiguous for each pass */
    const struct rg_use *const *fallbacks; /* uses bound to their placeholder */
    const struct rg_plan_target *colors;   /* colour targets; contiguous for each pass */
    const struct rg_block *blocks;
    const struct rg_culled *culled;
    VkDeviceSize memory_used;             /* bytes of all blocks */
    VkDeviceSize memory_without_aliasing; /* bytes if nothing aliased */
    VkDeviceSize memory_bound;            /* peak live bytes, a lower bound */
    VkDeviceSize memory_persistent;       /* bytes of dedicated memory, not included above */
    size_t arena_size;                    /* arena bytes used by rg_compile() */
    uint32_t users; /* set by the library: number of executors, and RG_PLAN_DESTROYED */
};

#define RG_PLAN_DESTROYED (1u << 31) /* rg_plan_destroy() was called while executors had the plan */

#ifdef __cplusplus
}
#endif

#endif
