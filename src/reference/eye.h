/* eye.h: generates the camera rays of an image's samples. */
#ifndef FIRN_REFERENCE_EYE_H
#define FIRN_REFERENCE_EYE_H

#include "src/reference/bvh.h"
#include "src/render/pixel_filter.h"
#include "src/tech/frame.h"

struct camera_rays {
    struct frame_view view;
    struct background_push push; /* camera basis of the view */
    enum pixel_filter filter;
    vec3s forward;        /* unit viewing direction */
    bool is_orthographic; /* the camera is orthographic */
    bool has_lens;        /* the camera has a thin lens with depth of field */
};

struct camera_rays eye_of(const struct frame_view *view, enum pixel_filter filter);

/* Returns the camera ray of one sample of a pixel. */
struct bvh_ray eye_ray(const struct camera_rays *eye, uint32_t x, uint32_t y, uint32_t sample);

#endif
