/* fitted.glsl: metres from the depth of globals.fitted_clip_from_world. */
#ifndef LIB_FITTED_GLSL
#define LIB_FITTED_GLSL
#include "lib/globals.glsl"

/* Distance along the view's axis. */
float fitted_distance(float depth)
{
    float near = frame.fitted.x;
    float far = frame.fitted.y;
    return near * far / (far - depth * (far - near));
}
#endif
