/* layers.h: the layers of a picture: the beauty, and those that techniques_layer() returns. */
#ifndef FIRN_FRAME_LAYERS_H
#define FIRN_FRAME_LAYERS_H

#include "src/tech/techniques.h"

extern const struct frame_layer frame_beauty; /* every picture has it */

/* Layers are requested by bits: bit i is techniques_layer(i). */
enum {
    FRAME_LAYER_MAX = 32
};

#endif
