/*
 * refract_trace.frag: GPU ray tracer for nested dielectrics, main loop (refract_trace.c).
 *
 * At surfaces a pixel's path splits by Fresnel reflectance: the refracted path is followed,
 * reflected paths with enough throughput are pushed onto a stack of pending paths. One loop over
 * path segments serves all paths. With TRACE_RAYS, rays also hit the triangles of the surroundings;
 * otherwise paths that leave the objects end with a lookup in the environment cube.
 *
 * Code for rare cases is in loops that run at most once: lavapipe (Mesa 22.3) skips a loop that no
 * pixel of a group enters, but executes both sides of a branch.
 */
#version 460
#ifdef TRACE_QUERY
#extension GL_EXT_ray_query : require
#endif
#define REFRACT_FULLSCREEN
#include "lib/primary_ray.glsl"
#include "lib/specialization_constants.glsl"
#include "lighting/bump_normal.h"
#include "lighting/highlight.glsl"
#include "microfacet.h"
#include "refract/refract_uniforms.glsl"
#include "trace/trace_fresnel.glsl"
#ifdef TRACE_RAYS
#include "trace/trace_material.glsl"
#else
#include "object_material.h"
#include "trace/refract_trace.h"
#define REFRACT_NEAREST
#define REFRACT_ENV_CUBE_POINTS TRACE_CUBE_POINTS
#include "refract/refract_environment.glsl"
#endif
#include "trace/trace_medium_stack.glsl"
#ifdef TRACE_DENOISE
#include "trace/trace_denoise_inputs.glsl"
#endif

layout(location = REFRACT_VIEW_RAY) in vec3 ray;
#ifndef TRACE_RAYS
layout(set = 0, binding = REFRACT_SHADING) uniform sampler2D shading;
layout(set = 0, binding = REFRACT_DEPTH_FRONT) uniform sampler2D depth_front;
#endif

#ifdef TRACE_RAYS
const int trace_pending_max = 6; /* maximum number of pending paths */
#else
const int trace_pending_max = 2;
const int trace_ends_max = 3; /* maximum number of paths per pixel */
#endif
const int trace_segments_max = 256; /* maximum number of segments per path */
/* Number of segments in a pixel after which paths are no longer split. Light of pending paths would
 * be lost, because llvmpipe terminates loops after 65 535 iterations. */
const int trace_split_segments_max = 256;
/* Number of segments in a pixel from which Russian roulette becomes stricter, and the number of
 * further ones that raise its minimum throughput by trace.branch. */
const int trace_roulette_segments = 64;
const float trace_roulette_growth = 6.4;
const float trace_rough_min = 1e-3;
const float trace_branch_min = 1e-3;
const float trace_expected_lod = 6.0;
const float trace_expected_max = 4.0;
const uint trace_split_seed = 60u;
const uint trace_choice_seed = 61u;
const uint trace_survival_seed = 62u;
const float trace_lighting_branch = 0.1; /* minimum throughput of lighting rays */

/* State of a path, traced from the camera towards the light. */
struct trace_path {
    vec3 origin, dir, throughput;
    uvec4 medium_stack; /* objects that contain the origin */
    int from;           /* triangle on which the segment starts; below 0 if there is none */
    float side, reach;  /* as in trace_ray */
    uint seed;
    float kind; /* kind of light: 1 reflected, 2 diffuse, otherwise 0 */
    int left;   /* number of segments left */
    bool is_in_bubble;
    bool is_lighting_ray; /* samples the lighting of surroundings (trace_diffuse_light.glsl) */
    /* if positive, factor on the radiance of the sky that an unoccluded ray reaches; 0 after
     * refraction by an object; negative if the ray started inside an object */
    float open;
    vec3 d_origin, d_dir; /* ray differentials of origin and direction */
    bool shows_backdrop;  /* has only been refracted, and the image has no background */
};

struct trace_result {
    vec3 refraction, reflection; /* radiance, times the throughput */
    vec3 normal;                 /* first surface's normal, facing the camera */
    float distance, fresnel;
    bool is_object;
    bool is_ground; /* the primary ray hits surroundings */
    vec3 exit;
    float path_length, bounces, segments; /* of the main (refracted) path */
    uint last;                            /* main path's last object, or 0 */
    vec3 backdrop;                        /* throughput with which a hidden background is visible */
};

/* Per-pixel state in global variables, because lavapipe compiles array arguments slowly. */

trace_path path;                       /* the path that is being followed */
trace_path pending[trace_pending_max]; /* pending paths, the latest one first */
int pending_count;
int segment_count; /* number of segments so far */
trace_result result;
vec3 start;     /* origin of the primary ray */
bool is_first;  /* no surface has been hit yet */
bool is_main;   /* the main path is followed (result.path_length) */
bool sets_last; /* the followed path may set result.last */

#ifndef TRACE_RAYS
/* End of a path that leaves the objects. Environment lookups wait until all paths of the pixel have
 * ended. All pixels of a SIMD group then do their lookups together. */
struct trace_ray_end {
    vec3 origin, dir, throughput;
    float kind;
    bool shows_backdrop;
};

trace_ray_end ends[trace_ends_max];
int end_count, ends_left;
/* end of the path that sets result.last; throughput is 0 if the path never leaves the objects */
trace_path escaped_end;
#endif

/* Returns the untextured surface parameters of the medium of priority `rank`. */
object_material trace_untextured(uint rank)
{
    return object_material(trace_medium(rank, TRACE_TINT).rgb, trace_medium(rank, TRACE_IOR).w,
                           trace_medium(rank, TRACE_ABSORB).w);
}

/* Returns true if a path is inside an object. For a single closed object, tests path.side instead
 * of the medium stack. */
bool trace_is_in(trace_path path)
{
    bool has_side =
        trace_has(TRACE_HAS_CULLING) && !trace_has(TRACE_HAS_HOLES | TRACE_HAS_DIFFUSE_LIGHT);
    return has_side ? path.side > 0.0 : trace_is_inside(path.medium_stack);
}

/* Intersection of a path with an object's surface. */
struct trace_crossing {
    vec3 n, facet; /* shading normal and geometric normal, both on the side of the incoming ray */
    uint rank;
    bool is_hit; /* the ray hits a surface */
    bool is_entering, is_thin, is_real;
    bool is_inclusion;
    float eta;
    bool is_contact; /* with TRACE_HAS_CONTACTS: the medium stack becomes one of the next two */
    uvec4 front_stack, behind_stack;
    bool is_bumpy;            /* `n` comes from a normal map */
    object_material material; /* textured surface parameters, with TRACE_HAS_TEXTURED_OBJECTS */
    vec3 d_origin, d_n;       /* ray differentials of the hit point and of `n` */
};

#include "trace/trace_candidate_bvhs.glsl"
#include "trace/trace_contacts.glsl"
#include "trace/trace_inclusions.glsl"
#include "trace/trace_ray_differentials.glsl"

/* Computes the media on both sides of a contact, and how light is refracted there. */
void trace_cross_contact(trace_path path, trace_contact contact, int channel,
                         inout trace_crossing c)
{
    c.is_contact = true;
    c.is_thin = false;
    c.front_stack = trace_stack_change(path.medium_stack, contact.entered, contact.left);
    c.behind_stack = trace_stack_change(path.medium_stack, contact.left, contact.entered);
    c.is_entering = c.is_entering || trace_stack_has(c.behind_stack, c.rank);
    uint before = trace_current_medium(c.front_stack);
    uint after = trace_current_medium(c.behind_stack);
    c.is_real = !trace_is_same_medium(before, after);
    c.eta = trace_medium(before, TRACE_IOR)[channel] / trace_medium(after, TRACE_IOR)[channel];
}

/* Computes how light is refracted at a single surface of an object. */
void trace_cross_object(trace_path path, int channel, inout trace_crossing c)
{
    uint below = trace_current_medium_without(path.medium_stack, c.rank);
    uint above = max(below, c.rank);
    c.is_thin = trace_medium(c.rank, TRACE_TINT).w > 0.0;
    c.is_real = c.is_thin || below != above;
    if (trace_has(TRACE_HAS_CONTACTS) && c.is_real && !c.is_thin)
        c.is_real = !trace_is_same_medium(below, above);
    float ior_below = trace_medium(below, TRACE_IOR)[channel];
    float ior_above = trace_medium(c.is_thin ? c.rank : above, TRACE_IOR)[channel];
    c.eta = c.is_entering || c.is_thin ? ior_below / ior_above : ior_above / ior_below;
}

trace_crossing trace_crossing_at(trace_path path, trace_hit hit, trace_contact contact, int channel)
{
    trace_crossing c;
    int triangle = max(hit.triangle, 0);
    int at = BVH_CORNER_WORDS * triangle;
    vec4 n0 = uintBitsToFloat(trace_corner(at));
    vec4 n1 = uintBitsToFloat(trace_corner(at + 1));
    vec4 n2 = uintBitsToFloat(trace_corner(at + 2));
    c.facet = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * triangle + 2)).xyz;
    c.facet = trace_posed(c.facet, hit.bvh);
    c.n = n0.xyz + hit.u * (n1.xyz - n0.xyz) + hit.v * (n2.xyz - n0.xyz);
    c.n = normalize(trace_posed(c.n, hit.bvh));
    c.rank = hit.triangle >= 0 ? floatBitsToUint(n0.w) % BVH_OBJECT_NUMBER : 0u;
    c.is_entering = dot(c.facet, path.dir) < 0.0;
    c.facet *= c.is_entering ? 1.0 : -1.0;
    c.n *= c.is_entering ? 1.0 : -1.0;
    c.n = dot(c.n, path.dir) < 0.0 ? c.n : c.facet;
    differential_transfer(path, hit, c);
    c.is_hit = c.rank != 0u;
    c.is_thin = false;
    c.is_real = true;
    c.is_inclusion = false;
    c.is_contact = false;
    if (trace_has(TRACE_HAS_CONTACTS) && contact_bits(hit) == BVH_CONTACT) {
        trace_cross_contact(path, contact, channel, c);
    } else if (trace_has(TRACE_HAS_MEDIA)) {
        trace_cross_object(path, channel, c);
    } else {
        c.eta = refract_frame.etas[channel];
        c.eta = c.is_entering ? c.eta : 1.0 / c.eta;
    }
    c.is_bumpy = false;
#ifdef TRACE_RAYS
    if (trace_has(TRACE_HAS_TEXTURED_OBJECTS)) {
        c.material = trace_untextured(c.rank);
        vec3 mapped_n =
            trace_object_material(hit, path.origin, path.dir, c.rank != 0u, c.material, c.is_bumpy);
        mapped_n = bump_facing(c.is_entering ? mapped_n : -mapped_n, c.n, path.dir);
        c.n = !c.is_bumpy ? c.n : dot(mapped_n, path.dir) < 0.0 ? mapped_n : c.facet;
    }
#endif
    if (trace_has(TRACE_HAS_INCLUSIONS)) {
        c.is_real = c.is_real && !path.is_in_bubble;
        if (hit.triangle >= 0 && hit.bvh == BVH_INCLUSIONS) {
            vec3 n = n0.xyz + hit.u * (n1.xyz - n0.xyz) + hit.v * (n2.xyz - n0.xyz);
            float eta = 1.0 / refract_frame.etas[channel];
            if (trace_has(TRACE_HAS_MEDIA))
                eta = trace_medium(trace.ice, TRACE_IOR)[channel] /
                      trace_medium(0u, TRACE_IOR)[channel];
            c = trace_inclusion_crossing(path, hit, n, frame.outside_in_air * eta);
        }
    }
    return c;
}

/* Returns the state of a path that continues from a surface in direction `dir`. */
trace_path trace_continue(trace_path path, trace_hit hit, trace_crossing c, vec3 dir,
                          bool is_through)
{
    trace_path next = path;
    bool is_inside = is_through == c.is_entering;
    float outward = dot(dir, c.facet) * (c.is_entering ? 1.0 : -1.0);
    bool is_on_wrong_side = is_inside ? outward >= 0.0 : outward <= 0.0;
    next.origin = path.origin + hit.t * path.dir;
    next.dir = dir;
    differential_scatter(path, c, dir, is_through, next);
    next.from = hit.triangle;
    next.side = is_inside ? 1.0 : -1.0;
    next.reach = is_on_wrong_side || trace_has(TRACE_HAS_CULLING) ? 1e30 : trace.epsilon;
    if (trace_has(TRACE_HAS_INCLUSIONS) && c.is_inclusion) {
        next.side = trace_has(TRACE_HAS_CULLING) ? path.side : 0.0;
        next.is_in_bubble = !c.is_thin && is_inside;
    }
    if (trace_has(TRACE_HAS_CONTACTS) && c.is_contact)
        next.medium_stack = is_through ? c.behind_stack : c.front_stack;
    else if (!c.is_thin && !c.is_inclusion)
        next.medium_stack = is_inside ? trace_stack_push(path.medium_stack, c.rank)
                                      : trace_stack_remove(path.medium_stack, c.rank);
    next.seed = microfacet_hash(path.seed, is_through ? 1u : 0u);
    next.shows_backdrop = path.shows_backdrop && is_through;
    return next;
}

/* Reads the primary hit from the rasterised front faces. Returns false if the hit must be traced.
 * At grazing angles, it must be, because rasterised points are not exactly on triangles. */
bool trace_rasterised_hit(vec3 e, float scale, inout trace_hit hit, inout trace_crossing c)
{
#ifdef TRACE_RAYS
    return false;
#else
    if (!trace_has(TRACE_HAS_CULLING) || trace_camera_is_inside())
        return false;
    float depth = texelFetch(depth_front, ivec2(gl_FragCoord.xy), 0).r;
    hit.t = view_depth(refract_frame.clip_from_world, depth) * scale;
    hit.triangle = -1;
    c.n = texelFetch(shading, ivec2(gl_FragCoord.xy), 0).xyz;
    c.facet = c.n;
    c.rank = depth > 0.0 ? 1u : 0u;
    c.is_hit = depth > 0.0;
    c.is_entering = true;
    return depth == 0.0 || dot(c.n, e) < -0.05;
#endif
}

void trace_begin(vec3 eye, vec3 e)
{
    float side = trace_has(TRACE_HAS_CULLING) ? (trace_camera_is_inside() ? 1.0 : -1.0) : 0.0;
    uint seed = microfacet_hash(uint(gl_FragCoord.x), uint(gl_FragCoord.y));
    bool is_in_bubble = trace_has(TRACE_HAS_INCLUSIONS) && trace.is_in_bubble != 0u;
    path = trace_path(eye, e, vec3(1.0), trace_camera_stack(), -1, side, 1e30, seed, 0.0,
                      trace_segments_max, is_in_bubble, false, 1.0, differential_origin,
                      differential_dir, constant_backdrop == GLOBALS_BACKDROP_NONE);
    for (int i = 0; i < trace_pending_max; i++)
        pending[i] = path;
    pending_count = 0;
    segment_count = 0;
    start = eye;
    result = trace_result(vec3(0.0), vec3(0.0), -e, 0.0, 0.0, false, false, e, 0.0, 0.0, 0.0, 0u,
                          vec3(0.0));
    is_first = true;
    is_main = true;
    sets_last = true;
#ifdef TRACE_DENOISE
    denoise_begin();
#endif
#ifndef TRACE_RAYS
    for (int i = 0; i < trace_ends_max; i++)
        ends[i] = trace_ray_end(eye, e, vec3(0.0), 0.0, false);
    end_count = 0;
    escaped_end = path;
    escaped_end.throughput = vec3(0.0);
    ends_left = trace_ends_max - 1;
#endif
}

void trace_add(vec3 light, float kind)
{
#ifdef TRACE_DENOISE
    denoise_inputs.gathered += kind > 1.5 ? light : vec3(0.0);
    light = kind > 1.5 ? vec3(0.0) : light;
#endif
    result.refraction += kind > 0.5 ? vec3(0.0) : light;
    result.reflection += kind > 0.5 ? light : vec3(0.0);
}

#ifndef TRACE_RAYS
/* Appends a path to `ends` with constant indices. A variable index would move `ends` to memory. */
void trace_push_end(trace_path at)
{
    for (int k = 0; k < trace_ends_max; k++)
        if (k == end_count)
            ends[k] = trace_ray_end(at.origin, at.dir, at.throughput, at.kind, at.shows_backdrop);
    end_count++;
}
#endif

/* Pushes a pending path. If the path has left all objects, it is stored in `ends` instead. */
void trace_push_pending(trace_path other)
{
#ifndef TRACE_RAYS
    ends_left--;
    if (trace_has_escaped(other)) {
        trace_push_end(other);
        return;
    }
#endif
    for (int i = trace_pending_max - 1; i > 0; i--)
        pending[i] = pending[i - 1];
    pending[0] = other;
    pending_count++;
}

/* Returns a random number for the decision `salt` of the path: an additive recurrence over samples
 * (golden ratio), which starts at a hash of the path. */
float trace_random(uint salt)
{
    uint bits = microfacet_hash(path.seed, salt) + 2654435769u * trace.sample_index;
    return float(bits >> 8) * exp2(-24.0);
}

/* Returns true if a pixel can store another pending path. */
bool trace_has_room()
{
    bool has_room = pending_count < trace_pending_max && segment_count < trace_split_segments_max;
#ifndef TRACE_RAYS
    has_room = has_room && ends_left > 0;
#endif
    return has_room;
}

#include "trace/trace_participating_media.glsl"
#ifdef TRACE_RAYS
#include "trace/trace_diffuse_light.glsl"
#endif

/* Returns an estimate of the radiance that a path finds in a direction: the environment without
 * occlusion. The sun is clamped, because a path that is refracted again misses it. */
vec3 trace_expected_radiance(vec3 dir)
{
#ifdef TRACE_RAYS
    vec3 found = environment_radiance(environment, dir, trace_expected_lod);
#else
    vec3 found = textureLod(env_cube, dir, 0.0).rgb;
#endif
    return min(found, vec3(trace_expected_max));
}

/* Decides by Russian roulette whether a path of this throughput is followed. If so, divides the
 * throughput by the probability. The expected radiance is a control variate (Owen, "Monte Carlo
 * theory, methods and examples", 8.9): the pixel gets it for what is not followed, and loses it
 * for what is followed with too much weight. The mean is exact for any estimate.
 *
 * From trace_roulette_segments segments in the pixel on, the throughput that is followed for
 * certain grows. Otherwise a few pixels, in which paths are trapped by total reflection, would take
 * most of the time. This second roulette has no control variate, because its large weights would
 * make such pixels negative. */
bool trace_roulette(inout vec3 throughput, vec3 dir, float kind, float probability, uint salt)
{
    float number = trace_random(salt);
    float weight = number < probability ? 1.0 / max(probability, 1e-30) : 0.0;
    if (probability < 1.0)
        trace_add((1.0 - weight) * throughput * trace_expected_radiance(dir), kind);
    throughput *= weight;
    float extra = float(max(segment_count - trace_roulette_segments, 0));
    float min_throughput = trace.branch * extra / trace_roulette_growth;
    float max_throughput = max(throughput.r, max(throughput.g, throughput.b));
    float chance = min(max_throughput / max(min_throughput, 1e-30), 1.0);
    throughput /= max(chance, 1e-30);
    return number < probability * chance;
}

/* Returns true if a branch is followed as a separate path. Russian roulette decides on branches
 * below trace.branch, and in pixels of more than trace_roulette_segments segments on all. */
bool trace_is_split(inout vec3 throughput, vec3 dir)
{
    float max_throughput = max(throughput.r, max(throughput.g, throughput.b));
    float min_throughput = max(trace.branch, trace_branch_min);
    if (trace_has(TRACE_HAS_DIFFUSE_LIGHT) && path.is_lighting_ray)
        min_throughput = max(min_throughput, trace_lighting_branch);
    float probability = is_first ? 1.0 : min(max_throughput / min_throughput, 1.0);
    return max_throughput > 0.0 &&
           trace_roulette(throughput, dir, path.kind, probability, trace_split_seed);
}

/* Returns the surface parameters at a hit, with any textures applied. */
object_material trace_material_at(trace_crossing c)
{
#ifdef TRACE_RAYS
    if (trace_has(TRACE_HAS_TEXTURED_OBJECTS))
        return c.material;
#endif
    return trace_untextured(c.rank);
}

/* Computes Fresnel reflection and refraction at a hit. If the surface is rough, samples a
 * microfacet from the distribution of visible normals. */
trace_fresnel_split trace_fresnel_at(trace_crossing c)
{
    trace_fresnel_split p;
    vec3 m = c.n;
    float roughness = trace_has(TRACE_HAS_ROUGH) ? trace_material_at(c).roughness : 0.0;
    bool is_rough = roughness > trace_rough_min;
    p.reflected_weight = 1.0;
    p.refracted_weight = 1.0;
    if (trace_has(TRACE_HAS_ROUGH) && is_rough) {
        vec2 at = microfacet_point(trace.sample_index, path.seed);
        m = microfacet_sample(c.n, path.dir, roughness, at);
    }
    p.fresnel = trace_fresnel(path.dir, m, c.eta, c.is_thin, p.reflected, p.refracted);
    if (trace_has(TRACE_HAS_ROUGH) && is_rough) {
        vec3 flat_reflected, flat_refracted;
        bool is_refracted = p.fresnel < 1.0 && dot(p.refracted, c.n) < 0.0;
        bool is_reflected = dot(p.reflected, c.n) > 0.0;
        p.fresnel = trace_fresnel(path.dir, c.n, c.eta, c.is_thin, flat_reflected, flat_refracted);
        p.reflected_weight = is_reflected ? microfacet_masking(c.n, p.reflected, roughness) : 0.0;
        p.refracted_weight = is_refracted ? microfacet_masking(c.n, p.refracted, roughness) : 0.0;
    } else if ((!c.is_entering || c.is_inclusion) && dot(p.reflected, c.facet) <= 0.0) {
        p.reflected = reflect(path.dir, c.facet);
    }
    if (trace_has(TRACE_HAS_TEXTURED_OBJECTS) && c.is_bumpy)
        trace_correct_sides(p, path.dir, c.facet, c.eta, is_rough);
    return p;
}

/* Returns the throughput that a surface transmits before Fresnel reflection. If the surface is not
 * fully transmissive, adds the radiance of its opaque base to the pixel. */
vec3 trace_transmitted(trace_hit hit, trace_crossing c, trace_fresnel_split p)
{
    vec3 through = path.throughput * p.refracted_weight;
    if (trace_has(TRACE_HAS_MEDIA | TRACE_HAS_TINT | TRACE_HAS_TEXTURED_OBJECTS))
        through *= trace_material_at(c).tint;
#ifdef TRACE_RAYS
    if (trace_has(TRACE_HAS_OPACITY)) {
        float opacity = trace_material_at(c).opacity;
        int iterations = opacity > 0.0 ? int(trace.one) : 0;
        while (iterations > 0) {
            float passing;
            iterations -= int(trace.one);
            trace_surface_point point = trace_surface_point_at(hit, path.origin, path.dir);
            point.normal = c.is_bumpy ? c.n : point.normal;
            vec3 light = trace_shade(point, path.dir, true, passing);
            trace_add(path.throughput * light * opacity * (1.0 - p.fresnel), path.kind);
        }
        through *= 1.0 - opacity;
    }
#endif
    return through;
}

void trace_record(trace_hit hit, trace_crossing c, float fresnel, bool is_total)
{
    if (!is_first && sets_last && !c.is_inclusion)
        result.last = trace_object_number(hit.triangle);
    if (is_first) {
        result.is_object = true;
        result.normal = c.n;
        result.distance = distance(start, path.origin) + hit.t;
        result.fresnel = fresnel;
    } else if (is_main && trace_is_in(path)) {
        result.bounces += is_total ? 1.0 : 0.0;
        result.segments += 1.0;
    }
}

/* Terminates a path of low throughput by Russian roulette. The main path also gives the layers, so
 * it is only terminated if it carries next to nothing, until the pixel has trace_roulette_segments
 * segments. A path that gives alpha is always treated like that. */
bool trace_survives()
{
    float max_throughput = max(path.throughput.r, max(path.throughput.g, path.throughput.b));
    float probability = min(max_throughput / max(trace.branch, trace_branch_min), 1.0);
    bool is_kept = path.shows_backdrop || (is_main && segment_count < trace_roulette_segments);
    return is_kept ? max_throughput > 1e-5
                   : max_throughput > 0.0 && trace_roulette(path.throughput, path.dir, path.kind,
                                                            probability, trace_survival_seed);
}

/* Continues the path at a surface by refraction, and pushes the reflected branch as a second path.
 * Total reflection, or no room for a second path, continues it by reflection. Returns false if no
 * throughput is left. */
bool trace_scatter(trace_hit hit, trace_crossing c)
{
    trace_fresnel_split p = trace_fresnel_at(c);
    vec3 reflectance = trace_reflectance(hit, c, path.dir, p.fresnel);
    vec3 through = trace_transmitted(hit, c, p);
    vec3 back = path.throughput * reflectance * p.reflected_weight;
    bool is_total = p.fresnel >= 1.0 || through == vec3(0.0);
    if (trace_has(TRACE_HAS_DIFFUSE_LIGHT))
        path.open = path.open > 0.0 && trace_is_in(path) ? -1.0 : min(path.open, 0.0);
    trace_record(hit, c, p.fresnel, is_total);
    if (!is_total && trace_has_room()) {
        through *= 1.0 - reflectance;
        if (trace_is_split(back, p.reflected)) {
            trace_path other = trace_continue(path, hit, c, p.reflected, false);
            other.throughput = back;
            other.kind = is_first ? 1.0 : path.kind;
            trace_push_pending(other);
        }
    } else if (!is_total) { /* one of the branches, by Russian roulette */
        is_total = trace_random(trace_choice_seed) < p.fresnel;
        through *= (1.0 - reflectance) / (1.0 - p.fresnel);
        back /= max(p.fresnel, 1e-30);
    }
    bool is_mirror = is_first && is_total;
    path = trace_continue(path, hit, c, is_total ? p.reflected : p.refracted, !is_total);
    path.throughput = is_total ? back : through;
    path.kind = is_mirror ? 1.0 : path.kind;
    result.exit = is_main ? path.dir : result.exit;
    is_main = is_main && trace_is_in(path) && !is_mirror;
    is_first = false;
    return trace_survives();
}

/* Adds the light of the environment or surroundings where a path ends. Returns true if the path
 * continues instead, through a hole or a blended surface. */
bool trace_end_path(trace_hit hit)
{
    bool goes_on = false;
#ifdef TRACE_RAYS
    int iterations = is_first && !trace_camera_is_inside() ? 0 : int(trace.one);
    bool has_holes = trace_has(TRACE_HAS_HOLES) && hit.triangle >= 0 && path.left > 0;
    bool is_shaded = trace_has(TRACE_HAS_DIFFUSE_LIGHT) && hit.triangle >= 0;
    if (has_holes || is_shaded)
        iterations = int(trace.one);
    while (iterations > 0) {
        float passing;
        iterations -= int(trace.one);
        vec3 light = trace_radiance_at_end(path, hit, passing) * (1.0 - passing);
        bool is_surroundings = hit.bvh == BVH_SURROUNDINGS || hit.bvh == BVH_MOVERS;
        if (sets_last && is_surroundings && passing <= 0.5) /* long paths may end in bubbles */
            result.last = trace_object_number(hit.triangle);
        if (is_shaded && is_first && !trace_camera_is_inside() && lobes.is_lit && passing == 0.0) {
            lighting_begin(hit);
            trace_add(light, 0.0);
        } else if (is_first && !trace_camera_is_inside()) {
            /* blended surfaces do not attenuate primary rays: surroundings are composited later */
            passing = passing > 0.0 ? 1.0 : 0.0;
        } else {
            float open = 1.0;
            if (trace_has(TRACE_HAS_DIFFUSE_LIGHT) && hit.triangle < 0 && path.open > 0.0)
                open = path.open;
            bool is_backdrop = path.shows_backdrop && hit.triangle < 0;
            if (is_backdrop)
                result.backdrop += path.throughput;
            else
                trace_add(open * path.throughput * light, path.kind);
            result.is_object = true;
        }
        if (is_shaded && !is_first)
            light_gather_at(hit, path.throughput * (1.0 - passing));
        goes_on = has_holes && passing > 0.0;
        if (goes_on) {
            path.throughput *= passing;
            path.origin += hit.t * path.dir;
            path.from = hit.triangle;
            path.side = 0.0;
        }
    }
#else
    if ((!is_first || trace_camera_is_inside()) && end_count < trace_ends_max) {
        trace_push_end(path);
        result.is_object = true;
        escaped_end = sets_last ? path : escaped_end;
    }
#endif
    return goes_on;
}

/* Makes the next pending path the current one. Returns false if there is none. */
bool trace_pop_pending()
{
    path = pending[0];
    for (int i = 0; i + 1 < trace_pending_max; i++)
        pending[i] = pending[i + 1];
    is_main = false;
    sets_last = false;
    pending_count--;
    return pending_count >= 0;
}

/* Moves the path along one segment to its hit. Returns true if the path has ended. */
bool trace_step(trace_hit hit, trace_crossing c)
{
    if (hit.t < 1e30) {
        path.throughput = trace_absorb(path, hit.t);
        path.throughput *= trace_medium_transmittance(hit.t);
        result.path_length += is_main && trace_is_in(path) && !is_first ? hit.t : 0.0;
    }
    path.left--;
    segment_count++;
    bool crosses = c.is_hit && path.left >= 0;
    bool is_over = false;
    if (crosses && !c.is_real) {
        path = trace_continue(path, hit, c, path.dir, true);
    } else if (crosses) {
        is_over = !trace_scatter(hit, c);
#ifndef TRACE_RAYS
        if (trace_has_escaped(path) && !is_over) {
            is_over = true;
            crosses = false;
        }
#endif
    }
    if (!crosses)
        is_over = !trace_end_path(hit);
    return is_over;
}

void trace_pixel(vec3 eye, vec3 e, int channel)
{
    trace_hit raster_hit;
    trace_crossing raster_crossing;
    trace_begin(eye, e);
    bool is_rasterised =
        trace_rasterised_hit(e, primary_ray_slant(ray), raster_hit, raster_crossing);
    /* pixel groups without rasterised objects skip tracing */
    bool is_going = !is_rasterised || raster_crossing.is_hit;
    while (is_going) {
        trace_contact contact;
        trace_hit hit = contact_next_hit(path, !(is_first && is_rasterised), contact);
        trace_crossing c = trace_crossing_at(path, hit, contact, channel);
        if (is_rasterised && is_first) {
            hit = raster_hit;
            c.n = raster_crossing.n;
            c.facet = c.n;
            c.rank = raster_crossing.rank;
            c.is_hit = raster_crossing.is_hit;
            c.is_entering = true;
            c.eta = refract_frame.etas[channel];
        }
        if (trace_step(hit, c))
            is_going = trace_pop_pending();
    }
#ifndef TRACE_RAYS
    for (int i = 0; i < end_count; i++) {
        trace_ray_end end = ends[0];
        for (int k = 1; k < trace_ends_max; k++)
            end = k == i ? ends[k] : end;
        float backdrop;
        vec3 light = refract_environment_seen(end.origin, end.dir, end.shows_backdrop, backdrop);
        trace_add(end.throughput * light, end.kind);
        result.backdrop += backdrop * end.throughput;
    }
#endif
}

#include "trace/trace_dispersion.glsl"

/* Returns the depth-buffer value of a world-space point. */
float trace_depth(vec3 point)
{
    vec4 clip = refract_frame.clip_from_world * vec4(point, 1.0);
    return clamp(clip.z / clip.w, 0.0, 1.0);
}

#ifdef TRACE_PHOTONS
#include "trace/trace_photons.glsl"
#else
#include "trace/trace_image_outputs.glsl"
#endif
