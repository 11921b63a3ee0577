/* eye.h: the rays of a picture's samples. */
#ifndef FIRN_REFERENCE_EYE_H
#define FIRN_REFERENCE_EYE_H

#include "src/reference/bvh.h"
#include "src/render/pixel_filter.h"
#include "src/tech/frame.h"

struct eye {
    struct frame_view view;
    struct background_push push; /* of the view */
    enum pixel_filter filter;
    vec3s forward; /* the view's axis, unit */
    bool is_flat;  /* the camera is orthographic */
    bool has_lens; /* it has a lens that blurs */
};

struct eye eye_of(const struct frame_view *view, enum pixel_filter filter);

/* Returns the ray of a sample of a pixel. */
struct bvh_ray eye_ray(const struct eye *eye, uint32_t x, uint32_t y, uint32_t sample);

#endif
