/*
 * hazard_private.h: declarations shared by the files of the hazard checker.
 *
 * A cell is the smallest unit of a barrier: a mip, layer and aspect of an image, or a buffer.
 * Time is counted in slots: slot 0 is before the first frame, slot 1 has the initial barriers; in
 * each frame every pass has a slot, and one more follows for accesses after the frame. A slot's
 * barriers are executed before its pass.
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

/* Pipeline stages, one bit each; those of the graphics pipeline first and in its order. */
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

/* Content of a cell: one of these, or HAZARD_WRITTEN plus the declared pass, counted on from frame
 * to frame. */
enum {
    HAZARD_UNDEFINED,
    HAZARD_ZERO,
    HAZARD_IMPORTED,
    HAZARD_UPLOADED,
    HAZARD_WRITTEN,
};

enum {
    HAZARD_FRAMES = 3,         /* with history; else 2 */
    HAZARD_FIRST_SLOT = 2,     /* of the first frame */
    HAZARD_CONDITIONS = 16,    /* told apart */
    HAZARD_SCENARIOS = 64,     /* at most */
    HAZARD_SOME_SCENARIOS = 6, /* at least, if there are conditions */
    HAZARD_PASSES_RUN = 4000,  /* over all scenarios, about */
};

/* What an access is to Vulkan. */
struct hazard_rule {
    VkAccessFlags2 reads, writes;
    uint32_t stages;      /* 0: the shader's */
    VkImageLayout layout; /* in which imports arrive and outputs leave */
    VkImageUsageFlags image_usage;
    VkBufferUsageFlags buffer_usage;
};

const struct hazard_rule *hazard_rule(enum rg_access access);

/* Stages of a mask, without those it only implies; meta stages expanded. */
uint32_t hazard_stages(VkPipelineStageFlags2 stages, bool source);
uint32_t hazard_earlier(uint32_t stages);                        /* and the logically earlier */
uint32_t hazard_later(uint32_t stages);                          /* and the logically later */
VkAccessFlags2 hazard_accesses(VkAccessFlags2 access);           /* meta accesses expanded */
VkAccessFlags2 hazard_accesses_of(uint32_t stage);               /* what one stage can do */
bool hazard_access_fits(uint32_t stages, VkAccessFlags2 access); /* no impossible access */
bool hazard_layout_fits(VkImageLayout layout, enum rg_access access, VkImageAspectFlags aspects);
VkImageUsageFlags hazard_layout_usage(VkImageLayout layout); /* one of these is needed; 0: none */
VkImageAspectFlags hazard_aspects(VkFormat format);
uint32_t hazard_texel_size(VkFormat format); /* bytes at least */

/* An image or buffer named anywhere in the tables. */
struct hazard_resource {
    const struct rg_image *image; /* or: */
    const struct rg_buffer *buffer;
    uint32_t plan;                  /* index in the plan's images or buffers, or RG_NONE */
    const struct rg_import *import; /* may be NULL */
    const struct rg_output *output; /* may be NULL */
    bool persistent;
    VkExtent2D extent;
    uint32_t mips, layers, samples, depth;
    VkDeviceSize size; /* of a buffer */
    VkImageAspectFlags aspects;
    uint32_t first_cell, cell_count;
    uint32_t first, last;              /* plan passes that touch it */
    uint32_t first_alias, alias_count; /* resources that share memory with it */
    uint64_t touched;                  /* time of the last access or transition of any cell */
    uint64_t overwritten;              /* time of the last write of an alias */
};

/* The tables' word on one access of one repetition of a row. */
struct hazard_use {
    uint32_t resource;
    enum rg_access access;
    VkImageSubresourceRange range; /* counts resolved; of images only */
    uint32_t stages;
    VkAccessFlags2 reads, writes;
    bool needs_content, gives_content;
    bool keeps_content;             /* partial: what was there is needed only if the result is */
    const struct rg_target *target; /* or: */
    const struct rg_use *use;
    bool resolve;            /* of the target */
    uint32_t first_expected; /* one for each of its cells */
};

/* What one cell of a use should hold when the pass runs. */
struct hazard_expected {
    uint32_t content;
    bool wanted; /* or else it may hold anything */
};

struct hazard_pass {
    const struct rg_pass *pass;
    const struct rg_technique *technique;
    uint32_t row, repetition;
    uint32_t first_use, use_count;
    uint32_t condition; /* 0: none; else from 1 */
    bool useful;        /* an output may need it in some scenario */
    bool needed;        /* an output needs it in this one */
    bool lives;         /* is in the plan */
};

/* A barrier with its masks expanded. */
struct hazard_barrier {
    uint32_t src, dst;
    uint32_t earlier, later; /* hazard_earlier(src), hazard_later(dst) */
    VkAccessFlags2 src_access, dst_access;
    bool transition;
};

/* For each slot up to `last`, the stages ordered after a stage in a slot; 0 before that. */
struct hazard_reach {
    uint16_t *after; /* NULL: not yet asked for */
    uint32_t last;
};

/* A past access of a cell. */
struct hazard_record {
    uint32_t slot;
    uint32_t stages;
    VkAccessFlags2 access;
    bool available; /* then stages and access are those it is visible to */
};

/* A list's element: a read (record) or a barrier (its slot in the record, and index). */
struct hazard_node {
    struct hazard_record record;
    uint32_t barrier;
    uint32_t next; /* RG_NONE at the end */
};

struct hazard_cell {
    uint32_t resource;
    bool written; /* so there is a last write: */
    struct hazard_record write;
    uint32_t reads, barriers, last_barrier; /* nodes since the last write */
    uint32_t content;
    uint32_t declared;    /* while the tables are read: the content that they say it has */
    bool wanted, carried; /* while they are read backwards: someone needs its content; the next
                             frame does */
    VkImageLayout layout;
    uint64_t touched; /* time of the last access or transition */
    uint64_t changed; /* time of the last write or transition */
    uint32_t batch;   /* slot of the last barrier on it */
};

struct hazard {
    const struct rg_plan *plan;
    const struct rg_compile_params *params;
    FILE *report;
    uint32_t findings;
    uint32_t frame_count, frame, slot, slot_count;
    rg_when_fn *conditions[HAZARD_CONDITIONS];
    uint32_t condition_count;
    uint32_t scenario, scenario_count;
    bool every_scenario; /* else a sample */
    uint64_t time;
    struct hazard_resource *resources;
    struct hazard_pass *passes; /* of the tables, in their order */
    struct hazard_use *uses;
    struct hazard_cell *cells;
    struct hazard_barrier *barriers; /* as many as the plan's, with the initial ones */
    struct hazard_node *nodes;
    struct hazard_expected *expected; /* `expected_count` for each frame */
    uint32_t *ends;                   /* contents at the end of each frame, of all cells */
    uint32_t *aliases;
    uint32_t *plan_passes, *plan_images, *plan_buffers; /* of the tables, for each of the plan */
    struct hazard_reach *reach;                         /* of slot and stage */
    uint32_t resource_count, pass_count, use_count, cell_count, node_count;
    uint32_t expected_count, alias_count;
    uint32_t resource_room, pass_room, use_room, cell_room, node_room, alias_room;
};

/* An access about to happen: by a pass or the outside, or (transition) by a barrier. */
struct hazard_event {
    uint32_t slot;
    uint32_t stages;
    VkAccessFlags2 reads, writes;
    const struct hazard_barrier *transition; /* may be NULL */
    bool handed_back; /* to the outside, which orders itself after accesses of its own kind */
};

/* hazard.c */
void hazard_find(struct hazard *h, const char *format, ...) __attribute__((format(printf, 2, 3)));
void hazard_find_cell(struct hazard *h, uint32_t cell, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void *hazard_grow(void *array, uint32_t *room, uint32_t count, size_t size);
/* Steps through the cells of a range; begin with `index` 0, ends with RG_NONE. */
uint32_t hazard_next_cell(const struct hazard_resource *resource,
                          const VkImageSubresourceRange *range, uint32_t *index);

/* hazard_tables.c: fills resources, passes, uses and cells. */
void hazard_tables(struct hazard *h);

/* hazard_expect.c: which passes are useful; what this scenario's passes find and frames leave. */
void hazard_expect_useful(struct hazard *h);
void hazard_expect(struct hazard *h);
struct hazard_expected *hazard_expected(const struct hazard *h, const struct hazard_use *use,
                                        uint32_t frame); /* of its first cell */
bool hazard_runs(const struct hazard *h, const struct hazard_pass *pass, uint32_t frame);

/* Where the plan puts a resource. */
struct hazard_place {
    uint32_t block;
    VkDeviceSize offset, size;
    bool persistent;
};

/* hazard_memory.c: sizes, flags, places and lifetimes; fills aliases. */
void hazard_memory(struct hazard *h);
struct hazard_place hazard_memory_place(const struct hazard *h,
                                        const struct hazard_resource *resource);

/* hazard_batches.c: how many batches are enough if no memory is shared. */
uint32_t hazard_batches(const struct hazard *h);

/* hazard_optimal.c: what the plan says of bytes and batches. */
void hazard_optimal(struct hazard *h);

/* hazard_sync.c: what happens to a cell. */
void hazard_sync_forget(struct hazard *h, uint32_t cell); /* all of it; history is filled with 0 */
void hazard_sync_event(struct hazard *h, uint32_t cell, const struct hazard_event *event);
void hazard_sync_barrier(struct hazard *h, uint32_t cell, uint32_t barrier);
void hazard_sync_arrive(struct hazard *h, uint32_t cell, uint32_t slot, enum rg_access access);
bool hazard_sync_lost(const struct hazard *h, uint32_t cell); /* memory since used by others */

/* hazard_frame.c: what comes before the first frame; runs the frame h->frame. */
void hazard_frame_before(struct hazard *h);
void hazard_frame(struct hazard *h);

#endif
