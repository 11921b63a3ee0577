/* trace_cloud.glsl: participating media along path segments: Beer-Lambert absorption, extinction
 * and in-scattered light (phase function: cloud_light.glsl), applied to the path throughput. */
#ifndef TRACE_CLOUD_GLSL
#define TRACE_CLOUD_GLSL

/* Returns the path throughput after absorption along a segment of length `t`. */
vec3 trace_absorbed(trace_way path, float t)
{
    vec3 absorption = refract_frame.absorb;
    if (trace_has(TRACE_HAS_MEDIA))
        absorption = trace_medium(trace_top(path.medium_stack), TRACE_ABSORB).rgb;
    bool absorbs = trace_is_in(path) && !(trace_has(TRACE_HAS_INCLUSIONS) && path.is_in_bubble);
    return absorbs ? path.throughput * exp(-absorption * t) : path.throughput;
}

#ifndef TRACE_RAYS
float trace_cloud_passed(float t)
{
    return 1.0;
}
#else
#include "cloud_light.glsl"

const int cloud_steps = 8; /* ray marching steps per segment */

/* Adds the light scattered into a path along a segment. Returns the medium's transmittance. */
float trace_cloud_passed(float t)
{
    uint rank = trace_top(path.medium_stack);
    bool is_clear = !trace_has(TRACE_HAS_CLOUD) || !trace_is_in(path) || path.is_in_bubble;
    float own = is_clear ? 0.0 : trace_medium(rank, TRACE_TINT).w;
    cloud_place cloud = trace.clouds[int(max(-1.0 - own, 0.0))];
    vec3 from = trace_unposed_point(path.origin, TREE_OBJECTS);
    vec3 along = trace_unposed_point(path.origin + path.dir, TREE_OBJECTS) - from;
    vec3 to_sun = trace_unposed_point(path.origin + frame.sun_dir, TREE_OBJECTS) - from;
    cloud_part seen = cloud_follow(cloud, from, along, to_sun, dot(path.dir, frame.sun_dir), t,
                                   cloud_steps, own < 0.0 ? cloud_steps : 0);
    if (seen.depth > 0.0)
        trace_add(path.throughput * cloud_light(seen, path.dir), path.kind);
    return exp(-seen.depth);
}
#endif

#endif
