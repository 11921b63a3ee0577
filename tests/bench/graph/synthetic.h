/*
 * synthetic.h: render graphs of any length, the same on every machine for the same length and seed.
 *
 * synthetic_init() makes compute passes, in the order of submission. Each reads 1 to 3 images that
 * one of the 16 living passes before it wrote, and writes 1 or 2 new ones. One pass in five is
 * dead: no living pass reads what it writes. As soon as more than 4 living passes are unread, the
 * next living pass reads the oldest of them. The last pass reads what is still unread and writes
 * image 0, which is shown.
 *
 * synthetic_frame_init() makes raster passes as real frames have them: shadow maps, faces of an
 * environment cube, three colour targets with depth, draws that keep what is there, some of them
 * conditional, lighting, transparency with depth that is only tested, and effects in half size. One
 * pass in fifteen is dead. Each round of passes reads the picture of the one before; image 0 is
 * shown.
 */
#ifndef TESTS_SYNTHETIC_H
#define TESTS_SYNTHETIC_H

#include <stdbool.h>
#include <stdint.h>

enum {
    SYNTHETIC_MAX_READS = 16,
    SYNTHETIC_MAX_WRITES = 4,
    SYNTHETIC_NAME_SIZE = 16,
};

#define SYNTHETIC_NONE UINT32_MAX

struct synthetic_image {
    uint32_t width, height, texel_size; /* texels; bytes */
    uint64_t size;                      /* bytes */
    bool depth, cube;
    char name[SYNTHETIC_NAME_SIZE];
};

struct synthetic_pass {
    uint32_t read_count, write_count;
    bool live;
    bool raster;         /* its writes are colour targets, and depth if that is not only tested */
    bool keeps;          /* targets keep what they hold; else they are cleared */
    bool tests_depth;    /* the depth target is only tested: the last one of the reads */
    bool has_depth;      /* the last one of the writes, unless it is only tested */
    bool conditional;    /* runs in some frames */
    uint32_t repetition; /* of a row: the face of a cube */
    uint32_t reads[SYNTHETIC_MAX_READS]; /* indices of images */
    uint32_t writes[SYNTHETIC_MAX_WRITES];
    char name[SYNTHETIC_NAME_SIZE];
};

struct synthetic {
    uint32_t pass_count, image_count;
    uint32_t access_count; /* reads and writes of all passes */
    uint32_t live_count;   /* passes */
    struct synthetic_pass *passes;
    struct synthetic_image *images;
};

/* Makes a graph of 1 to 16777216 passes; false if memory is short. */
bool synthetic_init(struct synthetic *graph, uint32_t pass_count, uint64_t seed);
bool synthetic_frame_init(struct synthetic *graph, uint32_t pass_count);
void synthetic_finish(struct synthetic *graph);

/* Bytes of what living passes use, image 0 left out. */
struct synthetic_memory {
    uint64_t sum;   /* of all images */
    uint64_t bound; /* the most that is alive at one time: no packing takes less */
};

/* False if memory is short. */
bool synthetic_memory(const struct synthetic *graph, struct synthetic_memory *memory);

#endif
