/* trace_participating_media.glsl: Beer-Lambert absorption, extinction and in-scattered light of
 * participating media along path segments. The phase function is in medium_light.glsl. */
#ifndef TRACE_PARTICIPATING_MEDIA_GLSL
#define TRACE_PARTICIPATING_MEDIA_GLSL

/* Returns the path throughput after absorption along a segment of length `t`. */
vec3 trace_absorb(trace_path path, float t)
{
    vec3 absorption = refract_frame.absorb;
    if (trace_has(TRACE_HAS_MEDIA))
        absorption = trace_medium(trace_current_medium(path.medium_stack), TRACE_ABSORB).rgb;
    bool absorbs = trace_is_in(path) && !(trace_has(TRACE_HAS_INCLUSIONS) && path.is_in_bubble);
    return absorbs ? path.throughput * exp(-absorption * t) : path.throughput;
}

#ifndef TRACE_RAYS
float trace_medium_transmittance(float t)
{
    return 1.0;
}
#else
#include "inclusions/medium_light.glsl"

const int medium_steps = 8; /* ray marching steps per segment */

/* Adds the light scattered into a path along a segment. Returns the medium's transmittance. */
float trace_medium_transmittance(float t)
{
    uint rank = trace_current_medium(path.medium_stack);
    bool is_clear = !trace_has(TRACE_HAS_SCATTERING) || !trace_is_in(path) || path.is_in_bubble;
    float tint_w = is_clear ? 0.0 : trace_medium(rank, TRACE_TINT).w;
    medium_field field = trace.scattering_media[int(max(-1.0 - tint_w, 0.0))];
    vec3 from = trace_unposed_point(path.origin, BVH_OBJECTS);
    vec3 along = trace_unposed_point(path.origin + path.dir, BVH_OBJECTS) - from;
    vec3 to_sun = trace_unposed_point(path.origin + frame.sun_dir, BVH_OBJECTS) - from;
    medium_segment segment = medium_march(field, from, along, to_sun, dot(path.dir, frame.sun_dir),
                                          t, medium_steps, tint_w < 0.0 ? medium_steps : 0);
    if (segment.depth > 0.0)
        trace_add(path.throughput * medium_light(segment, path.dir), path.kind);
    return exp(-segment.depth);
}
#endif

#endif
