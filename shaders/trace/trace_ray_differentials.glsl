/*
 * trace_ray_differentials.glsl: ray differentials (Igehy 1999, Tracing Ray Differentials) that
 * select the mip level of environment lookups. Drops and silhouettes spread a pixel over a wide
 * solid angle; unfiltered lookups of a small bright window would show as fireflies.
 *
 * One differential is tracked per path, in a direction of the image plane that varies from sample
 * to sample. Its offset in sample i is 0.4 (i + 1)^-0.75 pixels, so that the filter width tends to
 * zero and the converged image is unfiltered. Bubbles, cracks and bumps count as flat.
 */
#ifndef TRACE_RAY_DIFFERENTIALS_GLSL
#define TRACE_RAY_DIFFERENTIALS_GLSL

const uint differential_seed = 60u;
const float differential_cosine_min = 0.02; /* minimum cosine of incidence in divisions */
const float differential_max = 2.0;         /* maximum length of a differential vector */

vec3 differential_origin, differential_dir; /* of primary rays */

/* Computes the differentials of the primary ray from `from` in direction `e`. */
void differential_of_pixel(vec3 from, vec3 e)
{
    differential_origin = vec3(0.0);
    differential_dir = vec3(0.0);
    if (!trace_has(TRACE_HAS_RAY_DIFFERENTIALS))
        return;
    uint seed = microfacet_hash(uint(gl_FragCoord.x), uint(gl_FragCoord.y));
    float angle = 6.2831853 *
                  microfacet_point(trace.sample_index, microfacet_hash(seed, differential_seed)).x;
    float away = 0.4 * pow(float(trace.sample_index) + 1.0, -0.75);
    vec2 aside = away * vec2(cos(angle), sin(angle));
    differential_origin = aside.x * dFdx(from) + aside.y * dFdy(from);
    differential_dir = aside.x * dFdx(e) + aside.y * dFdy(e);
}

vec3 differential_clamped(vec3 v)
{
    return v * min(1.0, differential_max * inversesqrt(max(dot(v, v), 1e-20)));
}

/* Transfers the differentials to the hit point and its shading normal `c.n`. */
void differential_transfer(trace_path path, trace_hit hit, inout trace_crossing c)
{
    c.d_origin = vec3(0.0);
    c.d_n = vec3(0.0);
    if (!trace_has(TRACE_HAS_RAY_DIFFERENTIALS))
        return;
    int triangle = max(hit.triangle, 0);
    int at = BVH_CORNER_WORDS * triangle;
    vec3 n0 = uintBitsToFloat(trace_corner(at)).xyz;
    vec3 side_1 = uintBitsToFloat(trace_corner(at + 1)).xyz - n0;
    vec3 side_2 = uintBitsToFloat(trace_corner(at + 2)).xyz - n0;
    at = BVH_TRIANGLE_WORDS * triangle;
    vec3 row_u = trace_posed(uintBitsToFloat(trace_row(at)).xyz, hit.bvh);
    vec3 row_v = trace_posed(uintBitsToFloat(trace_row(at + 1)).xyz, hit.bvh);
    float towards = min(dot(path.dir, normalize(c.facet)), -differential_cosine_min);
    vec3 d_origin = path.d_origin + min(hit.t, 1e6) * path.d_dir;
    d_origin -= dot(d_origin, normalize(c.facet)) / towards * path.dir;
    c.d_origin = differential_clamped(d_origin);
    vec3 n = n0 + hit.u * side_1 + hit.v * side_2;
    vec3 d_n = dot(row_u, c.d_origin) * side_1 + dot(row_v, c.d_origin) * side_2;
    d_n = trace_posed(d_n, hit.bvh) * inversesqrt(dot(n, n));
    d_n -= dot(d_n, c.n) * c.n;
    c.d_n = differential_clamped(c.is_entering ? d_n : -d_n);
}

/* Computes the differentials of the reflected or refracted ray. */
void differential_scatter(trace_path path, trace_crossing c, vec3 dir, bool is_through,
                          inout trace_path next)
{
    if (!trace_has(TRACE_HAS_RAY_DIFFERENTIALS))
        return;
    float towards = -dot(path.dir, c.n);
    float change = -dot(path.d_dir, c.n) - dot(path.dir, c.d_n);
    vec3 d_dir = path.d_dir + 2.0 * (change * c.n + towards * c.d_n);
    if (is_through) {
        float on = max(sqrt(max(1.0 - c.eta * c.eta * (1.0 - towards * towards), 0.0)),
                       differential_cosine_min);
        float along = c.eta * towards - on;
        d_dir = c.eta * path.d_dir + along * c.d_n +
                (c.eta - c.eta * c.eta * towards / on) * change * c.n;
    }
    bool is_undeflected = dir == path.dir;
    next.d_origin = c.d_origin;
    next.d_dir = is_undeflected ? path.d_dir : differential_clamped(d_dir);
}

#ifdef TRACE_RAYS
/* Returns the mip level at which a path looks up the environment map. */
float differential_lod(trace_path path)
{
    if (!trace_has(TRACE_HAS_RAY_DIFFERENTIALS) || is_first)
        return 0.0;
    float width = float(textureSize(environment, 0).x);
    return max(0.0, log2(max(length(path.d_dir) * width / 6.2831853, 1e-6)));
}
#endif

#endif
