/*
 * cloud_light.glsl: what cloudy ice (cloud.h) scatters into a straight part of a ray's way.
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
#ifndef CLOUD_LIGHT_GLSL
#define CLOUD_LIGHT_GLSL
#include "cloud.h"
#include "lib/lit_around.glsl"

layout(set = 0, binding = CLOUD_TEXELS) uniform sampler2DArray clouds;

const int cloud_sun_steps = 3;       /* towards the sun, each twice as long as the one before */
const float cloud_blur = 4.55 - 1.0; /* layer of lit.h that blurs as much as clouds do */

/* Returns the density of a cloud at a point in the space of the objects, from 0 to 1. */
float cloud_density(cloud_place cloud, vec3 point)
{
    vec3 at = (point - cloud.low) * cloud.texels_each;
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(CLOUD_SIZE))))
        return 0.0;
    float z = clamp(at.z - 0.5, 0.0, float(CLOUD_SIZE) - 1.0);
    float layer = min(floor(z), float(CLOUD_SIZE) - 2.0);
    vec3 texel = vec3(at.xy / float(CLOUD_SIZE), cloud.first_layer + layer);
    vec2 both = textureLod(clouds, texel, 0.0).rg;
    return mix(both.x, both.y, z - layer);
}

/* Returns the scatterings on the sun's way to a point. */
float cloud_sun_depth(cloud_place cloud, vec3 point, vec3 to_sun)
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

/* Returns the scatterings on the sun's way to places of a part of a way, x + y u + z u^2 at a share
 * u of it: the parabola through three places. They change smoothly from place to place, so that few
 * are as good as one for each step. */
vec3 cloud_sun_depths(cloud_place cloud, vec3 from, vec3 way, vec3 to_sun)
{
    float before = cloud_sun_depth(cloud, from + way / 6.0, to_sun);
    float middle = cloud_sun_depth(cloud, from + 0.5 * way, to_sun);
    float behind = cloud_sun_depth(cloud, from + way / 1.2, to_sun);
    float slope = 1.5 * (behind - before);
    float bend = 4.5 * (before - 2.0 * middle + behind);
    return vec3(middle - 0.5 * slope + 0.25 * bend, slope - bend, bend);
}

/* Returns what of the sun's light is scattered into a direction, after so many scatterings on its
 * way, each of which widens its directions; 1: the light on a white matt surface. */
float cloud_of_sun(float cosine, float depth)
{
    float g = frame.cloud_cosine;
    float wider = sign(g) * pow(abs(g), 1.0 + depth);
    return 0.25 * cloud_phase(cosine, wider) * exp(-(1.0 - g) * depth);
}

/* Returns the light of what is around: a share of what is about a direction, another of what is
 * everywhere. */
vec3 cloud_around(vec3 dir, float ahead, float anywhere)
{
    vec3 before = lit_matt(dir);
    vec3 even = 0.5 * (before + lit_matt(-dir));
    if (constant_background == GLOBALS_ENVIRONMENT) {
        vec2 at = background_uv(dir, constant_environment_turn);
        float layer = floor(cloud_blur);
        vec3 sharper = textureLod(environment_light, vec3(at, layer), 0.0).rgb;
        vec3 blurred = textureLod(environment_light, vec3(at, layer + 1.0), 0.0).rgb;
        before = mix(sharper, blurred, cloud_blur - layer);
    }
    return ahead * before + anywhere * even;
}

/* What a part of a way meets in a cloud. */
struct cloud_part {
    float depth; /* scatterings on it */
    float sun;   /* share of the sun's light that is scattered into it */
};

/* Returns the lengths of a ray to where it enters and leaves the box that has all of the cloud. */
vec2 cloud_between(cloud_place cloud, vec3 from, vec3 along)
{
    vec3 safe = mix(along, vec3(1e-6), lessThan(abs(along), vec3(1e-6)));
    vec3 one = (cloud.from - from) / safe, other = (cloud.to - from) / safe;
    vec3 enter = min(one, other), leave = max(one, other);
    return vec2(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)));
}

/* Follows a part of a way, of length t, from a point in the space of the objects, in `steps` steps
 * in the cloud, of which `turns` are made: all or none. */
cloud_part cloud_follow(cloud_place cloud, vec3 from, vec3 along, vec3 to_sun, float cosine,
                        float t, int steps, int turns)
{
    cloud_part seen = cloud_part(0.0, 0.0);
    vec2 between = clamp(cloud_between(cloud, from, along), 0.0, t);
    vec3 first = from + between.x * along, way = (between.y - between.x) * along;
    float part = (between.y - between.x) / float(steps);
    bool is_lit = frame.sun_light != vec3(0.0) && turns > 0 && part > 0.0;
    vec3 sun_depths = is_lit ? cloud_sun_depths(cloud, first, way, to_sun) : vec3(0.0);
    turns = part > 0.0 ? turns : 0;
    while (turns > 0) {
        turns--;
        float u = (float(turns) + 0.5) / float(steps);
        float here = cloud_density(cloud, first + u * way) * cloud.extinction * part;
        float sun_depth = max(sun_depths.x + u * (sun_depths.y + u * sun_depths.z), 0.0);
        float straight = exp(-here), turned = exp(-(1.0 - frame.cloud_cosine) * here);
        seen.sun *= turned;
        if (is_lit && here > 0.0)
            seen.sun += (1.0 - straight) * cloud_of_sun(cosine, sun_depth);
        seen.depth += here;
    }
    return seen;
}

/* Returns the light that a part adds to a way. */
vec3 cloud_light(cloud_part seen, vec3 dir)
{
    float straight = exp(-seen.depth), turned = exp(-(1.0 - frame.cloud_cosine) * seen.depth);
    return cloud_around(dir, turned - straight, 1.0 - turned) + seen.sun * frame.sun_light;
}

#endif
