/* layers.h: the layers of a picture: the beauty, and those that techniques_layer() lists. */
#ifndef FIRN_FRAME_LAYERS_H
#define FIRN_FRAME_LAYERS_H

#include "src/tech/techniques.h"

extern const struct frame_layer frame_beauty; /* always there */

/* Layers are asked for by a bit each: bit i for techniques_layer(i). */
enum {
    FRAME_LAYER_MAX = 32
};

#endif
