/*
 * refract_cracks.glsl: the crack that a part of a ray's way inside meets, in cracks.met.
 *
 * Error: the map shows cracks as the eye does. Of those behind each other it has one, as
 * cracks_met.glsl tells, and a ray that faces have reflected, which may come from behind, meets
 * that one, too. Along the picture its steps are long after a reflection: they miss narrow cracks,
 * and such as the ray crosses while it hardly grows deeper.
 */
#ifndef REFRACT_CRACKS_GLSL
#define REFRACT_CRACKS_GLSL
#include "cracks_law.h"
#include "refract_inside.glsl"
#include "within.glsl"

layout(set = 0, binding = REFRACT_CRACKS) uniform sampler2D cracks_met;

/* Cosine to the view's axis below which a ray goes across the view. Others are mostly those of the
 * eye that the surface has bent once: what they meet changes least from frame to frame if all
 * cracks are taken for level. */
const float cracks_across = 0.7;

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
