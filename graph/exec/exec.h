/* exec.h: data and functions that the files of the executor share. Private to graph/exec/. */
#ifndef RG_EXEC_EXEC_H
#define RG_EXEC_EXEC_H

#include "graph/exec/functions.h"
#include "graph/rg_exec.h"
#include "graph/rg_time.h"

/* A buffer in host memory has one object per slot, another one has one object in all. */
struct exec_buffer {
    VkBuffer *buffers;      /* per slot */
    VkDeviceMemory *memory; /* per slot; NULL unless in host memory */
    void **mapped;          /* per slot; NULL unless in host memory */
    VkDeviceMemory own;     /* of a persistent buffer */
    bool coherent;          /* the host memory needs no flush and no invalidation */
};

enum {
    RG_VIEW_COUNT = 2 * RG_COLOR_COUNT + 1 /* attachments of a pass: colours, depth, resolves */
};

struct exec_targets {
    VkImageView views[RG_VIEW_COUNT]; /* colours, depth, resolves; without gaps */
    VkFramebuffer framebuffer;
};

struct exec_pass {
    VkPipelineLayout layout; /* shared by the repetitions of a row, as are the next two */
    VkDescriptorSetLayout set_layout;
    VkPipeline pipeline;
    bool owner;  /* the first repetition, which frees the three */
    bool shares; /* its pipeline and layout are those of an earlier row that draws alike */
    VkRenderPass render_pass;
    VkDescriptorSet *sets; /* per image set and slot */
    uint32_t coverage;     /* how much of a region it draws (region.c) */
};

/* The image of a use that is bound to its fallback. */
struct exec_fallback {
    bool owner; /* else the rest is that of an earlier one that is alike */
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
};

struct exec_slot {
    VkCommandBuffer commands;
    VkFence fence;
    bool submitted;
    struct rg_times times;       /* of its frame, so far */
    struct rg_pass_time *passes; /* of its frame; NULL: not measured */
};

struct exec_sampler {
    struct rg_sampler key;
    VkSampler sampler;
};

/* An *image set* is one of the images of each import that has several; see import_images.c. */
struct rg_exec {
    struct rg_exec_params params;
    struct rg_functions vk;
    const struct rg_plan *plan;
    VkDevice device;
    uint32_t slot_count, slot;           /* `slot`: begun last */
    uint32_t image_set_count, image_set; /* 1 and 0 unless imports have several images */
    VkPhysicalDeviceMemoryProperties memory_properties;
    VkDeviceMemory *blocks;
    VkImage *images;              /* per plan image; of an import that of the image set in use */
    VkImage *import_images;       /* per image set and plan image; null unless there are several */
    VkDeviceMemory *image_memory; /* per plan image; of persistent ones */
    struct exec_buffer *buffers;
    VkImageView *use_views;          /* per image set and plan use; null for buffers */
    struct exec_fallback *fallbacks; /* per fallback of the plan */
    struct exec_sampler *samplers;
    uint32_t sampler_count;
    struct exec_pass *passes;
    struct exec_targets *targets; /* per image set and pass */
    VkDescriptorPool descriptor_pool;
    VkCommandPool command_pool;
    struct exec_slot *slots;
    struct rg_exec_region region;               /* {0}: the whole view */
    struct rg_exec_external_sync external_sync; /* of the frame submitted last */
    struct exec_time *time;                     /* NULL: made without `measured` */
    bool filled;       /* a frame has given persistent resources and fallbacks their content */
    VkBuffer triangle; /* made with `warm_up_only`: vertices and indices, all zero */
    VkDeviceMemory triangle_memory;
    VkImageMemoryBarrier2 *image_batch; /* room for all barriers of the plan */
    VkBufferMemoryBarrier2 *buffer_batch;
};

/* The pass being recorded. */
struct rg_cmd {
    struct rg_exec *exec;
    const struct rg_plan_pass *plan_pass;
    const struct exec_pass *pass;
    VkCommandBuffer commands;
    bool warm_up; /* each draw becomes one triangle, outside of the targets */
};

/* Logs a failed call and the name of what it was for (NULL: the frame). Returns `result`. */
VkResult rg_exec_check(const struct rg_exec *exec, VkResult result, const char *call,
                       const char *of);

/* Calls a function of Vulkan, and leaves if it fails: needs `result` and a label `fail`. */
#define RG_CALL(exec, of, function, ...) \
    do { \
        result = rg_exec_check((exec), (exec)->vk.function(__VA_ARGS__), "vk" #function, (of)); \
        if (result != VK_SUCCESS) \
            goto fail; \
    } while (0)

/* Calls one that makes *handle, which Vulkan leaves undefined after a failure. */
#define RG_MAKE(exec, of, function, handle, ...) \
    do { \
        result = rg_exec_check((exec), \
                               (exec)->vk.function((exec)->device, __VA_ARGS__, NULL, (handle)), \
                               "vk" #function, (of)); \
        if (result != VK_SUCCESS) { \
            *(handle) = VK_NULL_HANDLE; \
            goto fail; \
        } \
    } while (0)

/* Calls a function that has logged its failure. */
#define RG_PASS(call) \
    do { \
        result = (call); \
        if (result != VK_SUCCESS) \
            goto fail; \
    } while (0)

/* Names an object for captures and messages, if the instance has debug utils. */
void rg_exec_name(const struct rg_exec *exec, VkObjectType type, uint64_t handle, const char *name);

/* import_images.c */
VkResult rg_exec_count_image_sets(struct rg_exec *exec);
void rg_exec_keep_import_images(struct rg_exec *exec, uint32_t image,
                                const struct rg_exec_import *import);
void rg_exec_select_image_set(struct rg_exec *exec, uint32_t set);
/* Of the image set in use: */
struct exec_targets *rg_exec_targets(const struct rg_exec *exec, const struct exec_pass *pass);
VkDescriptorSet *rg_exec_set(const struct rg_exec *exec, const struct exec_pass *pass,
                             uint32_t slot);
VkImageView *rg_exec_use_view(const struct rg_exec *exec, uint32_t use);

/* region.c */
VkResult rg_exec_make_coverage(struct rg_exec *exec);
/* Whether a pass draws or copies only a part of its targets now. */
bool rg_exec_is_limited(const struct rg_exec *exec, const struct rg_plan_pass *pass);
/* Returns what a pass draws. */
VkRect2D rg_exec_area(const struct rg_exec *exec, const struct rg_plan_pass *pass);
VkRect2D rg_exec_within(VkRect2D inner, VkRect2D outer); /* the common part */

/* memory.c */
VkResult rg_exec_make_memory(struct rg_exec *exec);
/* Allocates from the first memory type that has all of `wanted` and `needed`, else of `needed`. */
VkResult rg_exec_allocate(const struct rg_exec *exec, const VkMemoryRequirements *needs,
                          VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags needed,
                          const char *name, VkDeviceMemory *memory);
void rg_exec_free_memory(struct rg_exec *exec);
VkBuffer rg_exec_buffer(const struct rg_exec *exec, uint32_t buffer, uint32_t slot);
VkResult rg_exec_sync_host(struct rg_exec *exec, uint32_t slot, enum rg_memory memory);

/* descriptors.c */
VkResult rg_exec_make_descriptors(struct rg_exec *exec);
void rg_exec_free_descriptors(struct rg_exec *exec);

/* pipelines.c */
VkResult rg_exec_make_pipelines(struct rg_exec *exec);
void rg_exec_free_pipelines(struct rg_exec *exec);
VkShaderStageFlags rg_exec_stages(const struct rg_pass *pass);

/* targets.c: views of targets, and VkRenderPass objects where asked for */
VkSampleCountFlagBits rg_exec_samples(const struct rg_exec *exec, const struct rg_plan_pass *pass);
VkResult rg_exec_make_targets(struct rg_exec *exec);
void rg_exec_free_targets(struct rg_exec *exec);

/* clear.c: what is done before the first frame */
void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands);
/* Waits for all work, and changes the layout of an image for all that follows. */
void rg_exec_record_move(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                         const VkImageSubresourceRange *range, VkImageLayout from,
                         VkImageLayout to);
/* Clears a new image and leaves it in TRANSFER_DST_OPTIMAL; depth takes the first float. */
void rg_exec_record_clear_image(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                                const VkImageSubresourceRange *range,
                                const VkClearColorValue *color);

/* fallback.c */
VkResult rg_exec_make_fallbacks(struct rg_exec *exec);
void rg_exec_free_fallbacks(struct rg_exec *exec);
void rg_exec_record_fallbacks(struct rg_exec *exec, VkCommandBuffer commands);
/* Brings one into the layout that shaders expect, with undefined content. */
void rg_exec_discard_fallback(const struct rg_exec *exec, VkCommandBuffer commands, uint32_t index);

/* record.c */
void rg_exec_record_batch(struct rg_exec *exec, VkCommandBuffer commands, uint32_t first,
                          uint32_t count);
/* Records passes `first` to `first + count - 1`; with the last pass, also the end of the frame. */
VkResult rg_exec_record(struct rg_exec *exec, const struct rg_frame *frame, uint32_t first,
                        uint32_t count);
/* Records what a pass does between its barriers. */
void rg_exec_record_work(struct rg_cmd *cmd, const struct rg_frame *frame);

/* warm_up.c: the triangle of an executor made with `warm_up_only` */
VkResult rg_exec_make_warm_up(struct rg_exec *exec);
void rg_exec_free_warm_up(struct rg_exec *exec);

/* time.c */
VkResult rg_exec_make_time(struct rg_exec *exec);
void rg_exec_free_time(struct rg_exec *exec);
uint64_t rg_time_now(void); /* nanoseconds, CLOCK_MONOTONIC */
void rg_time_begin(struct rg_exec *exec, uint64_t start);
void rg_time_begin_frame(struct rg_exec *exec, VkCommandBuffer commands);
void rg_time_begin_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
void rg_time_end_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
VkResult rg_time_finish(struct rg_exec *exec, uint32_t index, uint64_t wait_start);

#endif
