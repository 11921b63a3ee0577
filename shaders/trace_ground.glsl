/*
 * trace_ground.glsl: light on surroundings, as far as they and the objects let it through, refract
 * or mirror it.
 *
 * What a lit surface makes of a sky that nothing hides is shared out, in each sample, to rays from
 * its matt base, as the sky is bright in their directions, and one of its reflection. A ray that
 * reaches the sky straight brings its part, exactly; so only what is in the way makes noise. What
 * other rays find counts as much as it does in the mean of all rays. A part is a ratio, no mean:
 * where a small lamp is hidden and the rest is not, it is too bright. The reference has the mean.
 * A ray that comes out of water on the ground sees the sky blurred: no open way brings it the light
 * around the sun, which few rays would find, as sparkles.
 * At the end of such a ray, surroundings show themselves as if nothing were in the way of their
 * light, and the sun's disc is not seen: the sun is a light of its own, which surroundings hide.
 * Its mirror image in them is blurred: few rays find a sharp one, and those show as sparkles.
 */
#ifndef TRACE_GROUND_GLSL
#define TRACE_GROUND_GLSL
#include "ground.h"
#include "lib/microfacet.glsl"
#include "trace_surface.glsl"

const int ground_holes_max = 8; /* in the way of the sun */
const float ground_blur = 0.25; /* the least width of a distribution that mirrors the sun */
const float ground_bent = 0.5;  /* roughness of the sky as ways see it that an object has bent */
const float ground_sure = 0.01; /* share of a pixel's light that is followed in any case */
const int GROUND_WAYS = GROUND_MATT_WAYS + 1;
const float ground_least = 1e-6; /* light by which one is divided */

/* Returns the radiance of the sky without the sun's disc. */
vec3 ground_sky(vec3 dir)
{
    return lit_glossy(dir, 0.0, 0.0);
}

/* Returns the share of the sun's light at a point that surroundings leave: 0 or 1, at one point of
 * its disc. */
float ground_sun(trace_hit from, vec3 point, uint seed)
{
    vec2 at = microfacet_point(trace.sample_index, microfacet_hash(seed, GROUND_SUN_SEED));
    vec3 dir = ground_disc_dir(frame.sun_dir, frame.sun_radius, at);
    trace_hit hit = trace_hit(0.0, 0.0, 0.0, from.triangle, from.part);
    float passing = 1.0;
    int turns = frame.sun_light == vec3(0.0) ? 0 : ground_holes_max;
    while (turns > 0) {
        hit =
            trace_meet(trace_start(point, dir, 0.0, 1e30, hit.triangle, false, trace_around), true);
        turns--;
        bool is_met = hit.triangle >= 0;
        if (is_met && trace_has(TRACE_HAS_HOLES))
            passing *= trace_passing(trace_point_of(hit, point, dir));
        else if (is_met)
            passing = 0.0;
        turns = is_met && passing > 0.0 ? turns : 0;
        point += (is_met ? hit.t : 0.0) * dir;
    }
    return passing;
}

/* Returns by how much the sky in some directions counts, so that it makes what all of it makes.
 * What of that is a matter of hue goes into the weight, unless it is much. */
float ground_open(vec3 some, vec3 all, inout vec3 weight)
{
    some = max(some, ground_least);
    float open = dot(all, vec3(1.0)) / dot(some, vec3(1.0));
    weight *= clamp(all / (some * max(open, ground_least)), 0.5, 2.0);
    return open;
}

/* Lets a way go from a surface, with a weight for what it finds, and by how much more it counts if
 * that is the sky, straight. It is in the same media as the way that is followed. Of ways that
 * bring little, some are followed, whose difference to that sky counts for the others, too. */
void ground_put(trace_hit hit, vec3 dir, vec3 weight, float open, uint own)
{
    vec3 facet = uintBitsToFloat(trace_row(TREE_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
    facet = trace_posed(facet, hit.part);
    bool is_below = dot(dir, facet) * dot(way.dir, facet) >= 0.0;
    float most = max(weight.r, max(weight.g, weight.b));
    float chance = clamp(most / ground_sure, 1e-3, 1.0);
    vec2 at = microfacet_point(trace.sample_index, microfacet_hash(way.seed, own));
    vec3 straight = open * weight * ground_sky(dir);
    if (most <= trace_branch_min || waits >= trace_waits_max || is_below || at.x >= chance) {
        trace_add(straight, way.kind);
        return;
    }
    trace_add((1.0 - 1.0 / chance) * straight, way.kind);
    trace_way other = way;
    other.origin = way.origin + hit.t * way.dir;
    other.dir = dir;
    other.weight = weight / chance;
    other.from = hit.triangle;
    other.side = 0.0;
    other.reach = 1e30;
    other.seed = microfacet_hash(way.seed, GROUND_WAY_SEED);
    other.is_gathered = true;
    other.open = open;
    trace_put(other);
}

vec2 ground_point(uint own)
{
    return microfacet_point(trace.sample_index, microfacet_hash(way.seed, own));
}

/* Light of a surface's ways, the last of them of its reflection. */
struct ground_ways {
    vec3 dirs[GROUND_WAYS], weights[GROUND_WAYS];
    vec3 skies[GROUND_WAYS]; /* what each brings where it is free, which has been added already */
    float open[GROUND_WAYS];
};

ground_ways ground_ways_of(vec3 weight)
{
    ground_ways ways;
    vec3 sum = vec3(0.0);
    vec3 matt = weight * shares.matt / float(GROUND_MATT_WAYS), glossy = weight * shares.glossy;
    for (uint i = 0u; i < uint(GROUND_MATT_WAYS); i++) {
        ways.dirs[i] =
            ground_dir(shares.normal, trace.guide, i, ground_point(GROUND_MATT_SEED + i));
        float count = ground_weight(shares.normal, trace.guide, ways.dirs[i]);
        ways.weights[i] = vec3(count);
        ways.skies[i] = count * ground_sky(ways.dirs[i]);
        sum += ways.skies[i];
    }
    float open = ground_open(sum, float(GROUND_MATT_WAYS) * shares.on_matt, matt);
    for (uint i = 0u; i < uint(GROUND_MATT_WAYS); i++) {
        ways.weights[i] *= matt;
        ways.skies[i] *= open * matt;
        ways.open[i] = open;
    }
    vec3 h =
        microfacet_sample(shares.top, way.dir, shares.roughness, ground_point(GROUND_GLOSSY_SEED));
    vec3 dir = reflect(way.dir, h), sky = ground_sky(dir);
    float open_glossy = ground_open(sky, shares.mirrored, glossy);
    ways.dirs[GROUND_MATT_WAYS] = dir;
    ways.weights[GROUND_MATT_WAYS] = glossy;
    ways.skies[GROUND_MATT_WAYS] = open_glossy * glossy * sky;
    ways.open[GROUND_MATT_WAYS] = open_glossy;
    return ways;
}

void ground_follow(trace_hit hit, ground_ways ways, uint i, float chance)
{
    ground_put(hit, ways.dirs[i], ways.weights[i] / chance, ways.open[i], GROUND_CHANCE_SEED + i);
    trace_add(-ways.skies[i] / chance, way.kind);
}

/* Traces the light of the surface that has been asked for last, instead of adding it. `weight`: of
 * the light that it sends. */
void ground_gather(trace_hit hit, vec3 weight)
{
    if (way.is_gathered || !shares.is_lit)
        return;
#ifdef TRACE_SMOOTH
    float kind = way.kind;
    int turns = smooth_is_due() ? int(trace.one) : 0;
    smooth_note(way.origin + hit.t * way.dir, shares.top, weight * (shares.matt + shares.glossy));
    way.kind = smooth_kind;
    while (turns > 0) {
        ground_ways ways = ground_ways_of(weight);
        float much = dot(ways.skies[0], vec3(1.0)), more = dot(ways.skies[1], vec3(1.0));
        float second = clamp(more / max(much + more, ground_least), 0.1, 0.9);
        bool is_second = ground_point(SMOOTH_PICK_SEED).x < second;
        turns -= int(trace.one);
        ground_follow(hit, ways, is_second ? 1u : 0u, is_second ? second : 1.0 - second);
        ground_follow(hit, ways, uint(GROUND_MATT_WAYS), 1.0);
    }
    way.kind = kind;
#else
    ground_ways ways = ground_ways_of(weight);
    for (uint i = 0u; i < uint(GROUND_WAYS); i++)
        ground_follow(hit, ways, i, 1.0);
#endif
}

/* Makes surroundings that are seen straight what the pixel shows. */
void ground_begin(trace_hit hit)
{
    seen.is_object = true;
    seen.is_ground = true;
    seen.distance = distance(start, way.origin) + hit.t;
    is_first = false;
    is_main = false;
}

/* Returns the roughness by which a way sees the sky blurred. */
float ground_blur_of(trace_way way)
{
    return way.open > 0.0 ? 0.0 : way.open < 0.0 ? 1.0 : ground_bent;
}

/* Returns the light at the end of a way; `passing`: the share of it that goes on. */
vec3 trace_end(trace_way way, trace_hit hit, out float passing)
{
    vec3 light = trace_has(TRACE_HAS_GROUND) && way.is_gathered
                     ? lit_glossy(way.dir, ground_blur_of(way), 0.0)
                     : environment_radiance(environment, way.dir, footprint_lod(way));
    bool is_around = hit.part == TREE_SURROUNDINGS || hit.part == TREE_MOVERS;
    int turns = is_around ? int(trace.one) : 0;
    passing = 0.0;
    shares.is_lit = false; /* also where a way that is too long ends in an object */
    while (turns > 0) {
        turns -= int(trace.one);
        if (trace_has(TRACE_HAS_GROUND)) {
            sun_share = ground_sun(hit, way.origin + hit.t * way.dir, way.seed);
            sun_spread = way.is_gathered ? ground_blur : 0.0;
        }
        trace_point point = trace_point_of(hit, way.origin, way.dir);
        point.ior = trace_is_in(way) ? trace_ior(way.inside) : 1.0;
        light = trace_surface(point, way.dir, false, passing);
    }
    return light;
}

#endif
