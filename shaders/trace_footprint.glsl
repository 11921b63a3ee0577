/*
 * trace_footprint.glsl: how far the way of a neighbouring pixel is from a way that is followed, by
 * ray differentials (Igehy 1999, Tracing Ray Differentials), so that what is infinitely far away
 * is seen as blurred as the pixel sees it: drops and silhouettes spread its light widely, and a
 * few samples of a small window would show as salt.
 *
 * The neighbour is in one direction of the picture, which changes from sample to sample. It is
 * .4 (i + 1)^-.75 pixels away in sample i, so that pictures of many samples become as sharp as
 * without it. Bubbles and cracks of the ice, and normal textures, count as even.
 */
#ifndef TRACE_FOOTPRINT_GLSL
#define TRACE_FOOTPRINT_GLSL

const uint footprint_seed = 60u;
const float footprint_flat = 0.02; /* least cosine that a distance is divided by */
const float footprint_most = 2.0;  /* length of a difference */

vec3 footprint_shift, footprint_turn; /* of the pixel's ray */

/* Sets the differences of the pixel's ray, which begins at `from` in the direction `e`. */
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

/* Sets the differences of the point that a way meets and of its normal `c.n`. */
void footprint_meet(trace_way way, trace_hit hit, inout trace_cross c)
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
    float towards = min(dot(way.dir, normalize(c.facet)), -footprint_flat);
    vec3 shift = way.shift + min(hit.t, 1e6) * way.turn;
    shift -= dot(shift, normalize(c.facet)) / towards * way.dir;
    c.shift = footprint_bounded(shift);
    vec3 n = n0 + hit.u * side_1 + hit.v * side_2;
    vec3 bend = dot(row_u, c.shift) * side_1 + dot(row_v, c.shift) * side_2;
    bend = trace_posed(bend, hit.part) * inversesqrt(dot(n, n));
    bend -= dot(bend, c.n) * c.n;
    c.bend = footprint_bounded(c.is_entering ? bend : -bend);
}

/* Sets the differences of a way that goes on from a surface. */
void footprint_leave(trace_way way, trace_cross c, vec3 dir, bool is_through, inout trace_way next)
{
    if (!trace_has(TRACE_HAS_FOOTPRINT))
        return;
    float towards = -dot(way.dir, c.n);
    float change = -dot(way.turn, c.n) - dot(way.dir, c.bend);
    vec3 turn = way.turn + 2.0 * (change * c.n + towards * c.bend);
    if (is_through) {
        float on =
            max(sqrt(max(1.0 - c.eta * c.eta * (1.0 - towards * towards), 0.0)), footprint_flat);
        float along = c.eta * towards - on;
        turn = c.eta * way.turn + along * c.bend +
               (c.eta - c.eta * c.eta * towards / on) * change * c.n;
    }
    bool is_straight_on = dir == way.dir;
    next.shift = c.shift;
    next.turn = is_straight_on ? way.turn : footprint_bounded(turn);
}

#ifdef TRACE_RAYS
/* Returns the mip level of the environment picture as a way sees it. */
float footprint_lod(trace_way way)
{
    if (!trace_has(TRACE_HAS_FOOTPRINT) || is_first)
        return 0.0;
    float width = float(textureSize(environment, 0).x);
    return max(0.0, log2(max(length(way.turn) * width / 6.2831853, 1e-6)));
}
#endif

#endif
