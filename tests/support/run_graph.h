/* run_graph.h: compiles render graphs for a device and executes them; any failure fails the test.
 */
#ifndef TESTS_RUN_GRAPH_H
#define TESTS_RUN_GRAPH_H

#include "graph/rg_cmd.h"
#include "graph/rg_firn.h"
#include "graph/rg_profile.h"
#include "src/gpu/gpu.h"

enum {
    RUN_OUTPUT_COUNT = 10,
    RUN_KEPT_COUNT = 2,
};

struct run_params {
    struct rg_technique technique;
    VkExtent2D view;     /* pixels; 0 means 8 x 8 */
    VkExtent2D max_view; /* passed on to rg_compile_params */
    /* readback buffers that are outputs; NULL-terminated */
    const struct rg_buffer *outputs[RUN_OUTPUT_COUNT + 1];
    struct rg_output kept[RUN_KEPT_COUNT + 1]; /* further outputs; ends at {0} */
    const struct rg_import *imports;
    const struct rg_exec_import *objects; /* Vulkan objects of `imports` */
    size_t import_count;
    const struct rg_exec_set *sets;            /* the application's descriptor set, or NULL */
    const struct rg_exec_sampler *own_sampler; /* the application's, or NULL */
    uint32_t frames_in_flight;
    struct rg_pipelines *pipelines; /* shared with other executors; NULL for none */
    bool render_passes;             /* these three are of struct rg_exec_extensions */
    rg_more_fn *more;
    const struct rg_sampler *same_texel;
    enum rg_sharing sharing;
    VkFlags queues; /* of rg_compile_params; all are the device's main queue, except: */
    const struct rg_exec_queue *transfer; /* NULL for the main queue, too */
    bool no_device;                       /* compile without a device */
    struct rg_measure measure;
    const VkSpecializationInfo *constants;
    bool is_in_parts; /* run_frame() submits the smallest parts */
};

struct run {
    struct run_params params;
    struct rg_vulkan vulkan;
    struct gpu *gpu;
    struct rg_plan *plan;
    struct rg_exec *exec;
    uint32_t slot;  /* frame slot of the last frame */
    char line[512]; /* last line that the executor logged */
    uint32_t line_count;
};

/* Compile parameters of run_plan(). Must not be moved: has pointers into itself and run_params. */
struct run_tables {
    struct rg_compile_params compile;
    struct rg_output outputs[RUN_OUTPUT_COUNT + RUN_KEPT_COUNT];
    const struct rg_technique *technique;
};

void run_tables_init(struct run_tables *tables, const struct run_params *params,
                     const struct rg_device *device);

/* Compiles a plan for a device, or without one if NULL; fails on faults. The caller destroys it. */
struct rg_plan *run_plan(const struct run_params *params, const struct rg_device *device);

/* Creates run->plan for a device; run->exec stays NULL. */
void run_compile(struct run *run, struct gpu *gpu, const struct run_params *params);

/* Creates run->exec for `plan`, which is run->plan or a modified copy of it. Uses volk's current
 * function pointers. May return an error. */
VkResult run_create(struct run *run, const struct rg_plan *plan);

/* Compiles the plan and creates the executor; fails the test on any error. */
void run_open(struct run *run, struct gpu *gpu, const struct run_params *params);
void run_close(struct run *run);

/* Replaces run->plan by the plan of other params. May return an error. */
VkResult run_try_update(struct run *run, const struct run_params *params);
void run_update(struct run *run, const struct run_params *params); /* fails on errors */

/* Runs a frame in the next slot and waits for it. */
void run_frame(struct run *run, const struct rg_frame *frame);

/* Returns the mapped memory of a readback or upload buffer in the last frame's slot. */
void *run_data(struct run *run, const struct rg_buffer *buffer);

enum {
    RUN_VARIANT_COUNT = 4,
};

/* Returns the params changed to one of the four variants of run_variants(). */
struct run_params run_variant(const struct run_params *params, unsigned variant);

/*
 * Runs a frame and checks it in eight variants that must give equal results: dynamic rendering or
 * VkRenderPass objects, with or without memory aliasing of transient resources, as a whole or in
 * parts.
 */
void run_variants(struct gpu *gpu, const struct run_params *params, const struct rg_frame *frame,
                  void (*check)(struct run *run));

/* A pass that copies an image, or a range of it (.mip = 1, ...), to a buffer. */
#define RUN_READ_PART(title, from, to, ...) \
    { \
        .name = (title), .kind = RG_TRANSFER, \
        .uses = RG_USES({ .image = &(from), .access = RG_COPY_SRC, .range = { __VA_ARGS__ } }, \
                        { .buffer = &(to), .access = RG_COPY_DST }), \
        .record = run_record_read, \
    }
#define RUN_READ(title, from, to) RUN_READ_PART(title, from, to, 0)

/* Record function of RUN_READ: copies the image of the first use to the buffer of the second. */
rg_record_fn run_record_read;

#endif
