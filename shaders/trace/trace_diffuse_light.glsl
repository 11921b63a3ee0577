/*
 * trace_diffuse_light.glsl: ray-traced lighting of surroundings: soft shadows, light refracted and
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
#ifndef TRACE_DIFFUSE_LIGHT_GLSL
#define TRACE_DIFFUSE_LIGHT_GLSL
#include "lib/microfacet.glsl"
#include "lighting/diffuse_sampling.h"
#include "trace/trace_shading.glsl"

const int lighting_holes_max = 8; /* maximum number of surfaces with holes along a shadow ray */
const float lighting_sun_spread =
    0.25; /* minimum width of the sun's specular lobe at secondary hits */
const float lighting_refracted_roughness =
    0.5; /* roughness of sky lookups after refraction by an object */
const float lighting_roulette_max = 0.01; /* throughput below which Russian roulette is used */
const int LIGHT_GATHER_RAYS = DIFFUSE_SAMPLING_RAYS + 1;
const float lighting_radiance_min = 1e-6; /* minimum radiance in divisions */

/* Returns the radiance of the sky without the sun's disc. */
vec3 lighting_sky(vec3 dir)
{
    return lit_specular(dir, 0.0, 0.0);
}

/* Returns the visibility of the sun from a point, for next-event estimation: casts a shadow ray to
 * a random point of its disc. Blended surfaces attenuate it. */
float light_gather_sun(trace_hit from, vec3 point, uint seed)
{
    vec2 at =
        microfacet_point(trace.sample_index, microfacet_hash(seed, DIFFUSE_SAMPLING_SUN_SEED));
    vec3 dir = diffuse_sampling_disc_dir(frame.sun_dir, frame.sun_radius, at);
    trace_hit hit = trace_hit(0.0, 0.0, 0.0, from.triangle, from.part);
    float passing = 1.0;
    int turns = frame.sun_light == vec3(0.0) ? 0 : lighting_holes_max;
    while (turns > 0) {
        hit = trace_nearest_hit(
            trace_start(point, dir, 0.0, 1e30, hit.triangle, false, trace_surroundings_mask), true);
        turns--;
        bool is_hit = hit.triangle >= 0;
        if (is_hit && trace_has(TRACE_HAS_HOLES))
            passing *= trace_alpha_transmittance(trace_surface_point_at(hit, point, dir));
        else if (is_hit)
            passing = 0.0;
        turns = is_hit && passing > 0.0 ? turns : 0;
        point += (is_hit ? hit.t : 0.0) * dir;
    }
    return passing;
}

/* Returns the factor that scales the sampled sky radiance `some` to the unoccluded lighting `all`.
 * The remaining colour ratio, limited to 0.5 to 2, goes into `throughput`. */
float lighting_sky_factor(vec3 some, vec3 all, inout vec3 throughput)
{
    some = max(some, lighting_radiance_min);
    float open = dot(all, vec3(1.0)) / dot(some, vec3(1.0));
    throughput *= clamp(all / (some * max(open, lighting_radiance_min)), 0.5, 2.0);
    return open;
}

/* Pushes a lighting ray from a surface in the current path's medium. `open` scales the sky radiance
 * if the ray is unoccluded. Weak rays face Russian roulette against the unoccluded sky radiance. */
void lighting_push_ray(trace_hit hit, vec3 dir, vec3 throughput, float open, uint own)
{
    vec3 facet = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
    facet = trace_posed(facet, hit.part);
    bool is_below = dot(dir, facet) * dot(path.dir, facet) >= 0.0;
    float most = max(throughput.r, max(throughput.g, throughput.b));
    float chance = clamp(most / lighting_roulette_max, 1e-3, 1.0);
    vec2 at = microfacet_point(trace.sample_index, microfacet_hash(path.seed, own));
    vec3 straight = open * throughput * lighting_sky(dir);
    if (most <= trace_branch_min || pending_count >= trace_pending_max || is_below ||
        at.x >= chance) {
        trace_add(straight, path.kind);
        return;
    }
    trace_add((1.0 - 1.0 / chance) * straight, path.kind);
    trace_path other = path;
    other.origin = path.origin + hit.t * path.dir;
    other.dir = dir;
    other.throughput = throughput / chance;
    other.from = hit.triangle;
    other.side = 0.0;
    other.reach = 1e30;
    other.seed = microfacet_hash(path.seed, DIFFUSE_SAMPLING_PATH_SEED);
    other.is_lighting_ray = true;
    other.open = open;
    trace_push_pending(other);
}

vec2 lighting_random_point(uint own)
{
    return microfacet_point(trace.sample_index, microfacet_hash(path.seed, own));
}

/* Lighting rays of a surface; the last one is the specular reflection. */
struct lighting_rays {
    vec3 dirs[LIGHT_GATHER_RAYS], weights[LIGHT_GATHER_RAYS];
    vec3 skies[LIGHT_GATHER_RAYS]; /* unoccluded radiance of each ray, already added */
    float open[LIGHT_GATHER_RAYS];
};

lighting_rays lighting_rays_of(vec3 throughput)
{
    lighting_rays ways;
    vec3 sum = vec3(0.0);
    vec3 matt = throughput * shares.matt / float(DIFFUSE_SAMPLING_RAYS),
         glossy = throughput * shares.glossy;
    for (uint i = 0u; i < uint(DIFFUSE_SAMPLING_RAYS); i++) {
        ways.dirs[i] = diffuse_sampling_dir(shares.normal, trace.guide, i,
                                            lighting_random_point(DIFFUSE_SAMPLING_SEED + i));
        float count = diffuse_sampling_weight(shares.normal, trace.guide, ways.dirs[i]);
        ways.weights[i] = vec3(count);
        ways.skies[i] = count * lighting_sky(ways.dirs[i]);
        sum += ways.skies[i];
    }
    float open =
        lighting_sky_factor(sum, float(DIFFUSE_SAMPLING_RAYS) * shares.unoccluded_diffuse, matt);
    for (uint i = 0u; i < uint(DIFFUSE_SAMPLING_RAYS); i++) {
        ways.weights[i] *= matt;
        ways.skies[i] *= open * matt;
        ways.open[i] = open;
    }
    vec3 h = microfacet_sample(shares.top, path.dir, shares.roughness,
                               lighting_random_point(DIFFUSE_SAMPLING_GLOSSY_SEED));
    vec3 dir = reflect(path.dir, h), sky = lighting_sky(dir);
    float open_glossy = lighting_sky_factor(sky, shares.mirrored, glossy);
    ways.dirs[DIFFUSE_SAMPLING_RAYS] = dir;
    ways.weights[DIFFUSE_SAMPLING_RAYS] = glossy;
    ways.skies[DIFFUSE_SAMPLING_RAYS] = open_glossy * glossy * sky;
    ways.open[DIFFUSE_SAMPLING_RAYS] = open_glossy;
    return ways;
}

void lighting_trace_ray(trace_hit hit, lighting_rays ways, uint i, float chance)
{
    lighting_push_ray(hit, ways.dirs[i], ways.weights[i] / chance, ways.open[i],
                      DIFFUSE_SAMPLING_ROULETTE_SEED + i);
    trace_add(-ways.skies[i] / chance, path.kind);
}

/* Replaces the unoccluded lighting of the surface shaded last by traced lighting; `throughput` is
 * the path throughput there. */
void light_gather_at(trace_hit hit, vec3 throughput)
{
    if (path.is_lighting_ray || !shares.is_lit)
        return;
#ifdef TRACE_DENOISE
    float kind = path.kind;
    int turns = denoise_is_sampled() ? int(trace.one) : 0;
    denoise_record(path.origin + hit.t * path.dir, shares.top,
                   throughput * (shares.matt + shares.glossy));
    path.kind = denoise_kind;
    while (turns > 0) {
        lighting_rays ways = lighting_rays_of(throughput);
        float much = dot(ways.skies[0], vec3(1.0)), more = dot(ways.skies[1], vec3(1.0));
        float second = clamp(more / max(much + more, lighting_radiance_min), 0.1, 0.9);
        bool is_second = lighting_random_point(DENOISE_PICK_SEED).x < second;
        turns -= int(trace.one);
        lighting_trace_ray(hit, ways, is_second ? 1u : 0u, is_second ? second : 1.0 - second);
        lighting_trace_ray(hit, ways, uint(DIFFUSE_SAMPLING_RAYS), 1.0);
    }
    path.kind = kind;
#else
    lighting_rays ways = lighting_rays_of(throughput);
    for (uint i = 0u; i < uint(LIGHT_GATHER_RAYS); i++)
        lighting_trace_ray(hit, ways, i, 1.0);
#endif
}

/* Records surroundings that the primary ray hits as the pixel's visible surface. */
void lighting_begin(trace_hit hit)
{
    seen.is_object = true;
    seen.is_ground = true;
    seen.distance = distance(start, path.origin) + hit.t;
    is_first = false;
    is_main = false;
}

/* Returns the roughness of a lighting ray's sky lookup. */
float lighting_sky_roughness(trace_path path)
{
    return path.open > 0.0 ? 0.0 : path.open < 0.0 ? 1.0 : lighting_refracted_roughness;
}

/* Returns the radiance at the end of a path. `passing` becomes the fraction that a blended or
 * alpha-tested surface transmits. */
vec3 trace_radiance_at_end(trace_path path, trace_hit hit, out float passing)
{
    vec3 light = trace_has(TRACE_HAS_DIFFUSE_LIGHT) && path.is_lighting_ray
                     ? lit_specular(path.dir, lighting_sky_roughness(path), 0.0)
                     : environment_radiance(environment, path.dir, differential_lod(path));
    bool is_around = hit.part == BVH_SURROUNDINGS || hit.part == BVH_MOVERS;
    int turns = is_around ? int(trace.one) : 0;
    passing = 0.0;
    shares.is_lit = false; /* also applies to paths that reach the segment limit inside an object */
    while (turns > 0) {
        turns -= int(trace.one);
        if (trace_has(TRACE_HAS_DIFFUSE_LIGHT)) {
            sun_visibility = light_gather_sun(hit, path.origin + hit.t * path.dir, path.seed);
            sun_spread = path.is_lighting_ray ? lighting_sun_spread : 0.0;
        }
        trace_surface_point point = trace_surface_point_at(hit, path.origin, path.dir);
        point.ior = trace_is_in(path) ? trace_ior(path.medium_stack) : 1.0;
        light = trace_shade(point, path.dir, false, passing);
    }
    return light;
}

#endif
