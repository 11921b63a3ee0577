/* caustics_backtrace.frag: fragment shader of pool caustics by one ray from each floor texel. */
#version 460
#include "water/caustics.glsl"

layout(location = 0) out float raw;

/* Follows sunlight through level water back from the floor to the waves, which refract the ray. The
 * light is a glow that decreases with the refracted ray's angle to the sun. */
void main()
{
    vec3 inside = sun_inside();
    vec3 sun_dir = pool_sun_dir();
    vec2 p = map_point(ivec2(gl_FragCoord.xy)) + inside.xy / inside.z * push.pool.depth;
    vec3 wave = wave_at(push.water, p, frame.time);
    vec3 leaving = refract(-inside, -wave_normal(wave), push.water.ior);
    if (push.caustics.slope == CAUSTICS_PUBLISHED)
        leaving = normalize(sun_dir / sun_dir.z + vec3(wave.xy, 0.0));
    float away = distance(leaving, sun_dir) / radians(push.caustics.glow);
    raw = pool_is_lit(vec3(p, wave.z), sun_dir, push.pool.size) ? exp(-away * away) : 0.0;
}
