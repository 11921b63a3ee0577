/*
 * image.h: image in memory, which consists of named planes of floats and owns them. Row 0 is the
 * top row. Colours are linear Rec.709.
 */
#ifndef FIRN_FILE_IMAGE_H
#define FIRN_FILE_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"

enum {
    IMAGE_NAME_SIZE = 64
};

/* Limits of the image readers. Larger files are rejected with STATUS_DATA. */
enum {
    IMAGE_MAX_SIDE = 65536,      /* pixels */
    IMAGE_MAX_TEXELS = 1 << 28,  /* texels of one plane */
    IMAGE_MAX_SAMPLES = 1 << 30, /* of all planes: 4 GiB */
    IMAGE_MAX_PLANES = 256,
};

struct image_plane {
    char name[IMAGE_NAME_SIZE]; /* EXR channel name: "R", "N.X", "fresnel.Z" */
    bool half;                  /* stored as half in files */
    float *texels;              /* width * height floats */
};

struct image {
    uint32_t width, height; /* pixels */
    uint32_t plane_count;
    struct image_plane *planes;
};

/* Callback of a reader that knows an image's size and the number of its planes R, G, B and A, before
 * it decodes texels. After a failure the reader returns its status. */
typedef enum status image_size_fn(void *user, uint32_t width, uint32_t height,
                                  uint32_t plane_count);

/* Text metadata of an image file, such as {"firn/settings", "..."}. */
struct image_text {
    const char *name;
    const char *value;
};

/* Initialises an image without planes. Planes can be added only if its size is not 0. */
void image_init(struct image *image, uint32_t width, uint32_t height);

/* Initialises an image with zeroed planes of the width, names and types of `like`. Returns false
 * when out of memory. The caller finishes the image even then. */
bool image_init_like(struct image *image, const struct image *like, uint32_t height);

void image_finish(struct image *image);

/*
 * Adds a plane of zeros and returns its texels. If out of memory, returns NULL. The name is copied;
 * it must be unique and shorter than IMAGE_NAME_SIZE. Other planes' texels do not move in memory.
 */
float *image_add_plane(struct image *image, const char *name, bool half);

/* Returns the texels of a named plane, or NULL if there is none. */
float *image_find(const struct image *image, const char *name);

#endif
