/* renderer_internal.h: struct renderer and functions shared by the renderer*.c files. */
#ifndef FIRN_RENDER_RENDERER_INTERNAL_H
#define FIRN_RENDER_RENDERER_INTERNAL_H

#include "src/base/tile.h"
#include "src/render/compiled_frame.h"
#include "src/render/frame/env_cube_updates.h"
#include "src/render/object_draw_order.h"
#include "src/render/renderer.h"
#include "src/render/uploaded_scene.h"

struct adaptive;

/* Data of a frame that is needed until the frame is submitted. */
struct renderer_frame {
    struct frame_view view;
    struct globals globals;
    struct rg_frame graph;
};

struct renderer {
    struct renderer_params params;      /* interleaved: width, height of a tile */
    uint32_t width, height;             /* current image size, pixels */
    struct tiling tiling;               /* a single tile if interleaved */
    struct tile tile;                   /* tile of `tiling` being drawn */
    struct uploaded_scene own;          /* {0} if params.uploaded is set */
    const struct uploaded_scene *scene; /* `own` or params.uploaded */
    struct uploaded_scene bvh;          /* the scene's BVH, if traced */
    struct bvh own_bvh;                 /* BVH of `own_scene` */
    struct scene own_scene;
    struct rg_mesh *meshes;        /* one mesh per technique */
    struct compiled_frame capture; /* draws a static environment cube */
    struct compiled_frame image;   /* draws one sample of the image */
    struct frame_objects objects;  /* objects drawn by `image` */
    struct compiled_frame resolve; /* tone-maps the mean of many samples */
    bool captured;                 /* `capture` has drawn the environment cube */
    struct frame_cube cube;        /* cube state of `image` */
    bool skips_readback;           /* the image is not read back */
    struct renderer_costs costs;
    uint32_t last_slot; /* `image` slot of the last sample */
    bool is_partial;    /* `partial` is submitted in part by renderer_refine() */
    struct renderer_frame partial;

    enum {
        SAMPLE_NONE,
        SAMPLE_DRAWN,    /* by renderer_refine(), but in none of the sums */
        SAMPLE_WEIGHTED, /* in `display_sums` only */
        SAMPLE_ADDED,    /* to both sums, by renderer_abandon() */
    } sample;

    uint32_t sum_count;        /* number of samples in `sums` */
    struct image sums;         /* sums of the samples of renderer_refine() */
    struct image display_sums; /* their weighted sums; without planes if not weighted */
    struct image shown;        /* tone-mapped mean from renderer_resolve(), or empty */
    struct image lighting;     /* samples to denoise; {0} if none */
};

/* Returns true if params need a static environment cube. */
bool renderer_wants_capture(const struct renderer_params *params);
bool renderer_wants_resolve(const struct renderer_params *params); /* mean of samples */
bool renderer_is_weighted(const struct renderer_params *params);   /* weighted mean of samples */
bool renderer_uses_bvh(const struct renderer_params *params);

/* Copies the params and fills in defaults. For interleaved tiles, reduces the size to one tile. */
void renderer_set_params(struct renderer *renderer, const struct renderer_params *params);

/* Builds the scene's BVH. The renderer owns it if the scene has no storage for a BVH. */
MUST_USE enum status renderer_build_bvh(struct renderer *renderer);

/* Uploads the BVH, unless already uploaded. With ray queries, builds acceleration structures. */
MUST_USE enum status renderer_upload_bvh(struct renderer *renderer);

/* Compiles a request and creates its executor. */
MUST_USE enum status renderer_compile(struct renderer *renderer,
                                      struct compiled_frame *compiled_frame,
                                      struct frame_request request);

/* Returns an array of the Vulkan objects that a plan imports. The caller frees the array. If out of
 * memory, returns NULL and logs nothing. */
struct rg_exec_import *renderer_imports(const struct renderer *renderer,
                                        const struct frame_plan *plan);

/* Submits one sample to an executor of the renderer. Sets *slot to the frame's slot. */
MUST_USE enum status renderer_run(struct renderer *renderer, struct compiled_frame *compiled_frame,
                                  const struct renderer_shot *shot, uint32_t sample,
                                  uint32_t *slot);

/* Begins a frame of an executor and fills its uploads, but submits nothing. Sets *slot. */
MUST_USE enum status renderer_begin_frame(struct renderer *renderer,
                                          struct compiled_frame *compiled_frame,
                                          const struct renderer_shot *shot, uint32_t sample,
                                          struct renderer_frame *frame, uint32_t *slot);
/* Notes that a frame of the image, which may have drawn the environment cube, was submitted. */
void renderer_mark_drawn(struct renderer *renderer, const struct renderer_frame *frame);

/* Returns true if params ask for layer `layer`. */
bool renderer_wants_layer(const struct renderer *renderer, uint32_t layer);

/* Waits for a sample and adds it to the rectangle `tile` of the result's sums. */
MUST_USE enum status renderer_read_sample(struct renderer *renderer, struct render_result *result,
                                          const struct tile *tile, uint32_t sample, uint32_t slot);

/* Clears the lighting sums if params ask for denoising. Returns false when out of memory. */
bool renderer_denoise_begin(struct renderer *renderer);
/* Adds a sample to the lighting sums. */
void renderer_denoise_accumulate(struct renderer *renderer, const struct tile *tile,
                                 uint32_t sample, uint32_t slot);
void renderer_denoise_rescale(struct renderer *renderer, const struct adaptive *adaptive);
/* Denoises the lighting and adds it to the result's means. */
MUST_USE enum status renderer_denoise_end(struct renderer *renderer, struct render_result *result);

/* Adds the sample that renderer_refine() has drawn to the next one of the two sums. */
void renderer_add_sample(struct renderer *renderer);

/* Draws all samples if params.is_adaptive. Scales the sums to ADAPTIVE_SAMPLES samples. */
MUST_USE enum status renderer_draw_adaptive(struct renderer *renderer,
                                            const struct renderer_shot *shot,
                                            struct render_result *result,
                                            renderer_progress_fn *progress, void *user);

/* Draws the environment cube once, before the first sample, unless it is dynamic. */
MUST_USE enum status renderer_capture_cube(struct renderer *renderer,
                                           const struct renderer_shot *shot);

/* Returns the texels of an image that a finished frame copied to the host, or NULL. */
const void *renderer_read_back(struct compiled_frame *compiled_frame, const struct rg_image *image,
                               uint32_t slot);

#endif
