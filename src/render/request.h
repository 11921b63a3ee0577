/* request.h: the frames behind a picture, as frame_plan.h takes them; for the renderer. */
#ifndef FIRN_RENDER_REQUEST_H
#define FIRN_RENDER_REQUEST_H

#include "src/base/tile.h"
#include "src/frame/plan.h"
#include "src/render/renderer_params.h"

/* A sample; the environment cube that stays; one to keep as a file; the mean of many samples. */
struct frame_request renderer_picture_request(const struct renderer_params *params);
struct frame_request renderer_capture_request(const struct renderer_params *params);
struct frame_request renderer_bake_request(const struct renderer_params *params);
struct frame_request renderer_resolve_request(const struct renderer_params *params);

/* Whether each tile is some pixels of all the picture. */
bool renderer_is_interleaved(const struct renderer_params *params);

/* The tiles that a picture is drawn in, one after another, as parts of it: one if it is whole, or
 * drawn interleaved. */
struct tiling renderer_tiling(const struct renderer_params *params);

/* The plan of a frame as the renderer would compile it, without a device: for `firn graph`.
 * Only rung, size, layers, linear, display, keep, sharing, scene and settings of params count. */
MUST_USE enum status renderer_plan(struct frame_plan *plan, const struct renderer_params *params);

#endif
