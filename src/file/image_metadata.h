/*
 * image_metadata.h: header of an image file: size, channels, text metadata, windows, matrices. The
 * header owns its texts and its planes' names. image_header_finish() frees both.
 */
#ifndef FIRN_FILE_IMAGE_METADATA_H
#define FIRN_FILE_IMAGE_METADATA_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"
#include "src/file/color_primaries.h"
#include "src/file/image.h"

enum {
    IMAGE_TEXT_COUNT_MAX = 16,
    IMAGE_TEXT_SIZE_MAX = 1 << 20, /* of one text, with '\0' */
};

/* Name prefix of firn's own text metadata; texts with other names are ignored. */
#define IMAGE_TEXT_PREFIX "firn/"

/* Position of an image in a larger one: EXR's data window relative to its display window. */
struct image_window {
    uint32_t x, y;          /* top left pixel of the image */
    uint32_t width, height; /* larger image, pixels; 0 if none */
};

struct image_header {
    struct image image; /* size and planes without texels */
    uint32_t text_count;

    struct {
        char *name, *value;
    } texts[IMAGE_TEXT_COUNT_MAX];

    bool has_window; /* data window within the display window */
    struct image_window window;
    bool has_world_to_camera, has_world_to_ndc;
    bool is_cube_map;   /* EXR's `envmap`; not sent to parent */
    bool has_primaries; /* EXR's `chromaticities`; not sent to parent */
    struct primaries primaries;
    float world_to_camera[16], world_to_ndc[16]; /* EXR's row-vector order */
};

void image_header_finish(struct image_header *head);

/* Adds a plane without texels. Returns false when out of memory. */
MUST_USE bool image_header_add_plane(struct image_header *head, const char *name, bool half);

/*
 * Adds a copy of a text. Ignores names without firn's prefix, values that are too long or contain
 * '\0', and texts beyond the maximum number. If out of memory, returns false.
 */
MUST_USE bool image_header_add_text(struct image_header *head, const char *name, const char *value,
                                    size_t value_length);

/* Returns a text by its name, or NULL if there is none. */
const char *image_header_text(const struct image_header *head, const char *name);

/* Returns true if a header has the image's size and planes (in any order) and the given texts. */
bool image_header_matches(const struct image_header *head, const struct image *image,
                          const struct image_text *texts, uint32_t text_count);

#endif
