/*
 * quick.h: draft renderers, which draw the image while something moves.
 *
 * They use the scene's refraction models with the settings of --quality draft and further limits
 * (quick_settings()). If that is too slow at half the size, meshes are coarser, then cracks, air
 * and bubbles are left out, then bumps. They are created after the first image or when it stands
 * still, so that the first interaction finds them, and follow later changes of settings, size and
 * models. An image that is fast enough needs none; animated models have none, as each pose is
 * another scene.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_QUICK_H
#define FIRN_VIEW_QUICK_H

#include "src/render/renderer.h"

/* What the draft renderers are based on: the full renderers' parameters. */
struct quick_params {
    struct renderer_params left, right;
    bool is_split;    /* there is a right side (B) */
    uint64_t version; /* version of the viewport's renderers */
};

/* What the draft leaves out. */
enum quick_level {
    QUICK_WHOLE,  /* nothing that is easily noticed */
    QUICK_COARSE, /* uses coarser meshes */
    QUICK_BARE,   /* leaves out cracks, air and bubbles */
    QUICK_SMOOTH, /* leaves out bumps as well */
};

struct quick {
    struct renderer *left, *right; /* NULL if there is none */
    struct settings settings;      /* settings of `left` */
    struct settings right_settings;
    uint64_t version; /* viewport version that they were created for */
    enum quick_level level;
    double seconds; /* time of a half-size image when they were created */
    bool is_off;    /* draft rendering is disabled by the user */
    bool failed;    /* there was not enough memory */
};

/* Returns the settings of a draft: settings controlled by quality levels get the value of `draft`,
 * unless the user has chosen a value that no level has. */
struct settings quick_settings(const struct settings *settings, enum quick_level level);

/* Creates the renderers and draws hidden frames, to make the driver compile the shaders and to
 * measure their time. It is no error if there is no memory for them. */
MUST_USE enum status quick_make(struct quick *quick, const struct quick_params *params,
                                const struct renderer_shot *shot);

/* Updates existing draft renderers to the viewport's current state. On failure there are none. */
MUST_USE enum status quick_follow(struct quick *quick, const struct quick_params *params);

MUST_USE enum status quick_draw(struct quick *quick, const struct renderer_shot *shot,
                                VkExtent2D view);
void quick_finish(struct quick *quick); /* {0} is fine; keeps is_off */

#endif
