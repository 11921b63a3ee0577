/*
 * rg.h: declare images, buffers and passes as constant data, compile them to a plan.
 *
 * A program writes `const struct rg_image`, `rg_buffer` and `rg_pass` tables; a resource is known
 * by its address, so a misspelt name is a compiler error. The same structs may be filled at run
 * time. rg_compile() checks the tables, drops what no output needs, and works out every layout,
 * barrier, load and store operation and the place of every resource in memory. It needs no
 * VkDevice and calls no Vulkan function; rg_exec.h realises a plan on a device.
 *
 * Order:         passes run in the order of the tables.
 * Zero:          is the default everywhere; every field says what its zero means.
 * Ownership:     the tables belong to the caller and must outlive the plan. A plan lives in memory
 *                that the caller gives (rg_compile_params.memory) or that is freed by
 *                rg_plan_destroy().
 * Errors:        faults in the tables are data (struct rg_fault), all of them at once; nothing is
 *                printed here.
 * Thread-safety: a plan is never changed after rg_compile() and may be read from many threads.
 */
#ifndef RG_H
#define RG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <vulkan/vulkan_core.h>

#ifdef __GNUC__
#define RG_API __attribute__((visibility("default"))) /* all else stays inside the library */
#else
#define RG_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum {
    RG_COLOR_COUNT = 8,       /* colour targets of a pass; what every desktop device has */
    RG_ALL_MIPS = UINT16_MAX, /* rg_image.mips: down to 1x1 */
    RG_MAX_PUSH = 128,        /* bytes of push constants; what every device has */
};

#define RG_NONE UINT32_MAX /* no index */

/* What a pass does to a resource. One row each in compile/access.c. */
enum rg_access {
    RG_ACCESS_NONE,
    RG_COLOR,              /* colour target; not in rg_use */
    RG_DEPTH,              /* depth-stencil target, written; not in rg_use */
    RG_DEPTH_READ,         /* depth-stencil target, only tested; not in rg_use */
    RG_RESOLVE,            /* a target's .resolve; not in rg_use */
    RG_SAMPLED,            /* image and sampler of a descriptor */
    RG_STORAGE_READ,       /* storage image or buffer */
    RG_STORAGE_WRITE,      /* the same; the whole range gets new content unless `partial` */
    RG_STORAGE_READ_WRITE, /* the same; reads what was there */
    RG_UNIFORM,            /* uniform buffer */
    RG_VERTEX,             /* vertex buffer */
    RG_INDEX,              /* index buffer */
    RG_INDIRECT,           /* parameters of indirect draws and dispatches */
    RG_COPY_SRC,           /* copied, blitted or resolved from */
    RG_COPY_DST,           /* copied to; the whole range gets new content unless `partial` */
    RG_HOST_READ,          /* read by the CPU after the frame; only an output's access */
    RG_PRESENT,            /* shown; only an import's or output's access */
    RG_ACCESS_COUNT,
};

enum rg_load {
    RG_LOAD_KEEP,    /* what earlier passes left */
    RG_LOAD_CLEAR,   /* the row's clear value */
    RG_LOAD_DISCARD, /* undefined: the pass overwrites every texel */
};

enum rg_blend {
    RG_BLEND_NONE,
    RG_BLEND_OVER, /* premultiplied alpha */
    RG_BLEND_ADD,
};

enum rg_kind {
    RG_RASTER,
    RG_COMPUTE,
    RG_TRANSFER,
};

/* Whether one row stands for several passes, run one after another. */
enum rg_repeat {
    RG_ONCE,
    RG_PER_LAYER, /* one for each layer of the first target (or first image written) */
    RG_PER_MIP,   /* one for each mip of it */
};

enum rg_memory {
    RG_MEMORY_DEVICE,   /* device-local; transient buffers share memory with images' successors */
    RG_MEMORY_UPLOAD,   /* written by the CPU before each frame; one copy per frame in flight */
    RG_MEMORY_READBACK, /* read by the CPU after each frame; one copy per frame in flight */
};

/*
 * A two-dimensional image. It is transient, its content living from its first pass to its last one
 * in the frame, unless it is imported or persistent: then what one frame leaves is what the next
 * one finds (history). Before the first frame a persistent resource is all zero.
 */
struct rg_image {
    const char *name;       /* unique; shown in dumps, captures and messages */
    VkFormat format;        /* required */
    uint32_t width, height; /* texels; 0 means the view's times `scale` */
    float scale;            /* of the view, rounded up, at least one texel; 0 means 1 */
    uint32_t layers;        /* 0 means 1, or 6 for a cube */
    uint32_t mips;          /* 0 means 1; RG_ALL_MIPS the whole chain */
    uint32_t samples;       /* a texel: 1 (0 means 1), 2, 4 ... 64; with more than 1: a target, or
                               sampled by texelFetch; one mip, no cube */
    bool cube;              /* sampled as a cube map; layers are a multiple of 6 */
    bool array;             /* an array for shaders even with one layer; with more it always is */
    bool persistent;        /* keeps its content from frame to frame; never shares memory. Where it
                               is imported, it is as it comes */
};

struct rg_buffer {
    const char *name;            /* unique among images and buffers */
    VkDeviceSize size;           /* bytes, plus: */
    VkDeviceSize size_per_texel; /* bytes for every texel of the view, or of its part */
    enum rg_memory memory;
    bool persistent; /* as of an image; RG_MEMORY_DEVICE alone */
};

/* Part of an image. {0} is all of it. */
struct rg_range {
    VkImageAspectFlags aspect; /* 0 means all of the format's */
    uint32_t mip, mip_count;   /* count 0 means the rest */
    uint32_t layer, layer_count;
    bool
        each; /* in a repeated row: only this repetition's layer or mip, from `layer` or `mip` on */
};

/* How a shader samples. {0}: nearest, clamped to the edge, mip 0 only. */
struct rg_sampler {
    bool linear;      /* filter, also between mips */
    bool mips;        /* uses the mip chain */
    bool repeat_u;    /* wraps around horizontally */
    bool repeat_v;    /* wraps around vertically */
    float anisotropy; /* at most; 0 means none; ignored where the device has none */
};

/* What a use samples where nothing provides its image: one texel of this content. */
struct rg_fallback {
    float
        color[4]; /* linear, as for VkClearColorValue; of depth the first, of integers truncated */
};

/* One thing a pass reads or writes besides its targets. */
struct rg_use {
    const struct rg_image *image; /* this or: */
    const struct rg_buffer *buffer;
    enum rg_access access;
    uint16_t binding; /* in descriptor set 0, if the access needs a descriptor */
    bool partial;     /* a write that leaves some of the range as it was */
    bool same_texel;  /* RG_SAMPLED: fragments read the texel alone that they draw; what counts is
                         told at rg_exec_set_region() */
    const struct rg_sampler *sampler; /* RG_SAMPLED; NULL means {0} */
    /* RG_SAMPLED of one sample a texel: bound by the executor if no row of any technique writes the
     * image and no import provides it. NULL: then the read is a fault. */
    const struct rg_fallback *fallback;
    VkPipelineStageFlags2 stages; /* of the pass's shaders; 0: fragment or compute, and vertex
                                         too for RG_UNIFORM */
    struct rg_range range;
};

struct rg_target {
    const struct rg_image *image;
    enum rg_load load;
    VkClearValue clear;  /* for RG_LOAD_CLEAR */
    uint32_t mip, layer; /* of a repeated row: the first one; an image with a single layer (mip)
                            serves every repetition */
    enum rg_blend blend; /* colour only */
    /* Colour only: gets the mean of each texel's samples when the pass ends. The same format and
     * size, one sample a texel; `resolve_mip` and `resolve_layer` count as `mip` and `layer` do. */
    const struct rg_image *resolve;
    uint32_t resolve_mip, resolve_layer;
};

/* SPIR-V words of one stage, embedded at build time; its entry point is "main". */
struct rg_shader {
    const char *name;
    const uint32_t *words;
    size_t word_count;
};

/* One vertex buffer, binding 0. */
struct rg_vertex_layout {
    uint32_t stride; /* bytes */
    uint32_t attribute_count;
    const VkVertexInputAttributeDescription *attributes;
};

struct rg_cmd;   /* what record functions draw with; see rg_cmd.h */
struct rg_frame; /* left to the program to define: what its record functions may read */

/* When it runs, everything its row names is bound: pipeline, set 0, viewport, targets. */
typedef void rg_record_fn(struct rg_cmd *cmd, const struct rg_frame *frame);

/*
 * Whether a conditional pass runs in this frame; asked once for each recording of each pass, and
 * to answer the same for the same frame and repetition (0 for a row without). A pass that does not
 * run leaves everything as it was, its clears included; its barriers are recorded all the same. So
 * what only conditional passes write is there only for passes of the same condition (of several,
 * that of the last one that writes it), unless it is persistent or imported. A condition is a
 * function: where its answer depends on the repetition, let a pass read of such content only what
 * was written by the same repetition.
 */
typedef bool rg_when_fn(const struct rg_frame *frame, uint32_t repetition);

struct rg_pass {
    const char *name; /* unique */
    enum rg_kind kind;
    enum rg_repeat repeat;
    const struct rg_target *color;           /* RG_TARGETS(); NULL means none */
    uint32_t color_count;                    /* at most RG_COLOR_COUNT; the last may be zeros */
    VkCompareOp depth_compare;               /* 0 means LESS_OR_EQUAL */
    struct rg_target depth;                  /* no image: none */
    const struct rg_use *uses;               /* ends at a row of zeros; NULL means none */
    const struct rg_shader *vert, *frag;     /* raster; without frag only depth is written */
    const struct rg_shader *comp;            /* compute */
    const struct rg_vertex_layout *vertices; /* NULL means none: the shader makes them up */
    VkPrimitiveTopology topology;            /* 0 (points) means TRIANGLE_LIST */
    VkCullModeFlags cull;                    /* 0 means none */
    VkFrontFace front;                       /* 0 means counter-clockwise */
    uint32_t push_size;                      /* bytes of push constants */
    rg_record_fn *record;                    /* required */
    rg_when_fn *when;                        /* NULL: it runs in every frame */
    bool depth_read_only;                    /* tested, not written */
};

/* Passes that belong together. */
struct rg_technique {
    const char *name;
    const struct rg_pass *passes;
    size_t pass_count;
};

/* Initializer of a technique from an array of passes. */
#define RG_TECHNIQUE(title, table) \
    { \
        .name = (title), .passes = (table), .pass_count = sizeof(table) / sizeof((table)[0]) \
    }

/* The colour targets of a row and their number:
 * .color = RG_TARGETS({ &a, RG_LOAD_CLEAR }, { &b, RG_LOAD_KEEP }). As RG_USES(), a literal of the
 * scope that it is in: for rows made in a loop keep an array of targets. */
#define RG_TARGETS(...) \
    (const struct rg_target[]){ __VA_ARGS__ }, \
        .color_count = \
            sizeof((const struct rg_target[]){ __VA_ARGS__ }) / sizeof(struct rg_target)

/* The uses of a row, ended: .uses = RG_USES({ .image = &a, .access = RG_SAMPLED }, ...) */
#define RG_USES(...) ((const struct rg_use[]){ __VA_ARGS__, { 0 } })

/*
 * A resource that comes from outside. It arrives in the layout of `access`, with every earlier
 * write made visible to that access if it only reads (by shaders: vertex, fragment and compute
 * ones); with RG_ACCESS_NONE its content is undefined. It is handed back in the same state unless
 * it is an output. What passes write to it survives only if it is an output.
 */
struct rg_import {
    const struct rg_image *image; /* this or: */
    const struct rg_buffer *buffer;
    enum rg_access access;
    VkExtent2D extent;     /* of the image that comes; as declared if either is 0 */
    uint32_t layers, mips; /* the same */
    VkDeviceSize size;     /* of the buffer; the same */
};

/* A resource whose content is wanted after the plan; it arrives there ready for `access`. */
struct rg_output {
    const struct rg_image *image; /* this or: */
    const struct rg_buffer *buffer;
    enum rg_access access;
};

/* Memory that a resource needs, as Vulkan says it. */
struct rg_memory_requirements {
    VkDeviceSize size, alignment; /* a power of two; 0 means 1 */
    uint32_t type_bits;
};

/* What the compiler may ask of a device; made by rg_exec_device(), or by hand for tests. */
struct rg_device {
    const void *user;
    struct rg_memory_requirements (*image_memory)(const void *user, const VkImageCreateInfo *info);
    struct rg_memory_requirements (*buffer_memory)(const void *user,
                                                   const VkBufferCreateInfo *info);
    /* VK_IMAGE_TILING_OPTIMAL */
    VkFormatFeatureFlags (*format_features)(const void *user, VkFormat format);
    /* which rg_image.samples such an image may have */
    VkSampleCountFlags (*sample_counts)(const void *user, const VkImageCreateInfo *info);
    uint32_t max_image_size, max_layers; /* texels; 0 means no limit */
};

/*
 * Which transient resources may lie in the same memory. Taking over memory needs a barrier after
 * its former user's last pass, where the frame might need none: fewer bytes or fewer batches.
 */
enum rg_sharing {
    RG_SHARE_FEWEST_BATCHES, /* those that need no batch more than if nothing were shared */
    RG_SHARE_LEAST_MEMORY,   /* all that are not alive together */
    RG_SHARE_NOTHING,        /* none */
};

struct rg_compile_params {
    const struct rg_technique *const *techniques;
    size_t technique_count;
    VkExtent2D view;       /* texels; not 0 */
    VkExtent2D max_region; /* the largest that rg_exec_set_region() is given; 0 means the view */
    const struct rg_output *outputs;
    size_t output_count; /* 0 is a fault: everything would be culled */
    const struct rg_import *imports;
    size_t import_count;
    const struct rg_device *device; /* NULL: tight sizes, alignment 256, every format works */
    enum rg_sharing sharing;
    /* Room for the plan and for compiling it, aligned for any type; it outlives the plan and may
     * serve again after rg_plan_destroy(). What it lacks (plan->arena_size says how much would be
     * enough), or all where it is NULL, comes from malloc. */
    void *memory;
    size_t memory_size; /* bytes */
};

enum rg_error {
    RG_ERROR_NONE,
    RG_ERROR_NO_OUTPUT,          /* no output asked for */
    RG_ERROR_NO_NAME,            /* a resource, pass or technique without a name */
    RG_ERROR_DUPLICATE_NAME,     /* two resources or two passes of one name */
    RG_ERROR_NO_SIZE,            /* a view or buffer of size 0, a scale below 0 */
    RG_ERROR_TOO_LARGE,          /* beyond the device's or Vulkan's limits */
    RG_ERROR_FORMAT,             /* no such format, or one that cannot do what passes want of it */
    RG_ERROR_CUBE,               /* a cube that is not square or has no multiple of 6 layers */
    RG_ERROR_RANGE,              /* mip, layer or aspect that the image does not have */
    RG_ERROR_NOT_ONE_RESOURCE,   /* a row with both an image and a buffer, or an access of none */
    RG_ERROR_ACCESS,             /* an access that does not fit the kind of pass or resource */
    RG_ERROR_DUPLICATE_BINDING,  /* two uses of a row on one binding */
    RG_ERROR_TARGET_SIZE,        /* targets of one pass differ in size */
    RG_ERROR_NO_TARGET,          /* a raster pass without any target, or with a gap */
    RG_ERROR_NO_SHADER,          /* vert, frag for colours, or comp is missing */
    RG_ERROR_NO_RECORD,          /* a pass without record function */
    RG_ERROR_PUSH_SIZE,          /* more than RG_MAX_PUSH, or no multiple of 4 */
    RG_ERROR_CONFLICT,           /* one pass uses the same texels in two ways */
    RG_ERROR_READ_BEFORE_WRITE,  /* a pass reads what no earlier pass and no import provides */
    RG_ERROR_OUTPUT_NOT_WRITTEN, /* an output that no pass writes */
    RG_ERROR_WRITES_NOTHING,     /* a pass that writes no resource */
    RG_ERROR_REPEAT,             /* a repeated row without an image to count */
    RG_ERROR_LISTED_TWICE,       /* an import or output listed twice */
    RG_ERROR_SAMPLES,            /* numbers of samples, or a resolve, that Vulkan does not have */
    RG_ERROR_PERSISTENT,         /* a persistent resource in host memory */
    RG_ERROR_VALUE,              /* a number where an enum has no such constant */
    RG_ERROR_COUNT,
};

/* One fault, with the names a message needs. Any name may be NULL where it does not apply. */
struct rg_fault {
    enum rg_error error;
    const char *technique;
    const char *pass;
    const char *resource;
    uint32_t row;     /* of the technique's table, from 0; RG_NONE if none */
    const char *hint; /* how to mend it */
};

struct rg_plan_image {
    const struct rg_image *image;
    VkExtent2D extent;
    uint32_t layers, mips;
    VkImageAspectFlags aspects;
    VkImageUsageFlags usage;
    VkImageCreateFlags flags;
    uint32_t samples;
    bool imported, persistent;
    uint32_t import;           /* index into the params' imports, or RG_NONE */
    uint32_t first, last;      /* plan passes that touch it; an output's last is pass_count */
    uint32_t block;            /* index into blocks; RG_NONE unless transient */
    VkDeviceSize offset, size; /* in the block */
};

struct rg_plan_buffer {
    const struct rg_buffer *buffer;
    VkDeviceSize size; /* bytes, as declared */
    VkBufferUsageFlags usage;
    bool imported, persistent;
    uint32_t import;
    uint32_t first, last;
    uint32_t block; /* RG_NONE unless transient and RG_MEMORY_DEVICE */
    VkDeviceSize offset, memory_size;
};

/* Memory shared by the transient resources of one kind. */
struct rg_block {
    VkDeviceSize size, alignment;
    uint32_t type_bits;
    bool buffers; /* of buffers; else of images */
};

/* One VkImageMemoryBarrier2 or VkBufferMemoryBarrier2. */
struct rg_barrier {
    uint32_t image;  /* index into images, or RG_NONE */
    uint32_t buffer; /* index into buffers, or RG_NONE */
    VkPipelineStageFlags2 src_stages, dst_stages;
    VkAccessFlags2 src_access, dst_access;
    VkImageLayout old_layout, new_layout;
    VkImageSubresourceRange range;
};

struct rg_plan_target {
    uint32_t image; /* index into images */
    uint32_t mip, layer;
    VkAttachmentLoadOp load;
    VkAttachmentStoreOp store;
    VkImageLayout layout;
    uint32_t resolve; /* index into images, or RG_NONE; in the layout of a colour target */
    uint32_t resolve_mip, resolve_layer;
};

/* A descriptor, or an access that needs none, with its range resolved. */
struct rg_plan_use {
    const struct rg_use *use;
    uint32_t image, buffer; /* index, or RG_NONE */
    VkImageSubresourceRange range;
    VkImageLayout layout;
};

/* One pass to record: a row, or one repetition of it. */
struct rg_plan_pass {
    const struct rg_pass *pass;
    const struct rg_technique *technique;
    uint32_t row;                          /* index into the technique's passes */
    uint32_t repetition;                   /* from 0 */
    VkExtent2D extent;                     /* of the targets; the view's without targets */
    uint32_t first_barrier, barrier_count; /* one batch, before the pass */
    uint32_t first_use, use_count;
    uint32_t first_fallback, fallback_count;
    const struct rg_plan_target *color; /* color_count of them, in the plan's colors */
    uint32_t color_count;
    struct rg_plan_target depth; /* image RG_NONE: none */
};

struct rg_culled {
    const struct rg_pass *pass;
    uint32_t repetition;
};

struct rg_plan {
    const struct rg_fault *faults;
    uint32_t fault_count; /* not 0: nothing below is to be used */
    VkExtent2D view, max_region;
    uint32_t pass_count, image_count, buffer_count, barrier_count, use_count, block_count;
    uint32_t culled_count, color_count, fallback_count;
    uint32_t batch_count; /* passes with barriers before them, and the end if it has some */
    const struct rg_plan_pass *passes;  /* in execution order */
    const struct rg_plan_image *images; /* those that living passes use, in order of first use */
    const struct rg_plan_buffer *buffers;
    const struct rg_barrier *barriers; /* of the frame; behind them the initial ones */
    uint32_t first_final_barrier, final_barrier_count; /* after the last pass */
    /* Before the first frame, from TRANSFER_DST_OPTIMAL (persistent resources have just been filled
     * with zeros) to the state that every frame finds and leaves; in no batch. */
    uint32_t first_initial_barrier, initial_barrier_count;
    const struct rg_plan_use *uses;
    const struct rg_use *const *fallbacks; /* uses that are bound to their fallback; no images or
                                              uses of the plan, and in no dump */
    const struct rg_plan_target *colors;   /* colour targets: those of each pass in a row */
    const struct rg_block *blocks;
    const struct rg_culled *culled;
    VkDeviceSize memory_used;             /* bytes of all blocks */
    VkDeviceSize memory_without_aliasing; /* bytes if nothing were shared */
    VkDeviceSize memory_bound;            /* the least possible with these batches: bytes that are
                                             taken at some one time */
    VkDeviceSize memory_least;            /* the same if batches did not count */
    VkDeviceSize memory_persistent;       /* bytes of persistent resources, beside all this */
    size_t arena_size;                    /* bytes that compiling took */
};

/*
 * Compiles techniques, in the order given. Returns a plan, which the caller destroys, with all
 * faults found in it (fault_count 0: a good plan); NULL only when memory is short.
 */
RG_API struct rg_plan *rg_compile(const struct rg_compile_params *params);

/* How to create an image of a plan; the compiler asks for its memory with the same words. */
RG_API VkImageCreateInfo rg_image_create_info(const struct rg_plan_image *image);

RG_API void rg_plan_destroy(struct rg_plan *plan); /* may be NULL */

/* The plan as text, one line a thing; the form golden tests compare. No names of techniques'
 * functions and no addresses: the same tables give the same text. */
RG_API void rg_dump(const struct rg_plan *plan, FILE *out);

/* The plan as a Graphviz digraph: passes, resources and what flows between them. */
RG_API void rg_dump_dot(const struct rg_plan *plan, FILE *out);

/* The plan as a JSON object: everything that rg_dump() says, and offsets. */
RG_API void rg_dump_json(const struct rg_plan *plan, FILE *out);

/* The plan as one HTML page that needs no network: passes as columns, resources as bars over their
 * life in the shared memory, barriers between the passes. */
RG_API void rg_dump_html(const struct rg_plan *plan, FILE *out);

/* One line without newline: technique, row, pass, what is wrong with which resource, hint.
 * Returns the length it would have, as snprintf. */
RG_API int rg_fault_text(const struct rg_fault *fault, char *text, size_t size);

/* The stages, accesses, layout and usage of an access, as Vulkan names them. */
struct rg_access_info {
    const char *name;
    VkPipelineStageFlags2 stages; /* 0: the shader stages of the use */
    VkAccessFlags2 reads, writes; /* access masks */
    VkImageLayout layout;         /* UNDEFINED: buffers only */
    VkImageUsageFlags image_usage;
    VkBufferUsageFlags buffer_usage;
    VkFormatFeatureFlags format_features; /* that the image's format must have */
    VkDescriptorType image_descriptor;    /* VK_DESCRIPTOR_TYPE_MAX_ENUM: none */
    VkDescriptorType buffer_descriptor;   /* the same */
    bool reads_content;                   /* wants what was there (a KEEP target does too) */
    bool writes_content;
};
RG_API const struct rg_access_info *rg_access_info(enum rg_access access);

/* Name, bytes of a texel and aspects of a format; NULL for formats unknown to the graph. */
struct rg_format_info {
    VkFormat format;
    const char *name; /* without VK_FORMAT_ */
    uint32_t size;    /* bytes a texel */
    VkImageAspectFlags aspects;
};
RG_API const struct rg_format_info *rg_format_info(VkFormat format);

#ifdef __cplusplus
}
#endif

#endif
