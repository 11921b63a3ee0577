/* layer.h: a layer of a picture, as --aov names it, and its planes in an EXR file. */
#ifndef FIRN_TECH_LAYER_H
#define FIRN_TECH_LAYER_H

#include <stdbool.h>
#include <stdint.h>

struct rg_image;

/* How a layer's values are displayed. */
enum frame_shown {
    FRAME_SHOWN_COLOR,
    FRAME_SHOWN_AMOUNT,   /* one plane; 0: no surface */
    FRAME_SHOWN_DISTANCE, /* one plane; 0: no surface */
    FRAME_SHOWN_DIRECTION,
    FRAME_SHOWN_POSITION,
};

struct frame_layer {
    const char *name;
    const struct rg_image *image; /* NULL: only the reference has the layer */
    const char *planes[4];        /* names of the planes; the list ends at NULL */
    uint32_t first_channel;       /* channel of the image for the first plane */
    bool half;                    /* stored as half, else as float */
    bool mean;                    /* the mean of all samples, else sample 0, the pixel's centre */
    enum frame_shown shown;
    const char *help;
};

#endif
