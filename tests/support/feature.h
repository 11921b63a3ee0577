/*
 * feature.h: a small graph for each feature of the render graph.
 *
 * Two tests use each table: tests/gpu runs it and checks the results, and tests/unit/test_plans.c
 * compares its plan with tests/golden/<name>.txt.
 */
#ifndef TESTS_FEATURE_H
#define TESTS_FEATURE_H

#include "tests/gpu/shaders/data.h"
#include "tests/support/painted.h"

struct feature {
    const char *name; /* of the file with its plan */
    struct run_params params;
};

enum {
    FEATURE_COUNT = 16,
};

extern const struct feature *const feature_list[FEATURE_COUNT];

/* ---- what several use ---- */

enum {
    FEATURE_SIZE = 8, /* texels: width and height of the view */
    FEATURE_TEXELS = FEATURE_SIZE * FEATURE_SIZE,
};

/* Of the shaders that number texels: a struct data_seed, written before each frame. */
extern const struct rg_buffer feature_seed;
#define FEATURE_SEED \
    { \
        .buffer = &feature_seed, .access = RG_UNIFORM, .binding = DATA_SEED \
    }

/* One number a texel, to be read back. */
#define FEATURE_NUMBERS(title) \
    { \
        .name = (title), .size_per_texel = sizeof(uint32_t), .memory = RG_MEMORY_READBACK \
    }

rg_record_fn feature_record_texels; /* a workgroup for each DATA_GROUP x DATA_GROUP texels */
rg_record_fn feature_record_copy;   /* the row's first buffer to its second one */

/* A row that does the latter. */
#define FEATURE_COPY(title, from, to) \
    { \
        .name = (title), .kind = RG_TRANSFER, \
        .uses = RG_USES({ .buffer = &(from), .access = RG_COPY_SRC }, \
                        { .buffer = &(to), .access = RG_COPY_DST }), \
        .record = feature_record_copy, \
    }

/* What makes a row number an image and a buffer, see fill.comp. */
#define FEATURE_FILL(texels, numbers) FEATURE_FILL_BY(feature_record_texels, texels, numbers)
#define FEATURE_FILL_BY(record_function, texels, numbers) \
    .kind = RG_COMPUTE, \
    .uses = RG_USES( \
        FEATURE_SEED, { .image = &(texels), .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS }, \
        { .buffer = &(numbers), .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS }), \
    .comp = &fill_comp, .record = (record_function)

/* A row that adds an image to a buffer, see add.comp. */
#define FEATURE_ADD(title, texels, numbers) \
    { \
        .name = (title), .kind = RG_COMPUTE, \
        .uses = RG_USES( \
            { .image = &(texels), .access = RG_STORAGE_READ, .binding = DATA_TEXELS }, \
            { .buffer = &(numbers), .access = RG_STORAGE_READ_WRITE, .binding = DATA_NUMBERS }), \
        .comp = &add_comp, .record = feature_record_texels, \
    }

/* ---- feature_history.c: persistent images: added to, of the frame before, depth, parts ---- */

extern const struct feature feature_history;

enum {
    HISTORY_SUM, /* rows to paint, then outputs */
    HISTORY_SEE,
    HISTORY_BEFORE,
    HISTORY_KEEP,
    HISTORY_NEAREST,
    HISTORY_LAYERS,
    HISTORY_MIPS,
    HISTORY_PAINT_COUNT,

    HISTORY_SEEN_OUT = 0,
    HISTORY_BEFORE_OUT,
    HISTORY_DEPTH_OUT,
    HISTORY_NEAREST_OUT,
    HISTORY_LAYERS_OUT, /* of HISTORY_SIDE texels a side */
    HISTORY_MIPS_OUT,   /* and on: one a mip, the first of HISTORY_SIDE texels a side */

    HISTORY_SIDE = 4,
    HISTORY_LAYER_COUNT = 3,
    HISTORY_MIP_COUNT = 3,
};

/* The same of buffers: numbers added to each frame, bytes of the frame before. */
extern const struct feature feature_history_buffers;
extern const struct rg_buffer feature_history_bytes_in; /* what the next frame finds */

enum {
    HISTORY_TOTAL_OUT,
    HISTORY_BYTES_OUT,

    HISTORY_BYTES = 6,
};

/* ---- feature_when.c: rows that run only in frames that want it ---- */

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
    WHEN_PASS_COUNT = 5 + WHEN_LAYER_COUNT, /* that are asked */
};

/* ---- feature_repeat.c: a row for every layer, or every mip ---- */

extern const struct feature feature_per_layer;

enum {
    PER_LAYER_CUBE_OUT,
    PER_LAYER_COPY_OUT,
    PER_LAYER_SEEN_OUT, /* one texel a face */

    PER_LAYER_SIDE = 3,
};

extern const struct feature feature_per_mip;

enum {
    PER_MIP_FROM_2_OUT,
    PER_MIP_FROM_3_OUT,
    PER_MIP_TO_0_OUT,
    PER_MIP_TO_1_OUT,
};

/* ---- feature_samples.c: several samples a texel ---- */

/* Resolved: a triangle, into a mip of one layer and of another, per layer, of one target of two,
 * history, integers. */
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
    RESOLVE_PART_OUT, /* of half the view; two layers */
    RESOLVE_LAYERS_OUT,
    RESOLVE_SECOND_OUT,
    RESOLVE_KEPT_OUT,
    RESOLVE_NUMBERS_OUT,

    RESOLVE_LAYER_COUNT = 3,
};

/* Fetched one by one: colour and depth. */
extern const struct feature feature_samples;

enum {
    SAMPLES_TRIANGLE, /* rows to paint, then outputs */
    SAMPLES_PAINT_COUNT,

    SAMPLES_COLOR_OUT = 0,
    SAMPLES_DEPTH_OUT,
};

/* ---- feature_resources.c: other resources ---- */

/* An image of three dimensions: stored mip by mip, sampled, copied. */
extern const struct feature feature_volume;

enum {
    VOLUME_LOOK_OUT,
    VOLUME_TEXELS_OUT,

    VOLUME_DEPTH = 4,
};

/* An array of descriptors, the last of which is a fallback, and a set of the program's own. */
extern const struct feature feature_array;
extern const struct rg_set feature_array_set; /* a storage buffer of four numbers */

enum {
    ARRAY_FALLBACK = 7,
};

/* As many draws as a buffer says, each of which adds 1. */
extern const struct feature feature_count;
extern const struct rg_buffer feature_count_commands; /* a struct count_commands, of the CPU */

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

/* ---- feature_structure.c: acceleration structures ---- */

/* Rays along -z, from texels of a unit square, meet a triangle; 1 where they do. */
extern const struct feature feature_structure;
extern const struct rg_buffer feature_structure_triangle; /* three vec3s, of the CPU */

enum {
    STRUCTURE_SIZE = 1 << 16,     /* bytes; enough for each of both, and to build it */
    STRUCTURE_ALIGNMENT = 1 << 8, /* of the scratch memory; no device wants more */
};

/* ---- feature_data.c: what is no target ---- */

/* Storage images and buffers, sampled and copied afterwards. */
extern const struct feature feature_texels; /* a buffer that is sampled */
extern const struct feature feature_storage;

enum {
    STORAGE_NUMBERS_OUT,
    STORAGE_NEXT_OUT,
    STORAGE_LIST_OUT,
};

/* Draws and dispatches as many as a shader has written: 3 * seed vertices or indices. */
extern const struct feature feature_indirect;
extern const struct rg_vertex_layout feature_indirect_vertices; /* of vec2s in clip space */

enum {
    INDIRECT_NUMBERS_OUT,
    INDIRECT_DRAWN_OUT,
    INDIRECT_MESH_OUT,
};

/* Adds to an image and a buffer that come from outside and go back. */
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

/* Draws to an image whose content does not count and that is shown afterwards. */
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
