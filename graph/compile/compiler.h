/*
 * compiler.h: data and functions shared by the compiler's stages. Private to graph/compile/.
 *
 * Terms: a *row* is a struct rg_pass of a table; a *pass* is one repetition of a row; an *access*
 * is one use or target of a pass with its range resolved; a *cell* holds the synchronisation state
 * of one subresource: one (aspect, mip level, layer) of an image, or a whole buffer.
 */
#ifndef RG_COMPILE_COMPILER_H
#define RG_COMPILE_COMPILER_H

#include "graph/compile/arena.h"
#include "graph/compile/spirv_reflection.h"
#include "graph/rg.h"

/* Functions called for each access, which compilers would not inline by themselves. */
#define RG_INLINE static inline __attribute__((always_inline))

/* Values of cell.filled, which tells if earlier passes have written the subresource. */
enum {
    CELL_EMPTY,
    CELL_FILLED,
    CELL_FILLED_BY, /* plus index of the conditional writer */
};

/* struct access.flags */
enum {
    ACCESS_READS = 1 << 0,       /* needs content of earlier passes */
    ACCESS_WRITES = 1 << 1,      /* leaves content for later passes */
    ACCESS_OVERWRITES = 1 << 2,  /* discards earlier content of the range */
    ACCESS_NEEDED = 1 << 3,      /* the result is needed later */
    ACCESS_CONDITIONAL = 1 << 4, /* does not happen in every frame */
    ACCESS_TEXELS = 1 << 5,      /* through a texel buffer view */
    ACCESS_DROPPED = 1 << 6,     /* unneeded target, to be left out */
};

/* struct cell.flags */
enum {
    CELL_CERTAIN = 1 << 0, /* last write is unconditional, this frame */
    CELL_AWAITED = 1 << 1, /* unconditional read awaited the last write */
    CELL_FRESH = 1 << 2,   /* aliased memory, unused in this frame */
    CELL_CHANGED = 1 << 3, /* content or layout changed this frame */
};

struct cell {
    VkPipelineStageFlags2 write_stages; /* last write's stages, or chained ones */
    VkAccessFlags2 write_access;        /* its accesses not yet made available */
    VkPipelineStageFlags2 read_stages;  /* stages that read since the write */
    uint32_t visible;                   /* visibility bits of synchronised reads */
    uint32_t first_barrier;             /* barriers that made the write visible */
    uint32_t barrier_end;               /* range end; 0 if empty */
    VkImageLayout layout;
    uint32_t flags;
    uint32_t written;     /* pass after the last write */
    uint32_t touched;     /* pass after the last access */
    uint32_t last_access; /* latest access plus 1 (expand_passes.c) */
    uint32_t filled;
    bool is_needed;            /* culling: needed later in the frame */
    bool is_needed_next_frame; /* culling: needed by the next frame */
    bool changed;              /* scratch of share_history_barriers() */
};

/* Accesses to a cell by several queues (barriers.c). */
struct cell_queues {
    uint32_t home;                    /* queue that `cell` describes: that of the last write */
    uint32_t touched[RG_QUEUE_COUNT]; /* by queue: pass after the last access since that write */
};

#define RG_SIZE_OVERFLOW UINT64_MAX

/* Subresources: aspects, mip levels and array layers. */
struct range {
    uint16_t layer, layer_count;
    uint8_t mip, mip_count;
    uint8_t aspects; /* VkImageAspectFlags */
};

/* Fields are in the order of their use, so that each stage reads few cache lines. */
struct resource {
    const struct rg_image *image;    /* NULL for a buffer */
    struct cell *cells;              /* ordered by aspect, mip level, layer */
    struct resource *partner;        /* resource that it is swapped with after a frame, or NULL */
    struct cell_queues *queue_cells; /* parallel to `cells`; NULL if only the main queue has it */
    struct range all;                /* full range; buffers: one colour subresource */
    uint32_t cell_count;
    bool persistent;
    bool shared;                      /* its memory may alias other resources */
    bool is_mutable;                  /* some use has a view_format that differs */
    uint8_t queues;                   /* mask of the queues of its accesses */
    uint32_t plan_image, plan_buffer; /* indices into the plan, or RG_NONE */
    uint32_t first, last;             /* lifetime in passes; RG_NONE if unused */
    VkFlags usage;                    /* VkImageUsageFlags or VkBufferUsageFlags */
    uint32_t item;                    /* index into compiler.owners, or RG_NONE */
    uint32_t acquired_before;         /* pass before which memory is acquired */
    uint32_t last_barrier;            /* its newest barrier, or RG_NONE */
    const char *name;                 /* "?" if the table has none */
    const struct rg_buffer *buffer;
    uint32_t import, output; /* index into params->imports, outputs, or RG_NONE */
    uint32_t depth;          /* 1 unless the image is 3D */

    union {
        struct {
            VkExtent2D extent, max_extent; /* for params->view; for params->max_view */
        };

        struct {
            VkDeviceSize size, max_size; /* of a buffer, in bytes, or RG_SIZE_OVERFLOW */
        };
    };
    struct cell cell[]; /* storage for `cells` of single-cell resources */
};

struct access {
    struct resource *resource;
    const void *declared; /* a rg_use or rg_target */
    struct cell *cells;   /* first cell of the range */
    uint32_t cell_count;  /* number of cells in the range */
    struct range range;
    uint8_t kind;  /* enum rg_access */
    uint8_t queue; /* enum rg_queue */
    uint8_t flags;
    uint32_t visibility; /* reads: mask of (stage, access) pairs */
    VkImageLayout layout;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 mask; /* all its Vulkan accesses */
};

struct pass {
    uint32_t first_access, access_count;
    bool alive; /* not culled */
    bool drops; /* has accesses with ACCESS_DROPPED */
    enum rg_queue queue;
};

/* A transient resource to be packed into a memory block (in tests, any byte range). */
struct pack_item {
    VkDeviceSize size, alignment; /* bytes; a power of two */
    VkDeviceSize offset;          /* result: bytes from the block's start */
    uint32_t first, last;         /* live range in passes, inclusive */
    uint32_t type_bits;           /* as in VkMemoryRequirements */
    struct resource *resource;
    uint32_t block; /* index into the plan's blocks */
};

/* Unfinished accesses of the resources that used a pack_item's memory before. */
struct previous_owner {
    VkPipelineStageFlags2 stages; /* stages of pending accesses */
    VkAccessFlags2 writes;        /* writes not yet made available */
};

struct compiler {
    const struct rg_compile_params *params;
    struct rg_plan *plan;
    struct arena *arena;
    uint32_t max_image_size, max_layers; /* device and compiler limits */
    uint32_t max_volume_size;
    VkExtent2D max_view;
    uint32_t row_count;          /* approximate; for initial array sizes */
    struct resource **resources; /* imports and outputs come first */
    uint32_t resource_count, resource_room;
    uint32_t boundary_count;               /* imports and outputs in `resources` */
    uint32_t persistent_count;             /* number of persistent resources */
    struct map by_address;                 /* struct resource by rg_image or rg_buffer */
    struct map resource_names, pass_names; /* sets of strings */
    struct map provided;                   /* images that are written or imported, for fallbacks */

    /* Current technique and index of its current pass declaration; NULL and RG_NONE if none. */
    const struct rg_technique *technique;
    uint32_t row;
    uint32_t row_first_fault;
    struct rg_plan_pass *pass; /* its current pass */
    uint32_t step;             /* offset from the row's layer or mip level */
    uint32_t target_samples;   /* sample count; 0 before any target */
    struct spirv modules[2];   /* its shaders */

    struct pass *passes;
    struct rg_plan_pass *plan_passes; /* parallel to `passes` */
    uint32_t pass_count, pass_room, plan_pass_room;
    struct access *accesses;
    uint32_t access_count, access_room;
    uint32_t color_count;          /* number of colour target accesses */
    struct pack_item *items;       /* by first use, contiguous per block */
    struct previous_owner *owners; /* by resource.item; NULL if unknown */
    uint32_t item_count;
    VkDeviceSize memory_needed; /* bytes of all resources, with padding */

    /* The plan's arrays while they are being written. */
    struct rg_plan_image *images;
    struct rg_plan_buffer *buffers;
    struct rg_plan_use *uses;
    struct rg_plan_target *colors;
    const struct rg_use **fallbacks;
    uint32_t fallback_count, fallback_room;
    struct rg_barrier *barriers;
    uint32_t barrier_count, barrier_room;
    uint32_t batch_first; /* first barrier of the newest batch */
    uint32_t batch_end;   /* index of its pass plus 1 */

    /* Several queues: that of the current pass and of the newest batch, and, as pass index plus 1,
     * for which passes of each queue the current pass, and each queue so far, must wait. */
    bool has_queues;
    enum rg_queue queue, batch_queue;
    uint32_t waits[RG_QUEUE_COUNT], waited[RG_QUEUE_COUNT][RG_QUEUE_COUNT];
    struct rg_submission *submissions;
    uint32_t submission_room;
    struct rg_fault *faults;
    uint32_t fault_count, fault_room;
};

/* ---- fault.c ---- */

/* Reports a fault of the current pass declaration, but only once. `resource` may be NULL. */
__attribute__((cold)) void rg_fault(struct compiler *c, enum rg_error error, const char *resource,
                                    const char *hint);

/* As rg_fault(), with a hint that is formatted as by printf(). */
__attribute__((cold, format(printf, 4, 5))) void rg_fault_with(struct compiler *c,
                                                               enum rg_error error,
                                                               const char *resource,
                                                               const char *format, ...);

/* Adds a fault outside any row. */
__attribute__((cold)) void rg_fault_of(struct compiler *c, enum rg_error error,
                                       const char *resource, const char *hint);

/* Reports a fault of the current pass declaration if `wrong`. */
static inline void rg_fault_if(struct compiler *c, bool wrong, enum rg_error error,
                               const char *resource, const char *hint)
{
    if (wrong)
        rg_fault(c, error, resource, hint);
}

/* Adds a fault if an enum field is above the last constant of its enum. */
#define RG_CHECK_ENUM(c, of, field, last, resource, type) \
    rg_fault_if((c), (unsigned)(of)->field > (unsigned)(last), RG_ERROR_VALUE, (resource), \
                #field ": expected a constant of " type)

/* Returns true if a table is NULL despite a nonzero count, or its count exceeds `max`. */
static inline bool rg_is_bad_table(const void *table, size_t count, size_t max)
{
    return count && (!table || count > max);
}

/* Adds a fault if a table is NULL despite a nonzero count, or has more than `max` entries. */
#define RG_CHECK_TABLE(c, of, table, count, max, resource) \
    rg_fault_if((c), rg_is_bad_table((of)->table, (of)->count, (max)), RG_ERROR_TABLE, (resource), \
                #table ": expected " #count " entries, at most " #max)

/* format_table.c: returns the format with a number of SPIR-V; NULL if the graph has none. */
const struct rg_format_info *rg_storage_format(uint32_t number);

/* ---- access_table.c ---- */

extern const struct rg_access_info rg_access_table[RG_ACCESS_COUNT];

/* All shader stages. Shader accesses to imports and outputs are assumed to occur in all of them. */
#define RG_ANY_SHADER \
    (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | \
     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)

/* Value of cell.visible if a write is visible to all reads. Each bit stands for a pair of stage and
 * access. Bit 31 (other shader stages) is always clear, so reads in these stages always get a
 * barrier. */
#define RG_VISIBLE_TO_ALL UINT32_C(0x7fffffff)

/* Returns true for accesses by shaders through a descriptor. */
static inline bool rg_is_shader_access(enum rg_access kind)
{
    return kind >= RG_SAMPLED && kind <= RG_TRACE;
}

/* Returns the image or buffer usage flags that an access requires. */
static inline VkFlags rg_usage(const struct resource *r, enum rg_access kind)
{
    const struct rg_access_info *info = &rg_access_table[kind];
    return r->image ? info->image_usage : info->buffer_usage;
}

/* Returns all shader stages of a kind of pass. Invalid kinds are treated as compute. */
static inline VkShaderStageFlags rg_shader_stages(enum rg_kind kind)
{
    return kind == RG_RASTER     ? VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT
           : kind == RG_TRANSFER ? 0
                                 : VK_SHADER_STAGE_COMPUTE_BIT;
}

/* Returns the pipeline stages of shaders. */
static inline VkPipelineStageFlags2 rg_pipeline_stages(VkShaderStageFlags shaders)
{
    return (shaders & (VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT)) << 3 |
           (shaders & VK_SHADER_STAGE_COMPUTE_BIT) << 6;
}

/* Returns the stages of a use: those declared, or the default for the kind of pass. */
static inline VkPipelineStageFlags2 rg_use_stages(const struct rg_pass *pass,
                                                  const struct rg_use *use)
{
    if (rg_access_table[use->access].stages)
        return rg_access_table[use->access].stages;
    if (use->stages)
        return rg_pipeline_stages(use->stages);
    return pass->kind == RG_RASTER && use->access != RG_UNIFORM
               ? VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT
               : rg_pipeline_stages(rg_shader_stages(pass->kind));
}

/* Returns the format in which shaders see the image of a use. */
static inline VkFormat rg_view_format(const struct rg_use *use)
{
    return use->view_format ? use->view_format : use->image->format;
}

/* Cell iterator; usage: for (struct cell_walk w = rg_cells(access); w.cell; rg_next_cell(&w)) */

struct cell_walk {
    const struct access *access;
    struct cell *cell;          /* NULL at the end */
    uint32_t remaining;         /* cells, including the current one */
    VkImageAspectFlags aspects; /* remaining aspects, lowest one first */
    uint32_t mip, layer;
};

/* Returns the cell of a subresource. For depth and stencil together, returns the depth cell. */
static inline struct cell *rg_find_cell(const struct resource *r, VkImageAspectFlags aspects,
                                        uint32_t mip, uint32_t layer)
{
    VkImageAspectFlags below = r->all.aspects & ((aspects & (~aspects + 1)) - 1);
    uint32_t row = (below ? r->all.mip_count : 0) + mip;
    return &r->cells[row * r->all.layer_count + layer];
}

static inline struct cell_walk rg_cells(const struct access *a)
{
    return (struct cell_walk){
        .access = a,
        .cell = a->cells,
        .remaining = a->cell_count,
        .aspects = a->range.aspects,
        .mip = a->range.mip,
        .layer = a->range.layer,
    };
}

/* Advances to the next cell. The layer varies fastest, then the mip level, then the aspect. */
static inline void rg_next_cell(struct cell_walk *w)
{
    const struct range *range = &w->access->range;
    w->cell = --w->remaining ? w->cell + 1 : NULL;
    if (!w->cell || ++w->layer < (uint32_t)range->layer + range->layer_count)
        return;
    w->layer = range->layer;
    if (++w->mip == (uint32_t)range->mip + range->mip_count) {
        w->mip = range->mip;
        w->aspects &= w->aspects - 1;
    }
    w->cell = rg_find_cell(w->access->resource, w->aspects, w->mip, w->layer);
}

/* Returns the barrier range of the current cell; all zero for a buffer. */
static inline VkImageSubresourceRange rg_cell_range(const struct cell_walk *w)
{
    VkImageAspectFlags lowest = w->aspects & (~w->aspects + 1);
    if (!w->access->resource->image)
        return (VkImageSubresourceRange){ 0 };
    return (VkImageSubresourceRange){ lowest, w->mip, 1, w->layer, 1 };
}

/* ---- check_pass.c ---- */

/* Checks those fields of a pass declaration that do not depend on other passes. */
void rg_check_row(struct compiler *c, const struct rg_pass *pass);

bool rg_is_blended(const struct rg_target *target);  /* blending reads the old colour */
bool rg_keeps_color(const struct rg_target *target); /* old colour may partly remain */

/* check_shaders.c: compares a valid pass with its shaders' interfaces, if their code is known. */
void rg_check_shaders(struct compiler *c, const struct rg_pass *row);

/* Returns true for a use, and false for the zero entry that ends an array of uses. */
static inline bool rg_is_use(const struct rg_use *use)
{
    return use->image || use->buffer || use->access;
}

/* Returns the name of the image or buffer of a use: "?" without a name, NULL without both. */
static inline const char *rg_use_name(const struct rg_use *use)
{
    if (!use->image && !use->buffer)
        return NULL;
    const char *name = use->image ? use->image->name : use->buffer->name;
    return name ? name : "?";
}

/* Returns true if a use names exactly one resource and a valid access. */
static inline bool rg_is_valid_use(const struct rg_use *use)
{
    return !use->image != !use->buffer && use->access > RG_ACCESS_NONE &&
           use->access < RG_ACCESS_COUNT;
}

/* Returns the number of .color entries that are safe to read, even if color_count is wrong. */
static inline uint32_t rg_safe_color_count(const struct rg_pass *pass)
{
    return rg_is_bad_table(pass->color, pass->color_count, RG_COLOR_COUNT) ? 0 : pass->color_count;
}

/* Counts the colour targets before the first entry without an image. */
static inline uint32_t rg_color_count(const struct rg_pass *pass)
{
    uint32_t room = rg_safe_color_count(pass);
    uint32_t count = 0;
    while (count < room && pass->color[count].image)
        count++;
    return count;
}

/* ---- create_resource_records.c ---- */

/* Counts the passes and checks the params' arrays. Returns true if all arrays can be read. */
bool rg_check_params(struct compiler *c);

/* Adds the imports and outputs, and reports their faults. */
void rg_add_boundary(struct compiler *c);

/* Returns the number of mip levels of a full chain; `depth` is at least 1. */
uint32_t rg_full_chain(VkExtent2D extent, uint32_t depth);

/* Returns the size in texels of one side of a mip level; 1 if the image has no such level. */
static inline uint32_t rg_mip_side(uint32_t side, uint32_t mip)
{
    return mip < 32 && side >> mip ? side >> mip : 1;
}

/* Returns the declared number of array layers of an image; an import may have another one. */
static inline uint32_t rg_declared_layers(const struct rg_image *image)
{
    return image->layers ? image->layers : image->cube ? 6 : 1;
}

/* Returns true if an image has the content of its `previous`, not its own. */
static inline bool rg_is_history(const struct resource *r)
{
    return r->partner && r->image->previous;
}

/* Adds the resource of an image or buffer, and stores it in *value. NULL if out of memory. */
struct resource *rg_add_resource(struct compiler *c, const struct rg_image *image,
                                 const struct rg_buffer *buffer, void **value);

/* Returns the resource of an image or buffer, adding it on first use. NULL if out of memory. */
static inline struct resource *rg_resource_of(struct compiler *c, const struct rg_image *image,
                                              const struct rg_buffer *buffer)
{
    const void *address = image ? (const void *)image : (const void *)buffer;
    void **value = rg_map_value(c->arena, &c->by_address, address);
    if (value && *value)
        return *value;
    return value ? rg_add_resource(c, image, buffer, value) : NULL;
}

/* expand_passes.c: returns the access to an import before the frame, or to an output after it. */
struct access rg_boundary_access(struct resource *r, enum rg_access kind);

/* ---- compiler stages in execution order; each requires the previous ones ---- */

/* expand_passes.c: expands pass declarations to passes and accesses, and reports their faults. */
void rg_expand(struct compiler *c);

/* cull_passes.c: removes the passes that no output needs. */
void rg_cull(struct compiler *c);

/* memory_requirements.c: finds lifetimes and sizes, checks that the device supports the accesses to
 * formats, and lists the plan's images and buffers. */
void rg_find_lifetimes(struct compiler *c);
void rg_list_resources(struct compiler *c);

/* pack_memory.c: assigns each transient resource a memory block and an offset in it. */
void rg_pack_blocks(struct compiler *c);

/* barriers.c: writes the plan's passes, targets and uses, and adds the barriers. */
void rg_write_plan_passes(struct compiler *c);

/* alias_dependencies.c: sets the source scopes of barriers that wait for earlier uses of memory. */
void rg_complete_alias_barriers(struct compiler *c);

/* ---- pack_memory.c ---- */

struct pack_result {
    VkDeviceSize size;      /* bytes of the block */
    VkDeviceSize unaliased; /* bytes without aliasing */
    VkDeviceSize bound;     /* peak live bytes, a lower bound */
    VkDeviceSize alignment; /* the largest of all items */
};

/* Assigns memory offsets to items sorted by first use. No item is alive after pass `end`. */
struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count,
                           uint32_t end, bool unaliased);

#endif
