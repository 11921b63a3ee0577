/* frame_uniforms.h: computes the uniform data of a frame from camera, time and scene. */
#ifndef FIRN_FRAME_FRAME_UNIFORMS_H
#define FIRN_FRAME_FRAME_UNIFORMS_H

#include "shaders/specialization_constants.h"
#include "src/tech/frame.h"

/* Returns the push constants of the image's camera. */
struct surroundings_push frame_view_push(const struct frame_view *view);

/* Returns the previous frame's clip_from_world by its camera (fov_deg 0: the current camera). */
mat4s frame_view_previous_clip_from_world(const struct frame_view *view,
                                          const struct camera *earlier);

/* Returns the pixels that may show points within `radii` (0 means 1) bounding radii of the object's
 * centre, with a margin for rays that overshoot; the whole image if the camera is within that
 * distance or the object is behind it. */
VkRect2D frame_view_reach(const struct frame_view *view, const struct globals *globals,
                          float radii);

/* Returns true if the object's bounding sphere exceeds the image, or the camera is near it. */
bool frame_view_exceeds_image(const struct frame_view *view);

/* Returns the pixels of an image of `size` that may show the rotated box of one or all objects,
 * enlarged by `room` radii and one pixel; the whole image if a corner of the box is in front of the
 * near plane. `globals` is that of the object, or frame_view_globals(). */
VkRect2D frame_view_box_area(const struct frame_view *view, const struct globals *globals,
                             struct box box, VkExtent2D size, float room);

/* Returns the pixels of an image of `size` that show the objects' mirror image in a floor below
 * them, with a margin for uneven floors. */
VkRect2D frame_view_reflection_area(const struct frame_view *view, const struct globals *globals,
                                    VkExtent2D size);

/* Returns the push constants for face 0 to 5 of the environment cube, in Vulkan's face order. */
struct surroundings_push frame_view_face(const struct frame_view *view, uint32_t face);

/* Returns the sun's light as the radiance of a white surface that faces it; 0 without a sun. */
vec3s frame_sun_light(const struct scene *scene, const struct settings *settings);

/* Returns the uniform data of a frame. `push` is frame_view_push(). */
struct globals frame_view_globals(const struct frame_view *view,
                                  const struct surroundings_push *push);

/* Returns the uniform data of the passes that draw one object; `all` is frame_view_globals(). */
struct globals frame_view_object_globals(const struct frame_view *view, const struct globals *all,
                                         uint32_t object);

/* Specialization constants. They depend on scene, settings (of frame_resolve_settings()) and
 * refraction model (NULL: one that does not trace the scene's BVH), but not on camera and time. */
struct frame_constants {
    uint32_t values[CONSTANT_COUNT];
};
struct frame_constants frame_view_constants(const struct scene *scene,
                                            const struct settings *settings,
                                            const struct technique *refraction);

/* Returns `clip_from_world` with its depth remapped to 0 at the front and 1 at the back of a
 * sphere, along the camera axis. The near plane stays in front of the camera if that is inside the
 * sphere. *fitted is set to the distances of the near and the far plane, metres. */
mat4s frame_view_fit(const struct camera *camera, mat4s clip_from_world, vec3s center, float radius,
                     vec2s *fitted);

#endif
