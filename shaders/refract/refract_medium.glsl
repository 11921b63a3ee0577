/*
 * refract_medium.glsl: scattering media in the raster refraction models, with REFRACT_MEDIUM.
 */
#ifndef REFRACT_MEDIUM_GLSL
#define REFRACT_MEDIUM_GLSL
#define LIT_ENVIRONMENT_BINDING MEDIUM_AROUND
#include "inclusions/medium_light.glsl"
#include "lib/pose.glsl"

/* Ray-marches a scattering medium from a world-space point along `dir` up to length `t`. Returns
 * the in-scattered radiance times `straight`, and multiplies the transmittance `straight`. */
vec3 refract_in_scatter(medium_field cloud, vec3 point, vec3 dir, float t, inout float straight)
{
    vec3 from = pose_to_object(point);
    vec3 along = pose_to_object(point + dir) - from;
    vec3 to_sun = pose_to_object(point + frame.sun_dir) - from;
    int steps = int(frame.medium_steps);
    medium_segment seen = medium_march(cloud, from, along, to_sun, dot(dir, frame.sun_dir), t,
                                       steps, cloud.extinction > 0.0 ? steps : 0);
    vec3 light = vec3(0.0);
    if (seen.depth > 0.0)
        light = straight * medium_light(seen, dir);
    straight *= exp(-seen.depth);
    return light;
}

#endif
