/*
 * rg_internal.h: what the compiler's steps share. Private to graph/.
 *
 * Words: a *pass* here is one repetition of a row; an *access* is one use or target of a pass with
 * its range resolved; a *cell* is one (aspect, mip, layer) of an image, or a whole buffer: the
 * unit of every state the compiler tracks.
 */
#ifndef RG_INTERNAL_H
#define RG_INTERNAL_H

#include "graph/rg.h"

/* Memory that is freed all at once. After a failed allocation `failed` stays true. */
struct arena {
    struct arena_chunk *chunks;
    size_t size; /* bytes taken from malloc */
    bool failed;
};

/* Zeroed room for count elements, aligned for any type; NULL when memory is short. */
void *arena_alloc(struct arena *arena, size_t count, size_t element_size);
void arena_finish(struct arena *arena);

#define ARENA_ARRAY(arena, type, count) ((type *)arena_alloc((arena), (count), sizeof(type)))

/* Whoever used a resource's memory before it, in this frame or the one before. */
struct former {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 writes; /* not yet available */
    uint32_t end;          /* the first pass of this frame after them; 0: none in this frame */
};

#define RG_SIZE_OVERFLOW UINT64_MAX

struct resource {
    const struct rg_image *image; /* this or: */
    const struct rg_buffer *buffer;
    const char *name; /* "?" if it has none */
    uint32_t import;  /* index into the params' imports, or RG_NONE */
    uint32_t output;  /* index into the params' outputs, or RG_NONE */
    VkExtent2D extent;
    uint32_t layers, mips;
    VkImageAspectFlags aspects; /* 0 for buffers */
    VkDeviceSize size;          /* of a buffer, as declared; or RG_SIZE_OVERFLOW */
    uint32_t first_cell, cell_count;
    /* of the living passes: */
    uint32_t first, last; /* plan passes; first RG_NONE: unused */
    VkFlags usage;        /* VkImageUsageFlags or VkBufferUsageFlags */
    uint32_t plan_index;  /* in the plan's images or buffers */
    struct rg_memory_need need;
    VkPipelineStageFlags2 tail_stages; /* that touch it last in a frame */
    VkAccessFlags2 tail_writes;        /* their writes not yet made available */
    struct former former;              /* transient ones */
};

struct access {
    uint32_t resource;
    enum rg_access access;
    VkImageSubresourceRange range; /* images */
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 reads, writes; /* access masks */
    VkImageLayout layout;
    bool reads_content;       /* needs what earlier passes left */
    bool writes_content;      /* leaves something for later ones */
    bool overwrites;          /* nothing of the range's earlier content remains */
    bool needed;              /* somebody wants what it writes: STORE */
    const struct rg_use *use; /* NULL: a target */
    const struct rg_target *target;
};

struct pass {
    uint32_t technique, row, repetition;
    const struct rg_pass *rg;
    VkExtent2D extent;
    uint32_t first_access, access_count;
    bool alive;
};

/* Open addressing from a resource's address to its index. */
struct resource_map {
    const void **keys;
    uint32_t *values;
    uint32_t mask;
};

struct compiler {
    const struct rg_compile_params *params;
    struct rg_plan *plan;
    struct arena *arena;  /* the plan's */
    struct arena scratch; /* freed at the end of the compilation */
    struct resource *resources;
    uint32_t resource_count;
    struct resource_map map;
    struct pass *passes;
    uint32_t pass_count;
    struct access *accesses;
    uint32_t access_count;
    uint32_t cell_count;
    struct rg_plan_image *images;   /* the plan's, still to be written */
    struct rg_plan_buffer *buffers; /* the same */
    struct rg_fault *faults;        /* of room for fault_room */
    uint32_t fault_count, fault_room;
};

/* Where a fault lies; unused fields are NULL or RG_NONE. */
struct place {
    const struct rg_technique *technique;
    uint32_t row;
    const char *resource;
};

/* rg_resource.c */

/* Finds every resource that the tables name, in the order in which they name them. */
void rg_collect(struct compiler *c);

/* Their sizes, layers, mips and cells. */
void rg_resolve(struct compiler *c);

const struct rg_technique *rg_technique_of(const struct compiler *c, const struct pass *pass);

bool rg_is_use(const struct rg_use *use);      /* or the end of a row's uses */
bool rg_is_good_use(const struct rg_use *use); /* of one resource */

/* How many uses a row has. */
size_t rg_use_count(const struct rg_pass *pass);

/* Index of the resource at this address, or RG_NONE. */
uint32_t rg_find(const struct compiler *c, const void *address);

/* The cell of a resource. `aspect` counts the set bits of its aspects from the lowest. */
uint32_t rg_cell(const struct resource *r, uint32_t aspect, uint32_t mip, uint32_t layer);

/* Calls for each cell of an access: for (struct cell_walk w = rg_walk(c, a); rg_walk_next(&w);) */
struct cell_walk {
    const struct resource *resource;
    VkImageSubresourceRange range;
    uint32_t aspect; /* index among the resource's aspects */
    uint32_t mip, layer;
    uint32_t cell;
    bool started;
};
struct cell_walk rg_walk(const struct compiler *c, const struct access *access);
bool rg_walk_next(struct cell_walk *walk);

/* rg_check.c */
void rg_fault_add(struct compiler *c, enum rg_error error, struct place place, const char *hint);
void rg_check_params(struct compiler *c);
void rg_check_resources(struct compiler *c);
void rg_check_passes(struct compiler *c);

/* rg_expand.c: the passes and their accesses, from the rows; faults of ranges. */
void rg_expand(struct compiler *c);

/* rg_cull.c: what is read before it is written; which passes live; first and last uses. */
void rg_check_content(struct compiler *c);
void rg_cull(struct compiler *c);
void rg_lifetimes(struct compiler *c);

/* rg_pack.c */

/* Something to be placed, and its place. */
struct pack_item {
    VkDeviceSize size, alignment;
    uint32_t first, last; /* passes; both included */
    uint32_t index;       /* among the items: settles ties */
    VkDeviceSize offset;
    struct resource *resource;
};

struct pack_result {
    VkDeviceSize size;  /* bytes of the block */
    VkDeviceSize apart; /* if nothing were shared */
    VkDeviceSize bound; /* no packing can be smaller */
};

/* Fills the items' offsets. */
struct pack_result rg_pack(struct arena *scratch, struct pack_item *items, size_t count,
                           bool apart);

/* rg_overlap.c: fills `former` of the resources of a block, given in the order of first use. */
void rg_overlap(struct arena *scratch, const struct pack_item *items, uint32_t count);

/* rg_alias.c: the place of every transient resource, and who had it before. Needs lifetimes, usage
 * and tails. */
void rg_place(struct compiler *c);

/* rg_batch.c */

/* A barrier and the batches it may lie in: before any of the plan's passes release..deadline. */
struct transition {
    struct rg_barrier barrier;
    uint32_t release, deadline;
};

/* In the order of their deadlines. */
struct transitions {
    struct transition *items;
    uint32_t count, room;
};

void rg_transition_add(struct arena *scratch, struct transitions *list, const struct transition *t);

/* Joins the last ones from index `first` on, all of one access, while their ranges make one. */
void rg_transition_join(struct transitions *list, uint32_t first);

/* Writes the plan's barriers, batch by batch. */
void rg_batch(struct compiler *c, const struct transitions *list, struct rg_plan_pass *passes);

/* rg_tail.c: who touches each resource last in a frame. */
void rg_find_tails(struct compiler *c);

/* What is done to a whole resource outside the frame. */
struct access rg_end_access(const struct compiler *c, uint32_t resource, enum rg_access access);

/* What an output is wanted for; RG_ACCESS_NONE if it is none. */
enum rg_access rg_output_access(const struct compiler *c, const struct resource *r);

/* All shader stages that the graph knows: those of imports and outputs. */
#define RG_ANY_SHADER \
    (VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | \
     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)

/* rg_sync.c: barriers, plan passes, targets. Needs places. */
void rg_sync(struct compiler *c);

#endif
