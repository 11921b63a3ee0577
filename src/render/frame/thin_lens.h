/*
 * thin_lens.h: thin-lens camera model for depth of field (settings lens.*).
 *
 * Each sample of an image is taken from another point of the aperture, sample 0 from its centre.
 * The focal plane is perpendicular to the camera axis and stays fixed in the image. This works with
 * every refraction model, but blur consists of as many copies as there are samples.
 */
#ifndef FIRN_RENDER_FRAME_THIN_LENS_H
#define FIRN_RENDER_FRAME_THIN_LENS_H

#include "src/tech/frame_resources.h"

struct frame_lens {
    vec3s aside; /* camera to lens point, world, metres */
    float focus; /* focal plane distance, metres, above 0 */
};

/* Samples the lens for view->sample. `aside` is 0 for a pinhole or an orthographic camera. */
struct frame_lens frame_lens_of(const struct frame_view *view);

/* Offsets the camera to its lens sample and shears the projection to keep the focal plane fixed. */
void frame_lens_apply(struct frame_view *view);

#endif
