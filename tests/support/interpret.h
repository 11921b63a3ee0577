/*
 * interpret.h: interprets tables on arrays of texels, to compute the results expected of a device.
 *
 * Rows run in the order of the table, one repetition after another, without culling, aliasing or
 * frames in flight. Transient resources begin each frame with garbage, so that reads before writes
 * are detected. A pass does what random.frag, random.comp or a copy does; all formats except depth
 * have unsigned integers, so that results are exact.
 */
#ifndef TESTS_INTERPRET_H
#define TESTS_INTERPRET_H

#include "graph/rg.h"
#include "tests/gpu/shaders/random.h"

enum {
    INTERPRET_DISPATCH = 0, /* offset of a VkDispatchIndirectCommand in a buffer for RG_INDIRECT */
    INTERPRET_DRAW = 16,    /* of the VkDrawIndirectCommands */
    INTERPRET_DRAW_COUNT = 2,
    INTERPRET_COUNT = 48, /* of the uint32_t that is the number of counted draws, or more */
    INTERPRET_ARGUMENTS_SIZE = INTERPRET_COUNT + sizeof(uint32_t),
};

/* What a row's record function needs besides the row. */
struct interpret_row {
    uint32_t salt, shift;
    uint32_t from[2], to[2];         /* texels (words) written; `to` may lie outside */
    float depth;                     /* of the triangle */
    uint32_t instance_count;         /* of it, unless it is drawn indirectly */
    bool is_counted;                 /* so many indirect draws as the device has counted, not one */
    uint32_t src_offset, dst_offset; /* bytes, of copies from and to buffers */
    uint32_t size;                   /* bytes, of copies between buffers */
};

struct interpret_tables {
    const struct rg_pass *passes;
    const struct interpret_row *rows; /* one for each pass */
    uint32_t pass_count;
    const struct rg_image *images;
    uint32_t image_count;
    const struct rg_buffer *buffers; /* of whole words, none of a size that follows the view */
    uint32_t buffer_count;
    VkExtent2D view;
};

struct rg_frame {
    uint32_t number;
    const struct interpret_tables *tables;
    const struct rg_plan *plan; /* that is recorded */
    VkDescriptorSet own;        /* with these words, which rows with a set read */
};

extern const uint32_t interpret_own[RANDOM_OWN_WORDS];

/* A range of an image in one repetition of a row. */
struct interpret_part {
    bool volume; /* of three dimensions: layers are slices, fewer in each mip */
    uint32_t mip, mip_count, layer, layer_count;
    uint32_t width, height; /* texels, of the first mip */
};

struct interpret_image {
    struct interpret_part all;
    uint32_t (*texels)[4]; /* as shaders read them; depth: the float's bits, then
                              the stencil */
};

struct interpret {
    const struct interpret_tables *tables;
    struct interpret_image *images;
    uint32_t **words; /* of each buffer */
};

/* Returns false if memory is short. Persistent resources are zero. */
bool interpret_init(struct interpret *in, const struct interpret_tables *tables);
void interpret_finish(struct interpret *in);

/* Before the upload buffers of a frame are filled: there is garbage in all that is transient. */
void interpret_begin(struct interpret *in);
void interpret_frame(struct interpret *in, const struct rg_frame *frame);

/* The content of a buffer, to write or to read. */
uint32_t *interpret_words(const struct interpret *in, const struct rg_buffer *buffer);

/* What record functions need, too. */
struct interpret_part interpret_part(const struct interpret_tables *tables,
                                     const struct rg_pass *pass, uint32_t repetition,
                                     const struct rg_use *use);
const struct rg_use *interpret_use(const struct rg_pass *pass, enum rg_access access); /* or NULL */
const struct rg_use *interpret_written(const struct rg_pass *pass);                    /* or NULL */
struct random_push interpret_push(const struct rg_frame *frame, const struct rg_pass *pass);

/* Texel (x, y) of a layer and mip. */
uint32_t *interpret_texel(const struct interpret_image *image, uint32_t mip, const uint32_t at[3]);

#endif
