/*
 * run_random_private.h: declarations shared by the files behind run_random.h.
 */
#ifndef TESTS_RUN_RANDOM_PRIVATE_H
#define TESTS_RUN_RANDOM_PRIVATE_H

#include "tests/support/run_random.h"

enum {
    IMAGES = 12,
    ARGUMENTS = 2, /* buffers of parameters of indirect draws: the CPU's, and a copy */
    UPLOADS = 3,
    DEVICES = 4,
    BUFFERS = ARGUMENTS + UPLOADS + DEVICES + RUN_OUTPUT_COUNT,
    RESOURCES = IMAGES + BUFFERS, /* images first */
    ROWS = 30,
    USES = 8, /* of a row */
    LAYERS = 4,
    MIPS = 3,
    CELLS = LAYERS * MIPS, /* of an image */
    CLAIMS = USES + RG_COLOR_COUNT + 1,
};

/* Who has filled a part of a resource: nobody, a pass that runs in every frame, or passes of the
 * condition of this number and on. */
enum {
    FILLED_NEVER,
    FILLED_ALWAYS,
    FILLED_SOMETIMES,
};

/* What is known of an image or buffer; a buffer has one layer and mip. */
struct run_random_known {
    uint32_t layers, mips, width, height;
    bool depth, stencil, writable;
    bool volume; /* of three dimensions */
    bool sum;    /* of small numbers, as floats: only blended and copied */
    uint8_t filled[CELLS];
};

/* Part of a resource that the row being drawn uses already, in all its repetitions. */
struct run_random_claim {
    uint32_t resource;
    struct rg_range range; /* counts resolved */
    enum rg_access access;
    bool writes;
};

struct run_random_tables {
    uint64_t state;
    VkExtent2D view;
    struct rg_image images[IMAGES];
    struct rg_buffer buffers[BUFFERS];
    struct rg_pass passes[ROWS];
    struct rg_target targets[ROWS][RG_COLOR_COUNT]; /* of each pass */
    struct interpret_row rows[ROWS];
    struct rg_use uses[ROWS][USES + 1];
    char names[RESOURCES + ROWS][16];
    struct run_random_known known[RESOURCES];
    uint32_t image_count, buffer_count, pass_count, output_count, wanted_count;
    bool local; /* rows use images near each other, so that lives are short */
    /* All indirect draws are counted, or none: after a counted one, lavapipe (Mesa 22.3) takes its
     * count for the limit of the others in the command buffer. */
    bool is_counted;
    uint32_t last_written;
    unsigned features;
    /* of the row being drawn: */
    struct run_random_claim claims[CLAIMS];
    uint32_t claim_count, use_count;
    uint32_t repetitions;
    uint8_t filled; /* what it leaves */
};

/* run_random.c */
uint32_t run_random_below(struct run_random_tables *t, uint32_t count);
bool run_random_chance(struct run_random_tables *t, uint32_t percent);
void run_random_add_buffer(struct run_random_tables *t, enum rg_memory memory, VkDeviceSize size);
void run_random_name(struct run_random_tables *t, char kind, uint32_t slot, const char **name);

/* run_random_row.c: draws the next row; it may fail, and then none is added. */
void run_random_draw(struct run_random_tables *t);

/* Begins a row that runs always and once and writes everything; ends it and adds it. */
struct rg_pass *run_random_begin(struct run_random_tables *t, enum rg_kind kind);
void run_random_end(struct run_random_tables *t);

/* Perhaps gives the row a condition; before any other of these functions. */
void run_random_condition(struct run_random_tables *t, struct rg_pass *pass);

/* An image; a part of it, to read; a part of one mip of it, which decides whether and how often the
 * row is repeated. */
uint32_t run_random_image(struct run_random_tables *t);
uint32_t run_random_buffer(struct run_random_tables *t); /* no arguments; a uniform buffer fits */
struct rg_range run_random_range(struct run_random_tables *t, uint32_t resource);
struct rg_range run_random_written_range(struct run_random_tables *t, uint32_t image);

/* What a range means over all repetitions of the row, and whether it is filled for this row. */
struct rg_range run_random_covered(const struct run_random_tables *t, uint32_t resource,
                                   struct rg_range range);
bool run_random_is_filled(const struct run_random_tables *t, uint32_t resource,
                          struct rg_range covered);

/* Reserves a part of a resource for the row; what is read must be filled. */
bool run_random_claim(struct run_random_tables *t, uint32_t resource, struct rg_range range,
                      enum rg_access access);
struct rg_use *run_random_use(struct run_random_tables *t, uint32_t resource, enum rg_access access,
                              struct rg_range range);

uint32_t run_random_mip_size(uint32_t size, uint32_t mip);

/* run_random_state.c: perhaps blends with what a target keeps, or keeps some of its channels. */
void run_random_blend(struct run_random_tables *t, struct rg_target *target, bool sum);

/* Perhaps gives the row a stencil test: in any case one that overwrites what begins undefined; and
 * no other if the row draws all of its images. */
void run_random_stencil(struct run_random_tables *t, struct rg_pass *pass, bool whole);

/* run_random_copy.c: the same for transfer passes, and for one into a new readback buffer. */
void run_random_draw_copy(struct run_random_tables *t);
void run_random_draw_output(struct run_random_tables *t);

#endif
