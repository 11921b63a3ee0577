/* aov_layer.h: description of an image layer (AOV): its name for --aov and its EXR channels. */
#ifndef FIRN_TECH_AOV_LAYER_H
#define FIRN_TECH_AOV_LAYER_H

#include <stdbool.h>
#include <stdint.h>

struct rg_image;

/* Mappings of a layer's values to display colours. */
enum frame_shown {
    FRAME_SHOWN_COLOR,
    FRAME_SHOWN_AMOUNT,   /* one plane; 0 means no surface */
    FRAME_SHOWN_DISTANCE, /* one plane; 0 means no surface */
    FRAME_SHOWN_DIRECTION,
    FRAME_SHOWN_POSITION,
};

struct frame_layer {
    const char *name;
    const struct rg_image *image; /* NULL: only in the CPU reference */
    const char *planes[4];        /* EXR channel names; NULL ends */
    uint32_t first_channel;       /* image channel of the first plane */
    bool half;                    /* stored as half, otherwise as float */
    bool mean;                    /* mean of samples; otherwise sample 0 */
    enum frame_shown shown;
    const char *help;
};

#endif
