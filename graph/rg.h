/*
 * rg.h: render graph API: resources and passes as constant tables, compiled to an execution plan.
 *
 * A program writes tables of `const struct rg_image`, `rg_buffer` and `rg_pass`. A resource is
 * identified by its address, so that a misspelt name is a compile error. The same structs may also
 * be filled at run time. rg_compile() validates the tables, culls passes that no output needs, and
 * derives every layout, barrier, load and store operation and the memory of every resource. It
 * needs no VkDevice and calls no Vulkan function; rg_exec.h executes a plan on a device.
 *
 * Order:         passes execute in the order of the tables.
 * Zero:          the default of every field; the field's comment says what zero means.
 * Ownership:     tables belong to the caller and must outlive the plan. A plan belongs to the
 *                caller of rg_compile(), who destroys it.
 * Errors:        errors in tables are data (struct rg_fault), and all of them are reported at once,
 *                unless a whole table is missing. Nothing is printed.
 * Thread-safety: rg_compile() may run in several threads. A plan is immutable and may be
 *                read from many threads.
 */
#ifndef RG_H
#define RG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <vulkan/vulkan_core.h>

#include "graph/rg_plan.h"

#ifdef __GNUC__
#define RG_API __attribute__((visibility("default"))) /* exported; all other symbols are hidden */
#else
#define RG_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum {
    RG_COLOR_COUNT = 8, /* maximum colour attachments of a pass; supported by desktop devices */
    RG_ALL_MIPS = UINT16_MAX,  /* value of rg_image.mips: the full mip chain, down to 1x1 */
    RG_MAX_PUSH = 128,         /* maximum bytes of push constants; supported by every device */
    RG_MAX_ATTRIBUTES = 16,    /* maximum vertex attributes of a pass; supported by every device */
    RG_MAX_STRIDE = 2048,      /* maximum bytes per vertex in a buffer; supported by every device */
    RG_MAX_VERTEX_BUFFERS = 8, /* maximum vertex buffers of a pass; supported by every device */
    RG_MAX_ROWS = 1 << 24,     /* entries of any other table, at most */
};

/* How a pass accesses a resource. compile/access_table.c maps it to Vulkan stages, accesses and
 * usage. */
enum rg_access {
    RG_ACCESS_NONE,        /* no access; for an import: undefined content */
    RG_COLOR,              /* colour attachment; only derived from rg_pass.color */
    RG_DEPTH,              /* depth-stencil attachment, written; only derived from rg_pass.depth */
    RG_DEPTH_READ,         /* read-only depth-stencil attachment; only derived from rg_pass.depth */
    RG_RESOLVE,            /* multisample resolve attachment; only derived from rg_target.resolve */
    RG_SAMPLED,            /* combined image sampler; for a buffer: uniform texel buffer */
    RG_STORAGE_READ,       /* storage image, storage buffer or storage texel buffer, read only */
    RG_STORAGE_WRITE,      /* storage resource whose range is fully overwritten unless `partial` */
    RG_STORAGE_READ_WRITE, /* storage resource whose earlier content is read and modified */
    RG_UNIFORM,            /* uniform buffer */
    RG_TRACE,              /* acceleration structure in a buffer, traversed by ray queries */
    RG_VERTEX,             /* vertex buffer */
    RG_INDEX,              /* index buffer */
    RG_INDIRECT,           /* parameters of indirect draws and dispatches */
    RG_COPY_SRC,           /* source of copies, blits and resolves */
    RG_COPY_DST,      /* destination of copies; the range is fully overwritten unless `partial` */
    RG_BUILD,         /* acceleration structure being built */
    RG_BUILD_SOURCE,  /* acceleration structure read by a build, such as a BLAS by its TLAS */
    RG_BUILD_INPUT,   /* vertices, indices or instances read by an acceleration structure build */
    RG_BUILD_SCRATCH, /* scratch memory of a build; content is not preserved */
    RG_HOST_READ,     /* read by the CPU after the frame; allowed only for outputs */
    RG_PRESENT,       /* presented by a swapchain; allowed only for imports and outputs */
    RG_ACCESS_COUNT,
};

/* Content of an attachment when its pass begins. */
enum rg_load {
    RG_LOAD_KEEP,    /* what earlier passes left */
    RG_LOAD_CLEAR,   /* cleared to rg_target.clear */
    RG_LOAD_DISCARD, /* undefined: the pass overwrites every texel */
};

/* How a fragment's colour is combined with the colour attachment. */
enum rg_blend {
    RG_BLEND_NONE, /* overwrites the old value */
    RG_BLEND_OVER, /* source-over with premultiplied alpha */
    RG_BLEND_ADD,  /* sum of the old and the new value */
};

/* Kind of pass: which commands it records. */
enum rg_kind {
    RG_RASTER,   /* draws into targets */
    RG_COMPUTE,  /* dispatches */
    RG_TRANSFER, /* copies, blits, clears, and builds of acceleration structures */
};

/* Whether a row expands to several passes, which run one after another. */
enum rg_repeat {
    RG_ONCE,      /* a single pass */
    RG_PER_LAYER, /* one pass per layer of the row's first target, or first image written */
    RG_PER_MIP,   /* one pass per mip level of the first target, or first image written */
};

/* Memory type of a buffer. */
enum rg_memory {
    RG_MEMORY_DEVICE,   /* device-local; transient buffers may alias each other */
    RG_MEMORY_UPLOAD,   /* written by the CPU before each frame; one copy per frame in flight */
    RG_MEMORY_READBACK, /* read by the CPU after each frame; one copy per frame in flight */
};

/*
 * A 2D or 3D image. It is transient unless it is imported or persistent: its content lives from the
 * first to the last pass of a frame that accesses it, and its memory may alias other images. A
 * persistent image keeps its content from one frame to the next (history), and is zero-initialised
 * before the first frame.
 */
struct rg_image {
    const char *name;       /* unique among resources; shown in dumps, captures and messages */
    VkFormat format;        /* required; one of those in compile/format_table.c */
    uint32_t width, height; /* texels; 0 means the view's size times `scale` */
    float scale;            /* factor on the view's size, rounded up to a texel; 0 means 1 */
    uint32_t layers;        /* array layers; 0 means 1, or 6 for a cube */
    uint32_t mips;          /* mip levels; 0 means 1, RG_ALL_MIPS the full chain */
    /* samples per texel: 1 (0 means 1), 2, 4 ... 64. A multisampled image is a target, or read by
     * texelFetch; it has one mip level and is no cube */
    uint32_t samples;
    /* texels of a 3D image along z; 0 means 2D. A 3D image is sampled, stored or copied, but is no
     * target; it has one layer, one sample, and is no cube */
    uint32_t depth;
    bool cube;  /* sampled as a cube map; `layers` must be a multiple of 6 */
    bool array; /* array view in shaders even with one layer; several layers always are an array */
    /* keeps its content between frames, in unaliased memory; ignored for imports */
    bool persistent;
};

/*
 * A buffer: transient, persistent or imported, like an image. A buffer that is accessed as
 * RG_TRACE, RG_BUILD or RG_BUILD_SOURCE holds exactly one acceleration structure; `size` is then
 * the accelerationStructureSize from vkGetAccelerationStructureBuildSizesKHR(). A persistent
 * acceleration structure is valid once a row has built it.
 */
struct rg_buffer {
    const char *name;            /* unique among resources */
    VkDeviceSize size;           /* bytes, plus size_per_texel per texel */
    VkDeviceSize size_per_texel; /* additional bytes per texel of rg_compile_params.max_region */
    enum rg_memory memory;       /* persistent and imported buffers must be RG_MEMORY_DEVICE */
    bool persistent;             /* keeps its content between frames; zero-initialised */
    /* texel format for RG_SAMPLED and rg_use.texels, one of compile/format_table.c; 0 means none */
    VkFormat format;
};

/* Subresource range of an image. {0} is the whole image. */
struct rg_range {
    VkImageAspectFlags aspect; /* 0 means all aspects of the format */
    uint32_t mip, mip_count;   /* first mip level, and number of levels; count 0 means all others */
    uint32_t layer, layer_count; /* first layer, and number of layers; count 0 means all others */
    /* in a repeated row: only the repetition's layer or mip level, counted from the first */
    bool each;
};

/* Sampler state. {0}: the nearest texel of mip 0, clamped to the edge. */
struct rg_sampler {
    bool linear;   /* linear filter, also between mip levels */
    bool mips;     /* uses the mip chain; otherwise only mip 0 */
    bool repeat_u; /* wraps around horizontally */
    bool repeat_v; /* wraps around vertically */
    bool repeat_w; /* wraps around in depth */
    /* maximum anisotropy; 0 means none; limited by rg_exec_params.max_anisotropy */
    float anisotropy;
};

/* Colour of the 1x1 placeholder that a use samples if no pass and no import provides its image. */
struct rg_fallback {
    /* linear colour in the format's range; depth uses the first component, integers truncate */
    float color[4];
};

/* One resource that a pass reads or writes besides its targets. */
struct rg_use {
    const struct rg_image *image;   /* set either this or `buffer` */
    const struct rg_buffer *buffer; /* set either this or `image` */
    enum rg_access access;          /* required; none of those derived from targets */
    /* binding in set 0, if the access has a descriptor; unique except in descriptor arrays */
    uint16_t binding;
    /* index in a descriptor array. The elements are consecutive uses of the row, starting at 0,
     * with the same descriptor type and stages */
    uint16_t element;
    bool texels;  /* RG_STORAGE_...: the buffer is a storage texel buffer of rg_buffer.format */
    bool partial; /* a write that preserves some of the range's earlier content */
    /* RG_SAMPLED: reads only the fragment's own texel, so rg_exec_set_region() can draw less */
    bool same_texel;
    const struct rg_sampler *sampler; /* RG_SAMPLED; NULL means {0} */
    /* RG_SAMPLED, one sample per texel: placeholder bound if no row of any technique writes the
     * image and no import provides it. NULL: that case is a fault */
    const struct rg_fallback *fallback;
    /* shader stages that access it; 0 means fragment or compute, for RG_UNIFORM also vertex */
    VkPipelineStageFlags2 stages;
    struct rg_range range; /* subresources of an image; {0} means all. Must be {0} for a buffer */
};

/* An attachment of a raster pass. */
struct rg_target {
    const struct rg_image *image; /* NULL: no attachment */
    enum rg_load load;            /* content at the start of the pass */
    VkClearValue clear;           /* value for RG_LOAD_CLEAR; depth is in 0 to 1 */
    /* mip level and layer to render to, of the first repetition in a repeated row. An image with
     * one layer (mip level) serves every repetition */
    uint32_t mip, layer;
    enum rg_blend blend; /* blend mode of a colour target */
    /* custom blend state of a colour target, replaces `blend` (then 0): any factors, operations and
     * write mask, but no dual-source blending */
    const VkPipelineColorBlendAttachmentState *blend_state;
    /* resolve target of a multisampled colour target: gets the average of each texel's samples
     * when the pass ends; same format and size, one sample */
    const struct rg_image *resolve;
    /* mip level and layer of `resolve`, as for `mip` and `layer` */
    uint32_t resolve_mip, resolve_layer;
};

/* SPIR-V code of one shader stage. The entry point is "main"; descriptors are in set 0, and in set
 * 1 if the row has a `set`. rg_compile() compares the interface with the rows that use it. */
struct rg_shader {
    const char *name;      /* for captures and messages */
    const uint32_t *words; /* the SPIR-V module; borrowed */
    size_t word_count;     /* 32-bit words; 0: the code is not known yet and is not validated */
};

/* A descriptor set that the program owns, bound as set 1: for resources outside the graph, such as
 * all textures of a scene (bindless). rg_exec_params.sets has its layout, and the record function
 * binds it. The graph neither synchronises nor validates its resources. */
struct rg_set {
    const char *name; /* required; for messages and dumps */
};

/* Layout of a vertex buffer, in a linked list: binding 0 first, each `next` is the following. */
struct rg_vertex_layout {
    uint32_t stride;          /* bytes from one element to the next, at most RG_MAX_STRIDE */
    uint32_t attribute_count; /* number of `attributes` */
    /* borrowed; each has its own location below RG_MAX_ATTRIBUTES, and this layout's binding */
    const VkVertexInputAttributeDescription *attributes;
    VkVertexInputRate rate;              /* whether it advances per vertex or per instance */
    const struct rg_vertex_layout *next; /* layout of the next binding; NULL if there is none */
};

/* Stencil test of a pass whose depth target has a stencil aspect. Stencil writes are stored with
 * the depth; rg_target.clear has the initial stencil value. */
struct rg_stencil {
    VkStencilOpState front, back; /* for front faces; for back faces */
};

/* Depth bias of triangles, as in VkPipelineRasterizationStateCreateInfo. `clamp` needs the feature
 * depthBiasClamp; 0 means no limit. */
struct rg_depth_bias {
    float constant, clamp, slope;
};

struct rg_cmd;   /* the pass being recorded; rg_cmd.h declares its functions */
struct rg_frame; /* defined by the program: per-frame data for its callbacks */

/* Records the commands of one pass. The row's pipeline, descriptor set 0, viewport, scissor and
 * targets are already bound. Called by rg_exec_submit(), in the thread that called it. */
typedef void rg_record_fn(struct rg_cmd *cmd, const struct rg_frame *frame);

/*
 * Returns true if a conditional pass runs in a frame; `repetition` is 0 for a row without
 * repetitions. Called once for each recording of each pass, and must return the same value for the
 * same frame and repetition. A pass that does not run changes no content and clears nothing; its
 * barriers are recorded with those of the next pass that runs. Content that only conditional passes
 * write is therefore available only to passes with the same condition (with several writers: that
 * of the last one), unless it is persistent or imported. If the result depends on the repetition, a
 * pass may read such content only where the same repetition has written it.
 */
typedef bool rg_when_fn(const struct rg_frame *frame, uint32_t repetition);

/*
 * Returns the rectangle of the targets, in texels, that a raster pass draws in a frame. Draws are
 * clipped to it, and RG_LOAD_CLEAR clears only its inside; the outside is preserved by RG_LOAD_KEEP
 * and undefined otherwise. If it does not overlap the targets, the pass is skipped as by
 * rg_when_fn. Called once for each recording of each pass; only rg_cmd_pass(), rg_cmd_repetition()
 * and rg_cmd_extent() may be called with `cmd`.
 */
typedef VkRect2D rg_area_fn(const struct rg_cmd *cmd, const struct rg_frame *frame);

/*
 * Returns the next row to merge into a raster pass: called with the pass's own `row`, then with
 * each row returned; NULL ends the list. Merging passes over parts of the same targets into one
 * saves barriers. A merged row comes later in the plan. It has the same targets, images, shaders
 * and state as the pass, but may have other buffers and load operations; its load operations are
 * ignored, and the pass's `area` applies. The merged row's own pass must be skipped in this frame
 * (`when`, `area`). The graph does not check that nothing in between writes what the merged row
 * reads.
 */
typedef const struct rg_pass *rg_more_fn(const struct rg_pass *row, const struct rg_frame *frame);

/* A row of a pass table: one pass, or several repetitions of it. */
struct rg_pass {
    const char *name;      /* unique among passes; shown in dumps, captures and messages */
    enum rg_kind kind;     /* raster, compute or transfer */
    enum rg_repeat repeat; /* whether it expands to several passes */
    /* array of colour targets, made by RG_TARGETS(); NULL means none */
    const struct rg_target *color;
    uint32_t color_count;      /* at most RG_COLOR_COUNT; entries after the last image are zeros */
    VkCompareOp depth_compare; /* depth test; 0 means LESS_OR_EQUAL */
    struct rg_target depth;    /* depth-stencil target; none if its image is NULL */
    /* array made by RG_USES(), ends with a zero entry; NULL means none */
    const struct rg_use *uses;
    const struct rg_shader *vert, *frag; /* of a raster pass; without `frag` it writes only depth */
    const struct rg_shader *comp;        /* of a compute pass */
    const struct rg_vertex_layout *vertices; /* layout of vertex buffers; NULL means none */
    VkPrimitiveTopology topology; /* 0 (POINT_LIST) means TRIANGLE_LIST; up to TRIANGLE_FAN */
    VkCullModeFlags cull;         /* faces to cull; 0 means none */
    VkFrontFace front;            /* winding of front faces; 0 means counter-clockwise */
    uint32_t push_size;           /* bytes of push constants, for all stages; a multiple of 4 */
    rg_record_fn *record;         /* required */
    rg_when_fn *when;             /* condition; NULL: the pass runs in every frame */
    rg_area_fn *area;             /* of a raster pass: rectangle to draw; NULL: the whole targets */
    rg_more_fn *more;             /* of a raster pass: further rows to merge into it; NULL: none */
    bool depth_read_only;         /* the depth-stencil target is tested but not written */
    struct rg_depth_bias depth_bias;  /* {0}: none */
    const struct rg_stencil *stencil; /* borrowed; NULL: no stencil test */
    const struct rg_set *set;         /* the program's own set 1; NULL: shaders use only set 0 */
};

/* Passes that belong together, in execution order. */
struct rg_technique {
    const char *name; /* required; shown in faults and dumps */
    const struct rg_pass *passes;
    size_t pass_count;
};

/*
 * A resource that exists outside the plan. It arrives in the layout of `access`. If `access` only
 * reads, earlier writes are visible to it (for shader reads: in vertex, fragment and compute
 * shaders); with RG_ACCESS_NONE its content is undefined. After the frame it is returned in the
 * same state, unless it is an output. Writes of passes are preserved only if it is an output.
 */
struct rg_import {
    const struct rg_image *image;   /* set either this or `buffer` */
    const struct rg_buffer *buffer; /* set either this or `image` */
    enum rg_access access;          /* state in which it arrives */
    VkExtent2D extent;              /* actual size in texels; 0x0 means as declared */
    uint32_t layers, mips;          /* actual array layers and mip levels; 0 means as declared */
    uint32_t depth;                 /* actual depth of a 3D image in texels; 0 means as declared */
    VkDeviceSize size;              /* actual size of the buffer in bytes; 0 means as declared */
};

/* A resource whose content is needed after the frame; left ready for `access`. */
struct rg_output {
    const struct rg_image *image;   /* set either this or `buffer` */
    const struct rg_buffer *buffer; /* set either this or `image` */
    enum rg_access access;          /* required */
};

/* Memory requirements of a resource, as in VkMemoryRequirements. */
struct rg_memory_requirements {
    VkDeviceSize size, alignment; /* bytes; the alignment is a power of two, 0 means 1 */
    uint32_t type_bits;           /* bit i set: memory type i is allowed; not 0 */
};

/*
 * Device properties that the compiler queries. rg_exec_device() returns those of a VkDevice; tests
 * provide their own. Each function receives `user`; a NULL function imposes no limit. They are only
 * called from within rg_compile().
 */
struct rg_device {
    const void *user; /* borrowed */
    /* Return the memory requirements of an image or buffer with this create info. */
    struct rg_memory_requirements (*image_memory)(const void *user, const VkImageCreateInfo *info);
    struct rg_memory_requirements (*buffer_memory)(const void *user,
                                                   const VkBufferCreateInfo *info);
    /* Returns the features of images of a format with VK_IMAGE_TILING_OPTIMAL. */
    VkFormatFeatureFlags (*format_features)(const void *user, VkFormat format);
    /* Returns the features of texel buffers of a format. */
    VkFormatFeatureFlags (*buffer_features)(const void *user, VkFormat format);
    /* Returns the sample counts supported for an image with this create info. */
    VkSampleCountFlags (*sample_counts)(const void *user, const VkImageCreateInfo *info);
    /* texels per side, and layers; 0 means no limit but the compiler's own, 65536 and 16384 */
    uint32_t max_image_size, max_layers;
    /* texels per side of a 3D image; 0 means no limit but the compiler's own, 16384 */
    uint32_t max_volume_size;
};

/*
 * Which transient resources may alias. Before a resource takes over memory, a barrier must wait for
 * the last access of the previous owner, even where the frame would otherwise need no barrier: so
 * the least memory and the fewest batches of barriers are conflicting goals.
 */
enum rg_sharing {
    RG_SHARE_FEWEST_BATCHES, /* aliases where that costs no additional batch */
    RG_SHARE_LEAST_MEMORY,   /* aliases all resources with disjoint lifetimes */
    RG_SHARE_NOTHING,        /* no aliasing */
};

/* Overrides the size that an image's table declares; not allowed for images of the view's size. */
struct rg_size {
    const struct rg_image *image;
    VkExtent2D extent; /* texels */
};

/* Input of rg_compile(). All of it is borrowed. `memory` and the tables must outlive the plan; the
 * arrays of techniques, outputs, imports and sizes, and the device, are read only by rg_compile().
 */
struct rg_compile_params {
    const struct rg_technique *const *techniques; /* in execution order */
    size_t technique_count;
    VkExtent2D view; /* size of the frame in texels; required */
    /* texels: each resource gets the memory that it needs in a view of this size, so that
     * rg_exec_update() can change to any smaller view without allocating; 0x0 means the view */
    VkExtent2D max_view;
    /* texels: largest region for rg_exec_set_region(), within the view; 0x0 means the view */
    VkExtent2D max_region;
    /* results of the frame; passes that no output needs are culled */
    const struct rg_output *outputs;
    size_t output_count; /* 0 is a fault */
    const struct rg_import *imports;
    size_t import_count;
    const struct rg_size
        *sizes; /* override declared image sizes; an import's own size takes precedence */
    size_t size_count;
    const struct rg_device *device; /* NULL: tight sizes, alignment 256, no format limits */
    enum rg_sharing sharing;        /* whether fewer batches or less memory matters */
    /* no validation against shaders (some 5 us each), for known-good tables */
    bool skip_shaders;
    /* Constants that rg_exec_params.constants will set: each must exist in a shader of the tables.
     * NULL: specialization constants are not checked. */
    const VkSpecializationInfo *constants;
    /* Memory for the plan and for compiling it, aligned for any type. It outlives the plan, and may
     * be reused after rg_plan_destroy(). If it is too small, malloc() provides the rest;
     * rg_plan.arena_size is the sufficient size. NULL: everything comes from malloc(). */
    void *memory;
    size_t memory_size; /* bytes */
};

/* Kinds of faults. rg_fault_text() formats a fault. */
enum rg_error {
    RG_ERROR_NONE,
    RG_ERROR_NO_OUTPUT,        /* no output is requested */
    RG_ERROR_NO_NAME,          /* a resource, pass or technique without a name */
    RG_ERROR_DUPLICATE_NAME,   /* two resources or two passes of one name */
    RG_ERROR_NO_SIZE,          /* a view or buffer of size 0, or a negative scale */
    RG_ERROR_TOO_LARGE,        /* beyond the limits of the device or of Vulkan */
    RG_ERROR_FORMAT,           /* unknown format, or one without a feature that passes need */
    RG_ERROR_CUBE,             /* a cube that is not square, or whose layers are no multiple of 6 */
    RG_ERROR_RANGE,            /* a mip level, layer or aspect that the image does not have */
    RG_ERROR_NOT_ONE_RESOURCE, /* an entry with both an image and a buffer, or with neither */
    RG_ERROR_ACCESS,           /* an access that does not fit the kind of pass or resource */
    RG_ERROR_DUPLICATE_BINDING, /* two uses of a row with the same binding */
    RG_ERROR_TARGET_SIZE,       /* targets of one pass differ in size */
    RG_ERROR_NO_TARGET, /* a raster pass without any target, or with a gap between targets */
    RG_ERROR_NO_SHADER, /* vert, frag for colours, or comp is missing */
    RG_ERROR_NO_RECORD, /* a pass without record function */
    RG_ERROR_PUSH_SIZE, /* more than RG_MAX_PUSH, or no multiple of 4 */
    RG_ERROR_CONFLICT,  /* one pass accesses the same subresource in conflicting ways */
    RG_ERROR_READ_BEFORE_WRITE,  /* a pass reads content that no earlier pass or import provides */
    RG_ERROR_OUTPUT_NOT_WRITTEN, /* an output that no pass writes */
    RG_ERROR_WRITES_NOTHING,     /* a pass that writes no resource */
    RG_ERROR_REPEAT,             /* a repeated row without an image that defines the repetitions */
    RG_ERROR_LISTED_TWICE,       /* an import or output listed twice */
    RG_ERROR_SAMPLES,            /* a sample count or a resolve that Vulkan does not support */
    RG_ERROR_PERSISTENT,         /* a persistent or imported resource in host memory */
    RG_ERROR_VALUE,              /* a field value out of range, such as 9 where an enum ends at 2 */
    RG_ERROR_TABLE,              /* a table that is NULL, or longer than the limit */
    RG_ERROR_DEVICE,             /* a device that reports impossible properties */
    RG_ERROR_SHADER,         /* code that is no SPIR-V, or has no entry point `main` of its stage */
    RG_ERROR_SHADER_PUSH,    /* push constants whose size differs from the shaders' */
    RG_ERROR_SHADER_BINDING, /* a binding that is missing, of another type, or in no shader */
    RG_ERROR_SHADER_VERTEX,  /* a vertex attribute that is missing or of another type */
    RG_ERROR_SHADER_INPUT,   /* a fragment input that the vertex shader does not write */
    RG_ERROR_SHADER_OUTPUT,  /* a fragment output without a target, or a target without output */
    RG_ERROR_CONSTANT,       /* a specialization constant of wrong size, or in no shader */
    RG_ERROR_COUNT,
};

/* One fault, with the names that its message needs; a name that does not apply is NULL. */
struct rg_fault {
    enum rg_error error;
    const char *technique, *pass, *resource;
    uint32_t row;     /* index into the technique's passes; RG_NONE if it concerns no row */
    const char *hint; /* how to fix it */
};

/*
 * Compiles the techniques of `params`, in their order. Returns a plan, which the caller destroys;
 * check its fault_count first. Returns NULL only if out of memory. For any numbers and NULL
 * pointers in the tables, the result is a usable plan or its faults. Thread-safe.
 */
RG_API struct rg_plan *rg_compile(const struct rg_compile_params *params);

/* Frees a plan. NULL is allowed. rg_compile_params.memory stays the caller's. */
RG_API void rg_plan_destroy(struct rg_plan *plan);

/* Returns the create info of a plan's image, with which the compiler also queries the device. */
RG_API VkImageCreateInfo rg_image_create_info(const struct rg_plan_image *image);

/*
 * Each function writes a plan, or its faults, to `out`; the caller checks `out` for I/O errors. The
 * same tables give bit-identical output, since addresses are omitted. docs/render-graph.md
 * describes the formats.
 */
RG_API void rg_dump(const struct rg_plan *plan, FILE *out);      /* text, one item per line */
RG_API void rg_dump_dot(const struct rg_plan *plan, FILE *out);  /* Graphviz digraph */
RG_API void rg_dump_json(const struct rg_plan *plan, FILE *out); /* one JSON object */
RG_API void rg_dump_html(const struct rg_plan *plan, FILE *out); /* one self-contained page */

/* Writes a fault as one line without newline: technique, row, pass, resource, problem, hint. Writes
 * at most `size` bytes; returns the length of the whole line, as snprintf() does. */
RG_API int rg_fault_text(const struct rg_fault *fault, char *text, size_t size);

/* Vulkan stages, accesses, layout and usage of an access. */
struct rg_access_info {
    const char *name;             /* as in dumps */
    VkPipelineStageFlags2 stages; /* pipeline stages; 0 means the shader stages of the use */
    VkAccessFlags2 reads, writes;
    VkImageLayout layout; /* UNDEFINED for accesses of buffers only */
    VkImageUsageFlags image_usage;
    VkBufferUsageFlags buffer_usage;
    VkFormatFeatureFlags format_features; /* required of the image's format */
    VkDescriptorType image_descriptor;    /* VK_DESCRIPTOR_TYPE_MAX_ENUM if there is none */
    VkDescriptorType buffer_descriptor;   /* VK_DESCRIPTOR_TYPE_MAX_ENUM if there is none */
    bool reads_content; /* requires earlier content, as a RG_LOAD_KEEP target does */
    bool writes_content;
};

/* Returns the Vulkan mapping of an access; that of RG_ACCESS_NONE if out of range. Static data. */
RG_API const struct rg_access_info *rg_access_info(enum rg_access access);

/* Returns the descriptor type of a use; VK_DESCRIPTOR_TYPE_MAX_ENUM if it needs none. */
RG_API VkDescriptorType rg_use_descriptor(const struct rg_use *use);

/* Properties of a format. */
struct rg_format_info {
    VkFormat format;
    const char *name;           /* without VK_FORMAT_ */
    uint32_t size;              /* bytes per texel */
    VkImageAspectFlags aspects; /* colour, or depth and stencil */
    bool is_uint, is_sint;      /* integer formats, which cannot be filtered, blended or averaged */
};

/* Returns the properties of a format; NULL if the graph does not support it. Static data. */
RG_API const struct rg_format_info *rg_format_info(VkFormat format);

#ifdef __cplusplus
}
#endif

#include "graph/rg_table.h"

#endif
