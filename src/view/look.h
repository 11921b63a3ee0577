/*
 * look.h: what is behind the pixels of a picture at rest: its layers, for eyes and as values.
 *
 * Layers are drawn when they are asked for, apart from the picture, with a sample at each pixel's
 * centre, and kept on the host until the picture is another one.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_LOOK_H
#define FIRN_VIEW_LOOK_H

#include "src/view/picture.h"

enum {
    LOOK_LAYER_MAX = FRAME_LAYER_MAX + 1,
    LOOK_BIN_COUNT = 64,
};

/* What a hand has chosen. */
struct look_choice {
    uint32_t layer;   /* of look_layer(); 0: the picture */
    uint32_t channel; /* 0: all; else plane channel - 1 */
    float stops;      /* a layer of colours, or the picture, is so much brighter */
    bool false_color; /* a channel, or the mean of all, in the colours of heat.h */
};

struct look {
    struct look_choice choice; /* that `rgba` and `image` show */
    bool is_open;              /* somebody asks for values */
    struct image layers;       /* width 0: none */
    uint32_t drawn;            /* the choice's layer when they were drawn */
    uint32_t sample_count;     /* of the picture when `rgba` was made */
    uint8_t *rgba;             /* what is shown in place of the picture; NULL: nothing */
    struct gpu_image image;    /* the same on the device */
    struct gpu_image former;   /* the one before, which a window may still know */
    char *names;               /* of object numbers: object_names(); may be NULL */
    uint32_t bins[LOOK_BIN_COUNT];
    float least, greatest; /* of all values; at the ends of the bins, of the picture in stops */
    float below, above;    /* parts of all that are beyond the bins */
};

void look_finish(struct look *look, struct gpu *gpu); /* {0} is fine */

/* Layer i of the list that a hand chooses from: 0 is the picture, for which it returns NULL; so it
 * does at the end. */
const struct frame_layer *look_layer(uint32_t i);

/* Whether the choice shows something else than the picture as it is. */
bool look_replaces(const struct look_choice *choice);

/* Draws the layers that the choice and look_values() need. */
MUST_USE enum status look_draw(struct look *look, struct picture *picture,
                               const struct renderer_shot *shot);

/* Makes `rgba`, `image` and the histogram of what is shown, of so many samples. No frame may use
 * the image that was there before, which stays until the next call. */
MUST_USE enum status look_show(struct look *look, const struct picture *picture,
                               uint32_t sample_count);

/* ---- a pixel ---- */

struct look_values {
    float color[4];                         /* linear; of the mean of all samples */
    uint8_t shown[3];                       /* as it is shown, sRGB-encoded */
    float position[3], normal[3], distance; /* metres; the world's; along the view's axis */
    float layer[4];                         /* of the chosen one; not of the picture */
    uint32_t layer_count;                   /* of its planes */
    uint32_t object;                        /* number; 0: no surface */
    char name[64];                          /* of the object or the material; "": it has none */
};

/* False: there is no such pixel, or nothing has been drawn yet. */
bool look_values(const struct look *look, const struct picture *picture, uint32_t x, uint32_t y,
                 struct look_values *values);

#endif
