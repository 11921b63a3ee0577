/*
 * cracks_hit.frag: main() of the crack hits for refraction models that continue the ray at a gap
 * (refract_cracks.glsl); the clipping method defines crack_is_inside(). A gap that is highly
 * reflective along the straight ray hides weaker ones, however near they are.
 */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "inclusions/cracks.glsl"
#include "inclusions/cracks_clip.glsl"
#include "refract/inclusion_march.glsl"

layout(location = 0)
    out vec4 met; /* r: depth (inclusion_march.glsl); gba: normal of length 1 + width, um */

void main()
{
    if (!crack_is_inside())
        discard;
    crack_point c = crack_here();
    vec3 from_center = pose_object(frame.radius * position) - frame.center;
    met = vec4(inclusion_depth(from_center, frame.forward, frame.radius),
               (1.0 + crack_width()) * pose_object_normal(c.n));
    bool mirrors = dot(crack_reflectance(c), vec3(1.0)) > 3.0 * CRACKS_HIT_REFLECTANCE;
    gl_FragDepth = 0.5 * (gl_FragCoord.z + (mirrors ? 0.0 : 1.0));
}
