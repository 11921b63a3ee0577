/*
 * rg.h: render graph API: resources and passes as constant tables, compiled to an execution plan.
 *
 * A program writes tables of `const struct rg_image`, `rg_buffer` and `rg_pass`, or fills them at
 * run time. A resource is identified by its address, so that a misspelt name is a compile error.
 * rg_compile() validates the tables, culls passes that no output needs, and derives all layouts,
 * barriers, load and store operations and memory, without a VkDevice or Vulkan calls. rg_exec.h
 * executes a plan on a device.
 *
 *     static const struct rg_image scene = {
 *         .name = "scene",
 *         .format = VK_FORMAT_R16G16B16A16_SFLOAT, // of the view's size
 *     };
 *     static const struct rg_image shown = {
 *         .name = "shown",
 *         .format = VK_FORMAT_R8G8B8A8_UNORM,
 *     };
 *     static const struct rg_pass passes[] = {
 *         { .name = "draw", .vert = &draw_vert, .frag = &draw_frag, .record = record_draw,
 *           .color = RG_TARGETS({ &scene, RG_LOAD_CLEAR }) },
 *         { .name = "show", .vert = &full_vert, .frag = &tone_frag, .record = record_show,
 *           .color = RG_TARGETS({ &shown, RG_LOAD_DISCARD }),
 *           .uses = RG_USES({ .image = &scene, .access = RG_SAMPLED, .binding = 0 }) },
 *     };
 *     static const struct rg_technique technique = RG_TECHNIQUE("example", passes);
 *
 *     const struct rg_technique *techniques[] = { &technique };
 *     const struct rg_output output = { .image = &shown, .access = RG_COPY_SRC };
 *     struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
 *         .techniques = techniques,
 *         .technique_count = 1,
 *         .view = { 640, 480 },
 *         .outputs = &output,
 *         .output_count = 1,
 *     });
 *     rg_dump(plan, stdout); // the plan, or all faults
 *
 * A shader is a struct rg_shader, and a record function calls rg_cmd.h. Begin with struct rg_pass,
 * whose first fields are those that most passes need, then rg_target and rg_use, rg_image and
 * rg_buffer, rg_compile_params. The others are for single features.
 *
 * Order:         passes execute in the order of the tables.
 * Zero:          the default of every field; the field's comment says what zero means.
 * Ownership:     tables outlive the plan. The caller of rg_compile() destroys the plan.
 * Errors:        errors in tables are data (struct rg_fault), all reported at once, unless a table
 *                is missing. Nothing is printed.
 * Thread-safety: rg_compile() may run in several threads, and many threads may read a plan.
 */
#ifndef RG_H
#define RG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <vulkan/vulkan_core.h>

#include "graph/rg_plan.h"

/* Marks exported functions. Only building the libraries defines RG_BUILD. */
#if defined(_WIN32) && defined(RG_BUILD)
#define RG_API __declspec(dllexport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define RG_API __attribute__((visibility("default")))
#else
#define RG_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Version of the libraries: x.y.z; a change of x or y changes the ABI. */
#define RG_VERSION "0.3.0"

/* Limits of pass tables. Only RG_COLOR_COUNT exceeds what some mobile devices support. */
enum {
    RG_COLOR_COUNT = 8,        /* maximum colour attachments per pass */
    RG_ALL_MIPS = UINT16_MAX,  /* full mip chain, for rg_image.mips */
    RG_MAX_PUSH = 128,         /* maximum bytes of push constants */
    RG_MAX_ATTRIBUTES = 16,    /* maximum vertex attributes per pass */
    RG_MAX_STRIDE = 2048,      /* maximum vertex stride in bytes */
    RG_MAX_VERTEX_BUFFERS = 8, /* maximum vertex buffers per pass */
    RG_MAX_LAYERS = 2048,      /* maximum layerCount of layered rendering */
    RG_MAX_VIEWS = 6,          /* maximum views of multiview rendering */
    RG_MAX_ROWS = 1 << 24,     /* maximum entries of other tables */
};

/* Accesses of a pass to a resource; compile/access_table.c has their stages and access flags. */
enum rg_access {
    RG_ACCESS_NONE,        /* no access; import: undefined content */
    RG_COLOR,              /* colour attachment; implied by rg_pass.color */
    RG_DEPTH,              /* written depth-stencil attachment; implied by rg_pass.depth */
    RG_DEPTH_READ,         /* read-only depth-stencil attachment; implied by rg_pass.depth */
    RG_RESOLVE,            /* resolve attachment; implied by rg_target.resolve */
    RG_SAMPLED,            /* combined image sampler; uniform texel buffer */
    RG_STORAGE_READ,       /* read-only storage image or (texel) buffer */
    RG_STORAGE_WRITE,      /* storage write; overwrites range unless `partial` */
    RG_STORAGE_READ_WRITE, /* storage resource, read and modified */
    RG_UNIFORM,            /* uniform buffer */
    RG_TRACE,              /* acceleration structure traversed by ray queries */
    RG_VERTEX,             /* vertex buffer */
    RG_INDEX,              /* index buffer */
    RG_INDIRECT,           /* parameters of indirect draws and dispatches */
    RG_COPY_SRC,           /* source of copies, blits and resolves */
    RG_COPY_DST,           /* copy destination; overwrites range unless `partial` */
    RG_HOST_READ,          /* CPU read after frame; outputs only */
    RG_PRESENT,            /* presentation; imports and outputs only */
    RG_ACCESS_COUNT,
};

/* Content of an attachment when its pass begins. */
enum rg_load {
    RG_LOAD_KEEP,    /* content left by earlier passes */
    RG_LOAD_CLEAR,   /* cleared to rg_target.clear */
    RG_LOAD_DISCARD, /* undefined; the pass overwrites every texel */
};

/* Blending of a fragment's colour with the colour attachment. */
enum rg_blend {
    RG_BLEND_NONE, /* overwrites the old value */
    RG_BLEND_OVER, /* source-over with premultiplied alpha */
    RG_BLEND_ADD,  /* sum of old and new value */
};

/* Kind of pass: which commands it records. */
enum rg_kind {
    RG_RASTER,   /* draws into targets */
    RG_COMPUTE,  /* dispatches */
    RG_TRANSFER, /* copies, blits, clears */
};

/* Repetition of a pass over the layers or mip levels of the first image that it writes. */
enum rg_repeat {
    RG_ONCE,      /* a single pass */
    RG_PER_LAYER, /* one pass per layer */
    RG_PER_MIP,   /* one pass per mip level, from the largest to the smallest */
    /* one pass per mip level, from the smallest to the largest: the last repetition uses the mip
     * levels in the row, and the first the smallest ones that all targets and uses have */
    RG_PER_MIP_UP,
};

/* Memory type of a buffer. Upload and readback buffers have one copy per frame in flight. */
enum rg_memory {
    RG_MEMORY_DEVICE,   /* device-local; transient buffers may alias */
    RG_MEMORY_UPLOAD,   /* written by the CPU before frames */
    RG_MEMORY_READBACK, /* read by the CPU after frames */
};

/* A 2D or 3D image, transient unless imported or persistent. A transient image has content from the
 * first to the last pass that accesses it in a frame, and may share memory. A persistent image
 * keeps its content between frames (history) and is initially zero. */
struct rg_image {
    const char *name;       /* unique; shown in dumps and captures */
    VkFormat format;        /* required; one of compile/format_table.c */
    uint32_t width, height; /* texels; 0 means view times `scale` */
    float scale;            /* of view, rounded up; default 1 */
    uint32_t layers;        /* array layers; default 1, cube 6 */
    uint32_t mips;          /* mip levels, or RG_ALL_MIPS; default 1 */
    /* samples per texel: a power of two up to 64; 0 means 1. A multisampled image has one mip
     * level, is no cube map, and is read by texelFetch */
    uint32_t samples;
    /* texels along z; 0 means 2D. A 3D image has one layer, one sample, and is no cube or target */
    uint32_t depth;
    bool cube;       /* sampled as cube map; 6n layers */
    bool array;      /* array view even with one layer */
    bool persistent; /* keeps content; ignored for imports */
    /* read-only image with the content that `previous` had at the end of the last frame, and zero
     * in the first: a history image without a copy, because the two are swapped after each frame.
     * `previous` has equal fields, is written completely in each frame, and is not imported. NULL
     * if unused */
    const struct rg_image *previous;
};

/* A buffer, which is transient, persistent or imported, like an image. If passes access it as
 * RG_TRACE, it is imported and holds exactly one acceleration structure. */
struct rg_buffer {
    const char *name;            /* unique among resources */
    VkDeviceSize size;           /* bytes, plus size_per_texel per texel */
    VkDeviceSize size_per_texel; /* additional bytes per texel of the view */
    enum rg_memory memory;       /* RG_MEMORY_DEVICE if persistent or imported */
    bool persistent;             /* keeps content between frames; zero-initialised */
    VkFormat format;             /* texel buffer's format; 0 means none */
};

/* Subresource range of an image. A zeroed struct means the whole image. */
struct rg_range {
    VkImageAspectFlags aspect;   /* 0 means all aspects */
    uint32_t mip, mip_count;     /* mip_count 0 means all remaining levels */
    uint32_t layer, layer_count; /* layer_count 0 means all remaining layers */
    /* restricts a repeated pass to the layer or mip level of the current repetition */
    bool each;
};

/* Sampler state. A zeroed struct samples the nearest texel of mip 0 and clamps to the edge. With
 * rg_exec_params.samplers, a VkSampler of the application takes its place. */
struct rg_sampler {
    bool linear;      /* linear filter, also between mip levels */
    bool mips;        /* mip chain; otherwise only mip 0 */
    bool repeat_u;    /* wraps around horizontally */
    bool repeat_v;    /* wraps around vertically */
    bool repeat_w;    /* wraps around in depth */
    float anisotropy; /* maximum; limited by rg_exec_params.max_anisotropy */
    bool mirror;      /* repeats mirrored (MIRRORED_REPEAT) */
    bool border;      /* clamps to `border_color`, not to the edge, where it does not repeat */
    VkBorderColor border_color; /* an INT constant for integer formats, else a FLOAT constant */
    /* depth comparison, which shadow samplers of GLSL require; 0 means none */
    VkCompareOp compare;
    /* MIN or MAX of the texels that a linear filter averages; needs samplerFilterMinmax */
    VkSamplerReductionMode reduction;
    /* added to the mip level, and its limits; max_lod 0 means no limit. Used only with `mips` */
    float lod_bias, min_lod, max_lod;
};

/* Colour of the 1x1 placeholder that a use samples if no pass and no import provides its image. */
struct rg_fallback {
    /* linear colour in the format's range; integer formats truncate, depth formats use color[0] */
    float color[4];
};

/* One resource that a pass reads or writes besides its targets. */
struct rg_use {
    const struct rg_image *image;   /* set either this or `buffer` */
    const struct rg_buffer *buffer; /* set either this or `image` */
    enum rg_access access;          /* required; no attachment access */
    /* binding in descriptor set 0, unique except in descriptor arrays. Consecutive uses with equal
     * binding, descriptor type and stages form an array, in which `element` counts from 0. */
    uint16_t binding;
    uint16_t element;
    bool texels;                      /* storage texel buffer, of rg_buffer.format */
    bool partial;                     /* write preserves some earlier content */
    const struct rg_sampler *sampler; /* RG_SAMPLED; NULL means {0} */
    /* placeholder if a single-sample image is missing; without one, a missing image is a fault */
    const struct rg_fallback *fallback;
    /* shaders that access the resource: VK_SHADER_STAGE_VERTEX_BIT, FRAGMENT_BIT or COMPUTE_BIT; 0
     * means compute or fragment, plus vertex for RG_UNIFORM */
    VkShaderStageFlags stages;
    struct rg_range range; /* image subresources; {0} for a buffer */
    /* format in which shaders see an image, of equal texel size, such as UNORM of an SRGB image; 0
     * means that of the image. An imported image then has VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT and
     * VK_IMAGE_CREATE_EXTENDED_USAGE_BIT */
    VkFormat view_format;
};

/* An attachment of a raster pass. */
struct rg_target {
    const struct rg_image *image; /* NULL: no attachment */
    enum rg_load load;            /* content when the pass begins */
    VkClearValue clear;           /* for RG_LOAD_CLEAR; depth 0 to 1 */
    /* mip level and layer to draw to. A repeated pass begins there, and each further repetition
     * draws to the next mip level or layer, unless the image has only one. With RG_PER_MIP_UP the
     * repetitions run in the opposite order */
    uint32_t mip, layer;
    enum rg_blend blend; /* blend mode of a colour target */
    /* custom blend state, which requires that `blend` is 0; no dual-source blending */
    const VkPipelineColorBlendAttachmentState *blend_state;
    /* image of the same format and size that receives the averaged samples of a colour target */
    const struct rg_image *resolve;
    uint32_t resolve_mip, resolve_layer; /* as `mip` and `layer`, of `resolve` */
};

/* SPIR-V code of one shader stage, with entry point "main". Descriptors are in set 0, and in set 1
 * if the pass has a `set`. rg_compile() checks passes against the shader's interface. */
struct rg_shader {
    const char *name;      /* for captures and messages */
    const uint32_t *words; /* the SPIR-V module; borrowed */
    size_t word_count;     /* 32-bit words; 0: unknown, not validated */
};

/* Descriptor set 1, which the program owns and binds, for example for bindless textures. The graph
 * neither synchronises nor validates its resources. rg_exec_params.sets has the set's layout. */
struct rg_set {
    const char *name; /* required; for messages and dumps */
};

/* Layout of one vertex buffer. `next` links the layouts of bindings 0, 1 and so on. */
struct rg_vertex_layout {
    uint32_t stride;          /* bytes, at most RG_MAX_STRIDE */
    uint32_t attribute_count; /* number of `attributes` */
    /* attributes with this layout's binding and unique locations < RG_MAX_ATTRIBUTES; borrowed */
    const VkVertexInputAttributeDescription *attributes;
    VkVertexInputRate rate;              /* per vertex or per instance */
    const struct rg_vertex_layout *next; /* layout of the next binding */
};

/* Stencil test of a pass. The pass needs a depth target with a stencil aspect, which stores the
 * stencil values. rg_target.clear has the initial value. */
struct rg_stencil {
    VkStencilOpState front, back; /* for front faces; for back faces */
};

/* Depth bias of triangles, as in VkPipelineRasterizationStateCreateInfo. `clamp` needs the feature
 * depthBiasClamp; 0 means no limit. */
struct rg_depth_bias {
    float constant, clamp, slope;
};

struct rg_cmd;   /* the pass being recorded (rg_cmd.h) */
struct rg_frame; /* program-defined per-frame data for callbacks */

/* Records the commands of one pass. The pass's pipeline, descriptor set 0, viewport, scissor and
 * targets are already bound. Called in the thread that submits or records the frame. */
typedef void rg_record_fn(struct rg_cmd *cmd, const struct rg_frame *frame);

/* Returns true if a conditional pass runs in a frame; `repetition` is 0 unless the pass is
 * repeated. May be called several times in a frame, and must depend only on its arguments. A
 * skipped pass changes and clears nothing; its barriers are recorded with those of the next pass
 * that runs.
 * Content that only conditional passes write may be read only by passes with the same condition
 * (that of the last writer) and, if it depends on the repetition, by the same repetition, unless it
 * is persistent or imported. */
typedef bool rg_when_fn(const struct rg_frame *frame, uint32_t repetition);

/* Returns the rectangle of the targets, in texels, that a raster pass draws in a frame. Draws and
 * RG_LOAD_CLEAR are limited to it; the outside is preserved by RG_LOAD_KEEP, else undefined. If it
 * does not overlap the targets, the pass is skipped as by rg_when_fn. Called as rg_when_fn is;
 * only rg_cmd_pass(), rg_cmd_repetition() and rg_cmd_extent() may be called. */
typedef VkRect2D rg_area_fn(const struct rg_cmd *cmd, const struct rg_frame *frame);

/* Declaration of a pass in a table; expands to one pass or to several repetitions. If the row has a
 * fragment shader, trailing colour targets except the first are left out of the plan if no later
 * pass and no output needs them. The shader's writes to them are discarded, of which the validation
 * layer may warn (OutputNotConsumed). */
struct rg_pass {
    const char *name;              /* unique; shown in dumps and captures */
    enum rg_kind kind;             /* raster, compute or transfer */
    const struct rg_target *color; /* array by RG_TARGETS(); NULL if none */
    uint32_t color_count;          /* set by RG_TARGETS(); at most RG_COLOR_COUNT */
    struct rg_target depth;        /* depth-stencil target; image may be NULL */
    const struct rg_use *uses;     /* zero-terminated array by RG_USES(), or NULL */
    /* shaders of a raster pass, which without `frag` only writes depth, or of a compute pass. A row
     * with neither has no pipeline: `record` binds pipelines of the application
     * (rg_cmd_bind_pipeline()). The fixed-function state below is then ignored, except `vertices`,
     * which gives the number of vertex buffers of a mesh */
    const struct rg_shader *vert, *frag;
    const struct rg_shader *comp;
    const struct rg_vertex_layout *vertices; /* vertex buffer layout; NULL if none */
    uint32_t push_size;                      /* push constant bytes, multiple of 4 */
    rg_record_fn *record;                    /* required */

    /* what most passes leave at 0 */

    enum rg_repeat repeat;            /* whether it expands to several passes */
    rg_when_fn *when;                 /* condition; NULL means every frame */
    VkCompareOp depth_compare;        /* depth test; 0 means LESS_OR_EQUAL */
    bool depth_read_only;             /* depth-stencil is tested, not written */
    VkPrimitiveTopology topology;     /* TRIANGLE_LIST if 0; up to TRIANGLE_FAN */
    VkCullModeFlags cull;             /* faces to cull; 0 means none */
    VkFrontFace front;                /* front-face winding; 0 means counter-clockwise */
    struct rg_depth_bias depth_bias;  /* {0} means none */
    const struct rg_stencil *stencil; /* borrowed; NULL: no stencil test */
    const struct rg_set *set;         /* the application's set 1, or NULL */
    enum rg_queue queue;              /* if rg_compile_params.queues lacks it, the main queue */
    /* layerCount of layered rendering, from rg_target.layer on; 0 means 1. Shaders choose a layer
     * by gl_Layer, which needs the feature shaderOutputLayer */
    uint32_t layers;
    /* multiview rendering: each of the `layers`, at most RG_MAX_VIEWS, is a view (viewMask of
     * VkRenderingInfo). A draw draws to all of them, and gl_ViewIndex is the layer counted from
     * rg_target.layer on. Needs the feature multiview */
    bool multiview;
    rg_area_fn *area; /* rectangle to draw; NULL: whole targets */
    bool secondary;   /* record() calls only rg_cmd_record_secondary() and rg_cmd_execute() */
};

/* Passes that belong together, in execution order. */
struct rg_technique {
    const char *name; /* required; shown in faults and dumps */
    const struct rg_pass *passes;
    size_t pass_count;
};

/* A resource that exists outside the plan. It arrives in the layout of `access`; if that only
 * reads, earlier writes are visible to it (for shader reads: in vertex, fragment and compute
 * shaders), and RG_ACCESS_NONE means undefined content. Unless it is also an output, the frame
 * returns it in the same state, and writes to it may be lost. */
struct rg_import {
    const struct rg_image *image;   /* set either this or `buffer` */
    const struct rg_buffer *buffer; /* set either this or `image` */
    enum rg_access access;          /* state in which it arrives */
    VkExtent2D extent;              /* actual texels; 0x0 means as declared */
    uint32_t layers, mips;          /* actual counts; 0 means as declared */
    uint32_t depth;                 /* actual texels; 0 means as declared */
    VkDeviceSize size;              /* actual bytes; 0 means as declared */
};

/* A resource that is needed after the frame. The frame leaves it in the state for `access`. */
struct rg_output {
    const struct rg_image *image;   /* set either this or `buffer` */
    const struct rg_buffer *buffer; /* set either this or `image` */
    enum rg_access access;          /* required */
};

/* Memory requirements of a resource, as in VkMemoryRequirements. */
struct rg_memory_requirements {
    VkDeviceSize size, alignment; /* bytes; alignment 0 means 1 */
    uint32_t type_bits;           /* mask of allowed memory types; nonzero */
};

/* Callbacks by which rg_compile() queries a device, as returned by rg_exec_device(). Each callback
 * receives `user`. A NULL callback imposes no limit. */
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
    /* device limits: texels per image side, and layers; 0 means 65536 and 16384 */
    uint32_t max_image_size, max_layers;
    uint32_t max_volume_size; /* texels per 3D side; default 16384 */
};

/* Which transient resources may share memory (alias). Aliasing saves memory but may add barriers,
 * because a resource must wait until the memory's previous resource is no longer accessed. */
enum rg_sharing {
    RG_SHARE_FEWEST_BATCHES, /* aliases if no batch is added */
    RG_SHARE_NOTHING,        /* no aliasing */
};

/* Replacement of a declared size. An image must declare a nonzero width and height. */
struct rg_size {
    const struct rg_image *image;   /* set either this or `buffer` */
    VkExtent2D extent;              /* texels of `image` */
    const struct rg_buffer *buffer; /* set either this or `image` */
    VkDeviceSize size;              /* bytes of `buffer` */
};

/* Input of rg_compile(). All pointers are borrowed. `memory` and the tables must outlive the plan.
 * The device and the arrays of techniques, outputs, imports and sizes need not outlive the call. */
struct rg_compile_params {
    const struct rg_technique *const *techniques; /* in execution order */
    size_t technique_count;
    VkExtent2D view; /* frame size in texels; required */
    /* largest view that rg_exec_update() can change to without allocating; 0x0 means `view` */
    VkExtent2D max_view;
    const struct rg_output *outputs; /* required; unneeded passes are culled */
    size_t output_count;             /* 0 is a fault */
    const struct rg_import *imports;
    size_t import_count;
    const struct rg_size *sizes; /* override declared sizes; imports take precedence */
    size_t size_count;
    const struct rg_device *device; /* NULL: tight sizes, 256-byte alignment */
    enum rg_sharing sharing;        /* aliasing of transient resources */
    VkFlags queues; /* mask of 1 << enum rg_queue: further queues to use; 0: only the main queue */
    bool skip_shaders; /* no shader validation (7 us each) */
    /* Memory for compiling and for the plan. It must outlive the plan and be aligned for any type.
     * If NULL or too small, malloc() provides the rest. rg_plan.arena_size bytes are enough. */
    void *memory;
    size_t memory_size; /* bytes */
};

/* Kinds of faults. rg_fault_text() formats a fault. */
enum rg_error {
    RG_ERROR_NONE,
    RG_ERROR_NO_OUTPUT,          /* no output is requested */
    RG_ERROR_NO_NAME,            /* resource, pass or technique without name */
    RG_ERROR_DUPLICATE_NAME,     /* name of two resources or passes */
    RG_ERROR_NO_SIZE,            /* empty view or buffer; negative scale */
    RG_ERROR_TOO_LARGE,          /* beyond device or Vulkan limits */
    RG_ERROR_FORMAT,             /* unknown, or lacks a needed feature */
    RG_ERROR_CUBE,               /* cube with invalid size or layers */
    RG_ERROR_RANGE,              /* no such mip, layer or aspect */
    RG_ERROR_NOT_ONE_RESOURCE,   /* not exactly one image or buffer */
    RG_ERROR_ACCESS,             /* access unfit for pass or resource */
    RG_ERROR_DUPLICATE_BINDING,  /* two uses share a binding */
    RG_ERROR_TARGET_SIZE,        /* a pass's targets differ in size */
    RG_ERROR_NO_TARGET,          /* no target, or gap between targets */
    RG_ERROR_NO_SHADER,          /* one of vert and frag is missing */
    RG_ERROR_NO_RECORD,          /* a pass without record function */
    RG_ERROR_PUSH_SIZE,          /* above RG_MAX_PUSH, or not 4n */
    RG_ERROR_CONFLICT,           /* conflicting accesses in one pass */
    RG_ERROR_READ_BEFORE_WRITE,  /* read before any write or import */
    RG_ERROR_OUTPUT_NOT_WRITTEN, /* an output that no pass writes */
    RG_ERROR_WRITES_NOTHING,     /* a pass that writes no resource */
    RG_ERROR_REPEAT,             /* repeated pass that writes no image */
    RG_ERROR_LISTED_TWICE,       /* an import or output listed twice */
    RG_ERROR_SAMPLES,            /* unsupported sample count or resolve */
    RG_ERROR_PERSISTENT,         /* persistent or imported, in host memory */
    RG_ERROR_VALUE,              /* field value out of range */
    RG_ERROR_TABLE,              /* table NULL, or too long */
    RG_ERROR_DEVICE,             /* device reports impossible properties */
    RG_ERROR_SHADER,             /* invalid SPIR-V, or no `main` */
    RG_ERROR_SHADER_PUSH,        /* push constant size differs from shaders' */
    RG_ERROR_SHADER_BINDING,     /* missing, mismatched or unused binding */
    RG_ERROR_SHADER_ACCESS,      /* loads or stores that the use does not declare */
    RG_ERROR_SHADER_VERTEX,      /* missing or mismatched vertex attribute */
    RG_ERROR_SHADER_INPUT,       /* fragment input without vertex output */
    RG_ERROR_SHADER_OUTPUT,      /* output without target, or vice versa */
    RG_ERROR_COUNT,
};

/* One fault, with the names that its message needs; a name that does not apply is NULL. */
struct rg_fault {
    enum rg_error error;
    const char *technique, *pass, *resource;
    uint32_t row;     /* index in the technique, or RG_NONE */
    const char *hint; /* how to fix it */
};

/* Compiles the techniques of `params` in order. Returns a plan, which the caller destroys, or NULL
 * if out of memory. If tables have invalid numbers or NULL pointers, the plan has faults. A plan
 * with a nonzero fault_count cannot be executed. Thread-safe. */
RG_API struct rg_plan *rg_compile(const struct rg_compile_params *params);

/* Frees a plan. NULL is allowed. rg_compile_params.memory stays the caller's. If executors still
 * use the plan, they reject its frames. The last of them frees it when it is updated to another
 * plan or destroyed; the plan's tables and memory must last until then. */
RG_API void rg_plan_destroy(struct rg_plan *plan);

/* Returns the create info of a plan's image, for queries of memory and for vkCreateImage(). */
RG_API VkImageCreateInfo rg_image_create_info(const struct rg_plan_image *image);

/* Write a plan, or its faults, to `out`. Equal tables give bit-identical output. I/O errors of
 * `out` are for the caller to check. docs/reference/render-graph.md describes the formats. */
RG_API void rg_dump(const struct rg_plan *plan, FILE *out);      /* text, one item per line */
RG_API void rg_dump_json(const struct rg_plan *plan, FILE *out); /* one JSON object */
RG_API void rg_dump_html(const struct rg_plan *plan, FILE *out); /* one self-contained page */

/* Writes a fault as one line without newline: technique, row, pass, resource, problem, hint. Writes
 * at most `size` bytes. Returns the whole line's length, as snprintf() does. */
RG_API int rg_fault_text(const struct rg_fault *fault, char *text, size_t size);

/* Vulkan stages, accesses, layout and usage of an rg_access. */
struct rg_access_info {
    const char *name;             /* as in dumps */
    VkPipelineStageFlags2 stages; /* 0 means the use's shader stages */
    VkAccessFlags2 reads, writes;
    VkImageLayout layout; /* UNDEFINED for accesses of buffers only */
    VkImageUsageFlags image_usage;
    VkBufferUsageFlags buffer_usage;
    VkFormatFeatureFlags format_features; /* required of the image's format */
    VkDescriptorType image_descriptor;    /* VK_DESCRIPTOR_TYPE_MAX_ENUM if there is none */
    VkDescriptorType buffer_descriptor;   /* VK_DESCRIPTOR_TYPE_MAX_ENUM if there is none */
    bool reads_content;                   /* requires earlier content */
    bool writes_content;
};

/* Returns the Vulkan mapping of an access, or of RG_ACCESS_NONE if out of range. Static data. */
RG_API const struct rg_access_info *rg_access_info(enum rg_access access);

/* Returns the descriptor type of a use; VK_DESCRIPTOR_TYPE_MAX_ENUM if it needs none. */
RG_API VkDescriptorType rg_use_descriptor(const struct rg_use *use);

/* Properties of a format. */
struct rg_format_info {
    VkFormat format;
    const char *name;           /* without VK_FORMAT_ */
    uint32_t size;              /* bytes per texel */
    VkImageAspectFlags aspects; /* colour, or depth and stencil */
    bool is_uint, is_sint;      /* integer: no filtering, blending, averaging */
    uint32_t spirv_format;      /* Image Format of storage images in SPIR-V; 0 if there is none */
};

/* Returns the properties of a format; NULL if the graph does not support it. Static data. */
RG_API const struct rg_format_info *rg_format_info(VkFormat format);

#ifdef __cplusplus
}
#endif

#include "graph/rg_initializers.h"

#endif
