/*
 * refract_cracks.glsl: the crack that a ray meets behind the front faces, in cracks.met.
 *
 * Error: of cracks behind each other one is met, as cracks_met.glsl tells.
 */
#ifndef REFRACT_CRACKS_GLSL
#define REFRACT_CRACKS_GLSL
#include "cracks_law.h"
#include "refract_inside.glsl"
#include "within.glsl"

layout(set = 0, binding = REFRACT_CRACKS) uniform sampler2D cracks_met;

struct cracks_hit {
    float t; /* length of the ray; within_none: it meets none */
    vec3 n;  /* unit, against the ray */
    float width;
};

cracks_hit cracks_find(march_space space, vec3 point, vec3 dir)
{
    within_ray ray;
    ray.from = space.map_from_world * vec4(point, 1.0);
    ray.way = space.map_from_world * vec4(dir, 0.0);
    ray.depth = within_depth(point - space.center, frame.forward, space.radius);
    ray.pace = max(0.5 * dot(dir, frame.forward) / space.radius, 1e-3);
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
