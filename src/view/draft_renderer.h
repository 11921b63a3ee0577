/*
 * draft_renderer.h: draft renderers, which draw the image while something moves.
 *
 * They use the scene's refraction models with the settings of --quality draft and further limits
 * (draft_renderer_settings()). If half the size is too slow, they also use coarser meshes, and if
 * that is too slow, too, refraction model bounce instead of one that traces rays. They show all
 * inclusions, so that the ice looks the same in motion and at rest. The coarsest level is tried
 * first, since it can show an image soonest.
 *
 * Draft renderers are created before those of full quality, and draw the first image. They follow
 * later changes of settings, size and models. An image whose samples are fast enough needs none.
 * Animated models have none, because each pose is another scene.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_DRAFT_RENDERER_H
#define FIRN_VIEW_DRAFT_RENDERER_H

#include "src/render/renderer.h"

/* Parameters of the full-quality renderers. Draft renderers use simplified copies of them. */
struct draft_renderer_params {
    struct renderer_params left, right;
    bool is_split;    /* there is a right side (B) */
    uint64_t version; /* version of the viewport's renderers */
};

/* Simplifications of a draft. Each level includes the simplifications of all levels before it. */
enum draft_renderer_level {
    DRAFT_RENDERER_FULL,        /* nothing that is easily noticed */
    DRAFT_RENDERER_COARSE_MESH, /* uses coarser meshes */
    DRAFT_RENDERER_BOUNCE,      /* uses refraction model bounce, if the scene's model traces rays */
};

struct draft_renderer {
    struct renderer *left, *right; /* NULL if there is none */
    struct settings settings;      /* settings of `left` */
    struct settings right_settings;
    uint64_t version; /* viewport version at creation */
    enum draft_renderer_level level;
    double seconds; /* time of a half-size image */
    bool is_off;    /* disabled by the user */
    bool failed;    /* there was not enough memory */
};

/* Returns a copy of `settings` with lower quality for drafts. Settings at the value of a quality
 * level get the value of quality level `draft`. Then upper limits of draft level `level` apply. */
struct settings draft_renderer_settings(const struct settings *settings,
                                        enum draft_renderer_level level);

/* Creates the draft renderers. Draws hidden frames to compile the shaders and to measure the frame
 * time. If out of memory, creates no draft renderers and returns STATUS_OK. */
MUST_USE enum status draft_renderer_create(struct draft_renderer *q,
                                           const struct draft_renderer_params *params,
                                           const struct renderer_shot *shot);

/* Updates existing draft renderers to the viewport's current state. On failure, destroys them. */
MUST_USE enum status draft_renderer_update(struct draft_renderer *q,
                                           const struct draft_renderer_params *params);

MUST_USE enum status draft_renderer_draw(struct draft_renderer *q, const struct renderer_shot *shot,
                                         VkExtent2D view);
void draft_renderer_finish(struct draft_renderer *q); /* {0} is fine; keeps is_off */

#endif
