/*
 * bubble_deflection.glsl: deflection of light by a sphere of lower refractive index, as an air
 * bubble in ice.
 *
 * b: impact parameter in the sphere's radii, 0 to 1, the sine of the angle of incidence; eta:
 * refractive index around the sphere over the one inside, above 1.
 *
 * Light stays in the plane of the ray and the sphere's centre and is deflected away from the
 * centre. Deflection angles are stored as cosine and sine.
 */
#ifndef BUBBLE_DEFLECTION_GLSL
#define BUBBLE_DEFLECTION_GLSL

vec2 bubble_double(vec2 deflection)
{
    return vec2(deflection.x * deflection.x - deflection.y * deflection.y,
                2.0 * deflection.x * deflection.y);
}

/* Returns the deflection of transmitted light, 2 (theta_t - theta_i). The impact parameter `b` must
 * be at most 1 / `eta`, because reflection is total beyond. */
vec2 bubble_transmitted(float b, float eta)
{
    vec2 incident = vec2(sqrt(1.0 - b * b), b);
    vec2 inside = vec2(sqrt(max(1.0 - eta * eta * b * b, 0.0)), eta * b);
    return bubble_double(vec2(inside.x * incident.x + inside.y * incident.y,
                              inside.y * incident.x - inside.x * incident.y));
}

/* Returns the deflection of reflected light, pi - 2 theta_i. */
vec2 bubble_reflected(float b)
{
    return bubble_double(vec2(b, sqrt(1.0 - b * b)));
}

/* Rotates direction `e` by the deflection towards `outward`, a unit vector perpendicular to `e`. */
vec3 bubble_rotate(vec3 e, vec3 outward, vec2 deflection)
{
    return deflection.x * e + deflection.y * outward;
}

/* Returns an approximate opacity of transmitted light for compositing (see bubbles.c). The opacity
 * is 0 for undeflected light and 1 at the critical angle. */
float bubble_opacity(float b, float eta)
{
    return min(eta * eta * b * b, 1.0);
}

#endif
