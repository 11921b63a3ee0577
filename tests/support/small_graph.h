/*
 * small_graph.h: rows of tables for tests that compile but never record, and their plans.
 */
#ifndef TESTS_SMALL_GRAPH_H
#define TESTS_SMALL_GRAPH_H

#include "graph/rg.h"

enum {
    SMALL_GRAPH_SIZE = 16,                                       /* texels of the view */
    SMALL_GRAPH_BYTES = 4 * SMALL_GRAPH_SIZE * SMALL_GRAPH_SIZE, /* of an image of its size */
};

extern const struct rg_shader small_graph_shader; /* of no words */
rg_record_fn small_graph_record;
rg_area_fn small_graph_area;
rg_more_fn small_graph_more;

/* Rows that lack nothing but what the dots say: targets, or uses. */
#define DRAW(title, ...) \
    { \
        .name = (title), .vert = &small_graph_shader, .frag = &small_graph_shader, \
        .record = small_graph_record, __VA_ARGS__ \
    }
#define COMPUTE(title, ...) \
    { \
        .name = (title), .kind = RG_COMPUTE, .comp = &small_graph_shader, \
        .record = small_graph_record, .uses = RG_USES(__VA_ARGS__) \
    }
#define COPY(title, ...) \
    { \
        .name = (title), .kind = RG_TRANSFER, .record = small_graph_record, \
        .uses = RG_USES(__VA_ARGS__) \
    }

/* Four bytes a texel. */
#define IMAGE(...) \
    { \
        .format = VK_FORMAT_R8G8B8A8_UNORM, __VA_ARGS__ \
    }
#define CLEARED(to)  &(to), RG_LOAD_CLEAR
#define TEXTURE(of)  .image = &(of), .access = RG_SAMPLED
#define SAMPLING(of) .uses = RG_USES({ TEXTURE(of) })

/* One technique; outputs and imports end at a row of zeros. */
struct small_graph {
    const struct rg_pass *passes;
    size_t pass_count;
    struct rg_output outputs[4];
    struct rg_import imports[2];
    struct rg_size sizes[1];
    VkExtent2D view; /* 0 means SMALL_GRAPH_SIZE, both ways */
    enum rg_sharing sharing;
};

#define PASSES(table) .passes = (table), .pass_count = sizeof(table) / sizeof((table)[0])
#define WANTS(of)     .outputs = { { .image = &(of), .access = RG_SAMPLED } }

/* The plan, which has no faults; the caller destroys it. */
struct rg_plan *small_graph_compile(const struct small_graph *graph);

/* Index in the plan's images, or RG_NONE. */
uint32_t small_graph_find(const struct rg_plan *plan, const struct rg_image *image);

#endif
