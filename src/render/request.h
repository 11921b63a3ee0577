/* request.h: the requests (src/frame/plan.h) of the renderer's frames. */
#ifndef FIRN_RENDER_REQUEST_H
#define FIRN_RENDER_REQUEST_H

#include "src/base/tile.h"
#include "src/frame/plan.h"
#include "src/render/renderer_params.h"

/* Return the requests for a sample; for the environment cube, once for all samples; for the
 * environment cube to be written to a file; and for tonemapping the mean of many samples. */
struct frame_request renderer_picture_request(const struct renderer_params *params);
struct frame_request renderer_capture_request(const struct renderer_params *params);
struct frame_request renderer_bake_request(const struct renderer_params *params);
struct frame_request renderer_resolve_request(const struct renderer_params *params);

/* Sets what of the params depends on the camera, of all shots, or if it moves, of the first. Scene
 * and size are set. */
void renderer_see(struct renderer_params *params, const struct camera *camera);

/* Returns whether faces beyond the picture are drawn for rays inside the object; the renderers of
 * pictures for which the answer differs are different ones. */
bool renderer_is_wide(const struct renderer_params *params);

/* Whether light on surroundings is smoothed: smooth.h. */
bool renderer_smooths(const struct renderer_params *params);

/* Returns whether tiles are interleaved (struct renderer_shot) and there are several. */
bool renderer_is_interleaved(const struct renderer_params *params);

/* Returns the rectangles in which a picture is drawn: one if the picture is drawn as a whole or in
 * interleaved tiles. */
struct tiling renderer_tiling(const struct renderer_params *params);

/* The plan of a frame as the renderer would compile it, without a device: for `firn graph`.
 * Only rung, size, layers, linear, display, keep, sharing, scene and settings of params count. */
MUST_USE enum status renderer_plan(struct frame_plan *plan, const struct renderer_params *params);

#endif
