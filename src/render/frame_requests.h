/* frame_requests.h: builds the frame requests (src/frame/frame_plan.h) of the renderer. */
#ifndef FIRN_RENDER_FRAME_REQUESTS_H
#define FIRN_RENDER_FRAME_REQUESTS_H

#include "src/base/tile.h"
#include "src/frame/frame_plan.h"
#include "src/render/renderer_params.h"

/* Returns the request for one sample of the image. The functions below return requests for the
 * static environment cube, for the cube of `firn bake`, and for tone-mapping the mean of the
 * samples. */
struct frame_request renderer_image_request(const struct renderer_params *params);
struct frame_request renderer_capture_request(const struct renderer_params *params);
struct frame_request renderer_bake_request(const struct renderer_params *params);
struct frame_request renderer_resolve_request(const struct renderer_params *params);

/* Sets the params that depend on the camera. If the camera moves, pass the camera of the first
 * shot. Scene and image size must already be set. */
void renderer_set_camera(struct renderer_params *params, const struct camera *camera);

/* Returns true if faces outside the image must be drawn for rays inside the object. Shots with
 * different results need different renderers. */
bool renderer_draws_beyond_image(const struct renderer_params *params);

/* Returns true if the lighting of surroundings is denoised (denoise.h). */
bool renderer_denoises(const struct renderer_params *params);

/* Returns true if there are several tiles and they are interleaved (struct renderer_shot). */
bool renderer_is_interleaved(const struct renderer_params *params);

/* Returns the rectangular tiles of an image. If drawn whole or interleaved, there is one tile. */
struct tiling renderer_tiling(const struct renderer_params *params);

/* Compiles the plan of a frame for `firn graph`, without a device. Uses only these params:
 * refraction, size, layers, linear, display, keep, sharing, scene and settings. */
MUST_USE enum status renderer_plan(struct frame_plan *plan, const struct renderer_params *params);

#endif
