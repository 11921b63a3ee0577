/*
 * feature_graphs.h: one small graph for each feature of the render graph.
 *
 * Two tests use each graph: tests/gpu runs it and checks the results, and tests/unit/test_plans.c
 * compares its plan with tests/golden/<name>.txt.
 */
#ifndef TESTS_SUPPORT_FEATURE_GRAPHS_H
#define TESTS_SUPPORT_FEATURE_GRAPHS_H

#include "tests/gpu/shaders/data.h"
#include "tests/support/rectangle_rows.h"

struct feature {
    const char *name; /* stem of the plan's file name in tests/golden */
    struct run_params params;
};

enum {
    FEATURE_COUNT = 16,
};

extern const struct feature *const feature_list[FEATURE_COUNT];

/* ---- shared by several features ---- */

enum {
    FEATURE_SIZE = 8, /* width and height of the view, pixels */
    FEATURE_TEXELS = FEATURE_SIZE * FEATURE_SIZE,
};

/* Uniform buffer with a struct data_seed, for shaders that number texels; written every frame. */
extern const struct rg_buffer feature_seed;
#define FEATURE_SEED \
    { \
        .buffer = &feature_seed, .access = RG_UNIFORM, .binding = DATA_SEED \
    }

/* A readback buffer with one uint32_t per texel. */
#define FEATURE_NUMBERS(title) \
    { \
        .name = (title), .size_per_texel = sizeof(uint32_t), .memory = RG_MEMORY_READBACK \
    }

rg_record_fn feature_record_texels; /* one workgroup per DATA_GROUP x DATA_GROUP texels */
rg_record_fn feature_record_copy;   /* copies the first buffer of the pass to the second */

/* A pass that copies one buffer to another. */
#define FEATURE_COPY(title, from, to) \
    { \
        .name = (title), .kind = RG_TRANSFER, \
        .uses = RG_USES({ .buffer = &(from), .access = RG_COPY_SRC }, \
                        { .buffer = &(to), .access = RG_COPY_DST }), \
        .record = feature_record_copy, \
    }

/* Members of a compute pass that writes numbers to an image and a buffer; see fill.comp. */
#define FEATURE_FILL(texels, numbers) FEATURE_FILL_BY(feature_record_texels, texels, numbers)
#define FEATURE_FILL_BY(record_function, texels, numbers) \
    .kind = RG_COMPUTE, \
    .uses = RG_USES( \
        FEATURE_SEED, { .image = &(texels), .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS }, \
        { .buffer = &(numbers), .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS }), \
    .comp = &fill_comp, .record = (record_function)

/* A compute pass that adds the texels of an image to a buffer; see add.comp. */
#define FEATURE_ADD(title, texels, numbers) \
    { \
        .name = (title), .kind = RG_COMPUTE, \
        .uses = RG_USES( \
            { .image = &(texels), .access = RG_STORAGE_READ, .binding = DATA_TEXELS }, \
            { .buffer = &(numbers), .access = RG_STORAGE_READ_WRITE, .binding = DATA_NUMBERS }), \
        .comp = &add_comp, .record = feature_record_texels, \
    }

/* ---- feature_persistent.c: persistent images with sums, depth, layers and mips ---- */

extern const struct feature feature_history;

enum {
    HISTORY_SUM, /* rows to paint, then outputs */
    HISTORY_SEE,
    HISTORY_BEFORE,
    HISTORY_KEEP,
    HISTORY_NOW,
    HISTORY_LAST,
    HISTORY_NEAREST,
    HISTORY_LAYERS,
    HISTORY_MIPS,
    HISTORY_PAINT_COUNT,

    HISTORY_SEEN_OUT = 0,
    HISTORY_BEFORE_OUT,
    HISTORY_NOW_OUT,
    HISTORY_LAST_OUT,
    HISTORY_DEPTH_OUT,
    HISTORY_NEAREST_OUT,
    HISTORY_LAYERS_OUT, /* each layer is HISTORY_SIDE texels wide */
    HISTORY_MIPS_OUT,   /* one output per mip; mip 0 is HISTORY_SIDE texels wide */

    HISTORY_SIDE = 4,
    HISTORY_LAYER_COUNT = 3,
    HISTORY_MIP_COUNT = 3,
};

/* Persistent buffers: a total over all frames, and bytes that were copied a frame earlier. */
extern const struct feature feature_history_buffers;
extern const struct rg_buffer feature_history_bytes_in; /* content of the next frame's bytes */

enum {
    HISTORY_TOTAL_OUT,
    HISTORY_BYTES_OUT,

    HISTORY_BYTES = 6,
};

/* ---- feature_conditional_rows.c: conditional passes, which run only in some frames ---- */

extern const struct feature feature_when;

enum {
    WHEN_CAPTURE, /* rows to paint, then outputs */
    WHEN_SHOW,
    WHEN_CLEAR,
    WHEN_MARK,
    WHEN_FIRST,
    WHEN_SECOND,
    WHEN_PAINT_COUNT,

    WHEN_SHOWN_OUT = 0,
    WHEN_BOARD_OUT,
    WHEN_RESULT_OUT,
    WHEN_SNAPSHOT_OUT,
    WHEN_NUMBERS_OUT,
    WHEN_LIST_OUT,

    WHEN_LAYER_COUNT = 2,
    WHEN_PASS_COUNT = 5 + WHEN_LAYER_COUNT, /* passes whose condition is evaluated */
};

/* ---- feature_repeated_rows.c: passes repeated for every layer or mip ---- */

extern const struct feature feature_per_layer;

enum {
    PER_LAYER_CUBE_OUT,
    PER_LAYER_COPY_OUT,
    PER_LAYER_SEEN_OUT, /* one texel per cube face */

    PER_LAYER_SIDE = 3,
};

extern const struct feature feature_per_mip;

enum {
    PER_MIP_FROM_2_OUT,
    PER_MIP_FROM_3_OUT,
    PER_MIP_TO_0_OUT,
    PER_MIP_TO_1_OUT,
};

/* ---- feature_multisampling.c: multisampling ---- */

/* Multisample resolves: to single mips and layers, per layer, of one of two targets, of a
 * persistent image and of integers. */
extern const struct feature feature_resolve;
extern const struct rg_image feature_resolve_part, feature_resolve_layers;

enum {
    RESOLVE_TRIANGLE, /* rows to paint, then outputs */
    RESOLVE_OTHER,
    RESOLVE_PART,
    RESOLVE_LAYERS,
    RESOLVE_TWO,
    RESOLVE_KEEP,
    RESOLVE_NUMBERS,
    RESOLVE_PAINT_COUNT,

    RESOLVE_TRIANGLE_OUT = 0,
    RESOLVE_PART_OUT, /* two layers of half the view's extent */
    RESOLVE_LAYERS_OUT,
    RESOLVE_SECOND_OUT,
    RESOLVE_KEPT_OUT,
    RESOLVE_NUMBERS_OUT,

    RESOLVE_LAYER_COUNT = 3,
};

/* Shaders that fetch single samples of colour and depth. */
extern const struct feature feature_samples;

enum {
    SAMPLES_TRIANGLE, /* rows to paint, then outputs */
    SAMPLES_PAINT_COUNT,

    SAMPLES_COLOR_OUT = 0,
    SAMPLES_DEPTH_OUT,
};

/* ---- feature_volume_array.c: 3D images, descriptor arrays, indirect counts ---- */

/* A 3D image that is written mip by mip, sampled and copied. */
extern const struct feature feature_volume;

enum {
    VOLUME_LOOK_OUT,
    VOLUME_TEXELS_OUT,

    VOLUME_DEPTH = 4,
};

/* A descriptor array whose last image has a fallback, and a descriptor set of the application. */
extern const struct feature feature_array;
extern const struct rg_set feature_array_set; /* a storage buffer of four numbers */

enum {
    ARRAY_FALLBACK = 7,
};

/* Indirect draws whose draw count is read from a buffer; each draw adds 1 to the texels. */
extern const struct feature feature_count;
extern const struct rg_buffer feature_count_commands; /* a count_commands from the host */

enum {
    COUNT_DRAWN_OUT,
    COUNT_MESH_OUT,

    COUNT_MAX = 3,
};

struct count_commands {
    uint32_t count;
    VkDrawIndirectCommand draws[COUNT_MAX];
    VkDrawIndexedIndirectCommand meshes[COUNT_MAX];
};

/* ---- feature_acceleration_structure.c: acceleration structures ---- */

/* Traces rays along -z from the texels of a unit square; writes 1 where a ray hits a triangle. */
extern const struct feature feature_structure;

/* ---- feature_storage_indirect.c: storage resources, indirect commands, imports ---- */

/* Storage images and buffers that later passes sample and copy. */
extern const struct feature feature_texels; /* a sampled texel buffer */
extern const struct feature feature_storage;

enum {
    STORAGE_NUMBERS_OUT,
    STORAGE_NEXT_OUT,
    STORAGE_LIST_OUT,
};

/* Indirect draws and dispatches whose counts a shader writes: 3 * seed vertices or indices. */
extern const struct feature feature_indirect;
extern const struct rg_vertex_layout feature_indirect_vertices; /* one vec2 in clip space */

enum {
    INDIRECT_NUMBERS_OUT,
    INDIRECT_DRAWN_OUT,
    INDIRECT_MESH_OUT,
};

/* Adds to an imported image and buffer that are returned to the application. */
extern const struct feature feature_imports;
extern const struct rg_image feature_imports_picture;
extern const struct rg_buffer feature_imports_totals;

enum {
    IMPORTS_ADD, /* rows to paint, then outputs */
    IMPORTS_LOOK,
    IMPORTS_PAINT_COUNT,

    IMPORTS_SEEN_OUT = 0,
    IMPORTS_TOTALS_OUT,
};

/* Draws to an imported image, discarding its content, and presents it like a swapchain image. */
extern const struct feature feature_present;
extern const struct rg_image feature_present_picture;

enum {
    PRESENT_PAINT, /* rows to paint, then outputs */
    PRESENT_LOOK,
    PRESENT_PAINT_COUNT,

    PRESENT_PICTURE_OUT = 0,
    PRESENT_SEEN_OUT,
};

#endif
