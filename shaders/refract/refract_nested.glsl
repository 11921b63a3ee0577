/*
 * refract_nested.glsl: follows light through nested objects in their depth layers (ice_nested.h).
 *
 * A ray is in one level of nesting until it leaves it or enters the next. At each face the
 * refracted ray is followed, and the reflected one is pushed onto a stack of pending rays if its
 * throughput is high enough; otherwise it is given the mean radiance of the surroundings. Rays that
 * leave the outermost level look up the environment after all rays of the pixel have ended, because
 * lavapipe executes both sides of branches (Mesa 22.3).
 */
#ifndef REFRACT_NESTED_GLSL
#define REFRACT_NESTED_GLSL
#include "ice/ice_nested.h"
#include "lib/depth_map_bilinear.glsl"
#include "refract/refract_bounce.h"
#include "refract/refract_exit_bracket.glsl"

layout(push_constant, scalar) uniform Push
{
    refract_bounce_params params;
};

layout(set = 0, binding = ICE_NESTED_DEPTHS) uniform sampler2DArray depths;
layout(set = 0, binding = ICE_NESTED_NORMALS) uniform sampler2DArray normals;

layout(set = 0, binding = ICE_NESTED_MEDIA, scalar) uniform Media
{
    ice_nested_media media;
};

layout(location = REFRACT_FULLSCREEN_MEAN) flat in vec3 mean; /* surroundings' radiance */

#include "refract/refract_bubbles.glsl"

const float nested_start = 0.01;          /* marching start, in bounding radii */
const float nested_throughput_min = 0.01; /* minimum throughput of reflected rays */
const int nested_pending_max = 3;
const int nested_ends_max = 6;
const int nested_segments_max = 40; /* maximum number of segments per pixel */
const uint nested_steps = 2u;       /* factor on the ray marching steps */

/* Transformation from world space to texels of the depth layers. */
struct nested_space {
    mat4 map_from_world; /* projection to texel coordinates x / w, y / w */
    vec2 texel;          /* 1 / the depth layers' size */
    float pixel_width;   /* at the front face, metres */
};

struct nested_ray {
    vec3 point, dir, throughput;
    int level;
    ivec3 within; /* medium of each level that contains the ray */
    bool is_reflected;
};

/* Ray that has left all objects. */
struct nested_end {
    vec3 point, dir, throughput;
    bool is_reflected;
};

nested_ray pending[nested_pending_max]; /* stack of pending rays, the latest one first */
int pending_count;
nested_end ends[nested_ends_max];
int end_count;

nested_space nested_space_of_frame(vec3 front)
{
    mat4 m = refract_frame.clip_from_world;
    vec2 size = vec2(textureSize(depths, 0).xy);
    vec2 image_size = vec2(textureSize(shading, 0)); /* maps have a margin around it */
    for (int i = 0; i < 4; i++)
        m[i].xy = 0.5 * image_size * m[i].xy + (0.5 * size - 0.5) * m[i].w;
    return nested_space(m, 1.0 / size, bubbles_pixel_width(front));
}

/* Returns a layer's interpolated depth at a position in texels from the first texel's centre. */
float nested_depth_at(int layer, vec2 at, vec2 texel)
{
    vec2 corner = floor(at);
    vec2 fraction = at - corner;
    vec3 coords = vec3(fma(corner, texel, texel), float(layer));
    return depth_interpolate(textureGather(depths, coords), fraction);
}

/* Returns a point's signed distances to the far faces (x) and near faces (y) of a nesting level.
 * Negative is outside the level. The unit is depth times w. */
vec2 nested_signed_distances(nested_space space, int level, vec4 at)
{
    vec2 texels = at.xy / at.w;
    float near = nested_depth_at(2 * level, texels, space.texel);
    float far = nested_depth_at(2 * level + 1, texels, space.texel);
    vec2 dists = vec2(fma(-far, at.w, at.z), fma(near, at.w, -at.z));
    return at.w > 0.0 && near > 0.0 && far > 0.0 ? dists : vec2(march_outside_silhouette);
}

float nested_signed_distance(vec2 dists)
{
    return min(dists.x, dists.y);
}

/* Returns the signed distance to the nearest face of a nesting level or of the next inner level.
 * Negative is outside the level or inside the inner level. */
float nested_level_distance(nested_space space, int level, vec4 at, out bool is_in_next)
{
    float dist = nested_signed_distance(nested_signed_distances(space, level, at));
    float next = march_outside_silhouette;
    if (level + 1 < ICE_NESTED_LEVELS)
        next = nested_signed_distance(nested_signed_distances(space, level + 1, at));
    is_in_next = next >= 0.0;
    return min(dist, -next);
}

/* Returns the distance along a ray to the outermost object's bounding sphere. */
float nested_length(vec3 point, vec3 dir)
{
    vec3 from_center = point - refract_frame.center;
    float half_b = dot(from_center, dir);
    float outside = dot(from_center, from_center) - refract_frame.radius * refract_frame.radius;
    return sqrt(max(half_b * half_b - outside, 0.0)) - half_b;
}

/* Returns the last ray distance inside the ray's level (x) and the first beyond (y). Sets `enters`
 * if the ray enters the inner level. Refines by the Illinois method: if one end moves twice, the
 * signed distance at the fixed end is halved. */
vec2 nested_find_face(nested_space space, nested_ray ray, out bool enters)
{
    vec4 from = space.map_from_world * vec4(ray.point, 1.0);
    vec4 map_dir = space.map_from_world * vec4(ray.dir, 0.0);
    float first = nested_start * refract_frame.radius;
    uint steps = nested_steps * params.march.steps;
    float step_length = (max(nested_length(ray.point, ray.dir), first) - first) / float(steps);
    float exact = ldexp(step_length, -int(params.march.halvings));
    march_bracket ends = march_bracket(first, first, 0.0, 0.0, false);
    enters = false;
    for (uint i = 1u;; i++) {
        ends.beyond = first + float(i) * step_length;
        ends.distance_beyond =
            nested_level_distance(space, ray.level, fma(vec4(ends.beyond), map_dir, from), enters);
        if (ends.distance_beyond < 0.0 || i >= steps)
            break;
        ends.within = ends.beyond;
        ends.distance_within = ends.distance_beyond;
    }
    bool done = params.march.halvings == 0u;
    float moved = 0.0; /* 1: `within` moved last; -1: `beyond` */
    for (uint i = 1u;; i++) {
        bool is_in_next;
        float t = march_root(ends, 0.0);
        float dist =
            nested_level_distance(space, ray.level, fma(vec4(t), map_dir, from), is_in_next);
        if (!done && dist < 0.0) {
            ends.beyond = t;
            ends.distance_beyond = dist;
            ends.distance_within *= moved < 0.0 ? 0.5 : 1.0;
            moved = -1.0;
            enters = is_in_next;
        } else if (!done) {
            ends.within = t;
            ends.distance_within = dist;
            ends.distance_beyond *=
                moved > 0.0 && ends.distance_beyond > march_outside_silhouette ? 0.5 : 1.0;
            moved = 1.0;
        }
        done = done || ends.beyond - ends.within < exact || i >= params.march.halvings;
        if (done)
            break;
    }
    return vec2(ends.within, ends.beyond);
}

/* Returns the outward normal of the level's face that is nearest to a point. If there is no face,
 * returns 0. Sets `medium` to the medium inside the face. */
vec3 nested_normal(nested_space space, int level, vec3 point, out int medium)
{
    vec4 at = space.map_from_world * vec4(point, 1.0);
    vec2 texels = at.xy / at.w;
    vec2 dists = nested_signed_distances(space, level, at);
    int layer = 2 * level + (dists.y < dists.x ? 0 : 1);
    vec2 uv = fma(texels, space.texel, 0.5 * space.texel);
    vec3 n = textureLod(normals, vec3(uv, float(layer)), 0.0).xyz;
    ivec2 size = textureSize(normals, 0).xy;
    ivec2 nearest = clamp(ivec2(texels + 0.5), ivec2(0), size - 1);
    medium = max(int(texelFetch(normals, ivec3(nearest, layer), 0).w + 0.5) - 1, 0);
    float length2 = dot(n, n);
    return length2 > 0.0 ? n * inversesqrt(length2) : vec3(0.0);
}

/* Appends to `ends` by constant indices, since a variable index would move the array to memory. */
void nested_push_end(vec3 point, vec3 dir, vec3 throughput, bool is_reflected)
{
    for (int k = 0; k < nested_ends_max; k++)
        if (k == end_count)
            ends[k] = nested_end(point, dir, throughput, is_reflected);
    end_count++;
}

void nested_push_pending(nested_ray ray)
{
    for (int i = nested_pending_max - 1; i > 0; i--)
        pending[i] = pending[i - 1];
    pending[0] = ray;
    pending_count++;
}

nested_ray nested_pop_pending()
{
    nested_ray ray = pending[0];
    for (int i = 0; i + 1 < nested_pending_max; i++)
        pending[i] = pending[i + 1];
    pending_count--;
    return ray;
}

/* Returns true if a ray's point at distance `t` is inside the next outer level. */
bool nested_is_in(nested_space space, nested_ray ray, float t)
{
    vec4 at = space.map_from_world * vec4(fma(vec3(t), ray.dir, ray.point), 1.0);
    return nested_signed_distance(nested_signed_distances(space, ray.level - 1, at)) >= 0.0;
}

/* Face at the end of a ray segment. */
struct nested_face {
    int next;          /* level behind the face; -1: outside */
    int other;         /* medium behind the face */
    float reflectance; /* Fresnel reflectance */
    vec3 reflected, refracted;
    float segment_length;
    vec3 light; /* radiance that bubbles and the scattering medium send along the segment */
};

/*
 * Moves a ray to its next face. If the maps show no face, the ray continues straight. Where a
 * cavity and its surrounding level end together, a ray leaves both without a face, because the maps
 * show a cavity between two parts of an object only where they show both parts.
 */
nested_face nested_next_face(nested_space space, int channel, inout nested_ray ray)
{
    nested_face face;
    bool enters;
    vec2 ends = nested_find_face(space, ray, enters);
    int medium = ray.within[ray.level];
    int level = enters ? ray.level + 1 : ray.level;
    int entered;
    vec3 n = nested_normal(space, level, ray.point + (enters ? ends.y : ends.x) * ray.dir, entered);
    n = enters ? -n : n;
    int outer = ray.level > 0 ? ray.within[ray.level - 1] : 0;
    int outermost = ray.level > 1 ? ray.within[ray.level - 2] : 0;
    bool opens =
        !enters && ray.level > 0 && medium == outermost && !nested_is_in(space, ray, ends.y);
    n = opens ? vec3(0.0) : n;
    face.next = enters ? ray.level + 1 : ray.level - (opens ? 2 : 1);
    face.other = enters ? entered : opens ? outermost : outer;
    face.segment_length = ends.x;
    face.light = vec3(0.0);
    bubbles_segment segment;
    segment.from = ray.point;
    segment.dir = ray.dir;
    segment.t = ends.x;
    segment.width = space.pixel_width;
    segment.eta = frame.outside_in_air * media.ior[medium].g / media.ior[0].g;
    segment.absorb = media.absorb[medium].rgb;
#ifdef REFRACT_MEDIUM
    segment.medium = media.scattering_media[medium];
#endif
    float transmittance = 1.0;
    ray.throughput *= bubbles_gather(segment, ray.throughput, transmittance, face.light);
    ray.throughput *= transmittance;
    ray.point += ends.x * ray.dir;
    ray.throughput *= exp(-media.absorb[medium].rgb * ends.x);
    bool is_found = dot(n, ray.dir) > 0.0;
    float eta = media.ior[medium][channel] / media.ior[face.other][channel];
    face.reflectance = is_found ? optics_fresnel(ray.dir, n, eta) : 0.0;
    face.reflected = is_found ? reflect(ray.dir, n) : ray.dir;
    face.refracted = is_found ? optics_refract(ray.dir, -n, eta) : ray.dir;
    if (refract_is_below_ground(ray.point)) { /* no reflection in the ground */
        face.next = -1;
        face.reflectance = 0.0;
        face.refracted = normalize(ray.point - frame.cube_center);
    }
    return face;
}

/* Continues a ray from a face by refraction or reflection. Returns the throughput of directions
 * that are not followed, by which callers multiply the surroundings' mean radiance. If the ray
 * ends, its throughput becomes 0. */
vec3 nested_scatter(nested_face face, inout nested_ray ray)
{
    bool leaves = face.next < 0;
    bool is_total = face.reflectance >= 1.0;
    vec3 through = is_total ? vec3(0.0) : (1.0 - face.reflectance) * ray.throughput;
    nested_ray back = ray;
    back.dir = face.reflected;
    back.is_reflected = true;
    back.throughput *= face.reflectance;
    bool goes_back =
        max(back.throughput.r, max(back.throughput.g, back.throughput.b)) > nested_throughput_min;
    bool goes_through = !is_total && !leaves;
    bool is_pushed = goes_back && goes_through && pending_count < nested_pending_max;
    vec3 rest = vec3(0.0);
    if (leaves && !is_total && end_count < nested_ends_max)
        nested_push_end(ray.point, face.refracted, through, ray.is_reflected);
    else if (leaves)
        rest += through;
    if (is_pushed)
        nested_push_pending(back);
    if (goes_through) {
        rest += is_pushed ? vec3(0.0) : back.throughput;
        ray.dir = face.refracted;
        ray.throughput = through;
        if (face.next > ray.level)
            ray.within[face.next] = face.other;
        ray.level = face.next;
    } else {
        rest += goes_back ? vec3(0.0) : back.throughput;
        ray = back;
        ray.throughput *= goes_back ? 1.0 : 0.0;
    }
    return rest;
}

/* Adds a face to the recorded path, which follows the refracted direction wherever possible. */
void nested_record(nested_face face, nested_ray ray, bool is_first, inout refract_path path)
{
    bool is_total = face.reflectance >= 1.0;
    path.path += ray.within[ray.level] != 0 ? face.segment_length : 0.0;
    path.bounces += is_total ? 1.0 : 0.0;
    path.tir = is_total && is_first ? 1.0 : path.tir;
    path.point = ray.point;
    path.dir = face.refracted;
}

nested_ray nested_begin(refract_path path)
{
    ivec2 edge = (textureSize(normals, 0).xy - textureSize(shading, 0)) / 2;
    ivec2 texel = ivec2(gl_FragCoord.xy) + edge;
    int medium = int(texelFetch(normals, ivec3(texel, 0), 0).w + 0.5) - 1;
    nested_ray ray;
    ray.point = path.point;
    ray.dir = path.dir;
    ray.throughput = vec3(1.0);
    ray.level = 0;
    ray.within = ivec3(max(medium, 0), 0, 0);
    ray.is_reflected = false;
    for (int i = 0; i < nested_pending_max; i++)
        pending[i] = ray;
    for (int i = 0; i < nested_ends_max; i++)
        ends[i] = nested_end(ray.point, ray.dir, vec3(0.0), true);
    pending_count = 0;
    end_count = 0;
    return ray;
}

vec3 refract_radiance(vec3 e, vec3 n_f, int channel, out refract_path path)
{
    path = refract_leave_at_front(optics_refract(e, n_f, refract_frame.etas[channel]));
    nested_space space = nested_space_of_frame(path.point);
    nested_ray ray = nested_begin(path);
    vec3 light = vec3(0.0);
    vec3 rest = vec3(0.0);
    bool is_main = true;
    for (int segment = 0; segment < nested_segments_max; segment++) {
        nested_face face = nested_next_face(space, channel, ray);
        light += face.light;
        if (is_main)
            nested_record(face, ray, segment == 0, path);
        bool leaves = face.next < 0 && face.reflectance < 1.0;
        rest += nested_scatter(face, ray);
        is_main = is_main && !leaves;
        if (ray.throughput == vec3(0.0)) {
            is_main = false;
            if (pending_count == 0)
                break;
            ray = nested_pop_pending();
        }
    }
    rest += ray.throughput;
    for (int i = 0; i < nested_pending_max; i++)
        rest += i < pending_count ? pending[i].throughput : vec3(0.0);
    light += rest * mean;
    refract_backdrop = vec3(0.0);
    for (int i = 0; i < nested_ends_max; i++)
        if (i < end_count) {
            float backdrop;
            bool is_refracted = refract_shows_backdrop && !ends[i].is_reflected;
            light += ends[i].throughput *
                     refract_environment_seen(ends[i].point, ends[i].dir, is_refracted, backdrop);
            refract_backdrop += backdrop * ends[i].throughput;
        }
    return light;
}

#endif
