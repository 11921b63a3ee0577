/* refract_thickness.glsl: how thick the ice is behind the front face of this pixel. */
#ifndef REFRACT_THICKNESS_GLSL
#define REFRACT_THICKNESS_GLSL
#include "refract_front.glsl"
#include "refract_maps.glsl"

/* Metres along the straight ray. Distances along the view's axis are as near / depth; 0 where there
 * is no back face. */
float refract_thickness()
{
    float back = texelFetch(depth_back, ivec2(gl_FragCoord.xy), 0).r;
    return back > 0.0 ? length(eye_to_point) * max(gl_FragCoord.z / back - 1.0, 0.0) : 0.0;
}

#endif
