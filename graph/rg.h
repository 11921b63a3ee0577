/*
 * rg.h: declare images, buffers and passes as constant data, and compile them to a plan.
 *
 * A program writes tables of `const struct rg_image`, `rg_buffer` and `rg_pass`. A resource is
 * known by its address, so that a misspelt name is an error of the C compiler. The same structs may
 * be filled at run time. rg_compile() checks the tables, culls passes that no output needs, and
 * derives every layout, barrier, load and store operation and the memory of every resource. It
 * needs no VkDevice and calls no Vulkan function; rg_exec.h runs a plan on a device.
 *
 * Order:         passes run in the order of the tables.
 * Zero:          is the default of every field; its comment says what zero means.
 * Ownership:     tables belong to the caller and must outlive the plan. A plan belongs to the
 *                caller of rg_compile(), who destroys it.
 * Errors:        faults of tables are data (struct rg_fault), and all of them are found at once,
 *                unless a whole table is missing. Nothing is printed.
 * Thread-safety: rg_compile() may run in several threads. A plan never changes after it and may be
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
#define RG_API __attribute__((visibility("default"))) /* exported; all else stays in the library */
#else
#define RG_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum {
    RG_COLOR_COUNT = 8,       /* colour targets of a pass, at most; every desktop device has them */
    RG_ALL_MIPS = UINT16_MAX, /* value of rg_image.mips: the whole chain, down to 1x1 */
    RG_MAX_PUSH = 128,        /* bytes of push constants, at most; every device has them */
    RG_MAX_ATTRIBUTES = 16,   /* attributes of a vertex, at most; every device has them */
    RG_MAX_STRIDE = 2048,     /* bytes of a vertex, at most; every device has them */
    RG_MAX_VERTEX_BUFFERS = 8, /* vertex buffers of a pass, at most; every device has them */
    RG_MAX_ROWS = 1 << 24,     /* entries of any other table, at most */
};

/* What a pass does to a resource. compile/access.c has a row of Vulkan's words for each. */
enum rg_access {
    RG_ACCESS_NONE,        /* no access; of an import: its content is undefined */
    RG_COLOR,              /* colour target; only derived from rg_pass.color */
    RG_DEPTH,              /* depth-stencil target, written; only derived from rg_pass.depth */
    RG_DEPTH_READ,         /* depth-stencil target, only tested; derived as well */
    RG_RESOLVE,            /* target of a multisample resolve; derived from rg_target.resolve */
    RG_SAMPLED,            /* combined image sampler; of a buffer: uniform texel buffer */
    RG_STORAGE_READ,       /* storage image or buffer, or storage texel buffer; read */
    RG_STORAGE_WRITE,      /* one of these, its whole range written unless `partial` */
    RG_STORAGE_READ_WRITE, /* one of these, earlier content read and changed */
    RG_UNIFORM,            /* uniform buffer */
    RG_TRACE,              /* acceleration structure in a buffer, met by a shader's ray queries */
    RG_VERTEX,             /* vertex buffer */
    RG_INDEX,              /* index buffer */
    RG_INDIRECT,           /* parameters of indirect draws and dispatches */
    RG_COPY_SRC,           /* source of copies, blits and resolves */
    RG_COPY_DST,           /* destination of copies, its whole range written unless `partial` */
    RG_BUILD,              /* acceleration structure that is built */
    RG_BUILD_SOURCE,  /* acceleration structure that a build reads: one in another's instances */
    RG_BUILD_INPUT,   /* vertices, indices or instances that a build reads */
    RG_BUILD_SCRATCH, /* memory for a build; its content does not count */
    RG_HOST_READ,     /* read by the CPU after the frame; only of outputs */
    RG_PRESENT,       /* presented by a swapchain; only of imports and outputs */
    RG_ACCESS_COUNT,
};

/* What a target holds when its pass begins. */
enum rg_load {
    RG_LOAD_KEEP,    /* what earlier passes left */
    RG_LOAD_CLEAR,   /* rg_target.clear */
    RG_LOAD_DISCARD, /* undefined content: the pass overwrites every texel */
};

/* How a colour is combined with what its target holds. */
enum rg_blend {
    RG_BLEND_NONE, /* it replaces it */
    RG_BLEND_OVER, /* source-over with premultiplied alpha */
    RG_BLEND_ADD,  /* the sum of both */
};

/* What a pass records. */
enum rg_kind {
    RG_RASTER,   /* draws into targets */
    RG_COMPUTE,  /* dispatches */
    RG_TRANSFER, /* copies, blits, clears, and builds of acceleration structures */
};

/* Whether one row stands for several passes, which run one after another. */
enum rg_repeat {
    RG_ONCE,      /* it stands for one pass */
    RG_PER_LAYER, /* one pass for each layer of the row's first target, or first image written */
    RG_PER_MIP,   /* one pass for each mip level of that image */
};

/* Which memory a buffer has. */
enum rg_memory {
    RG_MEMORY_DEVICE,   /* device-local; a transient buffer may share it with other buffers */
    RG_MEMORY_UPLOAD,   /* written by the CPU before each frame; one copy per frame in flight */
    RG_MEMORY_READBACK, /* read by the CPU after each frame; one copy per frame in flight */
};

/*
 * An image of two dimensions, or of three. It is transient unless it is imported or persistent:
 * its content lives from the first pass of a frame that accesses it to the last one, and its
 * memory may be shared with other images. A persistent image keeps its content from one frame to
 * the next (history); before the first frame all of it is zero.
 */
struct rg_image {
    const char *name;       /* unique among resources; shown in dumps, captures and messages */
    VkFormat format;        /* one of compile/format.c; required */
    uint32_t width, height; /* texels; 0: the view's, times `scale` */
    float scale;            /* of the view, rounded up to at least one texel; 0 means 1 */
    uint32_t layers;        /* array layers; 0 means 1, or 6 for a cube */
    uint32_t mips;          /* mip levels; 0 means 1, RG_ALL_MIPS all */
    uint32_t samples;       /* per texel: 1 (0 means 1), 2, 4 ... 64. An image of several samples is
                               a target, or read by texelFetch; it has one mip and is no cube */
    uint32_t depth;  /* texels of an image of three dimensions; 0: it has two. It is sampled, stored
                       or copied, but no target; it has one layer, one sample, and is no cube */
    bool cube;       /* sampled as a cube map; the number of layers is a multiple of 6 */
    bool array;      /* an array for shaders even with one layer; with several it always is */
    bool persistent; /* keeps its content between frames, in memory that it does not share;
                               an import keeps what it came with instead */
};

/*
 * A buffer. It is transient, persistent or imported as an image is. One that is RG_TRACE, RG_BUILD
 * or RG_BUILD_SOURCE holds an acceleration structure of its size, and nothing else; `size` is what
 * vkGetAccelerationStructureBuildSizesKHR() says. A persistent one is valid once a row has built
 * it.
 */
struct rg_buffer {
    const char *name;            /* unique among resources */
    VkDeviceSize size;           /* bytes, in addition to: */
    VkDeviceSize size_per_texel; /* bytes for every texel of rg_compile_params.max_region */
    enum rg_memory memory;       /* persistent and imported buffers are RG_MEMORY_DEVICE */
    bool persistent;             /* keeps its content between frames; all zero before the first */
    VkFormat format;             /* of its texels, where it is RG_SAMPLED or rg_use.texels: one of
                        compile/format.c that the device has for such buffers. 0: it has none */
};

/* A part of an image. {0} is all of it. */
struct rg_range {
    VkImageAspectFlags aspect;   /* 0 means all aspects of the format */
    uint32_t mip, mip_count;     /* first mip level, and how many; count 0 means the rest */
    uint32_t layer, layer_count; /* first layer, and how many; count 0 means the rest */
    bool each; /* of a repeated row: only the repetition's layer or mip, counted from the first */
};

/* How a shader samples. {0}: the nearest texel of mip 0, clamped to the edge. */
struct rg_sampler {
    bool linear;      /* linear filter, also between mip levels */
    bool mips;        /* uses the mip chain; else mip 0 alone */
    bool repeat_u;    /* wraps around horizontally */
    bool repeat_v;    /* wraps around vertically */
    bool repeat_w;    /* wraps around in depth */
    float anisotropy; /* at most; 0 means none; limited by rg_exec_params.max_anisotropy */
};

/* The content of the one texel that a use samples where nothing provides its image. */
struct rg_fallback {
    float color[4]; /* linear, as of VkClearColorValue. Depth takes the first; integers truncate.
                       Finite, and in the range of the format's numbers */
};

/* One resource that a pass reads or writes besides its targets. */
struct rg_use {
    const struct rg_image *image;   /* exactly one of this */
    const struct rg_buffer *buffer; /* and this is given */
    enum rg_access access;          /* required; not one that is derived from targets */
    uint16_t binding; /* in descriptor set 0, if the access has a descriptor; unique in the row but
                         for the elements of an array: */
    uint16_t element; /* of an array of descriptors. They follow one another in the row, from 0 on,
                         with the same kind of descriptor and the same stages */
    bool texels;      /* RG_STORAGE_...: a buffer is a storage texel buffer, of rg_buffer.format */
    bool partial;     /* a write that keeps some of the range's earlier content */
    bool same_texel;  /* RG_SAMPLED: fragments read only the texel at their own position, which
                         rg_exec_set_region() makes use of */
    const struct rg_sampler *sampler;   /* RG_SAMPLED; NULL means {0} */
    const struct rg_fallback *fallback; /* RG_SAMPLED, one sample per texel: bound by the executor
                                           if no row of any technique writes the image and no import
                                           provides it. NULL: such a use is a fault */
    VkPipelineStageFlags2 stages; /* shader stages that access it; 0: fragment or compute, and for
                                     RG_UNIFORM the vertex stage too */
    struct rg_range range;        /* of an image; {0} means all of it. Of a buffer {0} */
};

/* An attachment of a raster pass. */
struct rg_target {
    const struct rg_image *image; /* NULL: no target */
    enum rg_load load;            /* content at the start of the pass */
    VkClearValue clear;           /* value for RG_LOAD_CLEAR; a depth is from 0 to 1 */
    uint32_t mip, layer;          /* where to draw; of a repeated row the first one. An image with a
                                      single layer (mip) serves every repetition */
    enum rg_blend blend;          /* of a colour target */
    const VkPipelineColorBlendAttachmentState *blend_state; /* instead of `blend`, which is 0: any
                                       factors, operations and channels, but no second source */
    const struct rg_image
        *resolve; /* of a colour target: gets the mean of the samples of each texel
                                       when the pass ends; same format and size, one sample */
    uint32_t resolve_mip, resolve_layer; /* of `resolve`, counted as `mip` and `layer` are */
};

/* The SPIR-V code of one shader stage; its entry point is "main", its descriptors are in set 0, and
 * in set 1 where the row has a `set`. rg_compile() compares it with the rows that name it. */
struct rg_shader {
    const char *name;      /* for captures and messages */
    const uint32_t *words; /* the module; borrowed */
    size_t word_count;     /* 32-bit words; 0: the code is not known yet, and nothing is compared */
};

/* A descriptor set of the program's own, which is set 1 of the shaders: for resources that the
 * graph need not know, as all textures of a scene (bindless). rg_exec_params.sets has its layout,
 * and the record function binds it. The graph neither synchronises nor checks what is in it. */
struct rg_set {
    const char *name; /* required; for messages and dumps */
};

/* The layout of a vertex buffer: of that at binding 0, or the one after that of which it is `next`.
 */
struct rg_vertex_layout {
    uint32_t stride;          /* bytes from vertex to vertex, at most RG_MAX_STRIDE */
    uint32_t attribute_count; /* elements of: */
    const VkVertexInputAttributeDescription *attributes; /* borrowed; each of another location below
                                                            RG_MAX_ATTRIBUTES, of this binding */
    VkVertexInputRate rate;              /* whether each vertex or each instance has an element */
    const struct rg_vertex_layout *next; /* of the next binding; NULL: this is the last */
};

/* The stencil test of a pass, whose depth target has a stencil. What the test writes is stored with
 * the depth; rg_target.clear has its first value. */
struct rg_stencil {
    VkStencilOpState front, back; /* of front faces; of back faces */
};

/* What is added to the depth of each fragment of a triangle, as of VkPipelineRasterizationState-
 * CreateInfo. `clamp` needs the feature depthBiasClamp; 0 is no limit. */
struct rg_depth_bias {
    float constant, clamp, slope;
};

struct rg_cmd;   /* the pass being recorded; rg_cmd.h has the functions to draw with */
struct rg_frame; /* defined by the program: the data of a frame that its functions read */

/* Records the work of one pass. The row's pipeline, descriptor set 0, viewport, scissor and targets
 * are bound when it is called. Called from rg_exec_submit(), in its thread. */
typedef void rg_record_fn(struct rg_cmd *cmd, const struct rg_frame *frame);

/*
 * Says whether a conditional pass runs in a frame; `repetition` is 0 for a row without repetitions.
 * It is asked once for each recording of each pass, and must answer the same for the same frame and
 * repetition. A pass that does not run leaves all content as it was, clears included; its barriers
 * are recorded with those of the next one that runs. So content that only conditional passes write
 * is available only to passes with the same condition (of several writers: that of the last one),
 * unless it is persistent or imported. Where the answer depends on the repetition, a pass may read
 * of such content only what the same repetition has written.
 */
typedef bool rg_when_fn(const struct rg_frame *frame, uint32_t repetition);

/*
 * Returns the texels of the targets that a raster pass draws in a frame. Draws are cut off at the
 * rectangle's edges, and RG_LOAD_CLEAR fills it alone; what is outside stays if it is kept, and is
 * undefined otherwise. If no texel of the targets is inside, the pass is left out as with
 * rg_when_fn. It is asked once for each recording of each pass; only rg_cmd_pass(),
 * rg_cmd_repetition() and rg_cmd_extent() may be called with `cmd`.
 */
typedef VkRect2D rg_area_fn(const struct rg_cmd *cmd, const struct rg_frame *frame);

/*
 * Returns a further row that a raster pass draws: first the one after its own `row`, then the one
 * after that; NULL: no more. So many passes over parts of the same targets become one, which waits
 * once. A further row comes later in the plan. It has the targets, images, shaders and state of the
 * pass's own, but may have other buffers and loads; those loads do not count, and `area` is that of
 * the pass. Its own pass must be left out in the frame (`when`, `area`). The graph does not check
 * that nothing writes what it reads between the two.
 */
typedef const struct rg_pass *rg_more_fn(const struct rg_pass *row, const struct rg_frame *frame);

/* A row: a pass, or several repetitions of it. */
struct rg_pass {
    const char *name;              /* unique among passes; shown in dumps, captures and messages */
    enum rg_kind kind;             /* what it records */
    enum rg_repeat repeat;         /* whether it stands for several passes */
    const struct rg_target *color; /* colour targets: RG_TARGETS(); NULL means none */
    uint32_t color_count;      /* at most RG_COLOR_COUNT; entries after the last image are zeros */
    VkCompareOp depth_compare; /* of the depth test; 0 means LESS_OR_EQUAL */
    struct rg_target depth;    /* depth-stencil target; without image: none */
    const struct rg_use *uses; /* RG_USES(): ended by a row of zeros; NULL means none */
    const struct rg_shader *vert, *frag; /* of a raster pass; without frag it only writes depth */
    const struct rg_shader *comp;        /* of a compute pass */
    const struct rg_vertex_layout *vertices; /* NULL: the vertex shader needs no vertex buffer */
    VkPrimitiveTopology topology; /* 0 (points) means TRIANGLE_LIST; up to TRIANGLE_FAN */
    VkCullModeFlags cull;         /* faces that are not drawn; 0 means none */
    VkFrontFace front;            /* winding of front faces; 0 means counter-clockwise */
    uint32_t push_size;           /* bytes of push constants, for all stages: a multiple of 4 */
    rg_record_fn *record;         /* required */
    rg_when_fn *when;             /* the condition; NULL: the pass runs in every frame */
    rg_area_fn *area;             /* of a raster pass: what it draws; NULL: all of its targets */
    rg_more_fn *more;             /* of a raster pass: rows that it draws, too; NULL: none */
    bool depth_read_only;         /* the depth target is tested and not written, its stencil too */
    struct rg_depth_bias depth_bias;  /* {0}: none */
    const struct rg_stencil *stencil; /* borrowed; NULL: no stencil test */
    const struct rg_set *set;         /* NULL: its shaders have set 0 alone */
};

/* Passes that belong together, in the order in which they run. */
struct rg_technique {
    const char *name; /* required; shown in faults and dumps */
    const struct rg_pass *passes;
    size_t pass_count;
};

/*
 * A resource that exists outside of the plan. It arrives in the layout of `access`. If that only
 * reads, earlier writes are visible to it (to vertex, fragment and compute shaders, if shaders do
 * it); with RG_ACCESS_NONE its content is undefined. After the frame it is handed back in the same
 * state, unless it is an output. What passes write to it is kept only if it is an output.
 */
struct rg_import {
    const struct rg_image *image;   /* exactly one of this */
    const struct rg_buffer *buffer; /* and this is given */
    enum rg_access access;          /* the state in which it arrives */
    VkExtent2D extent;              /* texels of the image that comes; 0x0: as declared */
    uint32_t layers, mips;          /* of the image that comes; 0: as declared */
    uint32_t depth;                 /* the same, of an image of three dimensions */
    VkDeviceSize size;              /* bytes of the buffer that comes; 0: as declared */
};

/* A resource whose content is needed after the frame; it is left ready for `access`. */
struct rg_output {
    const struct rg_image *image;   /* exactly one of this */
    const struct rg_buffer *buffer; /* and this is given */
    enum rg_access access;          /* required */
};

/* The memory that a resource needs, as of VkMemoryRequirements. */
struct rg_memory_requirements {
    VkDeviceSize size, alignment; /* bytes; the alignment is a power of two, 0 means 1 */
    uint32_t type_bits;           /* bit i: memory type i may be used; not 0 */
};

/*
 * What the compiler may ask of a device. rg_exec_device() makes one of a VkDevice, tests make it by
 * hand. Each function gets `user`; one that is NULL restricts nothing. All are called from within
 * rg_compile() alone.
 */
struct rg_device {
    const void *user; /* borrowed */
    /* Return the memory that an image or a buffer of this description needs. */
    struct rg_memory_requirements (*image_memory)(const void *user, const VkImageCreateInfo *info);
    struct rg_memory_requirements (*buffer_memory)(const void *user,
                                                   const VkBufferCreateInfo *info);
    /* Returns what images of a format can do with VK_IMAGE_TILING_OPTIMAL. */
    VkFormatFeatureFlags (*format_features)(const void *user, VkFormat format);
    /* Returns what texel buffers of a format can do. */
    VkFormatFeatureFlags (*buffer_features)(const void *user, VkFormat format);
    /* Returns which numbers of samples such an image may have. */
    VkSampleCountFlags (*sample_counts)(const void *user, const VkImageCreateInfo *info);
    uint32_t max_image_size, max_layers; /* texels on a side, and layers; 0 means no limit. The
                                            compiler's own are 65536 and 16384 */
    uint32_t max_volume_size;            /* texels on a side of an image of three dimensions; the
                                            compiler's own is 16384 */
};

/*
 * Which transient resources may share memory. When memory changes hands, a barrier must come after
 * the last access of the previous owner, where the frame might need none: so the fewest bytes and
 * the fewest batches of barriers exclude each other.
 */
enum rg_sharing {
    RG_SHARE_FEWEST_BATCHES, /* resources whose sharing costs no batch */
    RG_SHARE_LEAST_MEMORY,   /* all resources that are not alive at the same time */
    RG_SHARE_NOTHING,        /* none */
};

/* What rg_compile() works on. All of it is borrowed, and must outlive the plan, but for `memory`
 * only while rg_compile() runs: techniques (the array), outputs, imports, device. */
/* A size in place of the one that an image's table has; not for images of the view's size. */
struct rg_size {
    const struct rg_image *image;
    VkExtent2D extent; /* texels */
};

struct rg_compile_params {
    const struct rg_technique *const *techniques; /* in the order in which they run */
    size_t technique_count;
    VkExtent2D view;       /* texels; required */
    VkExtent2D max_view;   /* texels: each resource gets the memory that it needs in a view of this
                              size, so that plans of all smaller views have equal memory, which
                              rg_exec_update() keeps; 0x0 means the view */
    VkExtent2D max_region; /* texels: the largest one for rg_exec_set_region(), no larger than the
                              view; 0x0 means the view */
    const struct rg_output *outputs; /* what the frame is for; passes that none needs are culled */
    size_t output_count;             /* 0 is a fault */
    const struct rg_import *imports;
    size_t import_count;
    const struct rg_size *sizes; /* an import's own size takes precedence */
    size_t size_count;
    const struct rg_device *device; /* NULL: tight sizes, alignment 256, no limits of formats */
    enum rg_sharing sharing;        /* fewer batches or less memory */
    bool skip_shaders;              /* rows are not compared with their shaders, which takes some 5
                                       us a shader: for programs that compile known tables often */
    /* What rg_exec_params.constants will be: each must be in a shader of the list. NULL: shaders'
     * constants are not checked. */
    const VkSpecializationInfo *constants;
    /* Memory for the plan and for compiling it, aligned for any type. It outlives the plan, and may
     * be used again after rg_plan_destroy(). What it lacks comes from malloc(); rg_plan.arena_size
     * says how much is enough. NULL: everything comes from malloc(). */
    void *memory;
    size_t memory_size; /* bytes */
};

/* The kinds of faults. rg_fault_text() writes them out. */
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
    RG_ERROR_PERSISTENT,         /* a persistent or imported resource in host memory */
    RG_ERROR_VALUE,  /* a number that a field cannot have, as 9 where an enum ends at 2 */
    RG_ERROR_TABLE,  /* a table that is NULL, or longer than any may be */
    RG_ERROR_DEVICE, /* a device whose answer cannot be true */
    RG_ERROR_SHADER, /* code that is no SPIR-V, or without an entry point `main` of its stage */
    RG_ERROR_SHADER_PUSH,    /* push constants of another size than the shaders' */
    RG_ERROR_SHADER_BINDING, /* a binding that is missing, of another kind, or in no shader */
    RG_ERROR_SHADER_VERTEX,  /* a vertex attribute that is missing or of another type */
    RG_ERROR_SHADER_INPUT,   /* a fragment input that the vertex shader does not write */
    RG_ERROR_SHADER_OUTPUT,  /* a fragment output without a target, or the other way around */
    RG_ERROR_CONSTANT,       /* a specialization constant that no shader has, or of another size */
    RG_ERROR_COUNT,
};

/* One fault, with the names that a message needs; a name that does not apply is NULL. */
struct rg_fault {
    enum rg_error error;
    const char *technique, *pass, *resource;
    uint32_t row;     /* index into the technique's passes; RG_NONE if the fault is in no row */
    const char *hint; /* how to mend it */
};

/*
 * Compiles the techniques of `params`, in their order. Returns a plan, which the caller destroys;
 * check its fault_count first. Returns NULL only when memory is short. Whatever numbers the tables
 * hold, and whichever of their pointers are NULL, there is a plan or a fault. Thread-safe.
 */
RG_API struct rg_plan *rg_compile(const struct rg_compile_params *params);

/* Frees a plan. NULL is allowed. rg_compile_params.memory stays the caller's. */
RG_API void rg_plan_destroy(struct rg_plan *plan);

/* Returns how to create an image of a plan; the compiler asks a device about the same structure. */
RG_API VkImageCreateInfo rg_image_create_info(const struct rg_plan_image *image);

/*
 * Each of these writes a plan, or its faults, to `out`, whose errors the caller checks. The same
 * tables give the same bytes: no addresses are written. docs/render-graph.md describes the forms.
 */
RG_API void rg_dump(const struct rg_plan *plan, FILE *out);      /* text, one line a thing */
RG_API void rg_dump_dot(const struct rg_plan *plan, FILE *out);  /* a Graphviz digraph */
RG_API void rg_dump_json(const struct rg_plan *plan, FILE *out); /* one JSON object */
RG_API void rg_dump_html(const struct rg_plan *plan, FILE *out); /* one page, without network */

/* Writes a fault as one line without newline: technique, row, pass, resource, what is wrong, hint.
 * Writes at most `size` bytes; returns the length of the whole line, as snprintf() does. */
RG_API int rg_fault_text(const struct rg_fault *fault, char *text, size_t size);

/* What an access is in Vulkan's words. */
struct rg_access_info {
    const char *name;             /* as in dumps */
    VkPipelineStageFlags2 stages; /* 0: the shader stages of the use */
    VkAccessFlags2 reads, writes;
    VkImageLayout layout; /* UNDEFINED: only buffers are accessed so */
    VkImageUsageFlags image_usage;
    VkBufferUsageFlags buffer_usage;
    VkFormatFeatureFlags format_features; /* that the image's format must have */
    VkDescriptorType image_descriptor;    /* VK_DESCRIPTOR_TYPE_MAX_ENUM: none */
    VkDescriptorType buffer_descriptor;   /* VK_DESCRIPTOR_TYPE_MAX_ENUM: none */
    bool reads_content; /* needs earlier content; a RG_LOAD_KEEP target does too */
    bool writes_content;
};

/* Returns the words of an access; those of RG_ACCESS_NONE of any other number. Static data. */
RG_API const struct rg_access_info *rg_access_info(enum rg_access access);

/* Returns the descriptor that a use binds; VK_DESCRIPTOR_TYPE_MAX_ENUM: none. */
RG_API VkDescriptorType rg_use_descriptor(const struct rg_use *use);

/* What the graph knows of a format. */
struct rg_format_info {
    VkFormat format;
    const char *name;           /* without VK_FORMAT_ */
    uint32_t size;              /* bytes per texel */
    VkImageAspectFlags aspects; /* colour, or depth and stencil */
    bool is_uint, is_sint;      /* whole numbers, which cannot be filtered, blended or averaged */
};

/* Returns what is known of a format; NULL if it is unknown to the graph. Static data. */
RG_API const struct rg_format_info *rg_format_info(VkFormat format);

#ifdef __cplusplus
}
#endif

#include "graph/rg_table.h"

#endif
