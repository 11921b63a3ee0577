/* run_random_private.h: declarations shared by the files behind run_random.h. */
#ifndef TESTS_RUN_RANDOM_PRIVATE_H
#define TESTS_RUN_RANDOM_PRIVATE_H

#include "tests/support/run_random.h"

enum {
    IMAGES = 12,
    ARGUMENTS = 2, /* buffers of indirect draw parameters: the host's, and a device copy */
    UPLOADS = 3,
    DEVICES = 4,
    BUFFERS = ARGUMENTS + UPLOADS + DEVICES + RUN_OUTPUT_COUNT,
    RESOURCES = IMAGES + BUFFERS, /* indices of images, then of buffers */
    ROWS = 30,
    USES = 8, /* per pass */
    LAYERS = 4,
    MIPS = 3,
    CELLS = LAYERS * MIPS, /* subresources of an image: layers times mips */
    CLAIMS = USES + RG_COLOR_COUNT + 1,
};

/* When a subresource is filled: never, in every frame, or only in frames in which condition n is
 * true (FILLED_SOMETIMES + n). */
enum {
    FILLED_NEVER,
    FILLED_ALWAYS,
    FILLED_SOMETIMES,
};

/* Generator state of an image or buffer; a buffer has one layer and mip. */
struct run_random_known {
    uint32_t layers, mips, width, height;
    bool depth, stencil, writable;
    bool volume; /* 3D image */
    bool sum;    /* float image of small integers, only blended and copied */
    uint8_t filled[CELLS];
};

/* Range of a resource that the pass being generated already uses, over all repetitions. */
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
    struct rg_target targets[ROWS][RG_COLOR_COUNT]; /* colour targets of each pass */
    struct interpret_row rows[ROWS];
    struct rg_use uses[ROWS][USES + 1];
    char names[RESOURCES + ROWS][16];
    struct run_random_known known[RESOURCES];
    uint32_t image_count, buffer_count, pass_count, output_count, wanted_count;
    bool local; /* passes use images with near indices, so that lifetimes are short */
    /* All indirect draws use a count buffer, or none: after one with a count, lavapipe (Mesa 22.3)
     * applies the count as a limit to the other draws of the command buffer. */
    bool is_counted;
    uint32_t last_written;
    unsigned features;
    /* of the pass being generated: */
    struct run_random_claim claims[CLAIMS];
    uint32_t claim_count, use_count;
    uint32_t repetitions;
    uint8_t filled; /* FILLED_ value of what the pass writes */
};

/* run_random.c */
uint32_t run_random_below(struct run_random_tables *t, uint32_t count);
bool run_random_chance(struct run_random_tables *t, uint32_t percent);
void run_random_add_buffer(struct run_random_tables *t, enum rg_memory memory, VkDeviceSize size);
void run_random_name(struct run_random_tables *t, char kind, uint32_t slot, const char **name);

/* run_random_shader_rows.c: tries to generate a pass; adds none if random choices do not fit. */
void run_random_draw(struct run_random_tables *t);

/* run_random_begin() starts an unconditional, unrepeated pass; run_random_end() adds the pass. */
struct rg_pass *run_random_begin(struct run_random_tables *t, enum rg_kind kind);
void run_random_end(struct run_random_tables *t);

/* Randomly makes the pass conditional; must be called right after run_random_begin(). */
void run_random_condition(struct run_random_tables *t, struct rg_pass *pass);

/* Return a random image, a buffer, a range to read, and a range of one mip to write; the last
 * function also chooses the repetitions of the pass. */
uint32_t run_random_image(struct run_random_tables *t);
uint32_t run_random_buffer(struct run_random_tables *t); /* large enough for uniforms */
struct rg_range run_random_range(struct run_random_tables *t, uint32_t resource);
struct rg_range run_random_written_range(struct run_random_tables *t, uint32_t image);

/* Return a range's union over all repetitions of the pass; true if that union may be read. */
struct rg_range run_random_covered(const struct run_random_tables *t, uint32_t resource,
                                   struct rg_range range);
bool run_random_is_filled(const struct run_random_tables *t, uint32_t resource,
                          struct rg_range covered);

/* Reserves a range for the pass. Returns false if it is in use, or is read but not filled. */
bool run_random_claim(struct run_random_tables *t, uint32_t resource, struct rg_range range,
                      enum rg_access access);
struct rg_use *run_random_use(struct run_random_tables *t, uint32_t resource, enum rg_access access,
                              struct rg_range range);

uint32_t run_random_mip_size(uint32_t size, uint32_t mip);

/* run_random_blend_stencil.c: randomly adds blending or a write mask to a colour target. */
void run_random_blend(struct run_random_tables *t, struct rg_target *target, bool sum);

/* Randomly adds a stencil test. If the stencil is undefined or `whole` is true, any added test
 * always passes and overwrites the stencil. */
void run_random_stencil(struct run_random_tables *t, struct rg_pass *pass, bool whole);

/* run_random_transfer_rows.c: generate a random copy, and a copy to a new readback buffer. */
void run_random_draw_copy(struct run_random_tables *t);
void run_random_draw_output(struct run_random_tables *t);

#endif
