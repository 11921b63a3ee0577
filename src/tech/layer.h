/* layer.h: a layer of a picture, as --aov names it, and the planes it becomes in an EXR file. */
#ifndef FIRN_TECH_LAYER_H
#define FIRN_TECH_LAYER_H

#include <stdbool.h>
#include <stdint.h>

struct rg_image;

/* How a layer's numbers are shown to the eye. */
enum frame_shown {
    FRAME_SHOWN_COLOR,
    FRAME_SHOWN_AMOUNT,   /* one plane; 0: nothing is there */
    FRAME_SHOWN_DISTANCE, /* one plane; 0: nothing is there */
    FRAME_SHOWN_DIRECTION,
    FRAME_SHOWN_POSITION,
};

struct frame_layer {
    const char *name;
    const struct rg_image *image; /* NULL: no rung draws it, the reference alone makes it */
    const char *planes[4];        /* names, ends at NULL */
    uint32_t first_channel;       /* of the image, that the first plane takes */
    bool half;                    /* stored as half; else as float */
    bool mean;                    /* many samples are averaged; else the pixel's centre counts */
    enum frame_shown shown;
    const char *help;
};

#endif
