#version 460
#extension GL_GOOGLE_include_directive : require
#include "caustics.glsl"

layout(local_size_x = CAUSTICS_GROUP, local_size_y = CAUSTICS_GROUP) in;
layout(set = 0, binding = CAUSTICS_RAW, r32f) uniform writeonly image2D raw;

/* Returns a random offset on the unit square for the directions of each texel and sample. */
vec2 random(uvec2 texel)
{
    uvec2 v = (texel + sample_seed()) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    return vec2(v >> 8u) / 16777216.0;
}

/* Returns the light along a ray from the floor, if it leaves the surface towards the sun: the
 * cosine at the floor times the transmittance of the surface. `dir` goes up. */
float gathered(vec2 floor_point, vec3 dir, vec3 sun_dir, float sun_radius)
{
    vec2 p = floor_point + dir.xy / dir.z * push.pool.depth;
    for (int i = 0; i < 2; i++) /* iterations of the intersection with the wave */
        p = floor_point + dir.xy / dir.z * (push.pool.depth + wave_at(push.water, p, frame.time).z);
    vec3 n = wave_normal(wave_at(push.water, p, frame.time));
    vec3 leaving = refract(dir, -n, push.water.ior); /* 0 for total reflection */
    if (!pool_is_open(p, push.pool.size) || dot(dir, n) <= 0.0 ||
        distance(leaving, sun_dir) > sun_radius)
        return 0.0;
    return (1.0 - optics_fresnel(dir, -n, push.water.ior)) * dir.z;
}

/* Directions cover the cone evenly, by Roberts' R2 sequence. Radiance in water is that in air times
 * the squared index. */
void main()
{
    uvec2 texel = gl_GlobalInvocationID.xy;
    vec2 floor_point = map_point(ivec2(texel));
    vec3 a, b;
    vec3 axis = -sun_inside();
    square_to(axis, a, b);
    vec3 sun_dir = pool_sun_dir();
    float cone = sin(0.5 * radians(push.caustics.cone));
    float sun = sin(0.25 * radians(push.caustics.sun));
    vec2 start = random(texel);
    float sum = 0.0;
    for (uint i = 0u; i < push.caustics.directions; i++) {
        vec2 u = fract(start + vec2(i * 3242174889u, i * 2447445414u) / 4294967296.0);
        float rise = 2.0 * cone * cone * u.x; /* 1 - cosine */
        float angle = 2.0 * pi * u.y;
        vec3 dir =
            (1.0 - rise) * axis + sqrt(rise * (2.0 - rise)) * (cos(angle) * a + sin(angle) * b);
        if (dir.z > 0.05)
            sum += gathered(floor_point, dir, sun_dir, 2.0 * sun);
    }
    float mean = sum / float(push.caustics.directions);
    float spread = push.water.ior * push.water.ior * cone * cone / (sun * sun);
    float light = mean * spread / (sun_dir.z * sun_entering());
    imageStore(raw, ivec2(texel), vec4(light));
}
