/* fitted.glsl: converts depth by globals.fitted_clip_from_world to metres. */
#ifndef LIB_FITTED_GLSL
#define LIB_FITTED_GLSL
#include "lib/constants.glsl"
#include "lib/globals.glsl"

/* Returns view-space depth in metres. */
float fitted_distance(float depth)
{
    float near = frame.fitted.x;
    float far = frame.fitted.y;
    if (constant_orthographic != 0u)
        return near + depth * (far - near);
    return near * far / (far - depth * (far - near));
}
#endif
