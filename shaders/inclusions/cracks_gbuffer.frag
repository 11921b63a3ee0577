/* cracks_gbuffer.frag: writes the image of cracks that refracted rays may hit
 * (refract_cracks.glsl). A highly reflective crack hides less reflective ones, even if they are
 * nearer. */
#version 460
#include "inclusions/cracks_clip.glsl"
#include "inclusions/cracks_shading.glsl"
#include "refract/inclusion_march.glsl"

layout(location = 0) out vec4 hit; /* r: depth; gba: normal times (1 + gap width in micrometres) */

void main()
{
    if (!crack_is_inside())
        discard;
    crack_point c = crack_here();
    vec3 from_center = pose_object(frame.radius * position) - frame.center;
    hit = vec4(inclusion_depth(from_center, frame.forward, frame.radius),
               (1.0 + crack_width()) * pose_object_normal(c.n));
    bool is_reflective = dot(crack_reflectance(c), vec3(1.0)) > 3.0 * CRACKS_HIT_REFLECTANCE;
    gl_FragDepth = 0.5 * (gl_FragCoord.z + (is_reflective ? 0.0 : 1.0));
}
