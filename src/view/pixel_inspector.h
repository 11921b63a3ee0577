/*
 * pixel_inspector.h: pixel inspector: shows layers of a converging image and reads values of its
 * pixels.
 *
 * Layers are rendered on demand, apart from the image, with one sample at each pixel's centre, and
 * are kept in host memory until the image changes.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_PIXEL_INSPECTOR_H
#define FIRN_VIEW_PIXEL_INSPECTOR_H

#include "src/view/viewport.h"

enum {
    PIXEL_INSPECTOR_LAYER_MAX = FRAME_LAYER_MAX + 1,
    PIXEL_INSPECTOR_BIN_COUNT = 64,
};

/* What the user has chosen to inspect. */
struct pixel_inspector_choice {
    uint32_t layer;   /* index for pixel_inspector_layer(); 0 is the rendered image */
    uint32_t channel; /* 0 for all channels; otherwise plane channel - 1 */
    float stops;      /* exposure gain of the rendered image or a colour layer, in stops */
    bool false_color; /* one channel, or the mean of all, in the false colours of heat_map.h */
};

struct pixel_inspector {
    struct pixel_inspector_choice choice; /* choice that `rgba` and `image` show */
    bool is_open;                         /* the inspector panel is open, so values are needed */
    struct image layers;                  /* width 0 if nothing has been rendered */
    uint32_t drawn;                       /* layer chosen when `layers` was rendered */
    uint32_t sample_count;                /* samples of the rendered image when `rgba` was made */
    uint8_t *rgba;           /* pixels shown instead of the rendered image; NULL if none */
    struct gpu_image image;  /* `rgba` on the device */
    struct gpu_image former; /* previous image, which a window's plan may still refer to */
    char *names;             /* object names from object_names(); may be NULL */
    uint32_t bins[PIXEL_INSPECTOR_BIN_COUNT];
    float least, greatest; /* range of the values; for the rendered image in stops */
    float below, above;    /* fractions of the pixels outside the histogram's range */
};

void pixel_inspector_finish(struct pixel_inspector *look, struct gpu *gpu); /* {0} is fine */

/* Returns layer i of the list offered to the user. NULL for 0, which is the rendered image, and
 * after the last layer. */
const struct frame_layer *pixel_inspector_layer(uint32_t i);

/* Returns true if the choice shows something other than the unmodified rendered image. */
bool pixel_inspector_replaces_image(const struct pixel_inspector_choice *choice);

/* Renders the layers that the choice and pixel_inspector_values() need. */
MUST_USE enum status pixel_inspector_draw(struct pixel_inspector *look, struct viewport *picture,
                                          const struct renderer_shot *shot);

/* Computes `rgba`, `image` and the histogram of the current choice; `sample_count` belongs to the
 * rendered image. The image shown before stays valid until the next call, but no frame may still
 * use it. */
MUST_USE enum status pixel_inspector_show(struct pixel_inspector *look,
                                          const struct viewport *picture, uint32_t sample_count);

/* ---- the pixel under the cursor ---- */

struct pixel_inspector_values {
    float color[4];                         /* linear; mean of all samples */
    uint8_t shown[3];                       /* displayed, sRGB-encoded */
    float position[3], normal[3], distance; /* metres; world space; depth in metres */
    float layer[4];       /* values of the chosen layer; unused for the rendered image */
    uint32_t layer_count; /* number of planes in `layer` */
    uint32_t object;      /* object number; 0 if no surface was hit */
    char name[64];        /* name of the object or its material; "" if it has none */
};

/* Reads the values of a pixel. Returns false outside the image or before the first rendering. */
bool pixel_inspector_values(const struct pixel_inspector *look, const struct viewport *picture,
                            uint32_t x, uint32_t y, struct pixel_inspector_values *values);

#endif
