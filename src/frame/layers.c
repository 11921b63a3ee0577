/* layers.c: declaration of the beauty layer. */
#include "src/frame/layers.h"
#include "src/tech/frame.h"

const struct frame_layer frame_beauty = {
    .name = "beauty",
    .image = &frame_color,
    .planes = { "R", "G", "B", "A" },
    .half = true,
    .mean = true,
    .help = "the rendered image",
};
