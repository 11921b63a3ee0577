/*
 * quick.h: what draws a picture while something moves: renderers of its scene and rungs with the
 * settings of --quality draft, and fewer still (quick_settings()); where that is too slow in half
 * the size, with coarser meshes, then without cracks, air and bubbles, then without bumps, too.
 *
 * They are made after the first picture, or once it is still, so the first movement finds them, and
 * follow its settings, size and rungs when they are drawn with. A picture that takes no longer than
 * a frame may needs none. Animated models have none: each pose is another scene.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_QUICK_H
#define FIRN_VIEW_QUICK_H

#include "src/render/renderer.h"

/* What they are to draw, as the picture has it. */
struct quick_params {
    struct renderer_params left, right;
    bool is_split;    /* there is a right one */
    uint64_t version; /* of the picture: another one whenever its renderers are */
};

/* What is left out. */
enum quick_level {
    QUICK_WHOLE,  /* nothing that can be seen well */
    QUICK_COARSE, /* small triangles */
    QUICK_BARE,   /* what is in the ice: cracks, air, bubbles */
    QUICK_SMOOTH, /* bumps, too */
};

struct quick {
    struct renderer *left, *right; /* NULL: none */
    struct settings settings;      /* that `left` draws with */
    struct settings right_settings;
    uint64_t version; /* of the picture that they were made for */
    enum quick_level level;
    double seconds; /* that a picture of half the size took when they were made */
    bool is_off;    /* movements have all that the picture has, and its size */
    bool failed;    /* there was no memory for them */
};

/* What a moving picture has of these settings: what levels of quality decide is that of `draft`,
 * unless it is a value that no level has, which somebody has chosen. */
struct settings quick_settings(const struct settings *settings, enum quick_level level);

/* Makes them and draws pictures that nobody sees: so that the driver compiles, and to see how long
 * they take. Without memory for them there are none, which is no failure. */
MUST_USE enum status quick_make(struct quick *quick, const struct quick_params *params,
                                const struct renderer_shot *shot);

/* Lets those that are there draw the picture as it is now. On failure there are none. */
MUST_USE enum status quick_follow(struct quick *quick, const struct quick_params *params);

MUST_USE enum status quick_draw(struct quick *quick, const struct renderer_shot *shot,
                                VkExtent2D view);
void quick_finish(struct quick *quick); /* {0} is fine; is_off stays */

#endif
