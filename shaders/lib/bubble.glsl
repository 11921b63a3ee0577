/*
 * bubble.glsl: light that meets a sphere of thinner matter, as a bubble of air in ice is.
 *
 *   b    impact parameter in the sphere's radii, 0 to 1: the sine of the angle of incidence
 *   eta  refractive index around the sphere over the one inside, above 1
 *
 * Light stays in the plane of its ray and the sphere's centre, and turns away from the centre.
 * Turns are given as cosine and sine.
 */
#ifndef LIB_BUBBLE_GLSL
#define LIB_BUBBLE_GLSL

vec2 bubble_double(vec2 turn)
{
    return vec2(turn.x * turn.x - turn.y * turn.y, 2.0 * turn.x * turn.y);
}

/* Of the light that passes: 2 (theta_t - theta_i). For eta b <= 1: beyond that, none does. */
vec2 bubble_transmitted(float b, float eta)
{
    vec2 incident = vec2(sqrt(1.0 - b * b), b);
    vec2 inside = vec2(sqrt(max(1.0 - eta * eta * b * b, 0.0)), eta * b);
    return bubble_double(vec2(inside.x * incident.x + inside.y * incident.y,
                              inside.y * incident.x - inside.x * incident.y));
}

/* Of the light that is reflected: pi - 2 theta_i. */
vec2 bubble_reflected(float b)
{
    return bubble_double(vec2(b, sqrt(1.0 - b * b)));
}

/* A direction turned towards another, unit and square to it. */
vec3 bubble_turn(vec3 e, vec3 outward, vec2 turn)
{
    return turn.x * e + turn.y * outward;
}

/* How much of what lies behind it is replaced by what the light that passes shows: none where that
 * goes straight, all where it leaves along the surface. It is no law of nature: see bubbles.c. */
float bubble_cover(float b, float eta)
{
    return min(eta * eta * b * b, 1.0);
}

#endif
