/*
 * refract_cracks.glsl: intersects path segments inside the ice with the image cracks.hits.
 *
 * Errors: the image holds a single crack per pixel as visible from the camera (cracks_hit.frag),
 * so hidden ones are missed and rays reflected towards the camera hit the visible one from behind.
 * After a reflection, steps across the image are long: they miss narrow cracks, and cracks crossed
 * while the ray hardly changes depth.
 */
#ifndef REFRACT_CRACKS_GLSL
#define REFRACT_CRACKS_GLSL
#include "inclusions/cracks_reflectance.h"
#include "refract/inclusion_march.glsl"
#include "refract/refract_march_ray.glsl"

layout(set = 0, binding = REFRACT_CRACKS) uniform sampler2D cracks_hits;

/* Cosine to the view axis below which a ray counts as crossing the view. Other rays are mostly
 * refracted once; treating cracks as level for them keeps animations stable. */
const float cracks_across_cosine = 0.7;

struct cracks_hit {
    float t; /* distance along the ray; inclusion_none if nothing is hit */
    vec3 n;  /* unit normal on the side of the incoming ray */
    float width;
};

cracks_hit cracks_find(march_space space, vec3 point, vec3 dir)
{
    inclusion_ray ray;
    ray.from = space.map_from_world * vec4(point, 1.0);
    ray.way = space.map_from_world * vec4(dir, 0.0);
    ray.depth = inclusion_depth(point - space.center, frame.forward, space.radius);
    float along = dot(dir, frame.forward);
    ray.is_across = abs(along) < cracks_across_cosine;
    ray.pace = 0.5 * along / space.radius;
    ray.pace = abs(ray.pace) < 1e-3 ? 1e-3 : ray.pace;
    float t = inclusion_find(cracks_hits, ray, march_exit_distance(space, point, dir));
    vec4 met = texelFetch(cracks_hits, inclusion_texel(ray, min(t, 1e3)), 0);
    float wide = length(met.yzw);
    cracks_hit hit;
    hit.t = met.r > 0.0 ? t : inclusion_none;
    hit.n = met.yzw / max(wide, 1e-9);
    hit.n = dot(hit.n, dir) > 0.0 ? -hit.n : hit.n;
    hit.width = wide - 1.0;
    return hit;
}

#endif
