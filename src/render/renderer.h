/*
 * renderer.h: draws a picture of a scene with settings and a camera; used by every front end.
 *
 *     renderer_create()   uploads the scene, compiles the plan, creates its resources
 *     renderer_render()   draws all samples and reads the picture back
 *     renderer_draw()     draws one sample and leaves the picture on the device
 *     renderer_bake()     needs no renderer: draws the environment cube and reads it back
 *
 * Thread-safety: one thread at a time per gpu.
 * Ownership: gpu, scene (and `uploaded`) and settings are borrowed and must outlive the renderer.
 * Errors:    logged once where found; STATUS_NO_DEVICE, STATUS_TRY_AGAIN or STATUS_FAILED, and
 *            STATUS_USAGE for a picture beyond the device's limits, STATUS_DATA for a scene's
 *            panorama or textures beyond them.
 */
#ifndef FIRN_RENDER_RENDERER_H
#define FIRN_RENDER_RENDERER_H

#include "graph/rg_exec.h"
#include "graph/rg_time.h"
#include "src/frame/layers.h"
#include "src/gpu/gpu.h"
#include "src/image/image.h"
#include "src/render/renderer_params.h"
#include "src/scene/scene.h"

struct renderer;

struct render_result {
    struct image image; /* linear: beauty and layers */
    uint16_t *rgba_16;  /* as rgba, of 16 bits; NULL: the renderer makes none */
    uint8_t *rgba;      /* sRGB-encoded, width * height * 4 bytes; NULL if not asked for */
    float samples;      /* per pixel, on average */
};

/* Called after every sample. If it returns false, rendering stops with STATUS_FAILED and logs
 * nothing. */
typedef bool renderer_progress_fn(void *user, uint32_t done, uint32_t all);

/* Creates a renderer for shots of one size. On failure *renderer is NULL. */
MUST_USE enum status renderer_create(struct renderer **renderer,
                                     const struct renderer_params *params);

/*
 * Draws with other params from now on, of the same gpu, scene and `uploaded`, measured as before.
 * Memory, images and pipelines that both need stay, so a change costs what has changed; what was
 * drawn is gone. Waits for all frames. On failure the renderer may only be destroyed; if that is
 * STATUS_TRY_AGAIN, a new one may still fit into memory, since this needs that of both for a while.
 */
MUST_USE enum status renderer_change(struct renderer *renderer,
                                     const struct renderer_params *params);

/*
 * What renderer_render() or renderer_draw() draws: a picture, or one of its tiles.
 *
 * A tile is a rectangle of the picture (src/base/tile.h) with the same bits as in a whole picture.
 * Render targets have the size of the whole picture, but only a part of their memory is touched.
 * Interleaved tiles are small pictures: pixel (x, y) of tile i is pixel (columns x + i % columns,
 * rows y + i / columns) of the picture, so each tile shows the whole scene. Columns and rows must
 * then divide the picture's width and height.
 */
struct renderer_shot {
    struct camera camera;
    float time;            /* seconds since objects and lights began to move */
    uint32_t tile;         /* below columns * rows */
    struct camera earlier; /* of the frame before; fov_deg 0: `camera` */
};

/* Draws all samples of a shot. *result must be {0} or finished; on failure it is {0}. With tiles it
 * has the size of one tile. `progress` may be NULL. */
MUST_USE enum status renderer_render(struct renderer *renderer, const struct renderer_shot *shot,
                                     struct render_result *result, renderer_progress_fn *progress,
                                     void *user);

/*
 * Submits the shot's sample 0 and returns without waiting for it, except that at most two frames
 * are in flight. For renderers with params.keep.
 */
MUST_USE enum status renderer_draw(struct renderer *renderer, const struct renderer_shot *shot);

/*
 * Draws the environment cube at `time`, seconds, as an image in the layout of environment.h: six
 * faces, one below the other, planes R, G, B, A of half. Of params only gpu, scene, uploaded,
 * settings, sharing and width (of a face) are used. *image must be {0}; on failure it is {0}.
 */
MUST_USE enum status renderer_bake(const struct renderer_params *params, float time,
                                   struct image *image);

/*
 * For renderers with params.refines; the first one also for those with params.scales.
 *
 * renderer_set_view() makes the next pictures smaller, at most as large as params say; it makes no
 * memory and no pipelines, but renderer_picture() is another image. renderer_refine() draws a
 * sample in full size, waits, and adds it to those before; sample 0 begins anew.
 * renderer_resolve() tonemaps the mean of the samples with the settings as they are now, into
 * renderer_mean(): the pixels of renderer_render() with as many samples.
 */
MUST_USE enum status renderer_set_view(struct renderer *renderer, VkExtent2D view);
MUST_USE enum status renderer_refine(struct renderer *renderer, const struct renderer_shot *shot,
                                     uint32_t sample);
MUST_USE enum status renderer_resolve(struct renderer *renderer, uint32_t sample_count);
VkImage renderer_mean(const struct renderer *renderer);
const struct image *renderer_sums(const struct renderer *renderer); /* added up; {0}: none yet */
uint32_t renderer_sum_count(const struct renderer *renderer);       /* samples in them */

/* Waits for the frame submitted last. */
MUST_USE enum status renderer_wait(struct renderer *renderer);

/* Returns the kept picture (frame_display); every frame leaves it ready to be sampled. */
VkImage renderer_picture(const struct renderer *renderer);

/* Time that renderer_create() took, milliseconds of the host. */
struct renderer_costs {
    double tree;             /* build of the tree that rays meet; it stays with the scene */
    uint32_t tree_triangles; /* 0: the rung has no tree */
    uint64_t tree_size;      /* bytes */
    double rays;             /* build of acceleration structures for ray queries */
    uint64_t rays_size;      /* bytes; 0: there are none */
    double upload;           /* of the scene */
    double compile;          /* the frame's tables to a plan */
    double realise;          /* the plan's memory, images, descriptors and pipelines */
};
struct renderer_costs renderer_costs(const struct renderer *renderer);

/* Measures the passes of a frame as graph/rg_time.h says. The times are in the order of the passes
 * of renderer_frame(). */
void renderer_measure(struct renderer *renderer, const struct rg_measure *measure);
struct rg_times renderer_times(const struct renderer *renderer);
const struct rg_plan *renderer_frame(const struct renderer *renderer);

/* Returns the name of a row of that frame, the same for each of several objects. */
const char *renderer_row_name(const struct renderer *renderer, const struct rg_pass *row);

void renderer_destroy(struct renderer *renderer); /* may be NULL */

void render_result_finish(struct render_result *result);

#endif
