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

enum {
    FRAME_LAYER_PLANES = 8 /* maximum number of planes of a layer */
};

struct frame_layer {
    const char *name;
    const struct rg_image *image;           /* NULL: not drawn by the device */
    const char *planes[FRAME_LAYER_PLANES]; /* EXR channel names; NULL ends */
    uint32_t first_channel;                 /* image channel of the first plane */
    bool half;                              /* stored as half, otherwise as float */
    bool integer;                           /* numbers, such as IDs; stored as 32-bit integers */
    bool needs_bvh;                         /* drawn only by models that trace the BVH */
    bool mean;                              /* mean of samples; otherwise sample 0 */
    /* traced through the pixel centre by the CPU, with all refraction models: ray_layers.h */
    bool is_traced;
    enum frame_shown shown;
    const char *help;
};

/* Returns the number of planes of a layer. */
static inline uint32_t frame_layer_plane_count(const struct frame_layer *layer)
{
    uint32_t count = 0;
    while (count < FRAME_LAYER_PLANES && layer->planes[count])
        count++;
    return count;
}

#endif
