/* layer.h: a layer (AOV) of an image, as --aov names it, and its channels in an EXR file. */
#ifndef FIRN_TECH_LAYER_H
#define FIRN_TECH_LAYER_H

#include <stdbool.h>
#include <stdint.h>

struct rg_image;

/* How the values of a layer are mapped to colours for display. */
enum frame_shown {
    FRAME_SHOWN_COLOR,
    FRAME_SHOWN_AMOUNT,   /* one plane; 0 means no surface */
    FRAME_SHOWN_DISTANCE, /* one plane; 0 means no surface */
    FRAME_SHOWN_DIRECTION,
    FRAME_SHOWN_POSITION,
};

struct frame_layer {
    const char *name;
    const struct rg_image *image; /* NULL if only the CPU reference has the layer */
    const char *planes[4];        /* channel names in the EXR file; the list ends at NULL */
    uint32_t first_channel;       /* channel of the image for the first plane */
    bool half;                    /* stored as half, otherwise as float */
    bool mean; /* mean of all samples; otherwise sample 0, at the pixel's centre */
    enum frame_shown shown;
    const char *help;
};

#endif
