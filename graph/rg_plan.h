/*
 * rg_plan.h: what a plan is made of, the result of rg_compile(). Included by rg.h.
 *
 * A plan belongs to whoever compiled it, and never changes; its arrays live as long as it does.
 */
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

/* An image that living passes access. */
struct rg_plan_image {
    const struct rg_image *image; /* the declaration */
    VkExtent2D extent;            /* texels of mip 0 */
    uint32_t depth;               /* the same; 1 unless it has three dimensions */
    uint32_t layers, mips;
    VkImageAspectFlags aspects; /* of the format */
    VkImageUsageFlags usage;    /* of all accesses */
    VkImageCreateFlags flags;
    uint32_t samples;          /* per texel */
    bool imported, persistent; /* neither: transient */
    uint32_t import;           /* index into the params' imports, or RG_NONE */
    uint32_t first, last;      /* plan passes that access it; an output's last is pass_count */
    uint32_t block;            /* index into blocks; RG_NONE unless transient */
    VkDeviceSize offset, size; /* bytes, in the block; the size that its memory has */
};

/* A buffer that living passes access. */
struct rg_plan_buffer {
    const struct rg_buffer *buffer;   /* the declaration */
    VkDeviceSize size;                /* bytes, without alignment */
    VkDeviceSize max_size;            /* bytes in a view of max_view; in host memory it has them */
    VkBufferUsageFlags usage;         /* of all accesses */
    bool imported, persistent;        /* neither: transient */
    uint32_t import;                  /* index into the params' imports, or RG_NONE */
    uint32_t first, last;             /* plan passes, as of an image */
    uint32_t block;                   /* RG_NONE unless transient and RG_MEMORY_DEVICE */
    VkDeviceSize offset, memory_size; /* bytes, in the block; 0 in host memory */
};

/* Memory that transient images, or transient buffers, share. */
struct rg_block {
    VkDeviceSize size, alignment; /* bytes */
    uint32_t type_bits;           /* memory types that suit all of them */
    bool buffers;                 /* of buffers; else of images */
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

/* An attachment of a pass. */
struct rg_plan_target {
    uint32_t image;      /* index into images */
    uint32_t mip, layer; /* where it draws */
    VkAttachmentLoadOp load;
    VkAttachmentStoreOp store; /* derived from what later passes and outputs need */
    VkImageLayout layout;
    uint32_t resolve; /* index into images, or RG_NONE; in the layout of a colour target */
    uint32_t resolve_mip, resolve_layer;
};

/* A use with its range resolved: a descriptor, or an access that has none. */
struct rg_plan_use {
    const struct rg_use *use;      /* the declaration */
    uint32_t image, buffer;        /* index into images or buffers; the other is RG_NONE */
    VkImageSubresourceRange range; /* of an image */
    VkImageLayout layout;          /* of an image, during the pass */
};

/* One pass to record: a row, or one repetition of it. */
struct rg_plan_pass {
    const struct rg_pass *pass; /* the row */
    const struct rg_technique *technique;
    uint32_t row;                          /* index into the technique's passes */
    uint32_t repetition;                   /* from 0 */
    VkExtent2D extent;                     /* texels of the targets; the view's without targets */
    uint32_t first_barrier, barrier_count; /* one batch, recorded before the pass */
    uint32_t first_use, use_count;
    uint32_t first_fallback, fallback_count;
    const struct rg_plan_target *color; /* `color_count` of rg_plan.colors */
    uint32_t color_count;
    struct rg_plan_target depth; /* its image is RG_NONE if there is none */
};

/* A pass that no output needs. */
struct rg_culled {
    const struct rg_pass *pass;
    uint32_t repetition;
};

/* The result of rg_compile(). If fault_count is not 0, only the faults may be read. */
struct rg_plan {
    const struct rg_fault *faults;
    uint32_t fault_count;
    VkExtent2D view, max_region; /* of the params */
    uint32_t pass_count, image_count, buffer_count, barrier_count, use_count, block_count;
    uint32_t culled_count, color_count, fallback_count;
    uint32_t batch_count;              /* passes with barriers before them, and the end with some */
    const struct rg_plan_pass *passes; /* in the order in which they run */
    const struct rg_plan_image *images; /* in the order of their first access */
    const struct rg_plan_buffer *buffers;
    const struct rg_barrier *barriers; /* of the frame; behind them the initial ones */
    uint32_t first_final_barrier, final_barrier_count; /* one batch, after the last pass */
    /* Barriers before the first frame, in no batch: from TRANSFER_DST_OPTIMAL (persistent resources
     * have just been filled with zeros) to the state that every frame finds and leaves. */
    uint32_t first_initial_barrier, initial_barrier_count;
    const struct rg_plan_use *uses;        /* those of a pass adjoin */
    const struct rg_use *const *fallbacks; /* uses bound to their fallback; in no dump */
    const struct rg_plan_target *colors;   /* colour targets; those of a pass adjoin */
    const struct rg_block *blocks;
    const struct rg_culled *culled;
    VkDeviceSize memory_used;             /* bytes of all blocks */
    VkDeviceSize memory_without_aliasing; /* bytes if nothing were shared */
    VkDeviceSize memory_bound;            /* bytes taken at some one time: no packing needs less */
    VkDeviceSize memory_least;            /* that bound if batches did not count */
    VkDeviceSize memory_persistent;       /* bytes of persistent resources, beside all this */
    size_t arena_size;                    /* bytes of memory that compiling took */
};

#ifdef __cplusplus
}
#endif

#endif
