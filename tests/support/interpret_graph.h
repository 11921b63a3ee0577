/*
 * interpret_graph.h: reference interpreter of graph tables on the CPU, to compute expected results.
 *
 * Rows run in the order of the table, one repetition after another, without culling, aliasing or
 * frames in flight. Transient resources begin each frame with garbage, so that reads before writes
 * are detected. A pass does what random.frag, random.comp or a copy does; all formats except depth
 * have unsigned integers, so that results are exact.
 */
#ifndef TESTS_SUPPORT_INTERPRET_GRAPH_H
#define TESTS_SUPPORT_INTERPRET_GRAPH_H

#include "graph/rg.h"
#include "tests/gpu/shaders/random.h"

enum {
    INTERPRET_DISPATCH = 0, /* byte offset of a VkDispatchIndirectCommand in an indirect buffer */
    INTERPRET_DRAW = 16,    /* byte offset of the VkDrawIndirectCommands */
    INTERPRET_DRAW_COUNT = 2,
    INTERPRET_COUNT = 48, /* byte offset of the draw count, which may exceed the maximum */
    INTERPRET_ARGUMENTS_SIZE = INTERPRET_COUNT + sizeof(uint32_t),
};

/* Parameters of a pass's record function that are not in struct rg_pass. */
struct interpret_row {
    uint32_t salt, shift;
    uint32_t from[2], to[2]; /* written region, texels or 32-bit words; may exceed the resource */
    float depth;             /* depth of the triangle */
    uint32_t instance_count; /* instance count of direct draws */
    bool is_counted;         /* true for indirect draws with a count buffer, false for one draw */
    uint32_t src_offset, dst_offset; /* byte offsets of copies from and to buffers */
    uint32_t size;                   /* bytes copied between buffers */
};

struct interpret_tables {
    const struct rg_pass *passes;
    const struct interpret_row *rows; /* parallel to `passes` */
    uint32_t pass_count;
    const struct rg_image *images;
    uint32_t image_count;
    const struct rg_buffer *buffers; /* fixed sizes, multiples of 4 bytes */
    uint32_t buffer_count;
    VkExtent2D view;
};

struct rg_frame {
    uint32_t number;
    const struct interpret_tables *tables;
    const struct rg_plan *plan; /* the plan being recorded */
    VkDescriptorSet own;        /* descriptor set of the application, with interpret_set_words */
};

extern const uint32_t interpret_set_words[RANDOM_OWN_WORDS];

/* Subresource range of an image in one repetition of a pass. */
struct interpret_part {
    bool volume; /* 3D image; layers are depth slices, whose number halves per mip */
    uint32_t mip, mip_count, layer, layer_count;
    uint32_t width, height; /* extent of the first mip, texels */
};

struct interpret_image {
    struct interpret_part all;
    /* texels as shaders read them; for depth formats, float bits and stencil */
    uint32_t (*texels)[4];
};

struct interpret {
    const struct interpret_tables *tables;
    struct interpret_image *images;
    uint32_t **words; /* content of each buffer in 32-bit words */
};

/* Returns false when out of memory. Persistent resources start as zeros. */
bool interpret_init(struct interpret *in, const struct interpret_tables *tables);
void interpret_finish(struct interpret *in);

/* Starts a frame and fills transient resources with garbage. Fill upload buffers after it. */
void interpret_begin(struct interpret *in);
void interpret_frame(struct interpret *in, const struct rg_frame *frame);

/* Returns a buffer's content, which may be read and written. */
uint32_t *interpret_words(const struct interpret *in, const struct rg_buffer *buffer);

/* Also used by run_random_record_commands.c. */
struct interpret_part interpret_part(const struct interpret_tables *tables,
                                     const struct rg_pass *pass, uint32_t repetition,
                                     const struct rg_use *use);
const struct rg_use *interpret_use(const struct rg_pass *pass, enum rg_access access); /* or NULL */
const struct rg_use *interpret_written(const struct rg_pass *pass); /* NULL if there is none */
struct random_push interpret_push(const struct rg_frame *frame, const struct rg_pass *pass);

/* Returns the texel at position `at` (x, y, layer) of a mip level. */
uint32_t *interpret_texel(const struct interpret_image *image, uint32_t mip, const uint32_t at[3]);

#endif
