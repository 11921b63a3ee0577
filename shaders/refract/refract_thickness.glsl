/* refract_thickness.glsl: thickness of the ice behind the pixel's front face. */
#ifndef REFRACT_THICKNESS_GLSL
#define REFRACT_THICKNESS_GLSL
#include "refract/refract_depth_maps.glsl"
#include "refract/refract_front_face_input.glsl"

/* Returns the ice's thickness along the unrefracted ray in metres; 0 without a back face. Distance
 * is proportional to 1 / depth in perspective views, and linear in depth in orthographic views. */
float refract_thickness()
{
    float back = texelFetch(depth_back, ivec2(gl_FragCoord.xy), 0).r;
    if (constant_orthographic != 0u)
        return back > 0.0 ? max(view_depth(refract_frame.clip_from_world, back) -
                                    view_depth(refract_frame.clip_from_world, gl_FragCoord.z),
                                0.0)
                          : 0.0;
    return back > 0.0 ? length(eye_to_point) * max(gl_FragCoord.z / back - 1.0, 0.0) : 0.0;
}

#endif
