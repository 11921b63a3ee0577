/*
 * frames.h: which techniques make a frame, in their order; which rungs of refraction there are;
 * which layers a picture can have.
 */
#ifndef FIRN_FRAME_FRAMES_H
#define FIRN_FRAME_FRAMES_H

#include "src/tech/technique.h"

/* A way to refract, as --refraction names it. */
struct rung {
    const char *name;
    const struct technique *technique; /* two: src/tech/refract.h */
    const struct technique *bumped;    /* the same where the ice has bumps; NULL: it shows none */
    float reach; /* where it looks for the ice's faces: radii of the bounding sphere; 0: 1 */
};

extern const struct rung frame_rungs[]; /* ends at a row of zeros */

/* NULL if there is none of that name. */
const struct rung *frame_find_rung(const char *name);

enum {
    FRAME_TECHNIQUE_COUNT = 19
}; /* at most, in one frame */

/* The techniques of a frame in their order; ends at NULL. */
struct frame_list {
    const struct technique *techniques[FRAME_TECHNIQUE_COUNT + 1];
};

/* A frame of an object, which may be convex, with this rung and what the settings switch on; of a
 * pool, without the rung. If the cube is not dynamic, it comes from outside. */
struct frame_list frame_with(const struct rung *rung, const struct settings *settings,
                             bool is_convex);
bool frame_cube_is_dynamic(const struct settings *settings);

/* What over.c draws over the ice: OVER_HAS_AIR ... (shaders/over.h) */
uint32_t frame_over_layers(const struct settings *settings);

/* Whether such a frame reads a map of the ice's surface. */
bool frame_reads_bump_maps(const struct settings *settings);

/* Only the environment cube; and one whose faces are as large as the view. */
struct frame_list frame_capture(void);
struct frame_list frame_bake(void);

/* The mean of many samples, tonemapped. */
struct frame_list frame_resolve(void);

/* What a layer's numbers are to the eye. */
enum frame_shown {
    FRAME_SHOWN_COLOR,
    FRAME_SHOWN_AMOUNT,   /* one plane; 0: nothing there */
    FRAME_SHOWN_DISTANCE, /* the same */
    FRAME_SHOWN_DIRECTION,
    FRAME_SHOWN_POSITION,
};

/* A layer of a picture, as --aov names it, and the planes it becomes in an EXR file. */
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

extern const struct frame_layer frame_beauty;   /* always there */
extern const struct frame_layer frame_layers[]; /* those to ask for; ends at a row of zeros */

enum {
    FRAME_LAYER_COUNT = 20
};

#endif
