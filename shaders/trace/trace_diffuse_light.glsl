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
#include "lighting/diffuse_sampling.h"
#include "microfacet.h"
#include "trace/trace_shading.glsl"

const int lighting_holes_max = 8; /* maximum number of surfaces with holes along a shadow ray */
const float lighting_sun_spread = 0.25;         /* minimum sun lobe width at secondary hits */
const float lighting_refracted_roughness = 0.5; /* for sky lookups */
const float lighting_roulette_max = 0.01; /* throughput below which Russian roulette is used */
const int LIGHT_GATHER_RAYS = DIFFUSE_SAMPLING_RAYS + 1;
const float lighting_radiance_min = 1e-6; /* minimum radiance in divisions */

/* Returns a random point for a decision of the path; `seed` selects the decision. */
vec2 path_random_point(uint seed)
{
    return microfacet_point(trace.sample_index, microfacet_hash(path.seed, seed));
}

/* Returns the radiance of the sky without the sun's disc. */
vec3 lighting_sky(vec3 dir)
{
    return lit_specular(dir, 0.0, 0.0);
}

/* Returns the sun's visibility from `point`, 0 to 1. Casts a shadow ray to a random point of the
 * sun's disc (next-event estimation). Alpha-blended surfaces reduce the visibility. */
float light_gather_sun(trace_hit from, vec3 point, uint seed)
{
    vec2 at =
        microfacet_point(trace.sample_index, microfacet_hash(seed, DIFFUSE_SAMPLING_SUN_SEED));
    vec3 dir = diffuse_sampling_disc_dir(frame.sun_dir, frame.sun_radius, at);
    trace_hit hit = trace_hit(0.0, 0.0, 0.0, from.triangle, from.bvh);
    float passing = 1.0;
    int iterations = frame.sun_light == vec3(0.0) ? 0 : lighting_holes_max;
    while (iterations > 0) {
        hit = trace_nearest_hit(
            trace_start(point, dir, 0.0, 1e30, hit.triangle, false, trace_surroundings_mask), true);
        iterations--;
        bool is_hit = hit.triangle >= 0;
        if (is_hit && trace_has(TRACE_HAS_HOLES))
            passing *= trace_alpha_transmittance(trace_surface_point_at(hit, point, dir));
        else if (is_hit)
            passing = 0.0;
        iterations = is_hit && passing > 0.0 ? iterations : 0;
        point += (is_hit ? hit.t : 0.0) * dir;
    }
    return passing;
}

/* Returns the brightness ratio of `all` (unoccluded lighting) to `some` (a sky sample). Multiplies
 * `throughput` by the colour all / some, divided by this ratio and clamped to 0.5 to 2. */
float lighting_sky_factor(vec3 some, vec3 all, inout vec3 throughput)
{
    some = max(some, lighting_radiance_min);
    float open = dot(all, vec3(1.0)) / dot(some, vec3(1.0));
    throughput *= clamp(all / (some * max(open, lighting_radiance_min)), 0.5, 2.0);
    return open;
}

/* Pushes a ray that gathers light from a surface onto the stack of pending paths. `open` scales the
 * sky's radiance. If Russian roulette ends the ray, adds the radiance of an unoccluded ray. */
void lighting_push_ray(trace_hit hit, vec3 dir, vec3 throughput, float open, uint seed)
{
    vec3 facet = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
    facet = trace_posed(facet, hit.bvh);
    bool is_below = dot(dir, facet) * dot(path.dir, facet) >= 0.0;
    float max_throughput = max(throughput.r, max(throughput.g, throughput.b));
    float chance = clamp(max_throughput / lighting_roulette_max, 1e-3, 1.0);
    vec2 at = path_random_point(seed);
    vec3 unoccluded = open * throughput * lighting_sky(dir);
    if (max_throughput <= trace_branch_min || pending_count >= trace_pending_max || is_below ||
        at.x >= chance) {
        trace_add(unoccluded, path.kind);
        return;
    }
    trace_add((1.0 - 1.0 / chance) * unoccluded, path.kind);
    trace_path other = path;
    other.origin = path.origin + hit.t * path.dir;
    other.dir = dir;
    other.throughput = throughput / chance;
    other.from = hit.triangle;
    other.side = 0.0;
    other.reach = 1e30;
    other.seed = microfacet_hash(path.seed, DIFFUSE_SAMPLING_PATH_SEED);
    other.is_lighting_ray = true;
    other.shows_backdrop = false;
    other.open = open;
    trace_push_pending(other);
}

/* Lighting rays of a surface; the last one is the specular reflection. */
struct lighting_rays {
    vec3 dirs[LIGHT_GATHER_RAYS], weights[LIGHT_GATHER_RAYS];
    vec3 skies[LIGHT_GATHER_RAYS]; /* unoccluded radiance of each lighting ray */
    float open[LIGHT_GATHER_RAYS];
};

lighting_rays lighting_rays_of(vec3 throughput)
{
    lighting_rays rays;
    vec3 sum = vec3(0.0);
    vec3 diffuse = throughput * lobes.diffuse / float(DIFFUSE_SAMPLING_RAYS),
         specular = throughput * lobes.specular;
    for (uint i = 0u; i < uint(DIFFUSE_SAMPLING_RAYS); i++) {
        rays.dirs[i] = diffuse_sampling_dir(lobes.normal, trace.guide, i,
                                            path_random_point(DIFFUSE_SAMPLING_SEED + i));
        float count = diffuse_sampling_weight(lobes.normal, trace.guide, rays.dirs[i]);
        rays.weights[i] = vec3(count);
        rays.skies[i] = count * lighting_sky(rays.dirs[i]);
        sum += rays.skies[i];
    }
    float open =
        lighting_sky_factor(sum, float(DIFFUSE_SAMPLING_RAYS) * lobes.unoccluded_diffuse, diffuse);
    for (uint i = 0u; i < uint(DIFFUSE_SAMPLING_RAYS); i++) {
        rays.weights[i] *= diffuse;
        rays.skies[i] *= open * diffuse;
        rays.open[i] = open;
    }
    vec3 h = microfacet_sample(lobes.top, path.dir, lobes.roughness,
                               path_random_point(DIFFUSE_SAMPLING_GLOSSY_SEED));
    vec3 dir = reflect(path.dir, h), sky = lighting_sky(dir);
    float open_glossy = lighting_sky_factor(sky, lobes.mirrored, specular);
    rays.dirs[DIFFUSE_SAMPLING_RAYS] = dir;
    rays.weights[DIFFUSE_SAMPLING_RAYS] = specular;
    rays.skies[DIFFUSE_SAMPLING_RAYS] = open_glossy * specular * sky;
    rays.open[DIFFUSE_SAMPLING_RAYS] = open_glossy;
    return rays;
}

void lighting_trace_ray(trace_hit hit, lighting_rays rays, uint i, float chance)
{
    lighting_push_ray(hit, rays.dirs[i], rays.weights[i] / chance, rays.open[i],
                      DIFFUSE_SAMPLING_ROULETTE_SEED + i);
    trace_add(-rays.skies[i] / chance, path.kind);
}

/* Replaces the unoccluded lighting of the surface shaded last by traced lighting. `throughput` is
 * the path's throughput at that surface. */
void light_gather_at(trace_hit hit, vec3 throughput)
{
    if (path.is_lighting_ray || !lobes.is_lit)
        return;
#ifdef TRACE_DENOISE
    float kind = path.kind;
    int iterations = denoise_is_sampled() ? int(trace.one) : 0;
    denoise_record(path.origin + hit.t * path.dir, lobes.top,
                   throughput * (lobes.diffuse + lobes.specular));
    path.kind = denoise_kind;
    while (iterations > 0) {
        lighting_rays rays = lighting_rays_of(throughput);
        float light_0 = dot(rays.skies[0], vec3(1.0)), light_1 = dot(rays.skies[1], vec3(1.0));
        float second = clamp(light_1 / max(light_0 + light_1, lighting_radiance_min), 0.1, 0.9);
        bool is_second = path_random_point(DENOISE_PICK_SEED).x < second;
        iterations -= int(trace.one);
        lighting_trace_ray(hit, rays, is_second ? 1u : 0u, is_second ? second : 1.0 - second);
        lighting_trace_ray(hit, rays, uint(DIFFUSE_SAMPLING_RAYS), 1.0);
    }
    path.kind = kind;
#else
    lighting_rays rays = lighting_rays_of(throughput);
    for (uint i = 0u; i < uint(LIGHT_GATHER_RAYS); i++)
        lighting_trace_ray(hit, rays, i, 1.0);
#endif
}

/* Records the surroundings that the primary ray hits as the pixel's visible surface. */
void lighting_begin(trace_hit hit)
{
    result.is_object = true;
    result.is_ground = true;
    result.distance = distance(start, path.origin) + hit.t;
    is_first = false;
    is_main = false;
}

float lighting_sky_roughness(trace_path path)
{
    return path.open > 0.0 ? 0.0 : path.open < 0.0 ? 1.0 : lighting_refracted_roughness;
}

/* Returns the radiance at a path's end; sets `passing` to the transmitted fraction of light. */
vec3 trace_radiance_at_end(trace_path path, trace_hit hit, out float passing)
{
    vec3 light = trace_has(TRACE_HAS_DIFFUSE_LIGHT) && path.is_lighting_ray
                     ? lit_specular(path.dir, lighting_sky_roughness(path), 0.0)
                     : environment_radiance(environment, path.dir, differential_lod(path));
    bool is_surroundings = hit.bvh == BVH_SURROUNDINGS || hit.bvh == BVH_MOVERS;
    int iterations = is_surroundings ? int(trace.one) : 0;
    passing = 0.0;
    lobes.is_lit = false; /* also at the segment limit */
    while (iterations > 0) {
        iterations -= int(trace.one);
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
