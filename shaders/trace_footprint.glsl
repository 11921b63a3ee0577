/*
 * trace_footprint.glsl: ray differentials (Igehy 1999, Tracing Ray Differentials) that select the
 * mip level of environment lookups. Drops and silhouettes spread a pixel over a wide solid angle;
 * with few samples, unfiltered lookups of a small bright window would show as fireflies.
 *
 * One differential is tracked per path, in a direction of the image plane that varies from sample
 * to sample. Its offset in sample i is 0.4 (i + 1)^-0.75 pixels, so that the filter width tends to
 * zero and the converged image is as sharp as without filtering. Bubbles, cracks and bumps count as
 * flat.
 */
#ifndef TRACE_FOOTPRINT_GLSL
#define TRACE_FOOTPRINT_GLSL

const uint footprint_seed = 60u;
const float footprint_flat = 0.02; /* minimum cosine in divisions by the cosine of incidence */
const float footprint_most = 2.0;  /* maximum length of a differential vector */

vec3 footprint_shift, footprint_turn; /* differentials of the primary ray's origin and direction */

/* Computes the differentials of the primary ray from `from` in direction `e`. */
void footprint_of_pixel(vec3 from, vec3 e)
{
    footprint_shift = vec3(0.0);
    footprint_turn = vec3(0.0);
    if (!trace_has(TRACE_HAS_FOOTPRINT))
        return;
    uint seed = microfacet_hash(uint(gl_FragCoord.x), uint(gl_FragCoord.y));
    float angle =
        6.2831853 * microfacet_point(trace.sample_index, microfacet_hash(seed, footprint_seed)).x;
    float away = 0.4 * pow(float(trace.sample_index) + 1.0, -0.75);
    vec2 aside = away * vec2(cos(angle), sin(angle));
    footprint_shift = aside.x * dFdx(from) + aside.y * dFdy(from);
    footprint_turn = aside.x * dFdx(e) + aside.y * dFdy(e);
}

vec3 footprint_bounded(vec3 v)
{
    return v * min(1.0, footprint_most * inversesqrt(max(dot(v, v), 1e-20)));
}

/* Transfers the differentials to the hit point and its shading normal `c.n`. */
void footprint_meet(trace_way path, trace_hit hit, inout trace_cross c)
{
    c.shift = vec3(0.0);
    c.bend = vec3(0.0);
    if (!trace_has(TRACE_HAS_FOOTPRINT))
        return;
    int triangle = max(hit.triangle, 0);
    int at = TREE_CORNER_WORDS * triangle;
    vec3 n0 = uintBitsToFloat(trace_corner(at)).xyz;
    vec3 side_1 = uintBitsToFloat(trace_corner(at + 1)).xyz - n0;
    vec3 side_2 = uintBitsToFloat(trace_corner(at + 2)).xyz - n0;
    at = TREE_TRIANGLE_WORDS * triangle;
    vec3 row_u = trace_posed(uintBitsToFloat(trace_row(at)).xyz, hit.part);
    vec3 row_v = trace_posed(uintBitsToFloat(trace_row(at + 1)).xyz, hit.part);
    float towards = min(dot(path.dir, normalize(c.facet)), -footprint_flat);
    vec3 shift = path.shift + min(hit.t, 1e6) * path.turn;
    shift -= dot(shift, normalize(c.facet)) / towards * path.dir;
    c.shift = footprint_bounded(shift);
    vec3 n = n0 + hit.u * side_1 + hit.v * side_2;
    vec3 bend = dot(row_u, c.shift) * side_1 + dot(row_v, c.shift) * side_2;
    bend = trace_posed(bend, hit.part) * inversesqrt(dot(n, n));
    bend -= dot(bend, c.n) * c.n;
    c.bend = footprint_bounded(c.is_entering ? bend : -bend);
}

/* Computes the differentials of the reflected or refracted ray. */
void footprint_leave(trace_way path, trace_cross c, vec3 dir, bool is_through, inout trace_way next)
{
    if (!trace_has(TRACE_HAS_FOOTPRINT))
        return;
    float towards = -dot(path.dir, c.n);
    float change = -dot(path.turn, c.n) - dot(path.dir, c.bend);
    vec3 turn = path.turn + 2.0 * (change * c.n + towards * c.bend);
    if (is_through) {
        float on =
            max(sqrt(max(1.0 - c.eta * c.eta * (1.0 - towards * towards), 0.0)), footprint_flat);
        float along = c.eta * towards - on;
        turn = c.eta * path.turn + along * c.bend +
               (c.eta - c.eta * c.eta * towards / on) * change * c.n;
    }
    bool is_straight_on = dir == path.dir;
    next.shift = c.shift;
    next.turn = is_straight_on ? path.turn : footprint_bounded(turn);
}

#ifdef TRACE_RAYS
/* Returns the mip level at which a path looks up the environment map. */
float footprint_lod(trace_way path)
{
    if (!trace_has(TRACE_HAS_FOOTPRINT) || is_first)
        return 0.0;
    float width = float(textureSize(environment, 0).x);
    return max(0.0, log2(max(length(path.turn) * width / 6.2831853, 1e-6)));
}
#endif

#endif
