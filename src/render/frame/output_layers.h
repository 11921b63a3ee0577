/* output_layers.h: output layers (AOVs) of an image: beauty, and the layers of techniques. */
#ifndef FIRN_RENDER_FRAME_OUTPUT_LAYERS_H
#define FIRN_RENDER_FRAME_OUTPUT_LAYERS_H

#include "src/tech/techniques.h"

extern const struct frame_layer frame_beauty; /* present in every image */

/* Maximum number of layers. Bit i of a layer mask stands for techniques_layer(i). */
enum {
    FRAME_LAYER_MAX = TECHNIQUE_LAYER_MAX
};

#endif
