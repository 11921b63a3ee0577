/*
 * trace_cloud.glsl: what a medium absorbs on a straight part of a way, and what cloudy ice scatters
 * into it (cloud_light.glsl).
 */
#ifndef TRACE_CLOUD_GLSL
#define TRACE_CLOUD_GLSL

/* Absorbs light on a straight part. */
vec3 trace_absorbed(trace_way way, float t)
{
    vec3 absorption = refract_frame.absorb;
    if (trace_has(TRACE_HAS_MEDIA))
        absorption = trace_medium(trace_top(way.inside), TRACE_ABSORB).rgb;
    bool absorbs = trace_is_in(way) && !(trace_has(TRACE_HAS_INCLUSIONS) && way.is_in_bubble);
    return absorbs ? way.weight * exp(-absorption * t) : way.weight;
}

#ifndef TRACE_RAYS
float trace_cloud_passed(float t)
{
    return 1.0;
}
#else
#include "cloud_light.glsl"

const int cloud_steps = 8; /* of a straight part */

/* Adds what is scattered into a way on a straight part. Returns the share of its light that goes
 * straight on. */
float trace_cloud_passed(float t)
{
    uint rank = trace_top(way.inside);
    bool is_clear = !trace_has(TRACE_HAS_CLOUD) || !trace_is_in(way) || way.is_in_bubble;
    float own = is_clear ? 0.0 : trace_medium(rank, TRACE_TINT).w;
    cloud_place cloud = trace.clouds[int(max(-1.0 - own, 0.0))];
    vec3 from = trace_unposed_point(way.origin, TREE_OBJECTS);
    vec3 along = trace_unposed_point(way.origin + way.dir, TREE_OBJECTS) - from;
    vec3 to_sun = trace_unposed_point(way.origin + frame.sun_dir, TREE_OBJECTS) - from;
    cloud_part seen = cloud_follow(cloud, from, along, to_sun, dot(way.dir, frame.sun_dir), t,
                                   cloud_steps, own < 0.0 ? cloud_steps : 0);
    if (seen.depth > 0.0)
        trace_add(way.weight * cloud_light(seen, way.dir), way.kind);
    return exp(-seen.depth);
}
#endif

#endif
