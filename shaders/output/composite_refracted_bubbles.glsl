/* composite_refracted_bubbles.glsl: intersects refracted rays with the bubbles' depth image.
 * Used by composite.frag with BUBBLES_REFRACTED. Shades bubbles as seen along unrefracted rays. */
#ifndef COMPOSITE_REFRACTED_BUBBLES_GLSL
#define COMPOSITE_REFRACTED_BUBBLES_GLSL
#include "lib/optics.glsl"
#include "lib/primary_ray.glsl"
#include "refract/inclusion_march.glsl"

#ifdef COMPOSITE_VERTEX
#define COMPOSITE_REFRACTED_IO out
#else
#define COMPOSITE_REFRACTED_IO in
#endif

layout(location = COMPOSITE_REFRACTED) COMPOSITE_REFRACTED_IO vec3 view_ray;

/* Members of `frame`, passed as flat varyings because lavapipe fetches uniforms slowly. */
layout(location = COMPOSITE_REFRACTED + 1) COMPOSITE_REFRACTED_IO CompositeView
{
    flat mat4 clip_from_world;
    flat vec4 eye;    /* w: refractive index, outside / inside */
    flat vec4 center; /* w: radius */
    flat vec3 forward;
}

view;

#ifdef COMPOSITE_VERTEX
void view_write_varyings(vec2 corner)
{
    view_ray = primary_ray(corner);
    view.clip_from_world = frame.clip_from_world;
    view.eye = vec4(frame.eye, frame.eta);
    view.center = vec4(frame.center, frame.radius);
    view.forward = frame.forward;
}
#else
layout(set = 0, binding = COMPOSITE_FRONT_DEPTH) uniform sampler2D front_depth;
layout(set = 0, binding = COMPOSITE_SHADING) uniform sampler2D shading;
layout(set = 0, binding = COMPOSITE_BUBBLE_DEPTH) uniform sampler2D bubble_depth;

/* Projects a homogeneous point or direction to texel coordinates of the bubbles' images. */
vec4 bubble_texels(vec4 v)
{
    vec2 size = vec2(textureSize(bubble_depth, 0));
    vec4 at = view.clip_from_world * v;
    return vec4(0.5 * size * at.xy + (0.5 * size - 0.5) * at.w, at.zw);
}

vec4 refracted_bubbles(sampler2D bubbles)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(front_depth, pixel, 0).r;
    vec3 eye_to_point = primary_ray_at(view_ray, view_depth(view.clip_from_world, depth));
    vec3 point = view.eye.xyz + eye_to_point;
    vec3 dir = optics_refract(primary_ray_dir(eye_to_point), texelFetch(shading, pixel, 0).xyz,
                              view.eye.w);
    vec3 from_center = point - view.center.xyz;
    float radius = view.center.w;
    inclusion_ray ray;
    ray.from = bubble_texels(vec4(point, 1.0));
    ray.dir = bubble_texels(vec4(dir, 0.0));
    ray.depth = inclusion_depth(from_center, view.forward, radius);
    ray.depth_slope = max(0.5 * dot(dir, view.forward) / radius, 1e-3);
    ray.is_across = false;
    float half_b = dot(from_center, dir);
    float outside = dot(from_center, from_center) - radius * radius;
    float max_length = sqrt(max(half_b * half_b - outside, 0.0)) - half_b;
    float t = inclusion_find(bubble_depth, ray, max_length);
    vec4 found = texelFetch(bubbles, inclusion_texel(ray, min(t, max_length)), 0);
    return t < inclusion_none ? found : vec4(0.0);
}
#endif
#endif
