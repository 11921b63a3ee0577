/*
 * compiler.h: what the compiler's steps share. Private to graph/.
 *
 * Words: a *pass* here is one repetition of a row; an *access* is one use or target of a pass with
 * its range resolved; a *cell* is one (aspect, mip, layer) of an image, or a whole buffer: the
 * unit of every state the compiler tracks.
 */
#ifndef RG_COMPILE_COMPILER_H
#define RG_COMPILE_COMPILER_H

#include "graph/compile/arena.h"
#include "graph/rg.h"

/* ---- what the tables say ---- */

/* Whether earlier passes have filled a cell; from CELL_FILLED_BY on, if a condition holds. */
enum {
    CELL_EMPTY,
    CELL_FILLED,
    CELL_FILLED_BY, /* plus the index of a conditional pass */
};

enum {
    ACCESS_READS_CONTENT = 1 << 0,  /* needs what earlier passes left */
    ACCESS_WRITES_CONTENT = 1 << 1, /* leaves something for later ones */
    ACCESS_OVERWRITES = 1 << 2,     /* nothing of the range's earlier content remains */
    ACCESS_NEEDED = 1 << 3,         /* of a target: somebody wants what it writes */
    ACCESS_CONDITIONAL = 1 << 4,    /* does not happen in every frame */
};

enum {
    CELL_CERTAIN = 1 << 0, /* the last write is of this frame, and of every frame */
    CELL_AWAITED = 1 << 1, /* a read of every frame has waited for it */
    CELL_FRESH = 1 << 2,   /* shared memory that this frame has not used: who had it is not known */
    CELL_CHANGED = 1 << 3, /* content or layout, by this frame */
};

/* In an order that lets neighbours be written together (rg_state_write()). */
struct cell {
    VkPipelineStageFlags2 write_stages; /* of the last write, or that it was chained on to */
    VkAccessFlags2 write_access;        /* of it, while not yet available */
    VkPipelineStageFlags2 read_stages;  /* since then */
    uint32_t visible;                   /* to whom the write was made visible (rg_visibility) */
    uint32_t barrier_end;               /* of the access that made the write visible first, or 0 */
    VkImageLayout layout;
    uint32_t flags;
    uint32_t written, touched; /* the first pass after the last write, and after the last access */
    uint32_t first_barrier;    /* as barrier_end */
    uint32_t last_access;      /* one more than the index of the latest one found */
    uint32_t filled;
    bool wanted;      /* by later passes or outputs, while culling; of one of several */
    bool wanted_next; /* of a persistent resource: by the next frame */
    bool changed;     /* the same, in rg_state_each_early(): by the passes so far */
};

/* What later passes or outputs want of a resource, while culling. */
enum wanted {
    WANT_NOTHING,
    WANT_ALL = ACCESS_WRITES_CONTENT, /* of an access's flags */
    WANT_CELLS = 1 << 8,              /* none of these: it has several, and each says it */
};

#define RG_SIZE_OVERFLOW UINT64_MAX

struct resource {
    const void *address;          /* of: */
    const struct rg_image *image; /* this or: */
    const struct rg_buffer *buffer;
    struct cell *cells; /* of a single one: &cell */
    uint32_t cell_count;
    bool persistent;
    bool shared; /* transient, in a block */
    bool plain;  /* one cell, and nothing but its access can be wrong with a use of all of it */
    enum wanted wanted;
    VkImageSubresourceRange all; /* of an image */
    VkExtent2D extent;
    const struct rg_format_info *format; /* NULL: unknown, or a buffer */
    VkDeviceSize size;                   /* of a buffer, as declared; or RG_SIZE_OVERFLOW */
    uint32_t import;                     /* index into the params' imports, or RG_NONE */
    uint32_t output;                     /* index into the params' outputs, or RG_NONE */
    /* of the living passes: */
    uint32_t first, last;  /* plan passes; first RG_NONE: unused */
    VkFlags usage;         /* VkImageUsageFlags or VkBufferUsageFlags */
    uint32_t plan_image;   /* index into the plan's images, or RG_NONE */
    uint32_t plan_buffer;  /* the same of its buffers */
    uint32_t item;         /* in compiler.items, or RG_NONE: it shares no memory */
    uint32_t last_barrier; /* of several cells: index of the newest one, or RG_NONE */
    uint32_t taken;        /* of an item: the pass before which the memory changes hands */
    struct cell cell;
};

/* What an access does, in Vulkan's words; many accesses share one. */
struct effect {
    enum rg_access access;
    uint32_t visibility; /* that it needs (rg_visibility) */
    VkImageLayout layout;
    VkFlags usage; /* VkImageUsageFlags or VkBufferUsageFlags */
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 mask;   /* all it does */
    VkAccessFlags2 writes; /* of it */
};

struct access {
    struct resource *resource;
    const struct effect *effect;
    const void *declared; /* const struct rg_use or rg_target */
    uint32_t range;       /* one more than its index in compiler.ranges; 0: all (rg_range_of) */
    uint32_t flags;
};

struct pass {
    const struct rg_technique *technique;
    const struct rg_pass *rg;
    uint32_t row, repetition;
    VkExtent2D extent;
    uint32_t first_access, access_count;
    bool alive;
};

/* Where a fault lies; unused fields are NULL or RG_NONE. */
struct place {
    const struct rg_technique *technique;
    uint32_t row;
    const char *resource;
};

/* Open addressing; NULL is an empty slot. */
struct resource_map {
    struct resource **slots;
    uint32_t mask; /* one less than how many, half of which stay empty */
};

enum name_kind {
    NAME_RESOURCE,
    NAME_PASS,
    NAME_KIND_COUNT,
};

/* The same of names of a kind. */
struct name_map {
    const char **slots;
    uint32_t mask;
    uint32_t room; /* for so many more */
};

/* What an access means as a use of a kind of pass, as long as the use says nothing special. */
struct meaning {
    struct effect on_image, on_buffer;
    VkPipelineStageFlags2 shaders; /* that such a pass has */
    uint32_t flags;                /* of the access */
    bool fits;                     /* the kind of pass */
    bool image, buffer;            /* fits, and either can be used so */
};

/* A transient resource that shares memory; in the order of first use. */
struct pack_item {
    VkDeviceSize size, alignment; /* a power of two */
    VkDeviceSize offset;
    struct resource *resource;

    union {
        struct rg_plan_image *image;
        struct rg_plan_buffer *buffer; /* if it is_buffer */
    };

    uint32_t first_use, last; /* passes */
    uint32_t first;           /* from it on the memory is taken; not after the first use */
    uint32_t type_bits;
    bool is_buffer;
};

/* Who had the memory of an item before it, in this frame or the one before. */
struct former {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 writes; /* not yet available */
    uint32_t end;          /* the first pass of this frame after them; 0: none in this one */
};

struct compiler {
    const struct rg_compile_params *params;
    struct rg_plan *plan;
    struct arena *arena;
    uint32_t max_image_size, max_layers; /* the device's, or Vulkan's where it has no limit */
    struct resource *resources;
    uint32_t resource_count, resource_room;
    uint32_t end_count; /* of the first resources: imports and outputs are among them */
    uint32_t persistent_count;
    struct resource_map map;
    struct name_map names[NAME_KIND_COUNT];
    struct pass *passes;
    uint32_t pass_count, pass_room;
    struct access *accesses;
    uint32_t access_count, access_room;
    VkImageSubresourceRange *ranges; /* of accesses to some cells of several */
    uint32_t range_count, range_room;
    uint32_t alive_access_count;
    uint32_t color_access_count;    /* of colour targets, alive or not */
    struct rg_plan_image *images;   /* the plan's, still to be written */
    struct rg_plan_buffer *buffers; /* the same */
    struct rg_plan_target *colors;  /* the same */
    struct pack_item *items;
    uint32_t item_count;
    uint32_t *item_places;  /* where each has gone, if rg_place() has moved them; or NULL */
    struct former *formers; /* of the items */
    struct rg_fault *faults;
    uint32_t fault_count, fault_room;
    uint32_t row_first_fault;                    /* of the row being looked at */
    struct meaning (*meanings)[RG_ACCESS_COUNT]; /* by enum rg_kind */
    uint32_t known[RG_TRANSFER + 1];             /* a bit each, of those filled in so far */
    const struct meaning *of_shaders[RG_TRANSFER + 1][RG_ACCESS_COUNT]; /* of these: what shaders do
                                                                           to images; or NULL */
};

/* ---- rg_fault.c ---- */

/* Faults of one row that are told already are left out. */
void rg_fault_add(struct compiler *c, enum rg_error error, struct place place, const char *hint);

/* Brings the faults from `later` on before those from `first` on. */
void rg_fault_reorder(struct compiler *c, uint32_t first, uint32_t later);

/* ---- rg_format.c ---- */

enum {
    RG_FORMAT_COUNT = VK_FORMAT_D32_SFLOAT_S8_UINT + 1, /* from 0 to the last one known */
};

extern const struct rg_format_info rg_format_table[RG_FORMAT_COUNT];

/* rg_format_info() */
static inline const struct rg_format_info *rg_format_find(VkFormat format)
{
    if ((size_t)format >= RG_FORMAT_COUNT || !rg_format_table[format].name)
        return NULL;
    return &rg_format_table[format];
}

/* ---- rg_resource.c ---- */

/* Room for about so many. */
void rg_resource_expect(struct compiler *c, uint32_t count);

/* The import and output lists; faults of them. */
void rg_add_ends(struct compiler *c);

/* Adds a resource, which is checked and sized, and may move the others; NULL: memory is short.
 * `slot` is its own. */
struct resource *rg_resource_add(struct compiler *c, const struct rg_image *image,
                                 const struct rg_buffer *buffer, struct resource **slot);

/* The same of an image as most are: transient, of colour, of one cell. NULL, and nothing is done,
 * if it is another one, or there may be something to be said of it, or no room. */
struct resource *rg_resource_add_plain(struct compiler *c, const struct rg_image *image,
                                       struct resource **slot);

/* Where in the map a resource is, or would be. Neighbours in the tables are neighbours in the map,
 * and soon in the cache; higher bits are added for those that lie a power of two apart. */
static inline struct resource **rg_resource_slot(const struct resource_map *map,
                                                 const void *address)
{
    uintptr_t at = (uintptr_t)address;
    uint32_t i = (uint32_t)((at + (at >> 9)) >> 4) & map->mask;
    while (map->slots[i] && map->slots[i]->address != address)
        i = (i + 1) & map->mask;
    return &map->slots[i];
}

/* The resource, which is added when it is new. */
static inline struct resource *rg_resource_of(struct compiler *c, const struct rg_image *image,
                                              const struct rg_buffer *buffer)
{
    const void *address = image ? (const void *)image : (const void *)buffer;
    struct resource **slot = rg_resource_slot(&c->map, address);
    return *slot ? *slot : rg_resource_add(c, image, buffer, slot);
}

const char *rg_resource_name(const struct resource *r); /* "?" if it has none */

/* Or the end of a row's uses. */
static inline bool rg_is_use(const struct rg_use *use)
{
    return use->image || use->buffer || use->access;
}

/* Of one resource. */
static inline bool rg_is_good_use(const struct rg_use *use)
{
    return !use->image != !use->buffer && use->access > RG_ACCESS_NONE &&
           use->access < RG_ACCESS_COUNT;
}

/* ---- rg_walk.c: the cells of an access ---- */

/* Of a buffer: zeros. */
static inline const VkImageSubresourceRange *rg_range_of(const struct compiler *c,
                                                         const struct access *a)
{
    return a->range ? &c->ranges[a->range - 1] : &a->resource->all;
}

/* for (struct cell_walk w = rg_walk(r, range); rg_walk_next(&w);) */
struct cell_walk {
    const struct resource *resource;
    VkImageSubresourceRange range;
    uint32_t aspect; /* index among the resource's aspects, from the lowest bit */
    uint32_t mip, layer;
    struct cell *cell;
    bool started;
};
struct cell_walk rg_walk(const struct resource *r, const VkImageSubresourceRange *range);
bool rg_walk_next(struct cell_walk *walk);

/* ---- rg_check.c, rg_check_row.c ---- */

void rg_check_params(struct compiler *c);
void rg_check_output_memory(struct compiler *c, const struct resource *r);
void rg_check_resource(struct compiler *c, struct resource *r); /* but for its name */
void rg_check_tell(struct compiler *c, const struct resource *r, enum rg_error error,
                   const char *hint);

/* But for its name. Not needed if rg_is_simple_row(). */
void rg_check_row(struct compiler *c, const struct rg_pass *pass, const struct place *place);

/* The rest of it: faults of its uses, and that neither these nor its targets write. Not needed if
 * rg_is_fine_use() holds for all of them, their bindings differ and something is written. */
void rg_check_uses(struct compiler *c, const struct rg_pass *pass, const struct place *place);

/* Whether a good use cannot have faults, as the most cannot. */
static inline bool rg_is_fine_use(const struct rg_use *use, const struct meaning *m)
{
    if (use->stages & ~m->shaders)
        return false;
    if (use->image)
        return m->image && use->image->samples <= 1;
    return m->buffer &&
           (use->buffer->memory != RG_MEMORY_UPLOAD || !(m->flags & ACCESS_WRITES_CONTENT));
}

/* Entries of .color that can be looked at, whatever the row says. */
static inline uint32_t rg_color_room(const struct rg_pass *pass)
{
    if (!pass->color)
        return 0;
    return pass->color_count < RG_COLOR_COUNT ? pass->color_count : RG_COLOR_COUNT;
}

/* Colour targets: they end at the first entry without an image. */
static inline uint32_t rg_color_count(const struct rg_pass *pass)
{
    uint32_t room = rg_color_room(pass);
    uint32_t count = 0;
    while (count < room && pass->color[count].image)
        count++;
    return count;
}

static inline bool rg_is_push_size(uint32_t size)
{
    return size <= RG_MAX_PUSH && size % 4 == 0;
}

/* Whether a row is one that computes, once in every frame, and says nothing of drawing: by itself
 * it cannot have faults, its name and uses left out. */
static inline bool rg_is_simple_row(const struct rg_pass *pass)
{
    return pass->kind == RG_COMPUTE && pass->repeat == RG_ONCE && !pass->when && pass->comp &&
           pass->record && pass->uses && !pass->color_count && !pass->depth.image &&
           rg_is_push_size(pass->push_size);
}

/* Whether targets are written, or the lack of them is another fault. */
static inline bool rg_draws(const struct rg_pass *pass)
{
    return pass->kind == RG_RASTER &&
           (rg_color_count(pass) || !pass->depth.image || !pass->depth_read_only);
}

/* The row's kind; a wild value counts as compute. */
static inline enum rg_kind rg_kind_of(const struct rg_pass *pass)
{
    return (unsigned)pass->kind <= RG_TRANSFER ? pass->kind : RG_COMPUTE;
}

static inline bool rg_is_shader_access(enum rg_access access)
{
    return access >= RG_SAMPLED && access <= RG_UNIFORM;
}

/* ---- rg_expand.c: passes and accesses from the rows; faults of rows, ranges and content ---- */

void rg_expand(struct compiler *c);

/* ---- rg_access.c ---- */

extern const struct rg_access_info rg_access_table[RG_ACCESS_COUNT]; /* rg_access_info() */

/* The (stage, access) pairs of a read, one bit each. Bit 31 stands for all that is not told apart
 * and never counts as visible. */
uint32_t rg_visibility(enum rg_access access, VkPipelineStageFlags2 stages);

#define RG_VISIBLE_TO_ALL UINT32_C(0x7fffffff)

/* On an image; `reads` says whether the mask has what the access may read. */
struct effect rg_effect(enum rg_access access, bool reads, VkPipelineStageFlags2 stages);

/* Of a valid access. */
void rg_meaning_learn(struct meaning *m, enum rg_kind kind, enum rg_access access);

static inline const struct meaning *rg_meaning(struct compiler *c, enum rg_kind kind,
                                               enum rg_access access)
{
    struct meaning *m = &c->meanings[kind][access];
    if (!(c->known[kind] >> access & 1)) {
        rg_meaning_learn(m, kind, access);
        c->known[kind] |= UINT32_C(1) << access;
        c->of_shaders[kind][access] = m->image && rg_is_shader_access(access) ? m : NULL;
    }
    return m;
}

/* ---- rg_cull.c: which passes live ---- */

void rg_cull(struct compiler *c);

/* ---- rg_list.c: the plan's images and buffers in order of first use, and their memory ---- */

/* Faults of what the device cannot do with formats. */
void rg_check_formats(struct compiler *c);

/* Numbers a resource: a living pass is the first to name it. */
static inline void rg_meet(struct compiler *c, struct resource *r, uint32_t pass)
{
    if (r->image)
        r->plan_image = c->plan->image_count++;
    else
        r->plan_buffer = c->plan->buffer_count++;
    r->first = pass;
    if (r->persistent)
        r->usage |= r->image ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (r->shared)
        r->item = c->item_count++;
    r->taken = pass;
}

static inline void rg_follow(struct compiler *c, struct resource *r, VkFlags usage, uint32_t pass)
{
    if (r->first == RG_NONE)
        rg_meet(c, r, pass);
    r->last = pass;
    r->usage |= usage;
}

void rg_follow_passes(struct compiler *c);

/* After the last pass. */
void rg_follow_outputs(struct compiler *c);

/* Of all that was followed. */
void rg_list(struct compiler *c);

/* ---- rg_sync.c: barriers, in batches; rg_sync.h has the rest of it ---- */

struct sync {
    struct compiler *c;
    struct rg_plan_pass *passes; /* the plan's; those so far are filled */
    struct rg_barrier *barriers;
    uint32_t barrier_count, barrier_room;
    uint32_t batch_first; /* barrier of the newest batch */
    uint32_t batch_end;   /* one more than the pass it lies before; 0: there is none yet */
    bool changes_early;   /* memory changes hands in the batch, which may be an earlier one */
};

void rg_sync_begin(struct sync *sync, struct rg_plan_pass *passes);

/* The barriers after the last pass, and before the first frame. */
void rg_sync_end(struct sync *sync);

/* Once it is known who had which memory before: what the first barriers wait for. */
void rg_sync_takeovers(struct sync *sync);

/* ---- rg_state.c; rg_state.h has the rest of it ---- */

/* Every cell as the frame finds it. */
void rg_state_begin(struct compiler *c);

typedef void rg_early_fn(void *user, struct resource *r, const struct cell_walk *w,
                         const struct access *a);

/* Sees every read of a persistent cell that finds what the frame before left, in the layout that
 * the cell is in now: that in which a frame finds and leaves it. */
void rg_state_each_early(struct compiler *c, rg_early_fn *see, void *user);

/* ---- rg_end.c: what is done to a whole resource outside the frame ---- */

/* `effect` is for what it does. */
struct access rg_end_access(struct resource *r, enum rg_access access, struct effect *effect);

static inline VkFlags rg_usage(const struct resource *r, enum rg_access access)
{
    const struct rg_access_info *info = &rg_access_table[access];
    return r->image ? info->image_usage : info->buffer_usage;
}

/* All shader stages that the graph knows: those of imports and outputs. */
#define RG_ANY_SHADER \
    (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | \
     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)

/* ---- rg_emit.c: the plan's passes, their targets and uses ---- */

void rg_emit(struct compiler *c, struct sync *sync);

/* ---- rg_place.c: the place of every transient resource ---- */

/* Before or after the barriers are known (enum rg_sharing). */
void rg_place(struct compiler *c);

/* After rg_place(): when those who had the memory before are over. */
void rg_place_ends(struct compiler *c);

/* After rg_place(), and when what cells are left in is known: what those leave behind. */
void rg_place_left(struct compiler *c);

/* ---- spans of bytes: rising, and none touches the next; one more is at UINT64_MAX ---- */

struct span {
    VkDeviceSize begin, end;
};

/* Before `next`. No memmove(): there are few behind it. */
static inline void rg_span_insert(struct span *next, struct span span)
{
    while (span.begin != UINT64_MAX) {
        struct span moved = *next;
        *next++ = span;
        span = moved;
    }
    *next = span;
}

/* ---- rg_pack.c ---- */

struct pack_result {
    VkDeviceSize size;       /* bytes of the block */
    VkDeviceSize apart;      /* if nothing were shared */
    VkDeviceSize bound;      /* no packing can be smaller */
    VkDeviceSize least;      /* the same if items took their memory at the first use */
    VkDeviceSize alignments; /* of all items, each a bit */
};

/* Fills the items' offsets. None lives beyond the pass `end`. */
struct pack_result rg_pack(struct arena *arena, struct pack_item *items, uint32_t count,
                           uint32_t end, bool apart);

/* ---- rg_former.c: who had the memory of the items of a block, in the order of first use ---- */

/* `end` of each former. */
void rg_former_ends(struct arena *arena, const struct pack_item *items, struct former *formers,
                    uint32_t count);

/* What each item finds, left behind when the frame before was over. */
void rg_former_left(struct arena *arena, const struct pack_item *items, struct former *formers,
                    uint32_t count);

/* The same, if each follows itself. */
void rg_former_itself(struct arena *arena, const struct pack_item *items, struct former *formers,
                      uint32_t count);

#endif
