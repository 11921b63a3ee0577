/* renderer_internal.h: what the files of renderer.c share. */
#ifndef FIRN_RENDER_RENDERER_INTERNAL_H
#define FIRN_RENDER_RENDERER_INTERNAL_H

#include "src/base/tile.h"
#include "src/frame/cube.h"
#include "src/render/frame_exec.h"
#include "src/render/frame_objects.h"
#include "src/render/renderer.h"
#include "src/render/uploaded_scene.h"

struct adaptive;
struct warm_up;

struct renderer {
    struct renderer_params params;      /* interleaved: width and height are those of a tile */
    uint32_t width, height;             /* pixels of the picture, in the view that is set */
    struct tiling tiling;               /* one tile if the tiles are interleaved */
    struct tile tile;                   /* the tile of `tiling` that results have now */
    struct uploaded_scene own;          /* {0} if params.uploaded is set */
    const struct uploaded_scene *scene; /* `own` or params.uploaded */
    struct uploaded_scene tree;         /* the scene's tree, if the rung meets it */
    struct tree own_tree;               /* of a scene that has no place for one: */
    struct scene own_scene;
    struct rg_mesh *meshes;       /* of the techniques, in their order */
    struct frame_exec capture;    /* draws the environment cube, if it is not dynamic */
    struct frame_exec picture;    /* draws a sample */
    struct frame_objects objects; /* of the picture's frames */
    struct frame_exec resolve;    /* tonemaps the mean of many samples */
    struct warm_up *warm_up;      /* compiles for the first picture; may be NULL */
    bool captured;                /* `capture` has drawn the environment cube */
    struct frame_cube cube;       /* the cube that the picture's frames draw */
    bool stays;                   /* on the device: what `picture` draws now */
    struct renderer_costs costs;
    uint32_t last_slot;  /* slot of the picture's executor with the last sample */
    uint32_t sum_count;  /* samples in: */
    struct image sums;   /* of the samples of renderer_refine() */
    struct image ground; /* frame_smooth_layers and "samples"; {0}: nothing is smoothed */
};

/* What params need beside the picture: a cube that is drawn once, a mean of samples, the tree. */
bool renderer_wants_capture(const struct renderer_params *params);
bool renderer_wants_resolve(const struct renderer_params *params);
bool renderer_meets_tree(const struct renderer_params *params);

/* Copies the params and replaces sizes of 0 by 1, and the picture's size by that of an interleaved
 * tile. */
void renderer_take_params(struct renderer *renderer, const struct renderer_params *params);

/* Builds the scene's tree. A scene that has not been loaded has no place for it. */
MUST_USE enum status renderer_need_tree(struct renderer *renderer);

/* Uploads the tree, and what its rays go through, unless that has been done. */
MUST_USE enum status renderer_upload_tree(struct renderer *renderer);

/* Compiles a request and creates its executor. */
MUST_USE enum status renderer_make(struct renderer *renderer, struct frame_exec *frame_exec,
                                   struct frame_request request);

/* The objects behind a plan's imports, malloc'd; NULL: out of memory, which is not logged. */
struct rg_exec_import *renderer_imports(const struct renderer *renderer,
                                        const struct frame_plan *plan);

/* Submits a frame of one of the renderer's executors. */
MUST_USE enum status renderer_run(struct renderer *renderer, struct frame_exec *frame_exec,
                                  const struct renderer_shot *shot, uint32_t sample,
                                  uint32_t *slot);

/* Waits for a sample, and adds it to a part of the result's image. */
MUST_USE enum status renderer_fetch(struct renderer *renderer, struct image *image,
                                    const struct tile *part, uint32_t sample, uint32_t slot);

/*
 * Light on surroundings that is smoothed (smooth.h), renderer_smooth.c: makes its planes, if the
 * params ask for them; adds a sample; after samples of which parts have fewer, makes its means like
 * those of adaptive_even(); adds the light to the picture.
 */
bool renderer_smooth_begin(struct renderer *renderer); /* false: out of memory */
void renderer_smooth_fetch(struct renderer *renderer, const struct tile *part, uint32_t sample,
                           uint32_t slot);
void renderer_smooth_even(struct renderer *renderer, const struct adaptive *adaptive);
MUST_USE enum status renderer_smooth_end(struct renderer *renderer, struct image *image);

/* Draws the samples of a result whose params.adapts; sums are those of ADAPTIVE_SAMPLES. */
MUST_USE enum status renderer_draw_adaptive(struct renderer *renderer,
                                            const struct renderer_shot *shot,
                                            struct render_result *result,
                                            renderer_progress_fn *progress, void *user);

/* Draws the environment cube once, before the first sample, if it is not dynamic. */
MUST_USE enum status renderer_capture_cube(struct renderer *renderer,
                                           const struct renderer_shot *shot);

/* What a frame that has ended copied of an image; NULL: nothing. */
const void *renderer_read_back(struct frame_exec *frame_exec, const struct rg_image *image,
                               uint32_t slot);

#endif
