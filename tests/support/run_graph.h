/*
 * run_graph.h: compiles tables for a device and runs them; any failure fails the test.
 */
#ifndef TESTS_RUN_GRAPH_H
#define TESTS_RUN_GRAPH_H

#include "graph/rg_cmd.h"
#include "graph/rg_time.h"
#include "src/gpu/gpu.h"

enum {
    RUN_OUTPUT_COUNT = 8,
    RUN_KEPT_COUNT = 2,
};

struct run_params {
    struct rg_technique technique;
    VkExtent2D view;                 /* texels; 0 means 8 x 8 */
    VkExtent2D max_view, max_region; /* of rg_compile_params, as is */
    /* read back after the frame, in memory that the host reads; ends at NULL */
    const struct rg_buffer *outputs[RUN_OUTPUT_COUNT + 1];
    struct rg_output kept[RUN_KEPT_COUNT + 1]; /* more outputs; ends at {0} */
    const struct rg_import *imports;
    const struct rg_exec_import *objects; /* behind the imports */
    size_t import_count;
    const struct rg_exec_set *sets; /* of the program's own; of all rows' the first */
    uint32_t frames_in_flight;
    struct rg_pipelines *pipelines; /* NULL: none of other executors */
    bool render_passes;
    enum rg_sharing sharing;
    bool no_device; /* to compile for */
    struct rg_measure measure;
    const VkSpecializationInfo *constants;
};

struct run {
    struct run_params params;
    struct rg_vulkan vulkan;
    struct gpu *gpu;
    struct rg_plan *plan;
    struct rg_exec *exec;
    uint32_t slot;  /* of the last frame */
    char line[512]; /* that the executor has logged last */
    uint32_t line_count;
};

/* What run_plan() compiles. Points into itself and into the params: must not move. */
struct run_tables {
    struct rg_compile_params compile;
    struct rg_output outputs[RUN_OUTPUT_COUNT + RUN_KEPT_COUNT];
    const struct rg_technique *technique;
};

void run_tables_init(struct run_tables *tables, const struct run_params *params,
                     const struct rg_device *device);

/* Compiles for a device; NULL: for none. The caller destroys the plan, which has no faults. */
struct rg_plan *run_plan(const struct run_params *params, const struct rg_device *device);

/* Makes run->plan for a device. run->exec is NULL. */
void run_compile(struct run *run, struct gpu *gpu, const struct run_params *params);

/* Makes run->exec for a plan: run->plan, or a changed copy of it; it calls the functions that
 * volk's pointers hold now. May fail. */
VkResult run_create(struct run *run, const struct rg_plan *plan);

/* run_compile(), and run_create() without failure. */
void run_open(struct run *run, struct gpu *gpu, const struct run_params *params);
void run_close(struct run *run);

/* Puts the plan of other params in the place of run->plan. May fail. */
VkResult run_try_update(struct run *run, const struct run_params *params);
void run_update(struct run *run, const struct run_params *params); /* without failure */

/* Runs a frame in the next slot and waits for it. */
void run_frame(struct run *run, const struct rg_frame *frame);

/* What the last frame left in a readback buffer, or its upload buffer to write to. */
void *run_data(struct run *run, const struct rg_buffer *buffer);

enum {
    RUN_WAY_COUNT = 4,
};

/* The same with the rendering and the sharing of one of the four ways below. */
struct run_params run_way(const struct run_params *params, unsigned way);

/*
 * Runs a frame and checks it, in four ways that must not differ: with dynamic rendering and with
 * VkRenderPass objects, with transient resources in shared memory and without.
 */
void run_everywhere(struct gpu *gpu, const struct run_params *params, const struct rg_frame *frame,
                    void (*check)(struct run *run));

/* A row that copies all of an image, or a part (.mip = 1, ...), to a buffer. */
#define RUN_READ_PART(title, from, to, ...) \
    { \
        .name = (title), .kind = RG_TRANSFER, \
        .uses = RG_USES({ .image = &(from), .access = RG_COPY_SRC, .range = { __VA_ARGS__ } }, \
                        { .buffer = &(to), .access = RG_COPY_DST }), \
        .record = run_record_read, \
    }
#define RUN_READ(title, from, to) RUN_READ_PART(title, from, to, 0)

/* For such a row: its first use is the image, its second the buffer. */
rg_record_fn run_record_read;

#endif
