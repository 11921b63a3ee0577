/*
 * cracks.glsl: the position and the bumpy normal of a point of a crack.
 *
 * The roughness is the slope of value noise in the object's space, three octaves.
 */
#ifndef CRACKS_GLSL
#define CRACKS_GLSL
#include "cracks.h"
#include "lib/constants.glsl"
#include "lib/pose.glsl"

layout(location = CRACKS_POSITION) in vec3 position;
layout(location = CRACKS_NORMAL) in vec3 normal;
layout(location = CRACKS_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = CRACKS_LIGHTS) flat in vec4 lights[GLOBALS_LIGHT_COUNT];
layout(location = CRACKS_LOOK) flat in cracks_look look;

const vec4 crack_red = vec4(1.0, 0.0, 0.0, 1.0); /* colour with look.surface */

/* A point of a crack, in the object's space. */
struct crack_point {
    vec3 e; /* from the eye to it */
    vec3 n; /* towards the eye */
};

uint crack_hash(uint x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

float crack_value(uvec3 at)
{
    return float(crack_hash(at.x ^ crack_hash(at.y ^ crack_hash(at.z))) >> 8) / 8388607.5 - 1.0;
}

/* Returns the gradient of value noise with values from -1 to 1 at integer coordinates. */
vec3 crack_slope(vec3 p)
{
    uvec3 at = uvec3(ivec3(floor(p)));
    vec3 t = fract(p);
    vec3 s = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    vec3 ds = 30.0 * t * t * (t * (t - 2.0) + 1.0);
    float v[8];
    for (uint i = 0u; i < 8u; i++)
        v[i] = crack_value(at + uvec3(i & 1u, i >> 1 & 1u, i >> 2));
    vec4 across = vec4(v[1] - v[0], v[3] - v[2], v[5] - v[4], v[7] - v[6]);
    vec4 along = vec4(v[0], v[2], v[4], v[6]) + s.x * across;
    vec2 up = mix(along.xz, along.yw, s.y);
    vec2 slope_x = mix(across.xz, across.yw, s.y);
    vec2 slope_y = along.yw - along.xz;
    return ds * vec3(mix(slope_x.x, slope_x.y, s.z), mix(slope_y.x, slope_y.y, s.z), up.y - up.x);
}

crack_point crack_here()
{
    vec3 n = normalize(normal);
    vec3 slope = vec3(0.0);
    if (look.bump > 0.0)
        slope = 0.6 * crack_slope(position * 5.0) + 0.3 * crack_slope(position * 13.0 + 7.3) +
                0.15 * crack_slope(position * 31.0 + 3.7);
    crack_point c;
    c.e = normalize(eye_to_point);
    c.n = normalize(n - look.bump * (slope - dot(slope, n) * n));
    if (dot(n, c.e) > 0.0) /* cracks are visible from both sides */
        c.n = -c.n;
    return c;
}

/* Returns Blinn and Phong's highlights of the lights on the eye's side. */
float crack_highlight(crack_point c)
{
    float sum = 0.0;
    for (uint i = 0u; i < constant_lights; i++) {
        vec3 l = normalize(lights[i].xyz - eye_to_point);
        float shine = pow(max(dot(c.n, normalize(l - c.e)), 0.0), look.shininess);
        sum += dot(c.n, l) > 0.0 ? lights[i].w * shine : 0.0;
    }
    return look.strength * sum;
}
#endif
