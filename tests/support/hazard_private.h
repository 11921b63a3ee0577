/*
 * hazard_private.h: declarations shared by the files of the hazard checker.
 *
 * A cell is a subresource, the smallest unit of a barrier: a mip, layer and aspect of an image, or
 * a whole buffer. Time is counted in slots: slot 0 is before the first frame, slot 1 has the
 * initial barriers; in each frame every pass has a slot, and one more follows for accesses after
 * the frame. A slot's barriers are executed before its pass.
 *
 * The frames are simulated once for each scenario, which defines the conditions that are true in
 * each frame.
 */
#ifndef TESTS_HAZARD_PRIVATE_H
#define TESTS_HAZARD_PRIVATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "graph/rg.h"

/* Bits of pipeline stages; the graphics stages come first, in pipeline order. */
enum {
    HAZARD_INDIRECT = 1 << 0,
    HAZARD_INDEX = 1 << 1,
    HAZARD_ATTRIBUTE = 1 << 2,
    HAZARD_VERTEX = 1 << 3,
    HAZARD_EARLY = 1 << 4,
    HAZARD_FRAGMENT = 1 << 5,
    HAZARD_LATE = 1 << 6,
    HAZARD_COLOR = 1 << 7,
    HAZARD_COMPUTE = 1 << 8,
    HAZARD_COPY = 1 << 9,
    HAZARD_RESOLVE = 1 << 10,
    HAZARD_BLIT = 1 << 11,
    HAZARD_CLEAR = 1 << 12,
    HAZARD_BUILD = 1 << 13, /* of acceleration structures */
    HAZARD_HOST = 1 << 14,
    HAZARD_STAGE_COUNT = 15,
    HAZARD_GRAPHICS = (1 << 8) - 1,
    HAZARD_DEVICE = (1 << 14) - 1, /* all but the host */
    HAZARD_SHADERS = HAZARD_VERTEX | HAZARD_FRAGMENT | HAZARD_COMPUTE,
};

/* Content of a subresource. If written, it is HAZARD_WRITTEN + frame * pass_count + the index of
 * the declared pass that wrote it. */
enum {
    HAZARD_UNDEFINED,
    HAZARD_ZERO,
    HAZARD_IMPORTED,
    HAZARD_UPLOADED,
    HAZARD_WRITTEN,
};

enum {
    HAZARD_FRAMES = 3,         /* frames to simulate with persistent resources; 2 without */
    HAZARD_FIRST_SLOT = 2,     /* first slot of the first frame */
    HAZARD_CONDITIONS = 16,    /* largest number of distinct conditions */
    HAZARD_SCENARIOS = 64,     /* maximum number of scenarios */
    HAZARD_SOME_SCENARIOS = 6, /* minimum number of scenarios if there are conditions */
    HAZARD_PASSES_RUN = 4000,  /* approximate limit of pass executions over all scenarios */
};

/* The Vulkan access, stages, layout and usage flags of an rg_access. */
struct hazard_rule {
    VkAccessFlags2 reads, writes;
    uint32_t stages;      /* stages; 0 means the shader stages of the pass */
    VkImageLayout layout; /* layout of imports and outputs with this access */
    VkImageUsageFlags image_usage;
    VkBufferUsageFlags buffer_usage;
};

const struct hazard_rule *hazard_rule(enum rg_access access);

/* Converts a stage mask to HAZARD_ bits. Expands meta stages, but adds no implied stages. */
uint32_t hazard_stages(VkPipelineStageFlags2 stages, bool source);
uint32_t hazard_earlier(uint32_t stages);              /* adds logically earlier stages */
uint32_t hazard_later(uint32_t stages);                /* adds logically later stages */
VkAccessFlags2 hazard_accesses(VkAccessFlags2 access); /* expands meta accesses */
VkAccessFlags2 hazard_accesses_of(uint32_t stage);     /* accesses that one stage supports */
bool hazard_access_fits(uint32_t stages, VkAccessFlags2 access); /* stages support access */
bool hazard_layout_fits(VkImageLayout layout, enum rg_access access, VkImageAspectFlags aspects);
VkImageUsageFlags hazard_layout_usage(VkImageLayout layout); /* any one suffices; 0 for none */
VkImageAspectFlags hazard_aspects(VkFormat format);
uint32_t hazard_texel_size(VkFormat format); /* lower bound, bytes */

/* An image or buffer that the graph declares. */
struct hazard_resource {
    const struct rg_image *image; /* or NULL and: */
    const struct rg_buffer *buffer;
    uint32_t plan;                  /* index in the plan's images or buffers, or RG_NONE */
    const struct rg_import *import; /* may be NULL */
    const struct rg_output *output; /* may be NULL */
    bool persistent;
    /* image that it is swapped with after a frame (rg_image.previous), or RG_NONE */
    uint32_t partner;
    VkExtent2D extent;
    uint32_t mips, layers, samples, depth;
    VkDeviceSize size; /* of a buffer, bytes */
    VkImageAspectFlags aspects;
    uint32_t first_cell, cell_count;
    uint32_t first, last;              /* first and last pass of the plan that accesses it */
    uint32_t first_alias, alias_count; /* resources that overlap it in memory */
    uint64_t touched;     /* time of the last access or transition of any subresource */
    uint64_t overwritten; /* time of the last write to an aliased resource */
};

/* An access that a pass declares, in one repetition of the pass. */
struct hazard_use {
    uint32_t resource;
    enum rg_access access;
    VkImageSubresourceRange range; /* of images only; counts resolved */
    uint32_t stages;
    VkAccessFlags2 reads, writes;
    bool needs_content, gives_content;
    /* partial write, which needs the old content only if the result is needed */
    bool keeps_content;
    const struct rg_target *target; /* or NULL and: */
    const struct rg_use *use;
    bool resolve;            /* true for the resolve attachment of the target */
    bool dropped;            /* trailing target whose result nothing needs, not in the plan */
    uint32_t first_expected; /* first hazard_expected, one per subresource */
};

/* Expected content of a subresource when a pass accesses it. */
struct hazard_expected {
    uint32_t content;
    bool wanted; /* false if any content is valid */
};

struct hazard_pass {
    const struct rg_pass *pass;
    const struct rg_technique *technique;
    uint32_t row, repetition;
    uint32_t step; /* offset from the row's layer or mip level */
    uint32_t first_use, use_count;
    uint32_t condition; /* number of the condition, from 1; 0 if unconditional */
    bool useful;        /* an output may depend on the pass in some scenario */
    bool needed;        /* an output depends on the pass in the current scenario */
    bool lives;         /* is in the plan, not culled */
};

/* A barrier with expanded stage and access masks. */
struct hazard_barrier {
    uint32_t src, dst;
    uint32_t earlier, later; /* hazard_earlier(src), hazard_later(dst) */
    VkAccessFlags2 src_access, dst_access;
    bool transition;
};

/* Stages in each slot up to `last` that are ordered after a given stage of a given slot. */
struct hazard_reach {
    uint16_t *after; /* NULL until first used */
    uint32_t last;
};

/* A past access to a subresource. */
struct hazard_record {
    uint32_t slot;
    uint32_t stages;
    VkAccessFlags2 access;
    bool available; /* a barrier made the write available to `stages` and `access` */
};

/* List node: a past read, or barrier number `barrier` in slot record.slot. */
struct hazard_node {
    struct hazard_record record;
    uint32_t barrier;
    uint32_t next; /* index of the next node; RG_NONE at the end */
};

struct hazard_subresource {
    uint32_t resource;
    bool written; /* true if `write` is valid */
    struct hazard_record write;
    uint32_t reads, barriers, last_barrier; /* indices of list nodes since the last write */
    uint32_t content;
    uint32_t declared; /* declared content during the forward analysis */
    /* backward analysis: content is needed later in the frame (wanted), or in the next (carried) */
    bool wanted, carried;
    VkImageLayout layout;
    uint64_t touched; /* time of the last access or transition */
    uint64_t changed; /* time of the last write or transition */
    uint32_t batch;   /* slot of the subresource's last barrier */
};

struct hazard {
    const struct rg_plan *plan;
    const struct rg_compile_params *params;
    FILE *report;
    uint32_t findings;
    uint32_t frame_count, frame, slot, slot_count;
    bool *happens_after; /* by submissions: element [b * submission_count + a] is true if b waits */
    rg_when_fn *conditions[HAZARD_CONDITIONS];
    uint32_t condition_count;
    uint32_t scenario, scenario_count;
    bool every_scenario; /* false if scenarios are a random sample */
    uint64_t time;
    struct hazard_resource *resources;
    struct hazard_pass *passes; /* all declared passes and their repetitions, in order */
    struct hazard_use *uses;
    struct hazard_subresource *cells;
    struct hazard_barrier *barriers; /* parallel to the plan's barriers, including initial ones */
    struct hazard_node *nodes;
    struct hazard_expected *expected; /* `expected_count` for each frame */
    uint32_t *ends;                   /* final content of all subresources for each frame */
    uint32_t *aliases;
    uint32_t *plan_passes, *plan_images, *plan_buffers; /* indices in the tables */
    struct hazard_reach *reach;                         /* one element per slot and stage */
    uint32_t resource_count, pass_count, use_count, cell_count, node_count;
    uint32_t expected_count, alias_count;
    uint32_t resource_capacity, pass_capacity, use_capacity, cell_capacity, node_capacity,
        alias_capacity;
};

/* An access to check: of a pass, of the application after the frame, or of a layout transition. */
struct hazard_event {
    uint32_t slot;
    uint32_t stages;
    VkAccessFlags2 reads, writes;
    const struct hazard_barrier *transition; /* NULL if it is no layout transition */
    bool returned; /* returned import, whose stages the application waits for */
};

/* hazard_checker.c */
void hazard_report(struct hazard *h, const char *format, ...) __attribute__((format(printf, 2, 3)));
void hazard_report_subresource(struct hazard *h, uint32_t cell, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void *hazard_grow(void *array, uint32_t *capacity, uint32_t count, size_t size);
/* Returns the next subresource of a range, RG_NONE at the end; *index must be 0 at first. */
uint32_t hazard_next_subresource(const struct hazard_resource *resource,
                                 const VkImageSubresourceRange *range, uint32_t *index);

/* hazard_graph_tables.c: fills resources, passes, uses and subresources. */
void hazard_tables(struct hazard *h);

/* Returns the partner's subresource, or `cell` if its resource has no partner. */
static inline uint32_t hazard_partner(const struct hazard *h, uint32_t cell)
{
    const struct hazard_resource *resource = &h->resources[h->cells[cell].resource];
    if (resource->partner == RG_NONE)
        return cell;
    return h->resources[resource->partner].first_cell + cell - resource->first_cell;
}

/* Returns true if the subresource has the content that its partner had in the last frame. */
static inline bool hazard_is_history(const struct hazard *h, uint32_t cell)
{
    const struct hazard_resource *resource = &h->resources[h->cells[cell].resource];
    return resource->partner != RG_NONE && resource->image->previous;
}

/* hazard_expected_content.c: computes the useful passes and the expected content. */
void hazard_expect_useful(struct hazard *h);
void hazard_expect(struct hazard *h);
struct hazard_expected *hazard_expected(const struct hazard *h, const struct hazard_use *use,
                                        uint32_t frame); /* of its first subresource */
bool hazard_runs(const struct hazard *h, const struct hazard_pass *pass, uint32_t frame);

/* Memory that the plan binds to a resource. */
struct hazard_binding {
    uint32_t block;
    VkDeviceSize offset, size;
    bool persistent;
};

/* hazard_memory.c: checks sizes, flags, memory and lifetimes; fills the alias lists. */
void hazard_check_memory(struct hazard *h);
struct hazard_binding hazard_memory_binding(const struct hazard *h,
                                            const struct hazard_resource *resource);

/* hazard_min_batches.c: computes the minimum number of barrier batches without memory aliasing. */
uint32_t hazard_min_batches(const struct hazard *h);

/* hazard_statistics.c: checks the plan's statistics of memory and batches. */
void hazard_check_statistics(struct hazard *h);

/* hazard_queues.c: checks the submissions. Returns false if they are broken. */
bool hazard_check_queues(struct hazard *h);
enum rg_queue hazard_queue_of(const struct hazard *h, uint32_t slot);
/* Returns true if semaphores order slot `to` after slot `from`. */
bool hazard_waits(const struct hazard *h, uint32_t from, uint32_t to);
/* Returns true if a queue other than the main one has passes that access the resource. */
bool hazard_has_queues(const struct hazard *h, const struct hazard_resource *resource);

/* hazard_synchronization.c: tracks synchronization of one subresource. */
void hazard_sync_reset(struct hazard *h, uint32_t cell); /* resets to no history */
void hazard_sync_event(struct hazard *h, uint32_t cell, const struct hazard_event *event);
void hazard_sync_barrier(struct hazard *h, uint32_t cell, uint32_t barrier);
void hazard_sync_import(struct hazard *h, uint32_t cell, uint32_t slot, enum rg_access access);
bool hazard_sync_overwritten(const struct hazard *h, uint32_t cell); /* overwritten by alias */

/* hazard_simulate_frame.c: simulates the time before the first frame, and frame h->frame. */
void hazard_frame_before(struct hazard *h);
void hazard_frame(struct hazard *h);

#endif
