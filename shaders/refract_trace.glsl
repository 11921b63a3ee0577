/*
 * refract_trace.glsl: main() of refract_trace.c: follows the light of a pixel through the objects.
 *
 * All ways of a pixel go through one loop of straight parts. One way is followed; others, which
 * begin where light was reflected, wait. With TRACE_RAYS, ways meet the triangles around the
 * objects; else they look up the environment cube.
 *
 * What only some ways need is in loops that run at most once, because lavapipe (Mesa 22.3) skips
 * loops that no pixel of a group enters, but executes both sides of branches.
 */
#define REFRACT_SEEN
#include "bump_normal.h"
#include "lib/constants.glsl"
#include "lib/microfacet.glsl"
#include "lib/view_ray.glsl"
#include "refract_frame.glsl"
#include "surface.glsl"
#include "trace_part.glsl"
#ifdef TRACE_RAYS
#include "trace_dress.glsl"
#else
#include "dress.h"
#include "refract_trace.h"
#define REFRACT_NEAREST
#define REFRACT_ENV_CUBE_POINTS TRACE_CUBE_POINTS
#include "refract_environment.glsl"
#endif
#include "trace_shells.glsl"
#ifdef TRACE_SMOOTH
#include "trace_smooth.glsl"
#endif

layout(location = REFRACT_VIEW_RAY) in vec3 ray;
#ifndef TRACE_RAYS
layout(set = 0, binding = REFRACT_SHADING) uniform sampler2D shading;
layout(set = 0, binding = REFRACT_DEPTH_FRONT) uniform sampler2D depth_front;
#endif

#ifdef TRACE_RAYS
const int trace_waits_max = 6; /* ways that wait */
#else
const int trace_waits_max = 2;
const int trace_stops_max = 3; /* ways of a pixel */
#endif
const int trace_length_max = 40; /* straight parts of a way */
/* Straight parts of a pixel after which no way is parted: llvmpipe ends loops after 65 535 rounds
 * of a group of pixels, and what they have not followed yet would be lost. */
const int trace_parted_max = 256;
const float trace_left = -2.0; /* side of a way that meets no object any more */
const float trace_rough_min = 1e-3;
const float trace_branch_min = 1e-3;
const float trace_gathered_branch = 0.1; /* of light that brings light to surroundings */

/* A way of light, against its direction. */
struct trace_way {
    vec3 origin, dir, weight;
    uvec4 inside;      /* objects that it is in */
    int from;          /* the triangle on which it begins; below 0: none */
    float side, reach; /* as of trace_ray; side may be trace_left */
    uint seed;
    float kind; /* 1: it is reflected by the first surface; 2: of trace_smooth.glsl; else 0 */
    int left;   /* straight parts that it may still have */
    bool is_in_bubble;
    bool is_gathered; /* it brings light to surroundings (trace_ground.glsl) */
    float open;       /* by how much its end counts if nothing was in its way; 0: an object bent it;
                         below 0: it came out of one in which it began */
    vec3 shift, turn; /* of origin and direction, from pixel to pixel (trace_footprint.glsl) */
};

struct trace_seen {
    vec3 refraction, reflection; /* radiance, times its share */
    vec3 normal;                 /* of the first surface, on the eye's side */
    float distance, fresnel;
    bool is_object;
    bool is_ground; /* surroundings, seen straight */
    vec3 exit;
    float path, bounces, parts; /* of the way that is refracted wherever that is possible */
    uint last; /* number of the last object that this way meets after the first surface; 0: none */
};

/* ---- a pixel: variables, because lavapipe's compiler takes long over arrays in arguments ---- */

trace_way way;                    /* that is followed */
trace_way later[trace_waits_max]; /* those that wait, the last one first */
int waits;
int lengths; /* straight parts of all ways so far */
trace_seen seen;
vec3 start;       /* of the pixel's ray */
bool is_first;    /* it has met no surface */
bool is_main;     /* it is the one of seen.path */
bool is_straight; /* it is that of seen.last */

#ifndef TRACE_RAYS
/* Where a way ends. What is seen there is looked up when all ways of the pixel have ended: then the
 * pixels of a group do so at the same time. */
struct trace_stop {
    vec3 origin, dir, weight;
    float kind;
};

trace_stop stops[trace_stops_max];
int stop_count, parts_left;
trace_way straight_end; /* of the way of seen.last; without weight: it has none */
#endif

/* Returns a medium's surface without textures. */
dress trace_own(uint rank)
{
    return dress(trace_medium(rank, TRACE_TINT).rgb, trace_medium(rank, TRACE_IOR).w,
                 trace_medium(rank, TRACE_ABSORB).w);
}

/* Returns whether a way is in an object. A ray of one closed object knows by its side, so that its
 * set of objects takes no time. */
bool trace_is_in(trace_way way)
{
    bool has_side = trace_has(TRACE_HAS_CULLING) && !trace_has(TRACE_HAS_HOLES | TRACE_HAS_GROUND);
    return has_side ? way.side > 0.0 : trace_is_inside(way.inside);
}

/* A crossing of an object's surface. */
struct trace_cross {
    vec3 n, facet; /* normals on the side that light comes from, interpolated and the triangle's */
    uint rank;
    bool is_met; /* it is one */
    bool is_entering, is_thin, is_real;
    bool is_inclusion;
    float eta;
    float horizon;    /* sine beyond which rays that leave the outer side meet no object */
    bool is_bumpy;    /* a normal texture bends `n` */
    dress own;        /* of the surface, if TRACE_HAS_DRESS */
    vec3 shift, bend; /* of the point that is met and of `n`, from pixel to pixel */
};

#include "trace_footprint.glsl"
#include "trace_inclusions.glsl"
#include "trace_next.glsl"

trace_cross trace_cross_at(trace_way way, trace_hit hit, int channel)
{
    trace_cross c;
    int triangle = max(hit.triangle, 0);
    int at = TREE_CORNER_WORDS * triangle;
    vec4 n0 = uintBitsToFloat(trace_corner(at));
    vec4 n1 = uintBitsToFloat(trace_corner(at + 1));
    vec4 n2 = uintBitsToFloat(trace_corner(at + 2));
    c.facet = uintBitsToFloat(trace_row(TREE_TRIANGLE_WORDS * triangle + 2)).xyz;
    c.facet = trace_posed(c.facet, hit.part);
    c.n = n0.xyz + hit.u * (n1.xyz - n0.xyz) + hit.v * (n2.xyz - n0.xyz);
    c.n = normalize(trace_posed(c.n, hit.part));
    c.rank = hit.triangle >= 0 ? floatBitsToUint(n0.w) % TREE_NUMBER : 0u;
    c.is_entering = dot(c.facet, way.dir) < 0.0;
    c.facet *= c.is_entering ? 1.0 : -1.0;
    c.n *= c.is_entering ? 1.0 : -1.0;
    c.n = dot(c.n, way.dir) < 0.0 ? c.n : c.facet;
    footprint_meet(way, hit, c);
    c.is_met = c.rank != 0u;
    c.is_thin = false;
    c.is_real = true;
    c.is_inclusion = false;
    c.horizon = float(floatBitsToUint(n2.w) >> TREE_HORIZON_SHIFT) / float(TREE_HORIZON_STEPS);
    if (trace_has(TRACE_HAS_MEDIA)) {
        uint below = trace_top_without(way.inside, c.rank);
        uint above = max(below, c.rank);
        c.is_thin = trace_medium(c.rank, TRACE_TINT).w > 0.0;
        c.is_real = c.is_thin || below != above;
        float ior_below = trace_medium(below, TRACE_IOR)[channel];
        float ior_above = trace_medium(c.is_thin ? c.rank : above, TRACE_IOR)[channel];
        c.eta = c.is_entering || c.is_thin ? ior_below / ior_above : ior_above / ior_below;
    } else {
        c.eta = refract_frame.etas[channel];
        c.eta = c.is_entering ? c.eta : 1.0 / c.eta;
    }
    c.is_bumpy = false;
#ifdef TRACE_RAYS
    if (trace_has(TRACE_HAS_DRESS)) {
        c.own = trace_own(c.rank);
        vec3 bent = trace_dress(hit, way.origin, way.dir, c.rank != 0u, c.own, c.is_bumpy);
        bent = bump_facing(c.is_entering ? bent : -bent, c.n, way.dir);
        c.n = !c.is_bumpy ? c.n : dot(bent, way.dir) < 0.0 ? bent : c.facet;
    }
#endif
    if (trace_has(TRACE_HAS_INCLUSIONS)) {
        c.is_real = c.is_real && !way.is_in_bubble;
        if (hit.triangle >= 0 && hit.part == TREE_INCLUSIONS) {
            vec3 n = n0.xyz + hit.u * (n1.xyz - n0.xyz) + hit.v * (n2.xyz - n0.xyz);
            float eta = 1.0 / refract_frame.etas[channel];
            if (trace_has(TRACE_HAS_MEDIA))
                eta = trace_medium(trace.ice, TRACE_IOR)[channel] /
                      trace_medium(0u, TRACE_IOR)[channel];
            c = trace_inclusion_at(way, hit, n, frame.outside_in_air * eta);
        }
    }
    return c;
}

/* Makes a way go on from a surface. */
trace_way trace_leave(trace_way way, trace_hit hit, trace_cross c, vec3 dir, bool is_through)
{
    trace_way next = way;
    bool is_inside = is_through == c.is_entering;
    float outward = dot(dir, c.facet) * (c.is_entering ? 1.0 : -1.0);
    bool is_astray = is_inside ? outward >= 0.0 : outward <= 0.0;
    next.origin = way.origin + hit.t * way.dir;
    next.dir = dir;
    footprint_leave(way, c, dir, is_through, next);
    next.from = hit.triangle;
    next.side = is_inside ? 1.0 : outward > c.horizon ? trace_left : -1.0;
    next.reach = is_astray || trace_has(TRACE_HAS_CULLING) ? 1e30 : trace.hair;
    if (trace_has(TRACE_HAS_INCLUSIONS) && c.is_inclusion) {
        next.side = trace_has(TRACE_HAS_CULLING) ? way.side : 0.0;
        next.is_in_bubble = !c.is_thin && is_inside;
    }
    if (!c.is_thin && !c.is_inclusion)
        next.inside =
            is_inside ? trace_with(way.inside, c.rank) : trace_without(way.inside, c.rank);
    if (trace_has(TRACE_HAS_ROUGH | TRACE_HAS_GROUND))
        next.seed = microfacet_hash(way.seed, is_through ? 1u : 0u);
    return next;
}

/* Takes the first crossing from rasterised front faces, where rays only meet faces that they can
 * see; so the eye's ray needs not be traced. Returns whether it does: grazing rays are traced,
 * because rasterised points are not exactly on their triangles. */
bool trace_given(vec3 e, float scale, inout trace_hit hit, inout trace_cross c)
{
#ifdef TRACE_RAYS
    return false;
#else
    if (!trace_has(TRACE_HAS_CULLING) || trace_eye_is_inside())
        return false;
    float depth = texelFetch(depth_front, ivec2(gl_FragCoord.xy), 0).r;
    hit.t = view_distance(refract_frame.clip_from_world, depth) * scale;
    hit.triangle = -1;
    c.n = texelFetch(shading, ivec2(gl_FragCoord.xy), 0).xyz;
    c.facet = c.n;
    c.rank = depth > 0.0 ? 1u : 0u;
    c.is_met = depth > 0.0;
    c.is_entering = true;
    c.horizon = trace_grid_horizon(start + hit.t * e);
    return depth == 0.0 || dot(c.n, e) < -0.05;
#endif
}

void trace_begin(vec3 eye, vec3 e)
{
    float side = trace_has(TRACE_HAS_CULLING) ? (trace_eye_is_inside() ? 1.0 : -1.0) : 0.0;
    uint seed = microfacet_hash(uint(gl_FragCoord.x), uint(gl_FragCoord.y));
    bool is_in_bubble = trace_has(TRACE_HAS_INCLUSIONS) && trace.is_in_bubble != 0u;
    way = trace_way(eye, e, vec3(1.0), trace_eye_inside(), -1, side, 1e30, seed, 0.0,
                    trace_length_max, is_in_bubble, false, 1.0, footprint_shift, footprint_turn);
    for (int i = 0; i < trace_waits_max; i++)
        later[i] = way;
    waits = 0;
    lengths = 0;
    start = eye;
    seen = trace_seen(vec3(0.0), vec3(0.0), -e, 0.0, 0.0, false, false, e, 0.0, 0.0, 0.0, 0u);
    is_first = true;
    is_main = true;
    is_straight = true;
#ifdef TRACE_SMOOTH
    smooth_begin();
#endif
#ifndef TRACE_RAYS
    for (int i = 0; i < trace_stops_max; i++)
        stops[i] = trace_stop(eye, e, vec3(0.0), 0.0);
    stop_count = 0;
    straight_end = way;
    straight_end.weight = vec3(0.0);
    parts_left = trace_stops_max - 1;
#endif
}

void trace_add(vec3 light, float kind)
{
#ifdef TRACE_SMOOTH
    matt.gathered += kind > 1.5 ? light : vec3(0.0);
    light = kind > 1.5 ? vec3(0.0) : light;
#endif
    seen.refraction += kind > 0.5 ? vec3(0.0) : light;
    seen.reflection += kind > 0.5 ? light : vec3(0.0);
}

#ifndef TRACE_RAYS
/* By selection: an index that is not constant sends an array to memory. */
void trace_put_stop(trace_way at)
{
    for (int k = 0; k < trace_stops_max; k++)
        if (k == stop_count)
            stops[k] = trace_stop(at.origin, at.dir, at.weight, at.kind);
    stop_count++;
}
#endif

/* Lets a way wait; one that has left the objects has ended. */
void trace_put(trace_way other)
{
#ifndef TRACE_RAYS
    parts_left--;
    if (trace_has_left(other)) {
        trace_put_stop(other);
        return;
    }
#endif
    for (int i = trace_waits_max - 1; i > 0; i--)
        later[i] = later[i - 1];
    later[0] = other;
    waits++;
}

/* Whether a reflection of that weight is followed apart. */
bool trace_is_parted(vec3 weight)
{
    float most = max(weight.r, max(weight.g, weight.b));
    bool has_room = waits < trace_waits_max && lengths < trace_parted_max;
#ifndef TRACE_RAYS
    has_room = has_room && parts_left > 0;
#endif
    float least = max(trace.branch, trace_branch_min);
    if (trace_has(TRACE_HAS_GROUND) && way.is_gathered)
        least = max(least, trace_gathered_branch);
    return has_room && most > 0.0 && (is_first || most > least);
}

#include "trace_cloud.glsl"
#ifdef TRACE_RAYS
#include "trace_ground.glsl"
#endif

/* Returns the surface's own values, with textures. */
dress trace_dress_of(trace_cross c)
{
#ifdef TRACE_RAYS
    if (trace_has(TRACE_HAS_DRESS))
        return c.own;
#endif
    return trace_own(c.rank);
}

/* Parts light at a smooth surface or, at one of its microfacets, a rough one. */
trace_parting trace_part_at(trace_cross c)
{
    trace_parting p;
    vec3 m = c.n;
    float roughness = trace_has(TRACE_HAS_ROUGH) ? trace_dress_of(c).roughness : 0.0;
    bool is_rough = roughness > trace_rough_min;
    p.reflected_share = 1.0;
    p.refracted_share = 1.0;
    if (trace_has(TRACE_HAS_ROUGH) && is_rough) {
        vec2 at = microfacet_point(trace.sample_index, way.seed);
        m = microfacet_sample(c.n, way.dir, roughness, at);
    }
    p.fresnel = trace_part(way.dir, m, c.eta, c.is_thin, p.reflected, p.refracted);
    if (trace_has(TRACE_HAS_ROUGH) && is_rough) {
        vec3 mirrored, bent;
        bool is_refracted = p.fresnel < 1.0 && dot(p.refracted, c.n) < 0.0;
        bool is_reflected = dot(p.reflected, c.n) > 0.0;
        p.fresnel = trace_part(way.dir, c.n, c.eta, c.is_thin, mirrored, bent);
        p.reflected_share = is_reflected ? microfacet_masking(c.n, p.reflected, roughness) : 0.0;
        p.refracted_share = is_refracted ? microfacet_masking(c.n, p.refracted, roughness) : 0.0;
    } else if ((!c.is_entering || c.is_inclusion) && dot(p.reflected, c.facet) <= 0.0) {
        p.reflected = reflect(way.dir, c.facet);
    }
    if (trace_has(TRACE_HAS_DRESS) && c.is_bumpy)
        trace_keep_sides(p, way.dir, c.facet, c.eta, is_rough);
    return p;
}

/* Returns what of a way's light goes through a surface, without its reflectance, and adds what the
 * surface itself shows where it is not wholly transmissive. */
vec3 trace_through(trace_hit hit, trace_cross c, trace_parting p)
{
    vec3 through = way.weight * p.refracted_share;
    if (trace_has(TRACE_HAS_MEDIA | TRACE_HAS_TINT | TRACE_HAS_DRESS))
        through *= trace_dress_of(c).tint;
#ifdef TRACE_RAYS
    if (trace_has(TRACE_HAS_SHINE)) {
        float shine = trace_dress_of(c).shine;
        int turns = shine > 0.0 ? int(trace.one) : 0;
        while (turns > 0) {
            float passing;
            turns -= int(trace.one);
            trace_point point = trace_point_of(hit, way.origin, way.dir);
            point.normal = c.is_bumpy ? c.n : point.normal;
            vec3 light = trace_surface(point, way.dir, true, passing);
            trace_add(way.weight * light * shine * (1.0 - p.fresnel), way.kind);
        }
        through *= 1.0 - shine;
    }
#endif
    return through;
}

void trace_note(trace_hit hit, trace_cross c, float fresnel, bool is_total)
{
    if (!is_first && is_straight && !c.is_inclusion)
        seen.last = trace_number(hit.triangle);
    if (is_first) {
        seen.is_object = true;
        seen.normal = c.n;
        seen.distance = distance(start, way.origin) + hit.t;
        seen.fresnel = fresnel;
    } else if (is_main && trace_is_in(way)) {
        seen.bounces += is_total ? 1.0 : 0.0;
        seen.parts += 1.0;
    }
}

/* Makes the way go on from a surface. Returns whether it has any light left. */
bool trace_cross_surface(trace_hit hit, trace_cross c)
{
    trace_parting p = trace_part_at(c);
    vec3 shares = trace_shares_of(hit, c, way.dir, p.fresnel);
    vec3 through = trace_through(hit, c, p);
    vec3 back = way.weight * shares * p.reflected_share;
    bool is_total = p.fresnel >= 1.0 || through == vec3(0.0);
    if (trace_has(TRACE_HAS_GROUND))
        way.open = way.open > 0.0 && trace_is_in(way) ? -1.0 : min(way.open, 0.0);
    trace_note(hit, c, p.fresnel, is_total);
    if (!is_total && trace_is_parted(back)) {
        trace_way other = trace_leave(way, hit, c, p.reflected, false);
        other.weight = back;
        other.kind = is_first ? 1.0 : way.kind;
        trace_put(other);
        through *= 1.0 - shares;
    } else if (trace_is_crack(c) && p.fresnel > 0.5) { /* the greater part gets the other's light */
        is_total = true;
        back = way.weight;
    }
    bool is_mirror = is_first && is_total;
    way = trace_leave(way, hit, c, is_total ? p.reflected : p.refracted, !is_total);
    way.weight = is_total ? back : through;
    way.kind = is_mirror ? 1.0 : way.kind;
    seen.exit = is_main ? way.dir : seen.exit;
    is_main = is_main && trace_is_in(way) && !is_mirror;
    is_first = false;
    return max(way.weight.r, max(way.weight.g, way.weight.b)) > 1e-5;
}

/* Ends a way that has met no object. Returns whether it goes on, through a blended surface. */
bool trace_arrive(trace_hit hit)
{
    bool goes_on = false;
#ifdef TRACE_RAYS
    int turns = is_first && !trace_eye_is_inside() ? 0 : int(trace.one);
    bool is_holed = trace_has(TRACE_HAS_HOLES) && hit.triangle >= 0 && way.left > 0;
    bool is_shaded = trace_has(TRACE_HAS_GROUND) && hit.triangle >= 0;
#ifdef REFRACT_LAYERS
    is_shaded = is_shaded && !is_first;
#endif
    if (is_holed || is_shaded)
        turns = int(trace.one);
    while (turns > 0) {
        float passing;
        turns -= int(trace.one);
        vec3 light = trace_end(way, hit, passing) * (1.0 - passing);
        bool is_around = hit.part == TREE_SURROUNDINGS || hit.part == TREE_MOVERS;
        if (is_straight && is_around && passing <= 0.5) /* a long way may end at a bubble */
            seen.last = trace_number(hit.triangle);
        if (is_shaded && is_first && !trace_eye_is_inside() && shares.is_lit && passing == 0.0) {
            ground_begin(hit);
            trace_add(light, 0.0);
        } else if (is_first && !trace_eye_is_inside()) {
            /* the background is drawn over the picture, so a pane before objects hides nothing */
            passing = passing > 0.0 ? 1.0 : 0.0;
        } else {
            float open = 1.0;
            if (trace_has(TRACE_HAS_GROUND) && hit.triangle < 0 && way.open > 0.0)
                open = way.open;
            trace_add(open * way.weight * light, way.kind);
            seen.is_object = true;
        }
        if (is_shaded && !is_first)
            ground_gather(hit, way.weight * (1.0 - passing));
        goes_on = is_holed && passing > 0.0;
        if (goes_on) {
            way.weight *= passing;
            way.origin += hit.t * way.dir;
            way.from = hit.triangle;
            way.side = 0.0;
        }
    }
#else
    if ((!is_first || trace_eye_is_inside()) && stop_count < trace_stops_max) {
        trace_put_stop(way);
        seen.is_object = true;
        straight_end = is_straight ? way : straight_end;
    }
#endif
    return goes_on;
}

/* Follows the next of the ways that wait. Returns whether there is one. */
bool trace_next()
{
    way = later[0];
    for (int i = 0; i + 1 < trace_waits_max; i++)
        later[i] = later[i + 1];
    is_main = false;
    is_straight = false;
    waits--;
    return waits >= 0;
}

/* Goes on to the next surface. Returns whether the way has ended. */
bool trace_step(trace_hit hit, trace_cross c)
{
    if (hit.t < 1e30) {
        way.weight = trace_absorbed(way, hit.t);
        way.weight *= trace_cloud_passed(hit.t);
        seen.path += is_main && trace_is_in(way) && !is_first ? hit.t : 0.0;
    }
    way.left--;
    lengths++;
    bool crosses = c.is_met && way.left >= 0;
    bool is_over = false;
    if (crosses && !c.is_real) {
        way = trace_leave(way, hit, c, way.dir, true);
    } else if (crosses) {
        is_over = !trace_cross_surface(hit, c);
#ifndef TRACE_RAYS
        if (trace_has_left(way) && !is_over) {
            is_over = true;
            crosses = false;
        }
#endif
    }
    if (!crosses)
        is_over = !trace_arrive(hit);
    return is_over;
}

void trace_pixel(vec3 eye, vec3 e, int channel)
{
    trace_hit given;
    trace_cross given_cross;
    trace_begin(eye, e);
    bool is_given = trace_given(e, view_slant(ray), given, given_cross);
    /* groups of pixels beside rasterised objects trace nothing */
    bool is_going = !is_given || given_cross.is_met;
    while (is_going) {
        trace_hit hit = trace_meet(trace_start_of(way), !(is_first && is_given));
        trace_cross c = trace_cross_at(way, hit, channel);
        if (is_given && is_first) {
            hit = given;
            c.n = given_cross.n;
            c.facet = c.n;
            c.rank = given_cross.rank;
            c.is_met = given_cross.is_met;
            c.is_entering = true;
            c.horizon = given_cross.horizon;
            c.eta = refract_frame.etas[channel];
        }
        if (trace_step(hit, c))
            is_going = trace_next();
    }
#ifndef TRACE_RAYS
    for (int i = 0; i < stop_count; i++) {
        trace_stop stop = stops[0];
        for (int k = 1; k < trace_stops_max; k++)
            stop = k == i ? stops[k] : stop;
        trace_add(stop.weight * refract_environment(stop.origin, stop.dir), stop.kind);
    }
#endif
}

#include "trace_colors.glsl"

/* Returns the picture's depth of a point. */
float trace_depth(vec3 point)
{
    vec4 clip = refract_frame.clip_from_world * vec4(point, 1.0);
    return clamp(clip.z / clip.w, 0.0, 1.0);
}

#if defined(REFRACT_LAYERS)
#include "trace_layers.glsl"
#elif defined(TRACE_PHOTONS)
#include "trace_photons.glsl"
#else
#include "trace_picture.glsl"
#endif
