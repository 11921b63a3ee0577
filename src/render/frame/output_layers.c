/* output_layers.c: declaration of the beauty layer. */
#include "src/render/frame/output_layers.h"
#include "src/tech/frame_resources.h"

const struct frame_layer frame_beauty = {
    .name = "beauty",
    .image = &frame_color,
    .planes = { "R", "G", "B", "A" },
    .half = true,
    .mean = true,
    .help = "the rendered image",
};
