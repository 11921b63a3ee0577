/*
 * refract_cracks.glsl: intersects path segments inside the ice with the image cracks.hits.
 *
 * Errors: the image holds a single crack per pixel as visible from the camera
 * (cracks_gbuffer.frag), so hidden ones are missed and rays reflected towards the camera hit the
 * visible one from behind. After a reflection, steps across the image are long: they miss narrow
 * cracks, and cracks crossed while the ray hardly changes depth.
 */
#ifndef REFRACT_CRACKS_GLSL
#define REFRACT_CRACKS_GLSL
#include "inclusions/cracks_reflectance.h"
#include "refract/inclusion_march.glsl"
#include "refract/refract_march_ray.glsl"

layout(set = 0, binding = REFRACT_CRACKS) uniform sampler2D cracks_hits;

/* Minimum cosine between a ray and the view axis at which cracks count as parallel to the image
 * plane. This avoids flicker in animations. At smaller cosines, cracks keep their slopes. */
const float cracks_across_cosine = 0.7;

struct cracks_hit {
    float t; /* distance along the ray, or inclusion_none */
    vec3 n;  /* unit normal facing the incoming ray */
    float width;
};

cracks_hit cracks_find(march_space space, vec3 point, vec3 dir)
{
    inclusion_ray ray;
    ray.from = space.map_from_world * vec4(point, 1.0);
    ray.dir = space.map_from_world * vec4(dir, 0.0);
    ray.depth = inclusion_depth(point - space.center, frame.forward, space.radius);
    float along = dot(dir, frame.forward);
    ray.is_across = abs(along) < cracks_across_cosine;
    ray.depth_slope = 0.5 * along / space.radius;
    ray.depth_slope = abs(ray.depth_slope) < 1e-3 ? 1e-3 : ray.depth_slope;
    float t = inclusion_find(cracks_hits, ray, march_exit_distance(space, point, dir));
    vec4 texel = texelFetch(cracks_hits, inclusion_texel(ray, min(t, 1e3)), 0);
    float normal_length = length(texel.yzw);
    cracks_hit hit;
    hit.t = texel.r > 0.0 ? t : inclusion_none;
    hit.n = texel.yzw / max(normal_length, 1e-9);
    hit.n = dot(hit.n, dir) > 0.0 ? -hit.n : hit.n;
    hit.width = normal_length - 1.0;
    return hit;
}

#endif
