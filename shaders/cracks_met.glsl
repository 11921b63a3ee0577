/*
 * cracks_met.glsl: main() of the crack hits for refraction models that continue the ray at a gap
 * (refract_cracks.glsl); the clipping method defines crack_is_inside(). A gap that is highly
 * reflective along the straight ray hides weaker ones, however near they are.
 */
#include "cracks.glsl"
#include "within.glsl"

layout(location = 0) out vec4 met; /* r: depth (within.glsl); gba: normal of length 1 + width, um */

void main()
{
    if (!crack_is_inside())
        discard;
    crack_point c = crack_here();
    vec3 from_center = pose_object(frame.radius * position) - frame.center;
    met = vec4(within_depth(from_center, frame.forward, frame.radius),
               (1.0 + crack_width()) * pose_object_normal(c.n));
    bool mirrors = dot(crack_shares(c), vec3(1.0)) > 3.0 * CRACKS_MET_MUCH;
    gl_FragDepth = 0.5 * (gl_FragCoord.z + (mirrors ? 0.0 : 1.0));
}
