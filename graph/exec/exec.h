/* exec.h: what the executor's files share. Private to graph/. */
#ifndef RG_EXEC_EXEC_H
#define RG_EXEC_EXEC_H

#include "graph/exec/functions.h"
#include "graph/rg_exec.h"
#include "graph/rg_time.h"

/* Buffers of host memory have one object a slot, others one in all. */
struct exec_buffer {
    VkBuffer *buffers;      /* one a slot */
    VkDeviceMemory *memory; /* one a slot; only of host memory */
    void **mapped;          /* one a slot; only of host memory */
    VkDeviceMemory own;     /* of a persistent buffer */
    bool coherent;
};

enum {
    RG_VIEW_COUNT = 2 * RG_COLOR_COUNT + 1 /* of a pass: colours, depth, what they resolve to */
};

struct exec_targets {
    VkImageView views[RG_VIEW_COUNT]; /* colours, depth, resolves; without gaps */
    VkFramebuffer framebuffer;
};

struct exec_pass {
    VkPipelineLayout layout; /* shared by the repetitions of a row, as are: */
    VkDescriptorSetLayout set_layout;
    VkPipeline pipeline;
    bool owner;  /* of the three above */
    bool shares; /* but the pipeline is that of a row before, which draws alike */
    VkRenderPass render_pass;
    VkDescriptorSet *sets; /* of each set, one a slot */
    uint32_t coverage;     /* how much of a region it draws: region.c */
};

struct exec_fallback {
    bool owner; /* else all is borrowed from an earlier one that is alike */
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
};

struct exec_slot {
    VkCommandBuffer commands;
    VkFence fence;
    bool submitted;
    struct rg_times times;       /* of its frame, so far */
    struct rg_pass_time *passes; /* the same; NULL: not measured */
};

struct exec_sampler {
    struct rg_sampler key;
    VkSampler sampler;
};

struct rg_exec {
    struct rg_exec_params params;
    struct rg_functions vk;
    const struct rg_plan *plan;
    VkDevice device;
    uint32_t slot_count, slot; /* the slot taken last */
    uint32_t image_set_count,
        image_set; /* of imports' images; 1 and 0 unless one comes as several */
    VkPhysicalDeviceMemoryProperties memory_properties;
    VkDeviceMemory *blocks;
    VkImage *images;        /* of an import that comes as several: that of the set */
    VkImage *import_images; /* for each set, one a plan image: null unless it comes as several */
    VkDeviceMemory *image_memory; /* of persistent images */
    struct exec_buffer *buffers;
    VkImageView *use_views;          /* of each set, one a plan use; null for buffers */
    struct exec_fallback *fallbacks; /* one a fallback of the plan */
    struct exec_sampler *samplers;
    uint32_t sampler_count;
    struct exec_pass *passes;
    struct exec_targets *targets; /* of each set, one a pass */
    VkDescriptorPool descriptor_pool;
    VkCommandPool command_pool;
    struct exec_slot *slots;
    struct rg_exec_region region;               /* {0}: the whole view */
    struct rg_exec_external_sync external_sync; /* of the frame submitted last */
    struct exec_time *time;                     /* NULL: not made to measure */
    bool filled;                                /* the persistent resources are */
    VkBuffer triangle;                          /* a hollow executor's triangle: zeros */
    VkDeviceMemory triangle_memory;
    VkImageMemoryBarrier2 *image_batch; /* room to record any batch from */
    VkBufferMemoryBarrier2 *buffer_batch;
};

/* What a record function holds. */
struct rg_cmd {
    struct rg_exec *exec;
    const struct rg_plan_pass *plan_pass;
    const struct exec_pass *pass;
    VkCommandBuffer commands;
    bool warm_up; /* draw one triangle outside of the targets for each draw */
};

/* Logs the call and the name of what it was for (NULL: the whole frame) if it failed, and returns
 * its result. */
VkResult rg_exec_check(const struct rg_exec *exec, VkResult result, const char *call,
                       const char *of);

/* The way out of a failed call of Vulkan: needs `result` and a label `fail`. */
#define RG_CALL(exec, of, function, ...) \
    do { \
        result = rg_exec_check((exec), (exec)->vk.function(__VA_ARGS__), "vk" #function, (of)); \
        if (result != VK_SUCCESS) \
            goto fail; \
    } while (0)

/* The same for one that makes *handle, of which Vulkan says nothing after a failure. */
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

/* The same for functions that have logged their failure. */
#define RG_PASS(call) \
    do { \
        result = (call); \
        if (result != VK_SUCCESS) \
            goto fail; \
    } while (0)

/* Names an object for captures and messages, where the instance has debug utils. */
void rg_exec_name(const struct rg_exec *exec, VkObjectType type, uint64_t handle, const char *name);

/* import_images.c: imports that come as several images, of which each frame uses one */
VkResult rg_exec_count_image_sets(struct rg_exec *exec);
void rg_exec_keep_import_images(struct rg_exec *exec, uint32_t image,
                                const struct rg_exec_import *import);
void rg_exec_select_image_set(struct rg_exec *exec, uint32_t set);
struct exec_targets *rg_exec_targets(const struct rg_exec *exec, const struct exec_pass *pass);
VkDescriptorSet *rg_exec_set(const struct rg_exec *exec, const struct exec_pass *pass,
                             uint32_t slot);
VkImageView *rg_exec_use_view(const struct rg_exec *exec, uint32_t use);

/* region.c */
VkResult rg_exec_make_coverage(struct rg_exec *exec);
/* Whether a pass of the plan draws or copies less than all now. */
bool rg_exec_is_limited(const struct rg_exec *exec, const struct rg_plan_pass *pass);
/* What it draws. */
VkRect2D rg_exec_area(const struct rg_exec *exec, const struct rg_plan_pass *pass);
VkRect2D rg_exec_within(VkRect2D inner, VkRect2D outer); /* what both have */

/* functions.c: fills exec->vk */
VkResult rg_exec_find_functions(struct rg_exec *exec);

/* memory.c */
VkResult rg_exec_make_memory(struct rg_exec *exec);
/* Of the first type that has all of `wanted`, else of `needed`. */
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

/* targets.c: target views always, VkRenderPass objects where asked for */
VkSampleCountFlagBits rg_exec_samples(const struct rg_exec *exec, const struct rg_plan_pass *pass);
VkResult rg_exec_make_targets(struct rg_exec *exec);
void rg_exec_free_targets(struct rg_exec *exec);

/* clear.c: before the first frame */
void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands);
/* Waits for all work, and changes the layout of an image for all that follows. */
void rg_exec_record_move(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                         const VkImageSubresourceRange *range, VkImageLayout from,
                         VkImageLayout to);
/* Clears a new image, which is left in TRANSFER_DST_OPTIMAL; of depth the first float counts. */
void rg_exec_record_clear_image(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                                const VkImageSubresourceRange *range,
                                const VkClearColorValue *color);

/* fallback.c */
VkResult rg_exec_make_fallbacks(struct rg_exec *exec);
void rg_exec_free_fallbacks(struct rg_exec *exec);
void rg_exec_record_fallbacks(struct rg_exec *exec, VkCommandBuffer commands);
/* Brings one into the layout that shaders expect, with any content. */
void rg_exec_discard_fallback(const struct rg_exec *exec, VkCommandBuffer commands, uint32_t index);

/* record.c */
void rg_exec_record_batch(struct rg_exec *exec, VkCommandBuffer commands, uint32_t first,
                          uint32_t count);
/* Passes `first` to `first + count - 1`; with the last one what ends the frame. */
VkResult rg_exec_record(struct rg_exec *exec, const struct rg_frame *frame, uint32_t first,
                        uint32_t count);
/* What a pass does between its barriers. */
void rg_exec_record_work(struct rg_cmd *cmd, const struct rg_frame *frame);

/* warm_up.c */
VkResult rg_exec_make_warm_up(struct rg_exec *exec); /* if it is hollow */
void rg_exec_free_warm_up(struct rg_exec *exec);

/* time.c: */
VkResult rg_exec_make_time(struct rg_exec *exec);
void rg_exec_free_time(struct rg_exec *exec);
uint64_t rg_time_now(void); /* nanoseconds, CLOCK_MONOTONIC */
void rg_time_begin(struct rg_exec *exec, uint64_t start);
void rg_time_begin_frame(struct rg_exec *exec, VkCommandBuffer commands);
void rg_time_begin_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
void rg_time_end_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
VkResult rg_time_finish(struct rg_exec *exec, uint32_t index, uint64_t wait_start);

#endif
