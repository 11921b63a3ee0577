/* layers.c: the layer that every picture has. */
#include "src/frame/layers.h"
#include "src/tech/frame.h"

const struct frame_layer frame_beauty = {
    .name = "beauty",
    .image = &frame_color,
    .planes = { "R", "G", "B", "A" },
    .half = true,
    .mean = true,
    .help = "the picture",
};
