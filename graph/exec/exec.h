/* exec.h: data and functions that the files of the executor share. Private to graph/exec/. */
#ifndef RG_EXEC_EXEC_H
#define RG_EXEC_EXEC_H

#include "graph/exec/functions.h"
#include "graph/rg_exec.h"
#include "graph/rg_time.h"

/* A buffer in one slot. Only one in host memory has another object for each slot. */
struct exec_buffer {
    VkBuffer buffer;
    VkAccelerationStructureKHR acceleration; /* in the buffer; null: it holds something else */
    VkDeviceMemory host;                     /* null unless in host memory, as are the next two */
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
    VkImage *images;               /* per plan image */
    struct exec_targets *targets;  /* per pass */
    VkDescriptorSet **descriptors; /* per pass, of each slot */
};

struct exec_pass {
    VkDescriptorSetLayout set_layout; /* shared by the repetitions of a row */
    VkPipelineLayout layout;          /* this and the next also by rows that draw alike */
    VkPipeline pipeline;
    bool first; /* its pipeline has been made for it: no other pass, nor a former plan, had it */
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

/* What a use of a pass binds, and where. */
struct exec_descriptor {
    const struct rg_use *use;
    VkDescriptorType type; /* VK_DESCRIPTOR_TYPE_MAX_ENUM: nothing */
    uint32_t buffer;       /* index into the plan's, or RG_NONE */
    VkDescriptorImageInfo image;
};

/* Whether a buffer of a plan holds an acceleration structure. */
static inline bool rg_exec_is_structure(const struct rg_plan_buffer *buffer)
{
    return buffer->usage & VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR;
}

struct exec_slot {
    VkCommandBuffer commands;
    VkFence fence;
    bool submitted;
    struct rg_times times;       /* of its frame, so far */
    struct rg_pass_time *passes; /* of its frame; NULL: not measured */
    uint32_t stamp_count;        /* timestamps of its frame */
};

/* The list of what is freed with an executor. */
struct exec_objects {
    struct exec_object *entries;
    uint32_t count, room;
    uint32_t next; /* where the search for the next object begins */
};

/* A layout that a persistent image has kept from the former plan. */
struct exec_move {
    VkImage image;
    VkImageSubresourceRange range;
    VkImageLayout from;
};

/* Barriers that are recorded in one call: those of a pass that runs, and of passes before it that
 * do not. */
struct exec_batch {
    VkImageMemoryBarrier2 *images; /* room for all barriers of the plan */
    VkBufferMemoryBarrier2 *buffers;
    uint32_t image_count, buffer_count;
    VkMemoryBarrier2 all; /* their stages and accesses together */
    bool is_merged;       /* they are of several passes */
};

struct rg_exec {
    struct rg_exec_params params;
    struct rg_functions vk;
    const struct rg_plan *plan;
    VkDevice device;
    struct exec_objects objects; /* of the plan (objects.c) */
    struct exec_objects former;  /* while a plan is made: what those before it leave */

    enum {
        RG_NOT_FOUND,
        RG_FOUND_HERE,   /* another part of the plan has it */
        RG_FOUND_FORMER, /* the former plan had it */
    } found;             /* whether the latest object with a key was there already */

    uint32_t slot_count, slot;                     /* `slot`: begun last */
    uint32_t image_set_count;                      /* 1 unless imports have several images */
    struct exec_image_set *image_sets, *image_set; /* all of them, and that in use */
    VkPhysicalDeviceMemoryProperties memory_properties;
    VkDeviceMemory *blocks;
    struct exec_buffer *buffers;     /* per slot and plan buffer */
    struct exec_fallback *fallbacks; /* per fallback of the plan */
    struct exec_pass *passes;
    struct exec_descriptor *descriptors; /* room for those of any pass, while they are made */
    VkDescriptorSetLayoutBinding *bindings;
    VkCommandPool command_pool;
    struct exec_slot *slots;
    struct rg_exec_region region;               /* {0}: the whole view */
    struct rg_exec_external_sync external_sync; /* of the frame submitted last */
    struct exec_time *time;                     /* NULL: made without `measured` */
    bool filled;       /* a frame has given persistent resources and fallbacks their content */
    bool *has_content; /* persistent images, then buffers, whose content is the former plan's */
    struct exec_move *moves;
    uint32_t move_count;
    VkResult refused;   /* a record function did what cannot be done */
    bool can_count;     /* the device has drawIndirectCount */
    bool has_addresses; /* the plan has buffers with device addresses */
    VkBuffer triangle;  /* made with `warm_up_only`: vertices and indices, all zero */
    struct exec_batch batch;
};

/* The pass being recorded. */
struct rg_cmd {
    struct rg_exec *exec;
    uint32_t index;
    const struct rg_plan_pass *plan_pass;
    const struct exec_pass *pass;
    VkCommandBuffer commands;
    VkRect2D area; /* what a raster pass draws */
    bool warm_up;  /* each draw becomes one triangle, outside of the targets */
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

#define RG_NO_KEY 0

/* Adds data to a key, which begins as RG_NO_KEY; no padding may be among it. */
uint64_t rg_exec_key(uint64_t key, const void *data, size_t size);

/* Adds a number, an enum or a handle. */
#define RG_KEY(key, value) \
    ((key) = rg_exec_key((key), &(uint64_t){ (uint64_t)(value) }, sizeof(uint64_t)))

/* Finds an object with a key, or makes *handle by a function; it has its name, and is freed with
 * the plan. */
#define RG_MAKE_KEYED(exec, of, key, type, function, handle, ...) \
    do { \
        RG_PASS(rg_exec_make_room(exec)); \
        if (rg_exec_find((exec), VK_OBJECT_TYPE_##type, (key), (handle), sizeof(*(handle)))) \
            break; \
        RG_CALL(exec, of, function, (exec)->device, __VA_ARGS__, NULL, handle); \
        rg_exec_keep((exec), VK_OBJECT_TYPE_##type, (key), (uint64_t) * (handle), (of)); \
    } while (0)

#define RG_MAKE(exec, of, type, function, handle, ...) \
    RG_MAKE_KEYED(exec, of, RG_NO_KEY, type, function, handle, __VA_ARGS__)

/* Makes an array of zeros that is freed with the plan; false if memory is short. With a key it may
 * be that of the former plan, as it was left. */
#define RG_MAKE_KEYED_ARRAY(exec, key, array, count) \
    ((array) = rg_exec_make_array((exec), (key), (count), sizeof(*(array))), (array) != NULL)
#define RG_MAKE_ARRAY(exec, array, count) RG_MAKE_KEYED_ARRAY(exec, RG_NO_KEY, array, count)

void *rg_exec_make_array(struct rg_exec *exec, uint64_t key, size_t count, size_t size);
VkResult rg_exec_make_room(struct rg_exec *exec); /* in the list of what is freed, for one more */
bool rg_exec_find(struct rg_exec *exec, VkObjectType type, uint64_t key, void *handle, size_t size);
void rg_exec_keep(struct rg_exec *exec, VkObjectType type, uint64_t key, uint64_t handle,
                  const char *name);
/* Frees what the plan has not found, but keeps pipelines for one more plan, which may be the one
 * before: programs switch to and fro. */
void rg_exec_end_former(struct rg_exec *exec);
/* As if those of rg_exec_params.pipelines were of a former plan. */
void rg_exec_take_pipelines(struct rg_exec *exec);
/* All of them, but for pipelines that others can take. */
void rg_exec_free_objects(struct rg_exec *exec);

/* ---- the other files, in the order in which an executor is made ---- */

/* memory.c */
VkResult rg_exec_make_memory(struct rg_exec *exec);
/* Makes an image and its memory, in a block or its own. `salt` tells it from others of the name. */
VkResult rg_exec_make_image(struct rg_exec *exec, const struct rg_plan_image *plan, uint64_t salt,
                            VkImage *image);
VkResult rg_exec_make_view(struct rg_exec *exec, const struct rg_plan_image *plan, VkImage image,
                           VkImageViewType type, const VkImageSubresourceRange *range,
                           VkImageView *view);
/* Makes a buffer of a slot in host memory. `wanted`: properties of its memory that it may lack. */
VkResult rg_exec_make_host_buffer(struct rg_exec *exec, const VkBufferCreateInfo *info,
                                  VkMemoryPropertyFlags wanted, const char *name, uint32_t slot,
                                  struct exec_buffer *buffer);
/* Whether a resource is a program's own object, which may end and come again under its handle. */
bool rg_exec_is_foreign(const struct rg_exec *exec, bool imported);
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
/* The code of a shader, or of the one that replaces it. */
const struct rg_shader *rg_exec_code(const struct rg_exec *exec, const struct rg_shader *shader);

/* time.c */
VkResult rg_exec_make_time(struct rg_exec *exec);
void rg_time_keep(struct rg_exec *exec, const struct rg_exec *former); /* what is measured */
uint64_t rg_time_now(void); /* nanoseconds, CLOCK_MONOTONIC */
void rg_time_begin(struct rg_exec *exec, uint64_t start);
void rg_time_begin_frame(struct rg_exec *exec, VkCommandBuffer commands);
void rg_time_begin_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass);
void rg_time_end_pass(struct rg_exec *exec, VkCommandBuffer commands, uint32_t pass, bool drawn);
VkResult rg_time_finish(struct rg_exec *exec, uint32_t index, uint64_t wait_start);

/* region.c */
VkResult rg_exec_make_coverage(struct rg_exec *exec);
/* Whether a pass draws or copies only a part of its targets now. */
bool rg_exec_is_limited(const struct rg_cmd *cmd);
VkRect2D rg_exec_area(const struct rg_cmd *cmd);         /* what the region leaves of the pass */
VkRect2D rg_exec_within(VkRect2D inner, VkRect2D outer); /* the common part */

/* warm_up.c: the triangle of an executor made with `warm_up_only` */
VkResult rg_exec_make_warm_up(struct rg_exec *exec);

/* features.c: what the device must have for the plan */
VkResult rg_exec_check_features(struct rg_exec *exec);

/* clear.c: what is done before the first frame of a plan */
/* Finds which of the persistent resources that the former plan had too have content. */
VkResult rg_exec_keep_content(struct rg_exec *exec, const struct rg_exec *former);
void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands);
/* Waits for all work, and changes the layout of an image for all that follows. */
void rg_exec_record_move(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                         const VkImageSubresourceRange *range, VkImageLayout from,
                         VkImageLayout to);
/* Clears a new image and leaves it in TRANSFER_DST_OPTIMAL; depth takes the first float. */
void rg_exec_record_clear_image(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                                const VkImageSubresourceRange *range,
                                const VkClearColorValue *color);

/* batch.c */
/* Adds barriers of the plan to those that wait. */
void rg_exec_add_batch(struct rg_exec *exec, VkCommandBuffer commands, uint32_t first,
                       uint32_t count);
/* Records the barriers that wait. */
void rg_exec_record_batch(struct rg_exec *exec, VkCommandBuffer commands);

/* record.c */
extern const VkCommandBufferBeginInfo rg_exec_commands_once; /* they are submitted once */
/* Records passes `first` to `first + count - 1`; with the last pass, also the end of the frame. */
VkResult rg_exec_record(struct rg_exec *exec, const struct rg_frame *frame, uint32_t first,
                        uint32_t count);
/* Records what a pass does between its barriers. */
void rg_exec_record_work(struct rg_cmd *cmd, const struct rg_frame *frame);

#endif
