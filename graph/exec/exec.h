/* exec.h: data and functions that the files of the executor share. Private to graph/exec/. */
#ifndef RG_EXEC_EXEC_H
#define RG_EXEC_EXEC_H

#include "graph/exec/functions.h"
#include "graph/rg_exec.h"
#include "graph/rg_time.h"

/* A buffer in one slot. Only one in host memory has another object for each slot. */
struct exec_buffer {
    VkBuffer buffer;
    VkDeviceMemory host; /* null unless in host memory, as are the next two */
    void *mapped;
    bool coherent; /* the host memory needs no flush and no invalidation */
};

enum {
    RG_ATTACHMENT_COUNT = 2 * RG_COLOR_COUNT + 1 /* of a pass: colours, depth, resolves */
};

struct exec_targets {
    VkImageView views[RG_ATTACHMENT_COUNT]; /* as of rg_exec_attachments() */
    VkFramebuffer framebuffer;
};

/* What depends on which of the images of imports that have several a frame uses. One of each is
 * made for every image index beforehand, so that a frame allocates nothing. */
struct exec_image_set {
    VkImage *images;              /* per plan image */
    struct exec_targets *targets; /* per pass */
    VkDescriptorSet *descriptors; /* per pass and slot */
};

struct exec_pass {
    VkDescriptorSetLayout set_layout; /* shared by the repetitions of a row */
    VkPipelineLayout layout;          /* this and the next also by rows that draw alike */
    VkPipeline pipeline;
    bool first; /* of those that share a pipeline */
    VkRenderPass render_pass;
    uint32_t coverage; /* how much of a region it draws (region.c) */
};

/* The image of a use that is bound to its fallback. */
struct exec_fallback {
    bool first; /* of those that share an image */
    struct rg_plan_image described;
    VkImage image;
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

struct rg_exec {
    struct rg_exec_params params;
    struct rg_functions vk;
    const struct rg_plan *plan;
    VkDevice device;
    struct exec_object *objects; /* what is freed with the executor (objects.c) */
    uint32_t object_count, object_room;
    uint32_t slot_count, slot;                     /* `slot`: begun last */
    uint32_t image_set_count;                      /* 1 unless imports have several images */
    struct exec_image_set *image_sets, *image_set; /* all of them, and that in use */
    VkPhysicalDeviceMemoryProperties memory_properties;
    VkDeviceMemory *blocks;
    struct exec_buffer *buffers;     /* per slot and plan buffer */
    struct exec_fallback *fallbacks; /* per fallback of the plan */
    struct exec_sampler *samplers;
    uint32_t sampler_count;
    struct exec_pass *passes;
    VkDescriptorPool descriptor_pool;
    VkCommandPool command_pool;
    struct exec_slot *slots;
    struct rg_exec_region region;               /* {0}: the whole view */
    struct rg_exec_external_sync external_sync; /* of the frame submitted last */
    struct exec_time *time;                     /* NULL: made without `measured` */
    bool filled;       /* a frame has given persistent resources and fallbacks their content */
    VkBuffer triangle; /* made with `warm_up_only`: vertices and indices, all zero */
    VkImageMemoryBarrier2 *image_batch; /* room for all barriers of the plan */
    VkBufferMemoryBarrier2 *buffer_batch;
};

/* The pass being recorded. */
struct rg_cmd {
    struct rg_exec *exec;
    uint32_t index;
    const struct rg_plan_pass *plan_pass;
    const struct exec_pass *pass;
    VkCommandBuffer commands;
    bool warm_up; /* each draw becomes one triangle, outside of the targets */
};

/* ---- objects.c: calls that may fail, and what they make ---- */

/* Logs a failed call and the name of what it was for (NULL: the frame). Returns `result`. */
VkResult rg_exec_check(const struct rg_exec *exec, VkResult result, const char *call,
                       const char *of);

/* Calls a function that has logged its failure, and leaves if it fails: as those below, it needs
 * `result` and a label `fail`. */
#define RG_PASS(call) \
    do { \
        result = (call); \
        if (result != VK_SUCCESS) \
            goto fail; \
    } while (0)

/* Calls a function of Vulkan. */
#define RG_CALL(exec, of, function, ...) \
    RG_PASS(rg_exec_check((exec), (exec)->vk.function(__VA_ARGS__), "vk" #function, (of)))

/* Calls one that makes *handle, an object that has its name and is freed with the executor. */
#define RG_MAKE(exec, of, type, function, handle, ...) \
    do { \
        RG_PASS(rg_exec_make_room(exec)); \
        RG_CALL(exec, of, function, (exec)->device, __VA_ARGS__, NULL, handle); \
        rg_exec_keep((exec), VK_OBJECT_TYPE_##type, (uint64_t) * (handle), (of)); \
    } while (0)

/* Makes an array of zeros that is freed with the executor; false if memory is short. */
#define RG_MAKE_ARRAY(exec, array, count) \
    ((array) = rg_exec_make_array((exec), (count), sizeof(*(array))), (array) != NULL)

void *rg_exec_make_array(struct rg_exec *exec, size_t count, size_t size);
VkResult rg_exec_make_room(struct rg_exec *exec); /* in the list of what is freed, for one more */
void rg_exec_keep(struct rg_exec *exec, VkObjectType type, uint64_t handle, const char *name);
void rg_exec_free_objects(struct rg_exec *exec);

/* ---- the other files, in the order in which an executor is made ---- */

/* memory.c */
VkResult rg_exec_make_memory(struct rg_exec *exec);
/* Makes an image and its memory, in a block or its own. */
VkResult rg_exec_make_image(struct rg_exec *exec, const struct rg_plan_image *plan, VkImage *image);
VkResult rg_exec_make_view(struct rg_exec *exec, const struct rg_plan_image *plan, VkImage image,
                           VkImageViewType type, const VkImageSubresourceRange *range,
                           VkImageView *view);
/* Makes a buffer in host memory. `wanted`: properties of its memory that it may lack. */
VkResult rg_exec_make_host_buffer(struct rg_exec *exec, const VkBufferCreateInfo *info,
                                  VkMemoryPropertyFlags wanted, const char *name,
                                  struct exec_buffer *buffer);
VkImageSubresourceRange rg_exec_whole(const struct rg_plan_image *image);
struct exec_buffer *rg_exec_buffer(const struct rg_exec *exec, uint32_t buffer, uint32_t slot);
VkResult rg_exec_sync_host(struct rg_exec *exec, uint32_t slot, enum rg_memory memory);

/* fallback.c */
VkResult rg_exec_make_fallbacks(struct rg_exec *exec);
void rg_exec_record_fallbacks(struct rg_exec *exec, VkCommandBuffer commands);

/* targets.c: views of targets, and VkRenderPass objects where asked for */
VkResult rg_exec_make_targets(struct rg_exec *exec);
/* Lists what a pass draws into: colours, depth, then images resolved to. Returns their number. */
uint32_t rg_exec_attachments(const struct rg_plan_pass *pass,
                             struct rg_plan_target attachments[RG_ATTACHMENT_COUNT]);
VkSampleCountFlagBits rg_exec_samples(const struct rg_exec *exec, const struct rg_plan_pass *pass);

/* descriptors.c */
VkResult rg_exec_make_descriptors(struct rg_exec *exec);

/* pipelines.c */
VkResult rg_exec_make_pipelines(struct rg_exec *exec);
VkShaderStageFlags rg_exec_stages(const struct rg_pass *pass);

/* time.c */
VkResult rg_exec_make_time(struct rg_exec *exec);
uint64_t rg_time_now(void); /* nanoseconds, CLOCK_MONOTONIC */
void rg_time_begin(struct rg_exec *exec, uint64_t start);
void rg_time_begin_frame(struct rg_exec *exec, VkCommandBuffer commands);
void rg_time_begin_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
void rg_time_end_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
VkResult rg_time_finish(struct rg_exec *exec, uint32_t index, uint64_t wait_start);

/* region.c */
VkResult rg_exec_make_coverage(struct rg_exec *exec);
/* Whether a pass draws or copies only a part of its targets now. */
bool rg_exec_is_limited(const struct rg_cmd *cmd);
VkRect2D rg_exec_area(const struct rg_cmd *cmd);         /* what the pass draws */
VkRect2D rg_exec_within(VkRect2D inner, VkRect2D outer); /* the common part */

/* warm_up.c: the triangle of an executor made with `warm_up_only` */
VkResult rg_exec_make_warm_up(struct rg_exec *exec);

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

/* record.c */
extern const VkCommandBufferBeginInfo rg_exec_commands_once; /* they are submitted once */
void rg_exec_record_batch(struct rg_exec *exec, VkCommandBuffer commands, uint32_t first,
                          uint32_t count);
/* Records passes `first` to `first + count - 1`; with the last pass, also the end of the frame. */
VkResult rg_exec_record(struct rg_exec *exec, const struct rg_frame *frame, uint32_t first,
                        uint32_t count);
/* Records what a pass does between its barriers. */
void rg_exec_record_work(struct rg_cmd *cmd, const struct rg_frame *frame);

#endif
