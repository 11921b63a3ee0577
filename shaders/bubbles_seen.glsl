/* bubbles_seen.glsl: with BUBBLES_BENT, what over.frag needs to show bubbles along bent rays. */
#ifndef BUBBLES_SEEN_GLSL
#define BUBBLES_SEEN_GLSL
#ifdef BUBBLES_BENT
#include "within.glsl"

layout(set = 0, binding = BUBBLES_CRACKS) uniform sampler2D cracks_met;

layout(location = 1) out float seen_depth; /* of within.glsl */

/* Returns whether a crack that mirrors all hides a point on a ray from the eye, and writes the
 * point's depth. */
bool bubble_is_hidden(vec3 e, vec3 eye_to_point)
{
    vec4 met = texelFetch(cracks_met, ivec2(gl_FragCoord.xy), 0);
    seen_depth = within_depth(frame.eye + eye_to_point - frame.center, frame.forward, frame.radius);
    float n = frame.outside_in_air / frame.eta;
    float c = dot(met.yzw, e) / max(length(met.yzw), 1e-9);
    return met.r > 0.0 && met.r < seen_depth && n * n * (1.0 - c * c) > 1.0;
}
#else
bool bubble_is_hidden(vec3 e, vec3 eye_to_point)
{
    return false;
}
#endif
#endif
