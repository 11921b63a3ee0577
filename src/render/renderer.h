/*
 * renderer.h: scene + settings + camera to a picture; what every front end calls.
 *
 *     renderer_create()   uploads the scene, compiles the plan, realises it
 *     renderer_render()   draws all samples and brings the picture back
 *     renderer_draw()     or draws a sample and leaves the picture on the device
 *     renderer_bake()     or, without all these, what surrounds the object
 *
 * Ownership: gpu, scene (and `uploaded`) and settings are borrowed and outlive the renderer.
 * Errors:    logged once where found; STATUS_NO_DEVICE, STATUS_TRY_AGAIN or STATUS_FAILED, and
 *            STATUS_USAGE for a picture beyond the device's limits.
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
    uint8_t *rgba;      /* sRGB-encoded, width * height * 4 bytes; NULL if not asked for */
};

/* Called after every sample; false stops the render with STATUS_FAILED, nothing logged. */
typedef bool renderer_progress_fn(void *user, uint32_t done, uint32_t all);

MUST_USE enum status renderer_create(struct renderer **renderer,
                                     const struct renderer_params *params);

/*
 * What one picture shows. With tiles, one of them: a part of the picture (src/base/tile.h), with
 * the bits that it has there, for which images of the whole picture's size are made, of which only
 * some is touched. Interleaved ones are small pictures: pixel (x, y) of tile i is pixel
 * (columns x + i % columns, rows y + i / columns) of the picture, so each tile shows all of it;
 * they divide its width and height.
 */
struct renderer_shot {
    struct camera camera;
    float time;    /* seconds: what turns and moves has turned so long */
    uint32_t tile; /* below columns * rows */
};

/* *result must be {0} or finished; on failure it is {0}; with tiles it has the pixels of one.
 * `progress` may be NULL. */
MUST_USE enum status renderer_render(struct renderer *renderer, const struct renderer_shot *shot,
                                     struct render_result *result, renderer_progress_fn *progress,
                                     void *user);

/*
 * Draws the shot's sample 0 and returns without waiting for it; at most two frames are on their way
 * at once. For renderers that keep the picture.
 */
MUST_USE enum status renderer_draw(struct renderer *renderer, const struct renderer_shot *shot);

/*
 * The environment cube at a time, as environment.h has it: six faces, one below the other, planes
 * R, G, B, A of half. Only gpu, scene, uploaded, settings, sharing and width (of a face) of params
 * count. *image must be {0}; on failure it is.
 */
MUST_USE enum status renderer_bake(const struct renderer_params *params, float time,
                                   struct image *image);

/* Waits for the frame drawn last. */
MUST_USE enum status renderer_wait(struct renderer *renderer);

/* The kept picture (frame_display), which every frame leaves ready to be sampled by shaders. */
VkImage renderer_picture(const struct renderer *renderer);

/* What a renderer took to make, milliseconds of the host. */
struct renderer_costs {
    double upload;  /* of the scene */
    double compile; /* the frame's tables to a plan */
    double realise; /* the plan's memory, images, descriptors and pipelines */
};
struct renderer_costs renderer_costs(const struct renderer *renderer);

/* What each pass of a frame costs: graph/rg_time.h. The plan's passes are those of the times. */
void renderer_measure(struct renderer *renderer, const struct rg_measure *measure);
struct rg_times renderer_times(const struct renderer *renderer);
const struct rg_plan *renderer_frame(const struct renderer *renderer);

void renderer_destroy(struct renderer *renderer); /* may be NULL */

void render_result_finish(struct render_result *result);

#endif
