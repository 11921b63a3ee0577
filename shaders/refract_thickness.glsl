/* refract_thickness.glsl: the thickness of the ice behind this pixel's front face. */
#ifndef REFRACT_THICKNESS_GLSL
#define REFRACT_THICKNESS_GLSL
#include "refract_front.glsl"
#include "refract_maps.glsl"

/* Returns metres along the straight ray, or 0 without a back face. Distances along the view's axis
 * are proportional to 1 / depth, or orthographic ones linear in it. */
float refract_thickness()
{
    float back = texelFetch(depth_back, ivec2(gl_FragCoord.xy), 0).r;
    if (constant_orthographic != 0u)
        return back > 0.0 ? max(view_distance(refract_frame.clip_from_world, back) -
                                    view_distance(refract_frame.clip_from_world, gl_FragCoord.z),
                                0.0)
                          : 0.0;
    return back > 0.0 ? length(eye_to_point) * max(gl_FragCoord.z / back - 1.0, 0.0) : 0.0;
}

#endif
