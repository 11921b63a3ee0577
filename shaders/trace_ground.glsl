/*
 * trace_ground.glsl: ray-traced lighting of surroundings: soft shadows, light refracted and
 * reflected by the objects, and one bounce of indirect light.
 *
 * The unoccluded lighting of a surface by the sky is known from prefiltered lookups. It serves as a
 * control variate: each sample casts rays from the diffuse base, importance-sampled by a guide for
 * the sky's brightness, and one along the specular reflection. A ray that reaches the sky without a
 * hit returns its exact fraction of the unoccluded lighting, so only occlusion causes noise.
 * Fractions are ratios, not means: where a small lamp is occluded and the rest of the sky is not,
 * the result is too bright (ratio estimator). The CPU reference computes the mean.
 *
 * Further limits: rays that leave water on the ground look up a blurred sky, since few rays would
 * find the glow around the sun, and those would be fireflies. Surfaces hit by lighting rays are
 * shaded with unoccluded lighting. The sun's disc is excluded from sky lookups, because the sun is
 * sampled as a separate light; its specular reflection at secondary hits is widened.
 */
#ifndef TRACE_GROUND_GLSL
#define TRACE_GROUND_GLSL
#include "ground.h"
#include "lib/microfacet.glsl"
#include "trace_surface.glsl"

const int ground_holes_max = 8; /* maximum number of surfaces with holes along a shadow ray */
const float ground_blur = 0.25; /* minimum width of the sun's specular lobe at secondary hits */
const float ground_bent = 0.5;  /* roughness of sky lookups after refraction by an object */
const float ground_sure = 0.01; /* throughput below which Russian roulette is used */
const int GROUND_WAYS = GROUND_MATT_WAYS + 1;
const float ground_least = 1e-6; /* minimum radiance in divisions */

/* Returns the radiance of the sky without the sun's disc. */
vec3 ground_sky(vec3 dir)
{
    return lit_glossy(dir, 0.0, 0.0);
}

/* Returns the visibility of the sun from a point, for next-event estimation: casts a shadow ray to
 * a random point of its disc. Blended surfaces attenuate it. */
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

/* Returns the factor that scales the sampled sky radiance `some` to the unoccluded lighting `all`.
 * The remaining colour ratio, limited to 0.5 to 2, goes into `throughput`. */
float ground_open(vec3 some, vec3 all, inout vec3 throughput)
{
    some = max(some, ground_least);
    float open = dot(all, vec3(1.0)) / dot(some, vec3(1.0));
    throughput *= clamp(all / (some * max(open, ground_least)), 0.5, 2.0);
    return open;
}

/* Pushes a lighting ray from a surface in the current path's medium. `open` scales the sky radiance
 * if the ray is unoccluded. Weak rays face Russian roulette against the unoccluded sky radiance. */
void ground_put(trace_hit hit, vec3 dir, vec3 throughput, float open, uint own)
{
    vec3 facet = uintBitsToFloat(trace_row(TREE_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
    facet = trace_posed(facet, hit.part);
    bool is_below = dot(dir, facet) * dot(path.dir, facet) >= 0.0;
    float most = max(throughput.r, max(throughput.g, throughput.b));
    float chance = clamp(most / ground_sure, 1e-3, 1.0);
    vec2 at = microfacet_point(trace.sample_index, microfacet_hash(path.seed, own));
    vec3 straight = open * throughput * ground_sky(dir);
    if (most <= trace_branch_min || pending_count >= trace_waits_max || is_below ||
        at.x >= chance) {
        trace_add(straight, path.kind);
        return;
    }
    trace_add((1.0 - 1.0 / chance) * straight, path.kind);
    trace_way other = path;
    other.origin = path.origin + hit.t * path.dir;
    other.dir = dir;
    other.throughput = throughput / chance;
    other.from = hit.triangle;
    other.side = 0.0;
    other.reach = 1e30;
    other.seed = microfacet_hash(path.seed, GROUND_WAY_SEED);
    other.is_gathered = true;
    other.open = open;
    trace_put(other);
}

vec2 ground_point(uint own)
{
    return microfacet_point(trace.sample_index, microfacet_hash(path.seed, own));
}

/* Lighting rays of a surface; the last one is the specular reflection. */
struct ground_ways {
    vec3 dirs[GROUND_WAYS], weights[GROUND_WAYS];
    vec3 skies[GROUND_WAYS]; /* unoccluded radiance of each ray, already added */
    float open[GROUND_WAYS];
};

ground_ways ground_ways_of(vec3 throughput)
{
    ground_ways ways;
    vec3 sum = vec3(0.0);
    vec3 matt = throughput * shares.matt / float(GROUND_MATT_WAYS),
         glossy = throughput * shares.glossy;
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
        microfacet_sample(shares.top, path.dir, shares.roughness, ground_point(GROUND_GLOSSY_SEED));
    vec3 dir = reflect(path.dir, h), sky = ground_sky(dir);
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
    trace_add(-ways.skies[i] / chance, path.kind);
}

/* Replaces the unoccluded lighting of the surface shaded last by traced lighting; `throughput` is
 * the path throughput there. */
void ground_gather(trace_hit hit, vec3 throughput)
{
    if (path.is_gathered || !shares.is_lit)
        return;
#ifdef TRACE_SMOOTH
    float kind = path.kind;
    int turns = smooth_is_due() ? int(trace.one) : 0;
    smooth_note(path.origin + hit.t * path.dir, shares.top,
                throughput * (shares.matt + shares.glossy));
    path.kind = smooth_kind;
    while (turns > 0) {
        ground_ways ways = ground_ways_of(throughput);
        float much = dot(ways.skies[0], vec3(1.0)), more = dot(ways.skies[1], vec3(1.0));
        float second = clamp(more / max(much + more, ground_least), 0.1, 0.9);
        bool is_second = ground_point(SMOOTH_PICK_SEED).x < second;
        turns -= int(trace.one);
        ground_follow(hit, ways, is_second ? 1u : 0u, is_second ? second : 1.0 - second);
        ground_follow(hit, ways, uint(GROUND_MATT_WAYS), 1.0);
    }
    path.kind = kind;
#else
    ground_ways ways = ground_ways_of(throughput);
    for (uint i = 0u; i < uint(GROUND_WAYS); i++)
        ground_follow(hit, ways, i, 1.0);
#endif
}

/* Records surroundings that the primary ray hits as the pixel's visible surface. */
void ground_begin(trace_hit hit)
{
    seen.is_object = true;
    seen.is_ground = true;
    seen.distance = distance(start, path.origin) + hit.t;
    is_first = false;
    is_main = false;
}

/* Returns the roughness of a lighting ray's sky lookup. */
float ground_blur_of(trace_way path)
{
    return path.open > 0.0 ? 0.0 : path.open < 0.0 ? 1.0 : ground_bent;
}

/* Returns the radiance at the end of a path. `passing` becomes the fraction that a blended or
 * alpha-tested surface transmits. */
vec3 trace_end(trace_way path, trace_hit hit, out float passing)
{
    vec3 light = trace_has(TRACE_HAS_GROUND) && path.is_gathered
                     ? lit_glossy(path.dir, ground_blur_of(path), 0.0)
                     : environment_radiance(environment, path.dir, footprint_lod(path));
    bool is_around = hit.part == TREE_SURROUNDINGS || hit.part == TREE_MOVERS;
    int turns = is_around ? int(trace.one) : 0;
    passing = 0.0;
    shares.is_lit = false; /* also applies to paths that reach the segment limit inside an object */
    while (turns > 0) {
        turns -= int(trace.one);
        if (trace_has(TRACE_HAS_GROUND)) {
            sun_share = ground_sun(hit, path.origin + hit.t * path.dir, path.seed);
            sun_spread = path.is_gathered ? ground_blur : 0.0;
        }
        trace_point point = trace_point_of(hit, path.origin, path.dir);
        point.ior = trace_is_in(path) ? trace_ior(path.medium_stack) : 1.0;
        light = trace_surface(point, path.dir, false, passing);
    }
    return light;
}

#endif
