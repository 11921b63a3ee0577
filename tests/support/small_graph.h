/* small_graph.h: macros for small render graphs that tests compile but never execute. */
#ifndef TESTS_SMALL_GRAPH_H
#define TESTS_SMALL_GRAPH_H

#include "graph/rg.h"

enum {
    SMALL_GRAPH_SIZE = 16, /* width and height of the view, pixels */
    SMALL_GRAPH_BYTES = 4 * SMALL_GRAPH_SIZE * SMALL_GRAPH_SIZE, /* RGBA8 bytes of such an image */
};

extern const struct rg_shader small_graph_shader; /* a stub without SPIR-V code */
rg_record_fn small_graph_record;
rg_area_fn small_graph_area;

/* Valid passes with stub shaders; the variable arguments are targets or uses. */
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

/* An image with four bytes per texel. */
#define IMAGE(...) \
    { \
        .format = VK_FORMAT_R8G8B8A8_UNORM, __VA_ARGS__ \
    }
#define CLEARED(to)  &(to), RG_LOAD_CLEAR
#define TEXTURE(of)  .image = &(of), .access = RG_SAMPLED
#define SAMPLING(of) .uses = RG_USES({ TEXTURE(of) })

/* A graph of one technique; `outputs` and `imports` end at an element of zeros. */
struct small_graph {
    const struct rg_pass *passes;
    size_t pass_count;
    struct rg_output outputs[4];
    struct rg_import imports[2];
    struct rg_size sizes[1];
    VkExtent2D view; /* 0 means SMALL_GRAPH_SIZE for width and height */
    enum rg_sharing sharing;
};

#define PASSES(table) .passes = (table), .pass_count = sizeof(table) / sizeof((table)[0])
#define WANTS(of)     .outputs = { { .image = &(of), .access = RG_SAMPLED } }

/* Compiles the graph; fails the test if the plan has faults. The caller destroys the plan. */
struct rg_plan *small_graph_compile(const struct small_graph *graph);

/* Returns the index of an image in the plan, or RG_NONE. */
uint32_t small_graph_find(const struct rg_plan *plan, const struct rg_image *image);

#endif
