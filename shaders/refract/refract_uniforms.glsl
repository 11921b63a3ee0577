/* refract_uniforms.glsl: uniforms of the refraction models, in the block refract_frame. With
 * REFRACT_FULLSCREEN, they are flat varyings instead, because lavapipe's fragment shaders fetch
 * each uniform float separately for each pixel (Mesa 22.3). */
#ifndef REFRACT_UNIFORMS_GLSL
#define REFRACT_UNIFORMS_GLSL
#include "lib/globals.glsl"
#include "refract/refract.h"

#if defined(REFRACT_FULLSCREEN) || defined(REFRACT_FULLSCREEN_VERTEX)
#ifdef REFRACT_FULLSCREEN_VERTEX
#define REFRACT_FULLSCREEN_IO out
#else
#define REFRACT_FULLSCREEN_IO in
#endif

layout(location = REFRACT_FULLSCREEN_FRAME) REFRACT_FULLSCREEN_IO RefractFrame
{
    flat mat4 clip_from_world;
    flat vec3 eye;
    layout(location = REFRACT_FULLSCREEN_FRAME + 4, component = 3) flat float radius;
    layout(location = REFRACT_FULLSCREEN_FRAME + 5) flat vec3 center;
    layout(location = REFRACT_FULLSCREEN_FRAME + 5, component = 3) flat float eta;
    layout(location = REFRACT_FULLSCREEN_FRAME + 6) flat vec3 etas;
    layout(location = REFRACT_FULLSCREEN_FRAME + 7) flat vec3 absorb;
}

refract_frame;

#ifdef REFRACT_FULLSCREEN_VERTEX
void refract_frame_write()
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
