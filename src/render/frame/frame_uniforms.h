/* frame_uniforms.h: computes the uniform data of a frame from camera, time and scene. */
#ifndef FIRN_RENDER_FRAME_FRAME_UNIFORMS_H
#define FIRN_RENDER_FRAME_FRAME_UNIFORMS_H

#include "shaders/specialization_constants.h"
#include "src/tech/frame_resources.h"

/* Returns the push constants of the image's camera. */
struct surroundings_push frame_view_push(const struct frame_view *view);

/* Returns clip_from_world for `earlier`, or for the current camera if earlier->fov_deg is 0. */
mat4s frame_view_previous_clip_from_world(const struct frame_view *view,
                                          const struct camera *earlier);

/* Returns the pixels, with a margin, that may show a sphere around the object. The sphere's radius
 * is `radii` times the object's bounding radius; 0 means 1. If part of the sphere is not in front
 * of the camera, returns all pixels. */
VkRect2D frame_view_reach(const struct frame_view *view, const struct globals *globals,
                          float radii);

/* Returns true if the object's bounding sphere extends beyond the image or is near the camera. */
bool frame_view_exceeds_image(const struct frame_view *view);

/* Returns the pixels that may show `box`, enlarged by `room` bounding radii and one pixel. The box
 * rotates with its object. If a corner is nearer than the near plane, returns all pixels. `globals`
 * belong to the box's object; for the box of all objects, use frame_view_globals(). */
VkRect2D frame_view_box_area(const struct frame_view *view, const struct globals *globals,
                             struct box box, VkExtent2D size, float room);

/* Returns the pixels that may show the reflection of the objects in a floor below them. A margin
 * allows for uneven floors. */
VkRect2D frame_view_reflection_area(const struct frame_view *view, const struct globals *globals,
                                    VkExtent2D size);

/* Returns the push constants for face 0 to 5 of the environment cube, in Vulkan's face order. */
struct surroundings_push frame_view_face(const struct frame_view *view, uint32_t face);

/* Returns the sunlight as the radiance of a white surface that faces the sun; 0 without a sun. */
vec3s frame_sun_light(const struct scene *scene, const struct settings *settings);

/* Returns the uniform data of a frame. `push` is frame_view_push(). */
struct globals frame_view_globals(const struct frame_view *view,
                                  const struct surroundings_push *push);

/* Returns the uniform data of the passes that draw one object; `all` is frame_view_globals(). */
struct globals frame_view_object_globals(const struct frame_view *view, const struct globals *all,
                                         uint32_t object);

/* Specialisation constants. They depend on the scene, the resolved settings and the refraction
 * model, but not on camera or time. */
struct frame_constants {
    uint32_t values[CONSTANT_COUNT];
};
struct frame_constants frame_view_constants(const struct scene *scene,
                                            const struct settings *settings,
                                            const struct technique *refraction);

/* Returns `clip_from_world` with its depth fitted to a sphere: 0 at the front, 1 at the back. If
 * the camera is inside the sphere, the near plane is in front of the camera. *fitted receives the
 * distances of the near and far planes along the camera axis, in metres. */
mat4s frame_view_fit(const struct camera *camera, mat4s clip_from_world, vec3s center, float radius,
                     vec2s *fitted);

#endif
