/*
 * picture_head.h: what the file of a picture says of it, besides its texels.
 *
 * Ownership: a head owns its planes' names and its texts; picture_head_finish() frees them.
 */
#ifndef FIRN_IMAGE_PICTURE_HEAD_H
#define FIRN_IMAGE_PICTURE_HEAD_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"
#include "src/image/image.h"
#include "src/image/primaries.h"

enum {
    PICTURE_TEXT_COUNT_MAX = 16,
    PICTURE_TEXT_SIZE_MAX = 1 << 20, /* bytes of one, '\0' included */
};

/* Only texts whose names begin so are kept: firn's own. */
#define PICTURE_TEXT_PREFIX "firn/"

/* The position of an image in a larger picture: its data window in the display window. */
struct picture_place {
    uint32_t x, y;          /* first pixel of the image */
    uint32_t width, height; /* pixels of the picture; 0: the image is the whole picture */
};

struct picture_head {
    struct image image; /* size and planes without texels */
    uint32_t text_count;

    struct {
        char *name, *value;
    } texts[PICTURE_TEXT_COUNT_MAX];

    bool has_place; /* false: the image is partly outside of the picture */
    struct picture_place place;
    bool has_world_to_camera, has_world_to_ndc;
    bool is_cube_map;   /* an EXR's attribute `envmap`; not sent by reader processes */
    bool has_primaries; /* of an EXR; not sent by reader processes */
    struct primaries primaries;
    float world_to_camera[16], world_to_ndc[16]; /* EXR's row-vector order */
};

void picture_head_finish(struct picture_head *head);

/* Adds a plane without texels. Returns false when out of memory. */
MUST_USE bool picture_head_add_plane(struct picture_head *head, const char *name, bool half);

/*
 * Adds copies, if the name is one of firn's. Texts that are too long, too many, or contain '\0' are
 * left out: they are not firn's. Returns false when out of memory.
 */
MUST_USE bool picture_head_add_text(struct picture_head *head, const char *name, const char *value,
                                    size_t value_length);

/* Returns a text, or NULL if there is none of that name. */
const char *picture_head_text(const struct picture_head *head, const char *name);

/* Returns whether size, planes (in any order, with their kinds) and these texts are the head's. */
bool picture_head_matches(const struct picture_head *head, const struct image *image,
                          const struct image_text *texts, uint32_t text_count);

#endif
