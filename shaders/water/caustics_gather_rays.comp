/* caustics_gather_rays.comp: compute shader of pool caustics by many rays from each ground texel.
 */
#version 460
#include "water/caustics.glsl"

layout(local_size_x = CAUSTICS_GROUP_2D, local_size_y = CAUSTICS_GROUP_2D) in;
layout(set = 0, binding = CAUSTICS_RAW, r32f) uniform writeonly image2D raw;

/* Returns a random offset in the unit square for the direction samples of a texel. */
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

/* Returns the surface's Fresnel transmittance if a ray from `ground` hits the sun after refraction,
 * otherwise 0. `dir` points up. */
float gathered(vec3 ground, vec3 dir, vec3 sun_dir, float sun_radius)
{
    vec2 p = ground.xy - dir.xy / dir.z * ground.z;
    for (int i = 0; i < 2; i++) /* fixed-point iterations of the intersection with the wave */
        p = ground.xy + dir.xy / dir.z * (wave_at(push.water, p, frame.time).z - ground.z);
    vec3 wave = wave_at(push.water, p, frame.time);
    vec3 n = wave_normal(wave);
    vec3 leaving = refract(dir, -n, push.water.ior); /* 0 for total internal reflection */
    if (!pool_is_lit(vec3(p, wave.z), sun_dir, push.pool.size) || dot(dir, n) <= 0.0 ||
        distance(leaving, sun_dir) > sun_radius)
        return 0.0;
    return 1.0 - optics_fresnel(dir, -n, push.water.ior);
}

/* Gathers sunlight from directions that cover a cone around the refracted sun uniformly (Roberts'
 * R2 sequence). Radiance in water is radiance in air times the squared index of refraction. */
void main()
{
    uvec2 texel = gl_GlobalInvocationID.xy;
    vec3 a, b;
    vec3 axis = -sun_inside();
    vec2 map_pos = map_point(ivec2(texel)), facing;
    float height = caustics_map_height(push.pool, -axis, map_pos, facing);
    vec3 ground = vec3(map_pos + height / axis.z * axis.xy, height - push.pool.depth);
    vec3 n = height > 0.0 ? vec3(facing, 0.0) : up;
    orthonormal_basis(axis, a, b);
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
        if (dir.z > 0.05 && dot(dir, n) > 0.0)
            sum += gathered(ground, dir, sun_dir, 2.0 * sun) * dot(dir, n);
    }
    float mean = sum / float(push.caustics.directions);
    float spread = push.water.ior * push.water.ior * cone * cone / (sun * sun);
    float light = mean * spread * axis.z / (dot(axis, n) * sun_dir.z * sun_entering());
    imageStore(raw, ivec2(texel), vec4(light));
}
