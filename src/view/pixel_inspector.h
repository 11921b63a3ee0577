/* pixel_inspector.h: shows layers of a converging image, such as normals, and reads pixels. A layer
 * is rendered when needed, with one sample at each pixel's centre. The layer stays in host memory
 * until the image changes. All functions log their errors. */
#ifndef FIRN_VIEW_PIXEL_INSPECTOR_H
#define FIRN_VIEW_PIXEL_INSPECTOR_H

#include "src/view/view_renderers.h"

enum {
    PIXEL_INSPECTOR_LAYER_MAX = FRAME_LAYER_MAX + 1,
    PIXEL_INSPECTOR_BIN_COUNT = 64,
};

/* User's choice of what to inspect. */
struct pixel_inspector_choice {
    uint32_t layer;   /* layer index; 0 is the rendered image */
    uint32_t channel; /* channel number, from 1; 0 for all channels */
    float stops;      /* exposure gain of the rendered image or a colour layer, in stops */
    bool false_color; /* show values in false colours (heat_map.h) */
};

struct pixel_inspector {
    struct pixel_inspector_choice choice; /* choice that `rgba` and `image` show */
    bool is_open;                         /* the panel is open */
    struct image layers;                  /* width 0 if not rendered */
    uint32_t drawn_layer;                 /* layer chosen when `layers` was rendered */
    uint32_t sample_count;                /* samples when `rgba` was made */
    uint8_t *rgba;                        /* pixels shown instead, or NULL */
    struct gpu_image image;               /* `rgba` on the device */
    struct gpu_image previous;            /* previous image, perhaps still in use */
    char *names;                          /* object_names(), or NULL */
    uint32_t bins[PIXEL_INSPECTOR_BIN_COUNT];
    float min, max;                       /* value range; stops for the image */
    float shown_min, shown_max;           /* values of the first and last false colour */
    float below_fraction, above_fraction; /* pixel fractions outside the histogram range */
};

void pixel_inspector_finish(struct pixel_inspector *inspector, struct gpu *gpu); /* {0} is fine */

/* Returns selectable layer i, counted from 1. Returns NULL for 0 and after the last layer. */
const struct frame_layer *pixel_inspector_layer(uint32_t i);

/* Returns true if the choice shows something other than the unmodified rendered image. */
bool pixel_inspector_replaces_image(const struct pixel_inspector_choice *choice);

/* Renders the chosen layer and the layers that pixel_inspector_values() reads. */
MUST_USE enum status pixel_inspector_draw(struct pixel_inspector *inspector, struct viewport *p,
                                          const struct renderer_shot *shot);

/* Computes `rgba`, `image` and the histogram of the chosen layer. Call presenter_wait() first.
 * `sample_count` is the image's number of samples. The old `image` is valid until the next call. */
MUST_USE enum status pixel_inspector_show(struct pixel_inspector *inspector,
                                          const struct viewport *p, uint32_t sample_count);

/* ---- pixel under the cursor ---- */

struct pixel_inspector_values {
    float color[4];                         /* linear; mean of all samples */
    uint8_t shown[3];                       /* displayed, sRGB-encoded */
    float position[3], normal[3], distance; /* world space; lengths in metres */
    float layer[FRAME_LAYER_PLANES];        /* values of the chosen layer */
    uint32_t layer_count;                   /* number of planes in `layer` */
    uint32_t object;                        /* 0 if no surface was hit */
    char name[64];                          /* object or material name, or "" */
};

/* Reads a pixel. If the pixel is outside the image or nothing was rendered, returns false. */
bool pixel_inspector_values(const struct pixel_inspector *inspector, const struct viewport *p,
                            uint32_t x, uint32_t y, struct pixel_inspector_values *values);

#endif
