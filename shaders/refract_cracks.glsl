/*
 * refract_cracks.glsl: intersects path segments inside the ice with the image cracks.met.
 *
 * Errors: the image holds a single crack per pixel as visible from the camera (cracks_met.glsl), so
 * hidden ones are missed and rays reflected towards the camera hit the visible one from behind.
 * After a reflection, steps across the image are long: they miss narrow cracks, and cracks crossed
 * while the ray hardly changes depth.
 */
#ifndef REFRACT_CRACKS_GLSL
#define REFRACT_CRACKS_GLSL
#include "cracks_law.h"
#include "refract_inside.glsl"
#include "within.glsl"

layout(set = 0, binding = REFRACT_CRACKS) uniform sampler2D cracks_met;

/* Cosine to the view axis below which a ray counts as crossing the view. Other rays are mostly
 * refracted once; treating cracks as level for them keeps animations stable. */
const float cracks_across = 0.7;

struct cracks_hit {
    float t; /* distance along the ray; within_none if nothing is hit */
    vec3 n;  /* unit normal on the side of the incoming ray */
    float width;
};

cracks_hit cracks_find(march_space space, vec3 point, vec3 dir)
{
    within_ray ray;
    ray.from = space.map_from_world * vec4(point, 1.0);
    ray.way = space.map_from_world * vec4(dir, 0.0);
    ray.depth = within_depth(point - space.center, frame.forward, space.radius);
    float along = dot(dir, frame.forward);
    ray.is_across = abs(along) < cracks_across;
    ray.pace = 0.5 * along / space.radius;
    ray.pace = abs(ray.pace) < 1e-3 ? 1e-3 : ray.pace;
    float t = within_find(cracks_met, ray, march_room(space, point, dir));
    vec4 met = texelFetch(cracks_met, within_texel(ray, min(t, 1e3)), 0);
    float wide = length(met.yzw);
    cracks_hit hit;
    hit.t = met.r > 0.0 ? t : within_none;
    hit.n = met.yzw / max(wide, 1e-9);
    hit.n = dot(hit.n, dir) > 0.0 ? -hit.n : hit.n;
    hit.width = wide - 1.0;
    return hit;
}

#endif
