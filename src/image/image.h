/*
 * image.h: a picture in memory as named planes of floats.
 *
 * Rows run from the top; row 0 is the top one. Colours are linear Rec.709.
 * Ownership: an image owns its planes; image_finish() frees them.
 */
#ifndef FIRN_IMAGE_IMAGE_H
#define FIRN_IMAGE_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    IMAGE_NAME_SIZE = 64
};

/* What the readers accept; a larger picture in a file is STATUS_DATA. */
enum {
    IMAGE_MAX_SIDE = 65536,      /* pixels */
    IMAGE_MAX_TEXELS = 1 << 28,  /* of one plane */
    IMAGE_MAX_SAMPLES = 1 << 30, /* of all planes: 4 GiB in memory */
    IMAGE_MAX_PLANES = 256,
};

struct image_plane {
    char name[IMAGE_NAME_SIZE]; /* as in EXR: "R", "N.X", "fresnel.Z" */
    bool half;                  /* stored as half in files; float in memory all the same */
    float *texels;              /* width * height */
};

struct image {
    uint32_t width, height; /* pixels */
    uint32_t plane_count;
    struct image_plane *planes;
};

/* Words about a picture, stored with it: {"firn/settings", "..."}. */
struct image_text {
    const char *name;
    const char *value;
};

/* Empty image of a size. Sizes of 0 are allowed only for {0}. */
void image_init(struct image *image, uint32_t width, uint32_t height);

void image_finish(struct image *image);

/*
 * Adds a plane of zeros and returns its texels, or NULL when memory is short. The name is
 * copied; it must be shorter than IMAGE_NAME_SIZE and not in use. The pointers of other planes'
 * texels stay valid.
 */
float *image_add_plane(struct image *image, const char *name, bool half);

/* The texels of a plane, or NULL when there is none of that name. */
float *image_find(const struct image *image, const char *name);

#endif
