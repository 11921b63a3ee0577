/*
 * refract_frame.glsl: uniforms that the refraction models read, as `refract_frame`.
 *
 * With REFRACT_SEEN these are flat varyings written by the vertex shader, because lavapipe's
 * fragment shaders fetch each float of a uniform separately for each pixel (Mesa 22.3).
 */
#ifndef REFRACT_FRAME_GLSL
#define REFRACT_FRAME_GLSL
#include "lib/globals.glsl"
#include "refract.h"

#if defined(REFRACT_SEEN) || defined(REFRACT_SEEN_VERTEX)
#ifdef REFRACT_SEEN_VERTEX
#define REFRACT_SEEN_IO out
#else
#define REFRACT_SEEN_IO in
#endif

layout(location = REFRACT_SEEN_FRAME) REFRACT_SEEN_IO RefractFrame
{
    flat mat4 clip_from_world;
    flat vec3 eye;
    layout(location = REFRACT_SEEN_FRAME + 4, component = 3) flat float radius;
    layout(location = REFRACT_SEEN_FRAME + 5) flat vec3 center;
    layout(location = REFRACT_SEEN_FRAME + 5, component = 3) flat float eta;
    layout(location = REFRACT_SEEN_FRAME + 6) flat vec3 etas;
    layout(location = REFRACT_SEEN_FRAME + 7) flat vec3 absorb;
}

refract_frame;

#ifdef REFRACT_SEEN_VERTEX
void refract_frame_hand_on()
{
    refract_frame.clip_from_world = frame.clip_from_world;
    refract_frame.eye = frame.eye;
    refract_frame.center = frame.center;
    refract_frame.radius = frame.radius;
    refract_frame.etas = frame.etas;
    refract_frame.absorb = frame.absorb;
    refract_frame.eta = frame.eta;
}
#endif
#else
#define refract_frame frame
#endif

#endif
