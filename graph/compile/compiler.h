/*
 * compiler.h: data that the steps of the compiler share. Private to graph/compile/.
 *
 * Words: a *row* is a struct rg_pass of a table; a *pass* is one repetition of a row; an *access*
 * is one use or target of a pass with its range resolved; a *cell* is one (aspect, mip, layer) of
 * an image, or a whole buffer. State is tracked for each cell.
 */
#ifndef RG_COMPILE_COMPILER_H
#define RG_COMPILE_COMPILER_H

#include "graph/compile/arena.h"
#include "graph/compile/map.h"
#include "graph/compile/spirv.h"
#include "graph/rg.h"

/* struct cell.filled: whether earlier passes have given the cell content. */
enum {
    CELL_EMPTY,
    CELL_FILLED,
    CELL_FILLED_BY, /* plus the index of a conditional pass: filled if its condition holds */
};

/* struct access.flags */
enum {
    ACCESS_READS = 1 << 0,       /* needs the content that earlier passes left */
    ACCESS_WRITES = 1 << 1,      /* leaves content for later passes */
    ACCESS_OVERWRITES = 1 << 2,  /* nothing of the earlier content of the range remains */
    ACCESS_NEEDED = 1 << 3,      /* a later pass or an output needs what it writes */
    ACCESS_CONDITIONAL = 1 << 4, /* does not happen in every frame */
    ACCESS_TEXELS = 1 << 5,      /* of a buffer, through a view with its format */
};

/* struct cell.flags */
enum {
    CELL_CERTAIN = 1 << 0, /* the last write happens in every frame, and in this frame */
    CELL_AWAITED = 1 << 1, /* a read that happens in every frame has waited for the last write */
    CELL_FRESH = 1 << 2,   /* shared memory that this frame has not used yet */
    CELL_CHANGED = 1 << 3, /* this frame has changed content or layout */
};

struct cell {
    VkPipelineStageFlags2 write_stages; /* of the last write, or stages it was chained to */
    VkAccessFlags2 write_access;        /* of the last write, while it is not yet available */
    VkPipelineStageFlags2 read_stages;  /* that have read since the last write */
    uint32_t visible;                   /* reads that see the write: bits of access.visibility */
    uint32_t first_barrier;             /* barriers that made the write visible: from this one */
    uint32_t barrier_end;               /* up to this one; 0: none */
    VkImageLayout layout;
    uint32_t flags;
    uint32_t written;     /* the first pass after the last write */
    uint32_t touched;     /* the first pass after the last access */
    uint32_t last_access; /* while expanding: one more than the index of the latest access */
    uint32_t filled;
    bool wanted;      /* while culling: later passes or outputs need the content */
    bool wanted_next; /* while culling: the next frame needs the content (persistent) */
    bool changed;     /* scratch of rg_each_history_read(): passes so far have changed the cell */
};

#define RG_SIZE_OVERFLOW UINT64_MAX

struct resource {
    const char *name;             /* "?" if the table gives none */
    const struct rg_image *image; /* this or: */
    const struct rg_buffer *buffer;
    struct cell *cells; /* by aspect, then mip, then layer */
    uint32_t cell_count;
    bool persistent;
    bool shared;                         /* transient: its memory is part of a block */
    VkImageSubresourceRange all;         /* of a buffer: one mip and layer of the colour aspect */
    VkExtent2D extent, max_extent;       /* of an image; and in a view of params->max_view */
    uint32_t depth;                      /* 1 unless the image has three dimensions */
    const struct rg_format_info *format; /* NULL: unknown, or a buffer */
    VkDeviceSize size, max_size;         /* of a buffer, bytes; or RG_SIZE_OVERFLOW */
    uint32_t import, output;             /* index into the params' imports, outputs; or RG_NONE */
    uint32_t first, last;                /* plan passes that access it; first RG_NONE: unused */
    VkFlags usage;                       /* VkImageUsageFlags or VkBufferUsageFlags */
    uint32_t plan_image, plan_buffer;    /* index into the plan's images or buffers, or RG_NONE */
    uint32_t item;                       /* index into compiler.owners, or RG_NONE */
    uint32_t acquired_at;                /* the pass before which it takes over its memory */
    uint32_t last_barrier;               /* index of the newest barrier, or RG_NONE */
    struct cell cell[];                  /* room for one, which is `cells` if there is only one */
};

struct access {
    struct resource *resource;
    const void *declared; /* const struct rg_use or const struct rg_target */
    struct cell *cells;   /* the first one of the range */
    uint32_t cell_count;  /* of the range */
    VkImageSubresourceRange range;
    enum rg_access kind;
    uint32_t flags;
    uint32_t visibility; /* of a read: the (stage, access) pairs that it is, a bit each */
    VkImageLayout layout;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 mask; /* everything that it does */
};

struct pass {
    uint32_t first_access, access_count;
    bool alive; /* not culled */
};

/* A transient resource, or in tests a span of bytes, that pack.c gives a place in a block. */
struct pack_item {
    VkDeviceSize size, alignment; /* bytes; a power of two */
    VkDeviceSize offset;          /* result: bytes from the start of the block */
    uint32_t first, last;         /* passes during which no other item may have the bytes */
    uint32_t first_use;           /* the first pass that accesses it; not before `first` */
    uint32_t type_bits;           /* as of VkMemoryRequirements */
    struct resource *resource;
    uint32_t block; /* index into the plan's */
};

/* How the accesses end that had the memory of an item before the item. */
struct previous_owner {
    VkPipelineStageFlags2 stages; /* that may still use the bytes */
    VkAccessFlags2 writes;        /* that are not yet available */
    uint32_t end;                 /* the first pass of this frame after them; 0: none before it */
};

struct compiler {
    const struct rg_compile_params *params;
    struct rg_plan *plan;
    struct arena *arena;
    uint32_t max_image_size, max_layers; /* the device's, or the compiler's own */
    uint32_t max_volume_size;
    VkExtent2D max_view;
    uint32_t row_count;          /* of all techniques, about: how large arrays are at first */
    struct resource **resources; /* imports and outputs come first */
    uint32_t resource_count, resource_room;
    uint32_t boundary_count;   /* resources up to the last import or output */
    uint32_t persistent_count; /* resources that are persistent */
    struct map by_address;     /* of rg_image or rg_buffer: struct resource */
    struct text_set resource_names, pass_names;
    struct map
        provided; /* images that rows write or imports provide; only if a use has a fallback */

    /* The row at work; NULL and RG_NONE: none. */
    const struct rg_technique *technique;
    uint32_t row;
    uint32_t row_first_fault;
    struct rg_plan_pass *pass; /* its pass at work */
    uint32_t target_samples;   /* of its pass at work; 0: no target yet */
    uint32_t *bindings;        /* bits, all 0 unless the bindings of the row are being checked */
    struct spirv modules[2];   /* its shaders */
    bool *known_constants;     /* entries of params->constants that shaders have had so far */
    bool has_wordless_shaders;

    struct pass *passes;
    struct rg_plan_pass *plan_passes; /* as many; in the end the plan's alone */
    uint32_t pass_count, pass_room, plan_pass_room;
    struct access *accesses;
    uint32_t access_count, access_room;
    uint32_t color_count;          /* accesses that are colour targets */
    struct pack_item *items;       /* in the order of first use; those of one block adjoin */
    struct previous_owner *owners; /* by resource.item; NULL: not known yet */
    uint32_t item_count;
    VkDeviceSize memory_needed; /* bytes of all resources so far, and of their alignments */

    /* The plan's arrays, while they are written. */
    struct rg_plan_image *images;
    struct rg_plan_buffer *buffers;
    struct rg_plan_use *uses;
    struct rg_plan_target *colors;
    const struct rg_use **fallbacks;
    uint32_t fallback_count, fallback_room;
    struct rg_barrier *barriers;
    uint32_t barrier_count, barrier_room;
    uint32_t batch_first; /* the first barrier of the newest batch */
    uint32_t batch_end;   /* one more than the pass that the newest batch is before; 0: none yet */
    struct rg_fault *faults;
    uint32_t fault_count, fault_room;
};

/* ---- fault.c ---- */

/* Adds a fault of the row at work, unless the row has the same one already. `resource`: its name;
 * NULL if it is none's. Cold, so that calls are out of the way of tables without faults. */
__attribute__((cold)) void rg_fault(struct compiler *c, enum rg_error error, const char *resource,
                                    const char *hint);

/* Adds a fault that belongs to no row. */
__attribute__((cold)) void rg_fault_of(struct compiler *c, enum rg_error error,
                                       const char *resource, const char *hint);

/* Does so if something is wrong. */
static inline void rg_fault_if(struct compiler *c, bool wrong, enum rg_error error,
                               const char *resource, const char *hint)
{
    if (wrong)
        rg_fault(c, error, resource, hint);
}

/* Does so if a field is above the last constant of its enum. */
#define RG_CHECK_ENUM(c, of, field, last, resource, type) \
    rg_fault_if((c), (unsigned)(of)->field > (unsigned)(last), RG_ERROR_VALUE, (resource), \
                #field ": expected a constant of " type)

/* Whether a table is NULL in spite of its count, or its count cannot be true. */
static inline bool rg_is_no_table(const void *table, size_t count, size_t most)
{
    return count && (!table || count > most);
}

/* Adds a fault if a field is such a table. */
#define RG_CHECK_TABLE(c, of, table, count, most, resource) \
    rg_fault_if((c), rg_is_no_table((of)->table, (of)->count, (most)), RG_ERROR_TABLE, (resource), \
                #table ": expected " #count " entries, at most " #most)

/* ---- access.c ---- */

extern const struct rg_access_info rg_access_table[RG_ACCESS_COUNT];

/* All shader stages of the graph: those of imports and outputs that shaders read or write. */
#define RG_ANY_SHADER \
    (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | \
     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)

/* Each (stage, access) pair of reads has a bit. Bit 31 stands for pairs that are not told apart;
 * it is never set in cell.visible. */
#define RG_VISIBLE_TO_ALL UINT32_C(0x7fffffff)

/* Whether shaders do it, through a descriptor. */
static inline bool rg_is_shader_access(enum rg_access kind)
{
    return kind >= RG_SAMPLED && kind <= RG_TRACE;
}

/* Whether it is of an acceleration structure. */
static inline bool rg_holds_structure(enum rg_access kind)
{
    return kind == RG_TRACE || kind == RG_BUILD || kind == RG_BUILD_SOURCE;
}

/* Makes an access to all of a resource that does all that its kind may do, but for
 * ACCESS_OVERWRITES. Returns `a`. */
struct access *rg_access_init(struct access *a, struct resource *r, enum rg_access kind,
                              VkPipelineStageFlags2 stages);

/* Returns the image or buffer usage flags that an access needs. */
static inline VkFlags rg_usage(const struct resource *r, enum rg_access kind)
{
    const struct rg_access_info *info = &rg_access_table[kind];
    return r->image ? info->image_usage : info->buffer_usage;
}

/* Returns what happens to an import before the frame, or to an output after it. */
struct access rg_boundary_access(struct resource *r, enum rg_access kind);

/* Returns the stages of a use: its own, or those that its kind of pass has by default. */
VkPipelineStageFlags2 rg_use_stages(const struct rg_pass *pass, const struct rg_use *use);

/* Says what is wrong with a good use in a kind of pass; NULL: nothing. */
const char *rg_use_trouble(const struct rg_pass *pass, const struct rg_use *use);

/* ---- for (struct cell_walk w = rg_cells(access); w.cell; rg_next_cell(&w)) ---- */

struct cell_walk {
    const struct access *access;
    struct cell *cell;          /* NULL: the range is at its end */
    uint32_t left;              /* cells, with the one at work */
    VkImageAspectFlags aspects; /* those left; the lowest bit is at work */
    uint32_t mip, layer;
};

/* Returns the cell of the lowest of some aspects. Of aspects, only depth and stencil come together.
 */
static inline struct cell *rg_find_cell(const struct resource *r, VkImageAspectFlags aspects,
                                        uint32_t mip, uint32_t layer)
{
    VkImageAspectFlags below = r->all.aspectMask & ((aspects & (~aspects + 1)) - 1);
    uint32_t row = (below ? r->all.levelCount : 0) + mip;
    return &r->cells[row * r->all.layerCount + layer];
}

static inline struct cell_walk rg_cells(const struct access *a)
{
    return (struct cell_walk){
        .access = a,
        .cell = a->cells,
        .left = a->cell_count,
        .aspects = a->range.aspectMask,
        .mip = a->range.baseMipLevel,
        .layer = a->range.baseArrayLayer,
    };
}

/* Moves on by layers, then mips, then aspects. */
static inline void rg_next_cell(struct cell_walk *w)
{
    const VkImageSubresourceRange *range = &w->access->range;
    w->cell = --w->left ? w->cell + 1 : NULL;
    if (!w->cell || ++w->layer < range->baseArrayLayer + range->layerCount)
        return;
    w->layer = range->baseArrayLayer;
    if (++w->mip == range->baseMipLevel + range->levelCount) {
        w->mip = range->baseMipLevel;
        w->aspects &= w->aspects - 1;
    }
    w->cell = rg_find_cell(w->access->resource, w->aspects, w->mip, w->layer);
}

/* Returns the range of the cell at work, as barriers have it: of a buffer all zero. */
static inline VkImageSubresourceRange rg_cell_range(const struct cell_walk *w)
{
    VkImageAspectFlags lowest = w->aspects & (~w->aspects + 1);
    if (!w->access->resource->image)
        return (VkImageSubresourceRange){ 0 };
    return (VkImageSubresourceRange){ lowest, w->mip, 1, w->layer, 1 };
}

/* ---- check.c, check_row.c ---- */

/* Counts the rows. Returns whether all tables can be read. */
bool rg_check_params(struct compiler *c);

/* Checks an import, which `arrives`, or an output. Returns whether it names one resource. */
bool rg_check_boundary(struct compiler *c, const struct rg_image *image,
                       const struct rg_buffer *buffer, enum rg_access access, bool arrives);

void rg_check_resource(struct compiler *c, struct resource *r);
void rg_check_output_memory(struct compiler *c, const struct resource *r);

/* Finds what is wrong with a row by itself, its name left out. */
void rg_check_row(struct compiler *c, const struct rg_pass *pass);

/* ---- check_state.c ---- */

enum {
    ALL_CHANNELS = 0xf /* of VkColorComponentFlags */
};

/* Whether what a target holds is blended with, and whether any of it may stay. */
bool rg_is_blended(const struct rg_target *target);
bool rg_keeps_color(const struct rg_target *target);

void rg_check_target(struct compiler *c, const struct rg_target *target);
void rg_check_vertices(struct compiler *c, const struct rg_vertex_layout *v); /* may be NULL */
void rg_check_depth(struct compiler *c, const struct rg_pass *pass);

/* check_shaders.c: compares a row without faults with its shaders, if their code is known. */
void rg_check_shaders(struct compiler *c, const struct rg_pass *row);

/* Before and after all rows: finds constants that no shader has. */
void rg_begin_constants(struct compiler *c);
void rg_end_constants(struct compiler *c);

/* fallback.c: binds a use to its fallback, if it has one and nothing provides its image. Returns
 * whether it does. */
bool rg_use_fallback(struct compiler *c, const struct rg_use *use);

/* Whether it is a use, or the end of a row's uses. */
static inline bool rg_is_use(const struct rg_use *use)
{
    return use->image || use->buffer || use->access;
}

/* Whether it names one resource and an access. */
static inline bool rg_is_good_use(const struct rg_use *use)
{
    return !use->image != !use->buffer && use->access > RG_ACCESS_NONE &&
           use->access < RG_ACCESS_COUNT;
}

/* Returns how many entries of .color may be read, whatever the row says. */
static inline uint32_t rg_color_room(const struct rg_pass *pass)
{
    return rg_is_no_table(pass->color, pass->color_count, RG_COLOR_COUNT) ? 0 : pass->color_count;
}

/* Returns the number of colour targets: they end at the first entry without an image. */
static inline uint32_t rg_color_count(const struct rg_pass *pass)
{
    uint32_t room = rg_color_room(pass);
    uint32_t count = 0;
    while (count < room && pass->color[count].image)
        count++;
    return count;
}

/* ---- resource.c: the resources that tables name ---- */

/* Adds imports and outputs, with their faults. */
void rg_add_boundary(struct compiler *c);

/* Returns the mip levels of a whole chain; `depth` is 1 or more. */
uint32_t rg_full_chain(VkExtent2D extent, uint32_t depth);

/* Returns a side of a mip; any mip may be asked for. */
static inline uint32_t rg_mip_side(uint32_t side, uint32_t mip)
{
    return mip < 32 && side >> mip ? side >> mip : 1;
}

/* Returns the resource of an image or a buffer; a new one is sized and checked. NULL: memory is
 * short. */
struct resource *rg_resource_of(struct compiler *c, const struct rg_image *image,
                                const struct rg_buffer *buffer);

/* ---- the steps, in their order; each needs those before it ---- */

/* expand.c: rows become passes and accesses; finds the faults of rows. */
void rg_expand(struct compiler *c);

/* cull.c: decides which passes live. */
void rg_cull(struct compiler *c);

/* requirements.c: lifetimes of resources, the plan's images and buffers, their memory needs. */
void rg_find_lifetimes(struct compiler *c);
void rg_check_formats(struct compiler *c);
void rg_list_resources(struct compiler *c);

/* memory.c: the blocks of memory, and the place of each item in its block. */
void rg_place_items(struct compiler *c);

/* passes.c: the plan's passes, their targets and uses; barriers.c: the barriers between them. */
void rg_write_passes(struct compiler *c);

/* previous_owner.c: how the accesses end that had an item's memory before it. The first needs
 * places, the second also the state that every cell is left in; it completes the barriers that take
 * over memory. */
void rg_find_owner_ends(struct compiler *c);
void rg_find_owners(struct compiler *c);

/* ---- cell_state.c ---- */

/* Puts every cell into the state in which a frame finds it. */
void rg_begin_cells(struct compiler *c);

typedef void rg_history_read_fn(struct compiler *c, const struct cell_walk *w,
                                const struct access *a);

/* Calls `see` for each read of a persistent cell that finds what the frame before left there, in
 * the layout that the cell has in between. */
void rg_each_history_read(struct compiler *c, rg_history_read_fn *see);

/* ---- barriers.c ---- */

/* Adds what an access of a pass needs. `hands_back`: of an import that goes back, only cells that
 * are not as it arrived. */
void rg_add_barriers(struct compiler *c, const struct access *a, uint32_t pass, bool hands_back);

/* Adds the barriers after the last pass, and those before the first frame. */
void rg_end_barriers(struct compiler *c);

/* ---- pack.c ---- */

struct pack_result {
    VkDeviceSize size;      /* bytes of the block */
    VkDeviceSize apart;     /* bytes if nothing were shared */
    VkDeviceSize bound;     /* no packing is smaller */
    VkDeviceSize least;     /* the bound if items took their memory at the first use */
    VkDeviceSize alignment; /* the largest of all items */
};

/* Fills the offsets of items, which are in the order of first use and end at pass `end` or before.
 * `apart`: nothing is shared. */
struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count,
                           uint32_t end, bool apart);

#endif
