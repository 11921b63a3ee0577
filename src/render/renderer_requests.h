/* renderer_requests.h: builds the frame requests (src/frame/frame_plan.h) of the renderer. */
#ifndef FIRN_RENDER_RENDERER_REQUESTS_H
#define FIRN_RENDER_RENDERER_REQUESTS_H

#include "src/base/tile.h"
#include "src/frame/frame_plan.h"
#include "src/render/renderer_params.h"

/* Return the requests for a sample; for the environment cube, drawn once for all samples; for the
 * environment cube written to a file; and for tone-mapping the mean of many samples. */
struct frame_request renderer_image_request(const struct renderer_params *params);
struct frame_request renderer_capture_request(const struct renderer_params *params);
struct frame_request renderer_bake_request(const struct renderer_params *params);
struct frame_request renderer_resolve_request(const struct renderer_params *params);

/* Sets the params that depend on the camera of all shots or, if it moves, of the first one. Scene
 * and image size must be set. */
void renderer_set_camera(struct renderer_params *params, const struct camera *camera);

/* Returns true if faces outside the image are drawn, too, for rays inside the object. Images for
 * which the answer differs need different renderers. */
bool renderer_draws_beyond_image(const struct renderer_params *params);

/* Returns true if light on surroundings is denoised: denoise.h. */
bool renderer_denoises(const struct renderer_params *params);

/* Returns true if there are several tiles and they are interleaved (struct renderer_shot). */
bool renderer_is_interleaved(const struct renderer_params *params);

/* Returns the rectangles in which an image is drawn: one if drawn whole or in interleaved tiles. */
struct tiling renderer_tiling(const struct renderer_params *params);

/* Compiles the plan of a frame as the renderer would, without a device, for `firn graph`. Only
 * refraction, size, layers, linear, display, keep, sharing, scene and settings of params are used.
 */
MUST_USE enum status renderer_plan(struct frame_plan *plan, const struct renderer_params *params);

#endif
