/* make_frame_request.h: builds the frame requests (src/render/frame/compile_frame_plan.h) of the
 * renderer. */
#ifndef FIRN_RENDER_MAKE_FRAME_REQUEST_H
#define FIRN_RENDER_MAKE_FRAME_REQUEST_H

#include "src/base/tile.h"
#include "src/render/frame/compile_frame_plan.h"
#include "src/render/renderer_params.h"

/* Returns the frame request for one sample of the image. */
struct frame_request renderer_image_request(const struct renderer_params *params);
/* Returns the frame request for the static environment cube. */
struct frame_request renderer_capture_request(const struct renderer_params *params);
/* Returns the frame request for tone-mapping the mean of the samples. */
struct frame_request renderer_resolve_request(const struct renderer_params *params);

/* Sets the params that depend on the camera. params.scene, width and height must be set. If the
 * camera moves, pass the first shot's camera. */
void renderer_set_camera(struct renderer_params *params, const struct camera *camera);

/* Returns true if faces outside the image must be drawn, because rays inside the object look them
 * up. The result must be equal for all shots of a renderer. */
bool renderer_draws_beyond_image(const struct renderer_params *params);

/* Returns true if the lighting of surroundings is denoised (denoise.h). */
bool renderer_denoises(const struct renderer_params *params);

/* Returns true if there are several tiles and they are interleaved (struct renderer_shot). */
bool renderer_is_interleaved(const struct renderer_params *params);

/* Returns the rectangular tiles of an image. Whole and interleaved images have only one tile. */
struct tiling renderer_tiling(const struct renderer_params *params);

/* Compiles a frame's plan for `firn graph`, without a device. Only these params are used:
 * refraction, size, layers, linear, display, keep, sharing, scene and settings. */
MUST_USE enum status renderer_plan(struct frame_plan *plan, const struct renderer_params *params);

#endif
