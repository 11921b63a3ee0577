/* trace.h: what the rung that traces triangles needs of a scene. */
#ifndef FIRN_FRAME_TRACE_H
#define FIRN_FRAME_TRACE_H

#include "shaders/refract_trace.h"
#include "src/tech/frame.h"

/* Returns whether rays that leave the objects meet the triangles around them, as trace.surroundings
 * says. With `auto` they do if there are several objects, one that is not wholly transmissive or
 * has textures, or a corner of the surroundings within two radii of the object's middle. */
bool frame_trace_meets_surroundings(const struct scene *scene, const struct settings *settings);

/* Returns whether rays bring light to what is around the objects (ground.light): where something of
 * it is lit. */
bool frame_trace_lights_surroundings(const struct scene *scene, const struct settings *settings);

/* Returns CONSTANT_TRACE. */
uint32_t frame_trace_constant(const struct scene *scene, const struct settings *settings);

/* Fills what the rung needs in a frame, after scene_need_tree(). */
void frame_trace_fill(struct trace_frame *trace, const struct frame_view *view,
                      const struct globals *globals);

#endif
