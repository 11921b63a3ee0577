/*
 * trace_cloud.glsl: what a medium absorbs on a straight part of a way, and what cloudy ice scatters
 * into it (cloud.h).
 *
 * Light of what is around, without the sun: the share exp(-t) of it, t the scatterings on the part,
 * goes straight on; exp(-(1 - g) t) - exp(-t) comes from about its direction; the rest from
 * everywhere. The shares add up to 1: in even light cloudy ice is not seen. Light of the sun comes
 * straight to where it is scattered, and is spread the more the oftener it is scattered (Wrenninge,
 * Kulla and Lundqvist 2013, Oz: The Great and Volumetric).
 *
 * Error: the light around is that of infinity, the same at all places, and the sun's is neither
 * refracted nor hidden.
 */
#ifndef TRACE_CLOUD_GLSL
#define TRACE_CLOUD_GLSL

/* Absorbs light on a straight part. */
vec3 trace_absorbed(trace_way way, float t)
{
    vec3 absorption = refract_frame.absorb;
    if (trace_has(TRACE_HAS_MEDIA))
        absorption = trace_medium(trace_top(way.inside), TRACE_ABSORB).rgb;
    bool absorbs = trace_is_inside(way.inside) && !way.is_in_bubble;
    return absorbs ? way.weight * exp(-absorption * t) : way.weight;
}

#ifndef TRACE_RAYS
float trace_cloud_passed(float t)
{
    return 1.0;
}
#else
#include "cloud.h"
#include "trace_surface.glsl"

layout(set = 0, binding = TRACE_CLOUDS) uniform sampler2DArray clouds;

const int cloud_steps = 8;          /* of a straight part */
const int cloud_sun_steps = 3;      /* towards the sun, each twice as long as the one before */
const float cloud_roughness = 0.65; /* of a surface that blurs as much as clouds do */

/* Returns the density of a cloud at a point in the space of the objects, from 0 to 1. */
float cloud_density(trace_cloud cloud, vec3 point)
{
    vec3 at = (point - cloud.low) * cloud.texels_each;
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(CLOUD_SIZE))))
        return 0.0;
    float z = clamp(at.z - 0.5, 0.0, float(CLOUD_SIZE) - 1.0);
    float layer = min(floor(z), float(CLOUD_SIZE) - 2.0);
    vec3 texel = vec3(at.xy / float(CLOUD_SIZE), cloud.first_layer + layer);
    float below = textureLod(clouds, texel, 0.0).r;
    float above = textureLod(clouds, texel + vec3(0.0, 0.0, 1.0), 0.0).r;
    return mix(below, above, z - layer);
}

/* Returns the scatterings on the sun's way to a point. */
float cloud_sun_depth(trace_cloud cloud, vec3 point, vec3 to_sun)
{
    float sum = 0.0, from = 0.0, length = 0.06 * float(CLOUD_SIZE) / cloud.texels_each.x;
    for (int i = 0; i < cloud_sun_steps; i++) {
        sum += length * cloud_density(cloud, point + (from + 0.5 * length) * to_sun);
        from += length;
        length *= 2.0;
    }
    return sum * cloud.extinction;
}

/* Returns Henyey and Greenstein's share of light that is turned by an angle, by 1 / 4 pi. */
float cloud_phase(float cosine, float g)
{
    float base = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (base * sqrt(base));
}

/* Returns what of the sun's light is scattered into a direction, after so many scatterings on its
 * way, each of which widens its directions; 1: the light on a white matt surface. */
float cloud_of_sun(float cosine, float depth)
{
    float g = trace.cloud_cosine;
    float wider = sign(g) * pow(abs(g), 1.0 + depth);
    return 0.25 * cloud_phase(cosine, wider) * exp(-(1.0 - g) * depth);
}

/* Returns the light of what is around: a share of what is about a direction, another of what is
 * everywhere. */
vec3 cloud_around(vec3 dir, float ahead, float anywhere)
{
    vec3 before = lit_matt(dir);
    vec3 even = 0.5 * (before + lit_matt(-dir));
    if (constant_background == GLOBALS_ENVIRONMENT)
        before = lit_glossy(dir, cloud_roughness, 0.0);
    return ahead * before + anywhere * even;
}

/* Adds what is scattered into a way on a straight part. Returns the share of its light that goes
 * straight on. */
float trace_cloud_passed(float t)
{
    uint rank = trace_top(way.inside);
    bool is_clear = !trace_has(TRACE_HAS_CLOUD) || !trace_is_inside(way.inside) || way.is_in_bubble;
    float own = is_clear ? 0.0 : trace_medium(rank, TRACE_TINT).w;
    int turns = own < 0.0 ? cloud_steps : 0;
    float depth = 0.0, sun = 0.0;
    trace_cloud cloud = trace.clouds[int(max(-1.0 - own, 0.0))];
    vec3 from = trace_unposed_point(way.origin, TREE_OBJECTS);
    vec3 along = trace_unposed_point(way.origin + way.dir, TREE_OBJECTS) - from;
    vec3 to_sun = trace_unposed_point(way.origin + frame.sun_dir, TREE_OBJECTS) - from;
    float cosine = dot(way.dir, frame.sun_dir), part = t / float(cloud_steps);
    bool has_sun = frame.sun_light != vec3(0.0);
    while (turns > 0) {
        turns--;
        vec3 point = from + (float(turns) + 0.5) * part * along;
        float here = cloud_density(cloud, point) * cloud.extinction * part;
        float straight = exp(-here), turned = exp(-(1.0 - trace.cloud_cosine) * here);
        sun *= turned;
        if (has_sun && here > 0.0)
            sun += (1.0 - straight) * cloud_of_sun(cosine, cloud_sun_depth(cloud, point, to_sun));
        depth += here;
    }
    if (depth > 0.0) {
        float straight = exp(-depth), turned = exp(-(1.0 - trace.cloud_cosine) * depth);
        vec3 light = cloud_around(way.dir, turned - straight, 1.0 - turned) + sun * frame.sun_light;
        trace_add(way.weight * light, way.kind);
    }
    return exp(-depth);
}
#endif

#endif
