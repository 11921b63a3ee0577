/* milky_air_radiance.glsl: radiance of milky air in the ice, which air.c draws as textured planes.
 */
#ifndef MILKY_AIR_RADIANCE_GLSL
#define MILKY_AIR_RADIANCE_GLSL
#include "lib/procedural_sky.glsl"
#include "lib/specialization_constants.glsl"

/* Returns the mean radiance of the environment image, weighted by solid angle. */
vec3 air_mean(sampler2D environment)
{
    int lod = max(textureQueryLevels(environment) - 4, 0);
    ivec2 size = textureSize(environment, lod);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < size.y; y++) {
        float weight = sin((float(y) + 0.5) / float(size.y) * 3.14159265);
        for (int x = 0; x < size.x; x++)
            sum += weight * vec4(texelFetch(environment, ivec2(x, y), lod).rgb, 1.0);
    }
    return sum.rgb / sum.w;
}

/* Returns the radiance of a white medium in which multiple scattering makes light isotropic. */
vec3 air_light(sampler2D environment)
{
    if (constant_background == GLOBALS_COLOR)
        return frame.background_color;
    if (constant_background == GLOBALS_ENVIRONMENT)
        return air_mean(environment);
    return 0.5 * (sky_light(frame.sun_dir) + sky_light(-frame.sun_dir));
}

#endif
