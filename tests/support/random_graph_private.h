/* random_graph_private.h: declarations shared by the files of the random graph generator. */
#ifndef TESTS_RANDOM_GRAPH_PRIVATE_H
#define TESTS_RANDOM_GRAPH_PRIVATE_H

#include <stdbool.h>
#include <stdint.h>

#include "graph/rg.h"

enum {
    IMAGES = 48,
    BUFFERS = 24,
    RESOURCES = IMAGES + BUFFERS, /* indices of images, then of buffers */
    PASSES = 301,
    USES = 6, /* per pass */
    TECHNIQUES = 4,
    CELLS = 12 * 8, /* subresources of an image: layers times mips */
    CLAIMS = 2 * USES + 2 * RG_COLOR_COUNT,
    CONDITIONS = 3,
};

/* Generator state of an image or buffer; a buffer has one layer and mip. */
struct random_known {
    uint32_t layers, mips, samples, width, height;
    VkFormat format; /* of a buffer: its texel format */
    bool depth, stencil, storage, copies, written;
    bool volume;            /* 3D image */
    bool history;           /* image with the previous content of the image before it */
    bool structure;         /* buffer with an acceleration structure */
    uint8_t defined[CELLS]; /* bit 0: always written; bit n: written if condition n is true */
};

/* Range of a resource that the pass being generated already uses. */
struct random_claim {
    uint32_t resource;
    struct rg_range range; /* counts resolved */
    bool writes;
};

struct random_tables {
    uint64_t state;
    struct rg_image images[IMAGES];
    struct rg_buffer buffers[BUFFERS];
    struct rg_pass passes[PASSES];
    struct rg_target targets[PASSES][RG_COLOR_COUNT]; /* colour targets of each pass */
    struct rg_use uses[PASSES][USES + 1];
    char names[RESOURCES + PASSES][16];
    struct rg_technique techniques[TECHNIQUES];
    const struct rg_technique *technique_list[TECHNIQUES];
    struct rg_import imports[RESOURCES];
    struct rg_output outputs[RESOURCES];
    struct rg_size sizes[RESOURCES];
    struct rg_device device;
    struct random_known known[RESOURCES];
    uint32_t image_count, buffer_count, pass_count, wanted_count, condition_count, size_count;
    bool history, multisampled;
    /* passes use images with near indices, for short lifetimes and little culling */
    bool local;
    uint32_t last_written;
    /* of the pass being generated: */
    struct random_claim claims[CLAIMS];
    uint32_t claim_count, use_count;
    uint32_t condition; /* number of the condition, from 1; 0 if unconditional */
};

/* random_graph.c */
uint32_t random_graph_below(struct random_tables *t, uint32_t count);
bool random_graph_chance(struct random_tables *t, uint32_t percent);
const char *random_graph_name(struct random_tables *t, char kind, uint32_t index, uint32_t slot);
bool random_graph_exists(const struct random_tables *t, uint32_t resource);

/* random_graph_passes.c: tries to generate a pass; adds none if the random choices do not fit. */
void random_graph_draw(struct random_tables *t);

/* Adds a pass that writes all of image 0, so that there is an output. */
void random_graph_draw_last(struct random_tables *t);

/* Returns true if the range is defined whenever `condition` holds; condition 0 always holds. */
bool random_graph_is_defined(const struct random_known *known, const struct rg_range *range,
                             uint32_t condition);
struct rg_range random_graph_whole(const struct random_known *known);

#endif
