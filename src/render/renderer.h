/*
 * renderer.h: draws an image of a scene with given settings and camera; used by both programs.
 *
 * renderer_create() uploads the scene, compiles the plan, creates its resources; renderer_render()
 * draws all samples and reads the image back; renderer_draw() draws one sample and leaves the image
 * on the device.
 *
 * Thread-safety: one thread at a time per gpu.
 *
 * Ownership: gpu, scene (and `uploaded`) and settings are borrowed and must outlive the renderer.
 *
 * Errors: logged once where found; STATUS_NO_DEVICE, STATUS_TRY_AGAIN or STATUS_FAILED; beyond the
 * device's limits STATUS_USAGE for an image and STATUS_DATA for a scene's panorama or textures.
 */
#ifndef FIRN_RENDER_RENDERER_H
#define FIRN_RENDER_RENDERER_H

#include "graph/rg_exec.h"
#include "graph/rg_profile.h"
#include "src/file/image.h"
#include "src/gpu/gpu.h"
#include "src/render/frame/output_layers.h"
#include "src/render/renderer_params.h"
#include "src/scene/scene.h"

struct renderer;

struct render_result {
    struct image image;   /* linear: beauty and layers */
    struct image display; /* linear: weighted mean of the beauty; may be empty */
    uint16_t *rgba_16;    /* filled by callers; otherwise NULL */
    uint8_t *rgba;        /* 8-bit sRGB; NULL if not requested */
    float samples;        /* mean samples per pixel */
};

/* Callback after every sample. If it returns false, rendering ends with STATUS_FAILED, unlogged. */
typedef bool renderer_progress_fn(void *user, uint32_t done, uint32_t all);

/* Creates a renderer for shots of one size. On failure *renderer is NULL. */
MUST_USE enum status renderer_create(struct renderer **renderer,
                                     const struct renderer_params *params);

/* Switches to other params with the same gpu, scene and `uploaded`, and the same `measured`.
 * Memory, images and pipelines that both need are kept; drawn images are lost. Waits for all
 * frames. On failure the renderer may only be destroyed; after STATUS_TRY_AGAIN a new one may still
 * fit into memory, since this call needs that of both. */
MUST_USE enum status renderer_change(struct renderer *renderer,
                                     const struct renderer_params *params);

/*
 * An image, or one of its tiles, that renderer_render() or renderer_draw() draws.
 *
 * A tile is a rectangle of the image (src/base/tile.h), bit-identical to that rectangle of a whole
 * image. Render targets have the size of the whole image, but only part of their memory is touched.
 * Interleaved tiles are small images: pixel (x, y) of tile i is pixel (columns x + i % columns,
 * rows y + i / columns) of the image, so each tile shows the whole scene. Columns and rows must
 * then divide the image's width and height.
 */
struct renderer_shot {
    struct camera camera;
    float time;            /* animation time, seconds */
    uint32_t tile;         /* below columns * rows */
    struct camera earlier; /* previous frame's; fov_deg 0: `camera` */
};

/* Draws all samples of a shot into *result, which must own no memory. After a failure, *result is
 * empty. If an image is drawn in tiles, *result has the size of a tile. `progress` may be NULL. */
MUST_USE enum status renderer_render(struct renderer *renderer, const struct renderer_shot *shot,
                                     struct render_result *result, renderer_progress_fn *progress,
                                     void *user);

/* Same as renderer_render(), but *result is {0} or an earlier image, whose memory is reused. */
MUST_USE enum status renderer_render_again(struct renderer *renderer,
                                           const struct renderer_shot *shot,
                                           struct render_result *result,
                                           renderer_progress_fn *progress, void *user);

/* Filters the mean of an image that was assembled from tiles, and tone-maps it if params ask for
 * display. Images of a single tile are finished by renderer_render(). */
MUST_USE enum status renderer_finish_display(struct renderer *renderer,
                                             struct render_result *result);

/* Submits sample 0 of the shot without waiting for its completion. If two frames are in flight,
 * waits for one of them. The renderer must have been created with params.keep. */
MUST_USE enum status renderer_draw(struct renderer *renderer, const struct renderer_shot *shot);

enum {
    RENDERER_RESOLVE_STEPS = 4, /* mean, both halves of the filter, and tone curve */
};

/*
 * Progressive rendering, for renderers with params.refines (renderer_set_view() also with
 * `scales`).
 *
 * renderer_set_view() makes the next images smaller, at most as large as in params; it creates no
 * memory and no pipelines, but renderer_display_image() returns another image. renderer_refine()
 * draws the next part of a full-size sample, of about `seconds`, and waits for it. Two calls after
 * the last part add the sample to the sums, and the second sets *is_done; HUGE_VAL seconds do all
 * in one call. Sample 0 restarts the sums. Between the parts, which need equal arguments, only
 * renderer_resolve() and functions that read are allowed, or renderer_abandon(), which drops the
 * sample, as do functions that draw something else. RENDERER_RESOLVE_STEPS calls of
 * renderer_resolve() tone-map the mean of the samples with the current settings into
 * renderer_mean(): the pixels are those of renderer_render() with that many samples. The exposure
 * must be that of sample 0, on which the weights depend (weighted_mean.h).
 */
MUST_USE enum status renderer_set_view(struct renderer *renderer, VkExtent2D view);
MUST_USE enum status renderer_refine(struct renderer *renderer, const struct renderer_shot *shot,
                                     uint32_t sample, double seconds, bool *is_done);
MUST_USE enum status renderer_abandon(struct renderer *renderer);
MUST_USE enum status renderer_resolve(struct renderer *renderer, uint32_t sample_count,
                                      uint32_t step);
VkImage renderer_mean(const struct renderer *renderer);
/* Returns the sample sums, or an empty image before the first sample. */
const struct image *renderer_sums(const struct renderer *renderer);
uint32_t renderer_sum_count(const struct renderer *renderer); /* number of samples in the sums */
/* Returns pixel `i` of the mean of all samples in the sums that is shown, in linear radiance. */
void renderer_display_pixel(const struct renderer *renderer, size_t i, float rgba[static 4]);

/* Waits for the frame submitted last. */
MUST_USE enum status renderer_wait(struct renderer *renderer);

/* Returns the tone-mapped image on the device. After every frame, its layout allows sampling. */
VkImage renderer_display_image(const struct renderer *renderer);

/* Host times of renderer_create(), in milliseconds, and sizes of what it built. */
struct renderer_costs {
    double bvh;             /* BVH build time */
    uint32_t bvh_triangles; /* 0 without a BVH */
    uint64_t bvh_size;      /* bytes */
    double rays;            /* build time of acceleration structures */
    uint64_t rays_size;     /* bytes; 0 if there are none */
    double upload;          /* time to upload the scene */
    double compile;         /* plan compilation */
    double realise;         /* memory, images, descriptors and pipelines */
};
struct renderer_costs renderer_costs(const struct renderer *renderer);

/* Selects what the next frames measure. Times are in the pass order of renderer_frame(). */
void renderer_measure(struct renderer *renderer, const struct rg_measure *measure);
struct rg_times renderer_times(const struct renderer *renderer);
const struct rg_plan *renderer_frame(const struct renderer *renderer);

/* Returns the name of a pass of renderer_frame(). Per-object copies of a pass share one name. */
const char *renderer_pass_name(const struct renderer *renderer, const struct rg_pass *row);

void renderer_destroy(struct renderer *renderer); /* may be NULL */

/* Returns the image that contains the beauty for display. */
const struct image *render_result_display(const struct render_result *result);

/* Removes an image, but keeps the memory of its planes for the next one of that size. */
void render_result_clear(struct render_result *result, uint32_t width, uint32_t height);

void render_result_finish(struct render_result *result);

#endif
