/*
 * view.h: what a frame's shaders are told of camera, time and scene.
 */
#ifndef FIRN_FRAME_VIEW_H
#define FIRN_FRAME_VIEW_H

#include "shaders/constants.h"
#include "src/tech/frame.h"

struct background_push frame_view_push(const struct frame_view *view);

/*
 * Where in the picture points are that lie within so many radii (0: one) of the object's centre,
 * and a little more: so much as rays may overshoot. All of it where the eye is among them, or
 * they are behind it.
 */
VkRect2D frame_view_reach(const struct frame_view *view, const struct globals *globals,
                          float radii);

/* Where in what is drawn, `size` pixels, the box of the object is, turned with it and `room` radii
 * larger on all sides, and a pixel more; all of it where some of it lies before the near plane.
 * `globals` is frame_view_globals(). */
VkRect2D frame_view_object_area(const struct frame_view *view, const struct globals *globals,
                                VkExtent2D size, float room);

/* Of one face of the cube around the object. */
struct background_push frame_view_face(const struct frame_view *view, uint32_t face);

/* `push` is frame_view_push(). */
struct globals frame_view_globals(const struct frame_view *view,
                                  const struct background_push *push);

/* Of the scene's and the settings' shaders, whatever the camera and the time. */
struct frame_constants {
    uint32_t values[CONSTANT_COUNT];
};
struct frame_constants frame_view_constants(const struct scene *scene,
                                            const struct settings *settings);

/* Depth 0 at the front and 1 at the back of a sphere, as seen along the camera's axis. Guarded
 * where the eye is inside; *fitted gets the near and far plane's distances, metres. */
mat4s frame_view_fit(const struct camera *camera, mat4s clip_from_world, vec3s center, float radius,
                     vec2s *fitted);

#endif
