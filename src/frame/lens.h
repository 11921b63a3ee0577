/*
 * lens.h: a camera with a lens: what is not in focus is blurred (settings lens.*).
 *
 * Each sample of a picture looks through another point of the lens, the first one through its
 * middle. The plane in focus is perpendicular to the camera's axis, and stays where it is. So all
 * rungs have it, and as many images of what is out of focus as there are samples.
 */
#ifndef FIRN_FRAME_LENS_H
#define FIRN_FRAME_LENS_H

#include "src/tech/frame.h"

struct frame_lens {
    vec3s aside; /* from the eye to the sample's point of the lens, world, metres */
    float focus; /* distance of the plane in focus along the camera's axis, metres, above 0 */
};

/* Returns the point of the lens of view->sample; {0} aside where there is no lens, as in
 * orthographic pictures. */
struct frame_lens frame_lens_of(const struct frame_view *view);

/* Moves a view's camera to its point of the lens, and its pixels back. */
void frame_lens_apply(struct frame_view *view);

#endif
