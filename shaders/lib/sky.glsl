/*
 * sky.glsl: radiance of the procedural sky in a direction, and the light it gives.
 *
 * It is no measured one: a gradient from a bright horizon to a deep zenith, a soft sun, and dark
 * ground below. Include lib/globals.glsl before.
 */
#ifndef LIB_SKY_GLSL
#define LIB_SKY_GLSL

vec3 sky_gradient(vec3 dir)
{
    vec3 horizon = vec3(0.72, 0.80, 0.90);
    vec3 zenith = vec3(0.09, 0.24, 0.62);
    vec3 ground = vec3(0.16, 0.15, 0.14);
    float up = pow(clamp(dir.y, 0.0, 1.0), 0.55);
    return dir.y >= 0.0 ? mix(horizon, zenith, up)
                        : mix(horizon, ground, smoothstep(0.0, 0.12, -dir.y));
}

vec3 sky_radiance(vec3 dir)
{
    float c = clamp(dot(dir, frame.sun_dir), 0.0, 1.0);
    float disc = smoothstep(0.99985, 0.99995, c) * 60.0;
    float glow = 0.9 * pow(c, 400.0) + 0.25 * pow(c, 24.0);
    vec3 sun = vec3(1.0, 0.93, 0.80) * (disc + glow) * frame.sun_strength;
    return frame.sky_strength * (sky_gradient(dir) + sun);
}

/* Light reflected by a matt white surface: sun without shadow, and sky from above and below. */
vec3 sky_light(vec3 normal)
{
    vec3 ambient = mix(vec3(0.20, 0.19, 0.18), vec3(0.42, 0.50, 0.62), 0.5 + 0.5 * normal.y);
    float sun = max(0.0, dot(normal, frame.sun_dir));
    return frame.sky_strength * (ambient + vec3(1.0, 0.93, 0.80) * sun * frame.sun_strength);
}

#endif
