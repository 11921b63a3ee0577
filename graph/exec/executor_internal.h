/* executor_internal.h: data and functions shared by the executor's files. Private to graph/exec/.
 */
#ifndef RG_EXEC_EXECUTOR_INTERNAL_H
#define RG_EXEC_EXECUTOR_INTERNAL_H

#include <stdatomic.h>

#include "graph/exec/vulkan_functions.h"
#include "graph/rg_firn.h"
#include "graph/rg_profile.h"

/* Buffer of one frame in flight (slot). In device memory, all slots share one buffer. */
struct exec_buffer {
    VkBuffer buffer;
    VkAccelerationStructureKHR acceleration; /* imported; or VK_NULL_HANDLE */
    VkDeviceMemory host;                     /* null for device memory */
    void *mapped;
    bool coherent; /* host-coherent: needs no flush or invalidate */
};

enum {
    RG_ATTACHMENT_COUNT = 2 * RG_COLOR_COUNT + 1, /* colours, depth, resolves */
    RG_ZONE_COUNT = 64,                           /* of struct exec_pass_cost */
    RG_MERGED_MAX = 256 /* barriers of several passes recorded in one call */
};

struct exec_targets {
    VkImageView views[RG_ATTACHMENT_COUNT]; /* in the order of rg_exec_attachments() */
    VkFramebuffer framebuffer;
};

/* Objects for one image index of multi-image imports, such as swapchains, and, if the plan has
 * images with partners, for even or odd frames. The sets are created in advance, because a frame
 * must not allocate. */
struct exec_image_set {
    VkImage *images;               /* indexed by plan image */
    struct exec_targets *targets;  /* indexed by pass */
    VkDescriptorSet **descriptors; /* indexed by pass, then slot; slots may share a set */
};

struct exec_pass {
    VkDescriptorSetLayout set_layout; /* shared by a row's repetitions */
    VkPipelineLayout layout;          /* shared by equal rows; also `pipeline` */
    VkPipeline pipeline;
    VkRenderPass render_pass;
    uint32_t coverage; /* COVER_... flags (region_of_interest.c) */
};

/* Placeholder image that a use samples if no pass and no import provides its image. */
struct exec_fallback {
    bool first; /* first use of a shared image */
    struct rg_plan_image described;
    VkImage image;
    VkImageView view;
};

/* A descriptor of a pass: the resource use and the Vulkan object bound to it. */
struct exec_descriptor {
    const struct rg_use *use;
    VkDescriptorType type; /* VK_DESCRIPTOR_TYPE_MAX_ENUM: no descriptor */
    uint32_t buffer;       /* index into plan buffers, or RG_NONE */
    VkDescriptorImageInfo image;
};

struct exec_slot {
    VkCommandBuffer commands;
    VkFence fence;
    bool submitted;               /* and not known to have finished */
    bool recorded;                /* by rg_exec_record(), not known to have finished; no fence */
    uint64_t frame;               /* number of its last frame */
    struct rg_times times;        /* of the current frame, perhaps incomplete */
    struct rg_pass_time *passes;  /* per pass; NULL if not measured */
    uint32_t stamp_count;         /* timestamps written in its current frame */
    VkCommandBuffer *submissions; /* of the plan's submissions, if these are several */
};

/* List of objects that are freed together; with a hash table of their keys if they have keys. */
struct exec_objects {
    struct exec_object *entries;
    uint32_t *chains;     /* hash table: index of a chain's first object plus 1; 0 if it is empty */
    uint32_t count, room; /* `room` is a power of two, or 0 */
    unsigned char *keys;  /* concatenated keys of all objects */
    size_t key_bytes, key_room;
};

/* Layout in which the previous plan left a persistent image that the new plan keeps. */
struct exec_transition {
    uint32_t image; /* index into the plan's images */
    VkImageSubresourceRange range;
    VkImageLayout from;
};

/* Part of a frame: whole passes, or a rectangle of one pass. */
struct exec_part {
    uint32_t first, count;   /* passes */
    uint32_t row, row_end;   /* rows, if `count` is 1; row_end 0: all */
    uint32_t left, left_end; /* columns, if row_end */
    double spent;            /* seconds of the columns of these rows that were drawn before */
    bool ends_rows;          /* contains the last column */
    bool begins, ends;       /* contains the first, the last pixel of its passes */
    bool is_empty;           /* records barriers only */
};

/* Time that a pass took on the device (partial_submission.c). 0 means unknown. */
struct exec_pass_cost {
    float pass;                /* seconds; of passes that are not divided */
    float fixed;               /* seconds of a rectangle of a few pixels */
    float highest;             /* seconds of a row, at most */
    float rows[RG_ZONE_COUNT]; /* seconds per row in equal parts of the target's height */
    uint32_t trials;           /* rectangles of a few pixels that were drawn */
};

/* Barriers recorded in one call: those of a pass that runs and of the skipped passes before it. */
struct exec_batch {
    VkImageMemoryBarrier2 *images; /* `room` of each */
    VkBufferMemoryBarrier2 *buffers;
    uint32_t image_count, buffer_count, room;
    VkMemoryBarrier2 all; /* union of all stages and accesses */
    bool is_merged;       /* contains barriers of several passes */
};

struct rg_exec {
    struct rg_exec_params params;
    struct rg_exec_extensions extensions;
    struct rg_functions vk;
    const struct rg_plan *plan;
    VkDevice device;
    struct exec_objects objects;  /* those with keys (object_cache.c) */
    struct exec_objects unshared; /* objects of the plan that have no key */
    struct exec_objects former;   /* unshared objects of the previous plan, during updates */
    uint32_t next_object;         /* index in `objects` at which a search starts */
    uint32_t next_view;           /* the same for shared views */
    uint32_t plan_number;         /* number of the plan, incremented by updates */
    struct exec_retired *retired; /* objects of previous plans that frames may still use */
    uint64_t frame;               /* number of frames submitted or recorded */
    bool is_update;               /* frames of a previous plan may be in flight */

    size_t key_size;  /* bytes of the key of the object created next, which follow objects.keys */
    bool is_key_lost; /* out of memory */

    enum {
        RG_NOT_FOUND,
        RG_FOUND_HERE,   /* also used by the current plan */
        RG_FOUND_FORMER, /* left by the previous plan */
    } found;             /* result of the last lookup */

    uint32_t slot_count, slot;                     /* `slot` is the one begun last */
    uint32_t parities;                             /* 2 if images have partners, otherwise 1 */
    uint32_t parity;                               /* of the next frame; 0 or 1 */
    uint32_t image_set_count;                      /* image indices times `parities` */
    struct exec_image_set *image_sets, *image_set; /* all sets, and the current one */
    VkPhysicalDeviceMemoryProperties memory_properties;
    VkDeviceMemory *blocks;
    struct exec_buffer *buffers;     /* indexed by slot, then plan buffer */
    struct exec_fallback *fallbacks; /* indexed by the plan's fallbacks */
    struct exec_pass *passes;
    struct exec_descriptor *descriptors; /* scratch: of the pass being created */
    VkDescriptorSetLayoutBinding *bindings;
    VkDescriptorPool pool; /* of the pass being created, and of all before `pool_end` */
    uint64_t pool_number;  /* number of pools created */
    uint32_t pool_end;
    VkCommandPool command_pool;
    VkSemaphore timelines[RG_QUEUE_COUNT]; /* by queue, if the plan uses several */
    uint64_t timeline; /* value before the next frame; a submission signals this + index + 1 */
    struct exec_slot *slots;
    struct rg_exec_region region;               /* {0}: the whole view */
    struct rg_exec_external_sync external_sync; /* of the frame submitted last */
    struct exec_time *time;                     /* NULL if created without `measured` */
    bool initialized; /* persistent resources, placeholders are initialised */
    /* of images and then of buffers: 1 plus the index in the previous plan of the persistent
     * resource whose content is kept; 0 if there is none */
    uint32_t *origins;
    struct exec_transition *transitions;
    uint32_t transition_count;
    atomic_int record_result; /* VkResult: first error of the frame's record functions */
    bool begun;               /* rg_exec_begin() was called, and the frame is not submitted */
    bool has_indirect_count;  /* the device has drawIndirectCount */
    bool has_structures;      /* plan has acceleration structures */
    struct exec_batch batch;
    struct exec_part next_part;   /* where a frame in parts continues; `count` 0: no such frame */
    struct exec_pass_cost *costs; /* NULL until a frame is submitted in parts */
};

/* The pass being recorded. */
struct rg_cmd {
    struct rg_exec *exec;
    uint32_t index;
    const struct rg_plan_pass *plan_pass;
    const struct exec_pass *pass;
    VkCommandBuffer commands;
    VkRect2D area; /* render area of a raster pass */
    /* what the record function may rely on: bound by the executor or by the function itself */
    bool has_pipeline, has_push, has_set;
    bool is_secondary; /* records a secondary command buffer */
    bool is_direct;    /* the record function has the command buffer and may bind anything */
};

/* ---- object_cache.c: error handling, and creation and caching of Vulkan objects ---- */

/* Logs a failed call on the object `of`, or on the frame if that is NULL. Returns `result`. */
VkResult rg_exec_check(const struct rg_exec *exec, VkResult result, const char *call,
                       const char *of);
/* Logs a call that is not allowed now. Returns VK_ERROR_VALIDATION_FAILED_EXT. */
VkResult rg_exec_refuse(const struct rg_exec *exec, const char *misuse);
/* Logs a frame of a destroyed plan. Returns true if the plan was destroyed. */
bool rg_exec_refuse_plan(const struct rg_exec *exec);

/* Calls a function that logs its own failures. If the call fails, jumps to `fail`. The caller has a
 * variable `result` and a label `fail`. */
#define RG_TRY(call) \
    do { \
        result = (call); \
        if (result != VK_SUCCESS) \
            goto fail; \
    } while (0)

/* Calls a Vulkan function, logs a failure and jumps to `fail`. */
#define RG_CALL(exec, of, function, ...) \
    RG_TRY(rg_exec_check((exec), (exec)->vk.function(__VA_ARGS__), "vk" #function, (of)))

/* Kinds of host arrays that have keys, which begin with the kind. */
enum {
    RG_ARRAY_HOST_BUFFER = 1,
    RG_ARRAY_SETS,
    RG_ARRAY_INDEX,
};

/* Appends data, which must not contain padding, to the key of the object created next. */
void rg_exec_key(struct rg_exec *exec, const void *data, size_t size);

/* Appends a number, enum or handle to the key. */
#define RG_KEY(exec, value) rg_exec_key((exec), &(uint64_t){ (uint64_t)(value) }, sizeof(uint64_t))

/* Sets *handle to the cached object with the current key. If there is none, or the key is empty,
 * creates an object with a Vulkan function and names it. The object is freed with the plan. Resets
 * the key. */
#define RG_MAKE(exec, of, type, function, handle, ...) \
    do { \
        RG_TRY(rg_exec_reserve_object(exec)); \
        if (rg_exec_find((exec), VK_OBJECT_TYPE_##type, (handle), sizeof(*(handle)))) \
            break; \
        RG_CALL(exec, of, function, (exec)->device, __VA_ARGS__, NULL, handle); \
        rg_exec_add_object((exec), VK_OBJECT_TYPE_##type, (uint64_t) * (handle), (of)); \
    } while (0)

/* Creates a zeroed array that is freed with the plan; false if out of memory. If the previous plan
 * has an array with the current key, takes over that array with its content. Resets the key. */
#define RG_MAKE_ARRAY(exec, array, count) \
    ((array) = rg_exec_make_array((exec), (count), sizeof(*(array))), (array) != NULL)

void *rg_exec_make_array(struct rg_exec *exec, size_t count, size_t size);
VkResult rg_exec_reserve_object(struct rg_exec *exec); /* reserves an entry in the list */
bool rg_exec_find(struct rg_exec *exec, VkObjectType type, void *handle, size_t size);
void rg_exec_add_object(struct rg_exec *exec, VkObjectType type, uint64_t handle, const char *name);
/* Frees objects that this plan does not use, once the frames submitted until now have finished.
 * Pipelines are kept for one more plan, because programs often switch between two plans. */
VkResult rg_exec_retire_former(struct rg_exec *exec);
void rg_exec_free_retired(struct rg_exec *exec); /* those that no frame uses */
/* Moves the pipelines in rg_exec_params.pipelines to the executor, for reuse. */
void rg_exec_adopt_pipelines(struct rg_exec *exec);
/* Frees all objects, but moves pipelines to rg_exec_params.pipelines unless that is NULL. */
void rg_exec_free_objects(struct rg_exec *exec);

/* ---- other files ---- */

/* Returns a queue of the parameters; {0} if they have none. */
static inline struct rg_exec_queue rg_exec_queue_of(const struct rg_exec *exec, uint32_t queue)
{
    const struct rg_exec_params *p = &exec->params;
    return queue == RG_QUEUE_COMPUTE    ? p->compute
           : queue == RG_QUEUE_TRANSFER ? p->transfer
                                        : (struct rg_exec_queue){ p->queue, p->queue_family };
}

/* device_memory.c */
VkResult rg_exec_make_memory(struct rg_exec *exec);
/* Fills the distinct families of a mask of queues. Returns their number. */
uint32_t rg_exec_families(const struct rg_exec *exec, uint32_t queues,
                          uint32_t families[RG_QUEUE_COUNT]);
/* Creates an image and binds its memory. `placeholder` is the use that a placeholder is for, or
 * NULL. Sets exec->found to RG_FOUND_HERE if the placeholder is shared with another use. */
VkResult rg_exec_make_image(struct rg_exec *exec, const struct rg_plan_image *plan,
                            const struct rg_use *placeholder, VkImage *image);

/* Part of the key of an image view, without padding. */
struct exec_view {
    VkImageViewType type;
    VkImageUsageFlags usage; /* usage of the view, if its image has views of several formats */
    VkFormat format;         /* 0 means that of the image */
    VkImageSubresourceRange range;
};

VkResult rg_exec_make_view(struct rg_exec *exec, const struct rg_plan_image *plan, VkImage image,
                           const struct exec_view *info, VkImageView *view);
/* Creates a frame slot's buffer in host memory, with `preferred` memory properties if possible. */
VkResult rg_exec_make_host_buffer(struct rg_exec *exec, const VkBufferCreateInfo *info,
                                  VkMemoryPropertyFlags preferred, const char *name, uint32_t slot,
                                  struct exec_buffer *buffer);
VkImageSubresourceRange rg_exec_full_range(const struct rg_plan_image *image);
struct exec_buffer *rg_exec_buffer(const struct rg_exec *exec, uint32_t buffer, uint32_t slot);
VkResult rg_exec_sync_host(struct rg_exec *exec, uint32_t slot, enum rg_memory memory);

/* placeholder_images.c */
VkResult rg_exec_make_fallbacks(struct rg_exec *exec);
void rg_exec_record_fallbacks(struct rg_exec *exec, VkCommandBuffer commands);

/* attachments.c: creates attachment views, and VkRenderPass objects if requested */
VkResult rg_exec_make_targets(struct rg_exec *exec);
/* Lists the attachments of a pass: colours, depth, then resolve targets. Returns their number. */
uint32_t rg_exec_attachments(const struct rg_plan_pass *pass,
                             struct rg_plan_target attachments[RG_ATTACHMENT_COUNT]);

/* Returns the number of layers that a row draws at a time. */
static inline uint32_t rg_exec_layers(const struct rg_pass *row)
{
    return row->layers ? row->layers : 1;
}

/* Returns the view mask of a row; 0 without multiview. */
static inline uint32_t rg_exec_view_mask(const struct rg_pass *row)
{
    return row->multiview ? (1u << rg_exec_layers(row)) - 1 : 0;
}

VkSampleCountFlagBits rg_exec_samples(const struct rg_exec *exec, const struct rg_plan_pass *pass);

/* descriptors.c */
VkResult rg_exec_make_descriptors(struct rg_exec *exec);

/* queues.c: frames that are submitted to several queues */
VkResult rg_exec_make_queues(struct rg_exec *exec);
/* Waits until the queues with timeline semaphores are idle. Fences alone do not suffice for
 * lavapipe: it locks the semaphores of a submission once more after it has signalled the fence. */
void rg_exec_wait_for_queues(const struct rg_exec *exec);
VkResult rg_exec_submit_queues(struct rg_exec *exec, const struct rg_frame *frame);

/* pipelines.c */
VkResult rg_exec_make_pipelines(struct rg_exec *exec);
VkShaderStageFlags rg_exec_stages(const struct rg_pass *pass);
/* Returns the formats of a pass's targets, with pointers into `formats`. */
VkPipelineRenderingCreateInfo rg_exec_target_formats(const struct rg_exec *exec,
                                                     const struct rg_plan_pass *plan,
                                                     VkFormat formats[RG_COLOR_COUNT]);

/* Returns true if the executor creates a pipeline for a row. */
static inline bool rg_exec_has_pipeline(const struct rg_pass *row)
{
    return row->kind == RG_COMPUTE ? row->comp != NULL : row->vert != NULL;
}

/* Returns a shader, or its replacement (rg_exec_params.replace_shader). */
const struct rg_shader *rg_exec_code(const struct rg_exec *exec, const struct rg_shader *shader);

/* pass_timing.c */
VkResult rg_exec_make_time(struct rg_exec *exec);
void rg_time_keep(struct rg_exec *exec, const struct rg_exec *former); /* keeps rg_measure */
uint64_t rg_time_now(void); /* nanoseconds of the monotonic clock */
void rg_time_begin(struct rg_exec *exec, uint64_t start);
void rg_time_begin_frame(struct rg_exec *exec, VkCommandBuffer commands);
void rg_time_begin_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
void rg_time_end_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass, bool drawn);
VkResult rg_time_finish(struct rg_exec *exec, uint32_t index, uint64_t wait_start);

/* region_of_interest.c */
VkResult rg_exec_make_coverage(struct rg_exec *exec);
/* Returns true if the current region restricts what a pass draws or copies. */
bool rg_exec_is_limited(const struct rg_cmd *cmd);
VkRect2D rg_exec_area(const struct rg_cmd *cmd);            /* render area within the region */
VkRect2D rg_exec_intersect(VkRect2D inner, VkRect2D outer); /* intersection */

/* check_features.c: checks that the device has the features that the plan needs */
VkResult rg_exec_check_features(struct rg_exec *exec);

/* check_imports.c: checks imported objects against their declarations, as far as they are known */
VkResult rg_exec_check_imports(struct rg_exec *exec);

/* zero_fill_resources.c: finds the persistent resources that keep the content of the previous plan
 */
VkResult rg_exec_keep_content(struct rg_exec *exec, const struct rg_exec *former);
void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands);
/* Records a barrier by which all later commands wait for all earlier ones. */
void rg_exec_record_wait(const struct rg_exec *exec, VkCommandBuffer commands);
/* Records a layout transition that synchronises with all commands before and after. */
void rg_exec_record_transition(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                               const VkImageSubresourceRange *range, VkImageLayout from,
                               VkImageLayout to);
/* Clears a new image and leaves it in TRANSFER_DST_OPTIMAL. Depth is set to color->float32[0]. */
void rg_exec_record_clear_image(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                                const VkImageSubresourceRange *range,
                                const VkClearColorValue *color);

/* barrier_batch.c: adds barriers of the plan to those that are recorded together later */
void rg_exec_add_batch(struct rg_exec *exec, VkCommandBuffer commands, uint32_t first,
                       uint32_t count);
/* Records the pending barriers. */
void rg_exec_record_batch(struct rg_exec *exec, VkCommandBuffer commands);

/* commands.c */
/* Logs a misuse by a record function, for which the frame is refused. Only the first of a frame. */
__attribute__((cold, format(printf, 3, 4))) void
rg_exec_misuse(const struct rg_cmd *cmd, const char *resource, const char *format, ...);

/* record_commands.c */
/* Records a part of a frame, with the final barriers if it contains the last pass. */
VkResult rg_exec_record_part(struct rg_exec *exec, VkCommandBuffer commands,
                             const struct rg_frame *frame, const struct exec_part *part);
/* Records a part of a frame into a command buffer that the executor owns. */
VkResult rg_exec_record_own(struct rg_exec *exec, VkCommandBuffer commands,
                            const struct rg_frame *frame, const struct exec_part *part);
/* Binds the pass's pipeline and descriptor set 0, and sets viewport and scissor. */
void rg_exec_bind(const struct rg_cmd *cmd);
/* Returns the render area of a pass in a frame; empty if the pass does not run. */
VkRect2D rg_exec_pass_area(struct rg_exec *exec, uint32_t index, const struct rg_frame *frame);

/* executor.c */
/* Selects the image set of the next frame. Returns false if the image index is out of range. */
bool rg_exec_select_images(struct rg_exec *exec, uint32_t image_index);
/* Marks a frame as completely recorded. */
void rg_exec_end_frame(struct rg_exec *exec);
/* Records a part of the frame begun last, and submits it. */
VkResult rg_exec_submit_recorded(struct rg_exec *exec, const struct rg_frame *frame,
                                 const struct exec_part *part);
VkResult rg_exec_wait_fence(const struct rg_exec *exec);

#endif
