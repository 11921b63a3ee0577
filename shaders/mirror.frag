#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/octahedron.glsl"
#include "lib/pose.glsl"
#include "lib/view_ray.glsl"
#include "material.h"
#include "mirror.h"

layout(set = 0, binding = MIRROR_DEPTH) uniform sampler2D depths;
layout(set = 0, binding = MIRROR_SEEN) uniform sampler2D seen;
layout(set = 0, binding = MIRROR_FRONT) uniform sampler2D fronts;
layout(set = 0, binding = MIRROR_SURFACE) uniform sampler2D surfaces;
layout(set = 0, binding = MIRROR_GLOSSY) uniform sampler2D glossies;

layout(push_constant, scalar) uniform Push
{
    mirror_push push;
};

layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 color; /* is added */

const int halvings = 4;         /* of the step in which a ray meets an object */
const float cone = 0.8;         /* tangent of a reflection's half angle, for a width of 1 */
const float edge_share = 0.04;  /* of the picture: the image fades near its edges */
const float smooth_least = 0.4; /* roughness from which on the image fades */

/* The part of a mirrored ray in the objects' box: metres from its begin, and homogeneous points of
 * the picture. */
struct part {
    float enters, leaves; /* leaves <= enters: it misses the box */
    vec4 from, to;
};

vec2 picture_uv(vec4 clip)
{
    return clip.xy / clip.w * 0.5 + 0.5;
}

part part_in_box(vec3 point, vec3 dir)
{
    vec3 at = pose_to_object(point);
    vec3 along = transpose(mat3(frame.world_from_object)) * dir;
    vec3 inv = 1.0 / mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
    vec3 a = (push.box_min - at) * inv;
    vec3 b = (push.box_max - at) * inv;
    vec3 near = min(a, b), far = max(a, b);
    part p;
    p.enters = max(max(near.x, near.y), max(near.z, 0.0));
    p.leaves = min(far.x, min(far.y, far.z));
    p.from = frame.clip_from_world * vec4(point + p.enters * dir, 1.0);
    p.to = frame.clip_from_world * vec4(point + p.leaves * dir, 1.0);
    return p;
}

/* Returns how far a point is behind the objects' fronts, metres along the view's axis; below 0
 * before them, and beside them. */
float behind(vec4 clip)
{
    vec2 uv = picture_uv(clip);
    float front = texelFetch(fronts, ivec2(uv * vec2(textureSize(fronts, 0))), 0).r;
    bool is_beside =
        front <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)));
    if (is_beside)
        return -1e30;
    return view_distance(frame.clip_from_world, clip.z / clip.w) -
           view_distance(frame.clip_from_world, front);
}

/* Returns the share of a part after which the ray meets an object; above 1: none. */
float find(part p)
{
    float before = 0.0, after = 2.0;
    uint count = p.leaves > p.enters ? push.steps : 0u;
    for (uint i = 1u; i <= count && after > 1.0; i++) {
        float share = (float(i) - 0.5) / float(count);
        float deep = behind(mix(p.from, p.to, share));
        if (deep > 0.0 && deep < push.thickness)
            after = share;
        else
            before = share;
    }
    for (int i = 0; i < halvings && after <= 1.0; i++) {
        float share = 0.5 * (before + after);
        if (behind(mix(p.from, p.to, share)) > 0.0)
            after = share;
        else
            before = share;
    }
    return after;
}

/* Returns what a ray meets of the objects after a share of its part, premultiplied: the mean of as
 * many pixels as its reflection is wide. */
vec4 met(part p, float share, float roughness)
{
    vec4 clip = mix(p.from, p.to, share);
    float far = mix(p.enters, p.leaves, share);
    float distance = view_distance(frame.clip_from_world, clip.z / clip.w);
    float pixel = push.pixel * (constant_orthographic != 0u ? 1.0 : distance);
    vec2 uv = picture_uv(clip);
    vec2 to_edge = min(uv, 1.0 - uv) / edge_share;
    float fade = clamp(min(to_edge.x, to_edge.y), 0.0, 1.0);
    fade *= 1.0 - smoothstep(smooth_least, MATERIAL_ROUGH, roughness);
    float wide = 2.0 * cone * roughness * roughness * far / pixel;
    return fade * textureLod(seen, uv, log2(max(wide, 1.0)));
}

/* Returns 1 in the middle of the area that is drawn, 0 at its edges in the picture. */
float inside_area()
{
    vec2 to_min = gl_FragCoord.xy - push.area_min, to_max = push.area_max - gl_FragCoord.xy;
    vec2 at = min(to_min, to_max) / push.area_edge;
    return clamp(min(at.x, at.y), 0.0, 1.0);
}

vec3 image_on(vec4 surface, vec3 glossy, vec3 eye_to_point)
{
    vec3 dir = reflect(view_dir(eye_to_point), octahedron_dir(surface.xy));
    part p = part_in_box(frame.eye + eye_to_point, dir);
    float share = find(p);
    if (share > 1.0)
        return vec3(0.0);
    vec4 image = inside_area() * met(p, share, surface.z);
    return surface.w * image.rgb - image.a * glossy;
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, at, 0).r;
    float front = texelFetch(fronts, at, 0).r;
    vec4 surface = texelFetch(surfaces, at, 0);
    vec3 glossy = texelFetch(glossies, at, 0).rgb;
    vec3 eye_to_point = view_at(ray, view_distance(frame.clip_from_world, depth));
    vec3 image = image_on(surface, glossy, eye_to_point);
    bool is_mirror = depth > front && surface.w > 0.0 && surface.z < MATERIAL_ROUGH;
    color = is_mirror ? vec4(image, 0.0) : vec4(0.0); /* the rest is undefined */
}
