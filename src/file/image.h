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
#include "src/file/color_primaries.h"

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
    bool integer;               /* stored as 32-bit unsigned integers in files */
    float *texels;              /* width * height floats */
};

struct image {
    uint32_t width, height; /* pixels */
    uint32_t plane_count;
    struct image_plane *planes;
    uint32_t spare_count; /* planes after `plane_count`, whose memory image_add_plane() reuses */
};

/* Callback of a reader that knows an image's size and the number of its planes R, G, B and A,
 * before it decodes texels. After a failure the reader returns its status. */
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

/* Removes all planes and sets the size. If the size is unchanged, keeps their memory for
 * image_add_plane(), because fresh memory costs page faults. *image must be initialised or {0}. */
void image_clear(struct image *image, uint32_t width, uint32_t height);

/*
 * Adds a plane of zeros and returns its texels. If out of memory, returns NULL. The name is copied;
 * it must be unique and shorter than IMAGE_NAME_SIZE. Other planes' texels do not move in memory.
 */
float *image_add_plane(struct image *image, const char *name, bool half);

/* Returns the texels of a named plane, or NULL if there is none. */
float *image_find(const struct image *image, const char *name);

/* ---- headers of image files ---- */

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

/* EXR's data window or display window in the coordinates of the file, pixels. */
struct image_box {
    int32_t x, y;           /* top left pixel */
    uint32_t width, height; /* 0 if the file has no windows */
};

struct image_header {
    struct image image; /* size and planes without texels */
    uint32_t text_count;

    struct {
        char *name, *value;
    } texts[IMAGE_TEXT_COUNT_MAX];

    bool has_window; /* data window within the display window */
    struct image_window window;
    struct image_box data_window, display_window;
    bool has_world_to_camera, has_world_to_ndc;
    bool is_cube_map, is_latlong; /* EXR's `envmap` */
    bool has_primaries;           /* EXR's `chromaticities`; not sent to parent */
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
