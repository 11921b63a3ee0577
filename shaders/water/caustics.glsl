/* caustics.glsl: refraction of sunlight by waves, and light map coordinates, for pool caustics. */
#ifndef CAUSTICS_GLSL
#define CAUSTICS_GLSL
#include "lib/caustics_map_coordinates.glsl"
#include "lib/optics.glsl"
#include "lib/pool_walls.glsl"
#include "water/caustics.h"
#include "water/wave_function.h"

layout(push_constant, scalar) uniform Push
{
    caustics_push push;
};

const float pi = 3.14159265358979;
const vec3 up = vec3(0.0, 0.0, 1.0);

vec3 sun_inside()
{
    return pool_sun_inside(push.water.ior);
}

vec4 map_region()
{
    return caustics_map_region(push.pool, sun_inside());
}

vec2 map_texel_size()
{
    return map_region().zw / float(CAUSTICS_SIZE);
}

/* Returns the position of a texel's centre on the plane of the floor. */
vec2 map_point(ivec2 texel)
{
    return map_region().xy + (vec2(texel) + 0.5) * map_texel_size();
}

/* Returns a random seed that differs between the samples of a pixel; 0 for the first sample. */
uint sample_seed()
{
    return floatBitsToUint(frame.sample_random) ^ floatBitsToUint(0.5);
}

/* Returns the number of light map texels that the pool's floor covers. */
float map_pool_texels()
{
    vec2 texel = map_texel_size();
    return push.pool.size * push.pool.size / (texel.x * texel.y);
}

/* Returns the Fresnel transmittance of sunlight at level water. */
float sun_entering()
{
    return 1.0 - optics_fresnel(-pool_sun_dir(), up, 1.0 / push.water.ior);
}

/* Returns two unit vectors that form an orthonormal basis with the unit vector `dir`. */
void orthonormal_basis(vec3 dir, out vec3 a, out vec3 b)
{
    a = normalize(cross(dir, abs(dir.z) < 0.9 ? up : vec3(1.0, 0.0, 0.0)));
    b = cross(dir, a);
}

/* Returns the direction to a point of the sun's disc; `at` is in the unit disc. */
vec3 sun_disc(vec2 at)
{
    vec3 a, b;
    vec3 dir = pool_sun_dir();
    orthonormal_basis(dir, a, b);
    return normalize(dir + tan(0.5 * radians(push.caustics.sun)) * (at.x * a + at.y * b));
}

/* Returns the light map coordinates where a ray lands: on the floor at `depth`, or on a sunlit
 * wall. The ray enters the water at `p`; `slope` is the ray's horizontal distance per depth. */
vec2 map_landing(vec2 p, vec2 slope, float depth)
{
    vec2 undeviated = sun_inside().xy / -sun_inside().z;
    vec2 side = 0.5 * push.pool.size * sign(undeviated);
    vec2 drop = mix(vec2(depth), (side - p) / slope, greaterThan(slope * undeviated, vec2(1e-9)));
    float at = clamp(min(drop.x, drop.y), 0.0, depth);
    return p + at * slope + (depth - at) * undeviated;
}

/* Refracts a sun ray at point p of the water surface. Returns light map coordinates in xy and flux
 * in z. Flux 1 is the light from the sun's centre that enters an equal area of level water. The
 * flux is 0 if the wave itself or the pool's rim shadows p. */
vec3 land(vec2 p, vec3 sun)
{
    vec3 wave = wave_at(push.water, p, frame.time);
    vec3 n = wave_normal(wave);
    float c = dot(n, sun);
    if (c <= 0.0) /* the wave faces away from the sun */
        return vec3(p, 0.0);
    vec3 t = refract(-sun, n, 1.0 / push.water.ior);
    float entering = 1.0 - optics_fresnel(-sun, n, 1.0 / push.water.ior);
    float flux = c / n.z / pool_sun_dir().z * entering / sun_entering();
    flux = pool_is_lit(vec3(p, wave.z), sun, push.pool.size) ? flux : 0.0;
    return vec3(map_landing(p, t.xy / max(-t.z, 0.05), push.pool.depth + wave.z), flux);
}

#endif
