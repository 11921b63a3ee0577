/* linearize_depth.glsl: converts depth-buffer values of globals.fitted_clip_from_world to metres.
 */
#ifndef LINEARIZE_DEPTH_GLSL
#define LINEARIZE_DEPTH_GLSL
#include "lib/globals.glsl"
#include "lib/specialization_constants.glsl"

/* Returns view-space depth in metres. */
float fitted_view_depth(float depth)
{
    float near = frame.fitted.x;
    float far = frame.fitted.y;
    if (constant_orthographic != 0u)
        return near + depth * (far - near);
    return near * far / (far - depth * (far - near));
}
#endif
