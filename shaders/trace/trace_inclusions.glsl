/* trace_inclusions.glsl: intersects paths with the cracks and bubbles in the ice. Cracks are air
 * gaps too thin to shift light sideways. Bubbles contain the medium outside the ice. */
#ifndef TRACE_INCLUSIONS_GLSL
#define TRACE_INCLUSIONS_GLSL
#include "inclusions/cracks.h"
#include "inclusions/cracks_noise.h"
#include "inclusions/cracks_reflectance.h"
#include "trace/trace_medium_stack.glsl"

/* Returns the shading normal of a rough crack in object space. */
vec3 trace_crack_normal(vec3 n, vec3 point)
{
    vec3 perturbed = n;
    int iterations = trace.crack_rms_slope > 0.0 ? int(trace.one) : 0;
    while (iterations > 0) {
        iterations -= int(trace.one);
        perturbed = crack_perturbed(n, point / frame.radius, trace.crack_rms_slope);
    }
    return perturbed;
}

/* Returns the outward normal of a bubble at a surface point, both in object space. */
vec3 trace_bubble_normal(int triangle, vec3 point)
{
    vec4 first = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * triangle));
    vec3 from = point - first.xyz;
    if (!trace_has(TRACE_HAS_SHAPES))
        return normalize(from);
    vec4 second = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * triangle + 1));
    vec4 last = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * triangle + 2));
    return bubble_normal(from, second.xyz, first.w, last.w, second.w > 0.0);
}

/* Returns a crack's thin-film reflectance for red, green and blue. */
vec3 trace_crack_reflectance(trace_hit hit, vec3 dir, vec3 n, float eta)
{
    vec3 reflectance = vec3(0.0);
    int iterations = int(trace.one);
    while (iterations > 0) {
        iterations -= int(trace.one);
        vec3 corners;
        for (int k = 0; k < 3; k++)
            corners[k] = unpackHalf2x16(trace_corner(BVH_CORNER_WORDS * hit.triangle + k).w).y;
        float open = dot(corners, vec3(1.0 - hit.u - hit.v, hit.u, hit.v));
        reflectance =
            cracks_reflectance(min(-dot(dir, n), 1.0), eta, trace.crack_gap * sqrt(max(open, 0.0)));
    }
    return reflectance;
}

bool trace_is_crack(trace_crossing c)
{
    return trace_has(TRACE_HAS_INCLUSIONS) && c.is_inclusion && c.is_thin;
}

/* Returns the reflectance of a surface for red, green and blue, and sets `fresnel` to its mean. */
vec3 trace_reflectance(trace_hit hit, trace_crossing c, vec3 dir, inout float fresnel)
{
    vec3 reflectance = vec3(fresnel);
    if (trace_is_crack(c)) {
        reflectance = trace_crack_reflectance(hit, dir, c.n, c.eta);
        fresnel = dot(reflectance, vec3(1.0 / 3.0));
    }
    return reflectance;
}

/* Returns the hit of a path in ice or in a bubble with a crack or bubble. `n` is the crack's
 * interpolated normal in object space. `eta` is the index of ice relative to the outside. */
trace_crossing trace_inclusion_crossing(trace_path path, trace_hit hit, vec3 n, float eta)
{
    trace_crossing c;
    vec3 point = trace_unposed_point(path.origin + hit.t * path.dir, hit.bvh);
    vec3 facet = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
    c.is_thin = facet != vec3(0.0);
    if (c.is_thin) {
        n = trace_crack_normal(normalize(n), point);
    } else {
        facet = trace_bubble_normal(hit.triangle, point);
        n = facet;
    }
    c.facet = trace_posed(facet, hit.bvh);
    c.n = trace_posed(n, hit.bvh);
    float side = dot(c.facet, path.dir) < 0.0 ? 1.0 : -1.0;
    if (!c.is_thin)
        side = path.is_in_bubble ? -1.0 : 1.0;
    c.facet *= side;
    c.n *= side;
    c.n = dot(c.n, path.dir) < 0.0 ? c.n : c.facet;
    c.rank = 0u;
    c.is_hit = true;
    c.is_real = true;
    c.is_entering = side > 0.0;
    c.is_inclusion = true;
    c.is_bumpy = false;
    c.material = trace_untextured(0u);
    c.eta = path.is_in_bubble ? 1.0 / eta : eta;
    c.d_origin = path.d_origin + hit.t * path.d_dir;
    c.d_n = vec3(0.0);
    return c;
}

#endif
