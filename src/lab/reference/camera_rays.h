/* camera_rays.h: generates camera rays at the sample positions of an image. */
#ifndef FIRN_LAB_REFERENCE_CAMERA_RAYS_H
#define FIRN_LAB_REFERENCE_CAMERA_RAYS_H

#include "src/lab/reference/embree_scene.h"
#include "src/render/pixel_filter.h"
#include "src/tech/frame_resources.h"

struct camera_rays {
    struct frame_view view;
    struct surroundings_push push; /* camera basis of the view */
    enum pixel_filter filter;
    vec3s forward;        /* unit viewing direction of the camera */
    bool is_orthographic; /* the camera is orthographic */
    bool has_lens;        /* thin lens with depth of field */
};

struct camera_rays camera_rays_of(const struct frame_view *view, enum pixel_filter filter);

/* Returns the camera ray of one sample of a pixel. */
struct embree_scene_ray camera_rays_at(const struct camera_rays *rays, uint32_t x, uint32_t y,
                                       uint32_t sample);

#endif
